"""``skyprobe.post``: what goes in, what comes out, how it fails."""

from __future__ import annotations

import ast
import inspect
import math
import pathlib
import warnings
from collections.abc import Callable
from typing import Any, Literal

import numpy
import pytest

import skyprobe as sp
from skyprobe import _core, post


@pytest.fixture
def lamp() -> numpy.ndarray[Any, Any]:
    pixels = numpy.full((48, 64, 3), 0.01, dtype=numpy.float32)
    pixels[20, 30] = 1e5
    return pixels


def test_names_and_defaults_are_documented() -> None:
    stubs = ast.parse((pathlib.Path(sp.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
    documented = {node.name: ast.get_docstring(node) for node in stubs.body if isinstance(node, ast.FunctionDef)}
    for function in (post.glare, post.point_spread_function):
        assert inspect.cleandoc(function.__doc__ or "") == documented[function.__name__]
    assert set(post.__all__) == {name for name in vars(post) if not name.startswith("_")}
    signature = inspect.signature(_core.glare)
    assert signature.parameters["size"].default == 2.0 and signature.parameters["state"].default == "auto"


def test_glare_spreads_light_and_keeps_it(lamp: numpy.ndarray[Any, Any]) -> None:
    before = lamp.copy()
    pixels, report = post.glare(lamp, field_of_view_deg=20.0, state="photopic", size=0.6, scale="blender")
    assert (lamp == before).all(), "the argument stays as it is"
    assert pixels.dtype == numpy.float32 and pixels.shape == lamp.shape
    assert pixels.sum(dtype="float64") == pytest.approx(lamp.sum(dtype="float64"), rel=1e-5)
    assert pixels[20, 30, 0] < lamp[20, 30, 0] and (pixels[21, 31] > 1.0).all()
    assert report.state == "photopic" and report.glaring_pixels == 1 and report.repairs == (0, 0, 0)
    assert report.threshold == pytest.approx(20.0 * report.mean_luminance)
    again, _ = post.glare(lamp, field_of_view_deg=20.0, state="photopic", size=0.6, scale="blender")
    other, _ = post.glare(lamp, field_of_view_deg=20.0, state="photopic", size=0.6, seed=1, scale="blender")
    assert (again == pixels).all() and (other != pixels).any()


def test_a_probe_may_turn_before_or_after() -> None:
    sky = sp.Sky.with_sun(altitude_deg=10.0, azimuth_deg=268.0, atmosphere=sp.Atmosphere(quality="draft"))
    probe = sky.render(width=128)
    pixels, report = post.glare(probe.pixels, projection="latlong", all_light=True, scale="blender")
    assert report.threshold is None and report.glaring_pixels == 128 * 64
    turned, _ = post.glare(numpy.roll(probe.pixels, 40, axis=1), projection="latlong", all_light=True, scale="blender")
    assert turned == pytest.approx(numpy.roll(pixels, 40, axis=1), rel=1e-4)


def test_values_that_are_no_light_are_told(lamp: numpy.ndarray[Any, Any]) -> None:
    lamp[3, 3] = numpy.nan
    lamp[4, 4, 1] = numpy.inf
    pixels, report = post.glare(lamp, state="mesopic", scale="blender")
    assert numpy.isfinite(pixels).all()
    assert report.repairs == (3, 1, 0) and report.too_bright == 1
    assert pixels[40, 60, 0] < 1.0


def test_the_point_spread_function_is_that_of_the_paper() -> None:
    found = post.point_spread_function("scotopic", [3.0, 12.0], [568.0])
    # checked against: equations 11 to 17 in mpmath with 30 digits
    assert found == pytest.approx(numpy.array([[16.42311489699], [0.1094412745129]]), rel=1e-12)
    assert post.point_spread_function("photopic", 1.0, [400.0, 700.0]).shape == (1, 2)
    angles = numpy.linspace(0.0, 90.0, 2_000_001)
    whole = 2.0 * math.pi * numpy.sin(numpy.radians(angles)) * post.point_spread_function("photopic", angles, 568.0)[:, 0]
    assert whole.sum() * math.radians(angles[1]) == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({"state": "day"}, "state = "),
        ({"size": 2.5}, "size = 2.5"),
        ({"projection": "mirror"}, "projection = "),
        ({"projection": "latlong"}, "projection = latlong, 64 x 48"),
        ({"field_of_view_deg": 180.0}, "field_of_view_deg = 180"),
        ({"threshold": 1.0, "all_light": True}, "threshold = 1"),
        ({"whole_pixels": True}, "whole_pixels = True"),
        ({"white_luminance": 0.0}, "white_luminance = 0"),
        ({"scale": "blender"}, "scale = blender: must be None with white_luminance"),
        ({"white_luminance": None, "scale": "Mitsuba"}, "scale = "),
    ],
)
def test_mistakes_are_told_by_name(lamp: numpy.ndarray[Any, Any], arguments: dict[str, Any], told: str) -> None:
    with pytest.raises(sp.InputError, match=f"^{told}"):
        post.glare(lamp, **({"white_luminance": 683.0} | arguments))


def test_shapes_and_cancelling(lamp: numpy.ndarray[Any, Any]) -> None:
    for wrong in (lamp[0], lamp[..., :2], "picture"):
        with pytest.raises(sp.InputError, match="^pixels = "):
            post.glare(wrong, scale="blender")
    with pytest.raises(sp.Cancelled):
        post.glare(lamp, progress=lambda stage, fraction: False, scale="blender")
    with pytest.raises(sp.InputError, match="^angles_deg = 181"):
        post.point_spread_function("photopic", [181.0], [550.0])


def test_a_scale_that_is_not_known_is_told_and_one_that_is_given_counts(lamp: numpy.ndarray[Any, Any]) -> None:
    functions: tuple[Callable[..., Any], ...] = (post.glare, post.tone_map, post.auto_exposure)
    for function in functions:
        with pytest.warns(sp.ScaleWarning, match=r"^white luminance unknown: 683 cd/m2 assumed \(scale blender\); scale= or white_luminance= says otherwise$"):
            function(lamp)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            function(lamp, scale="mitsuba")
            function(lamp, white_luminance=683.0)
            warnings.simplefilter("ignore", sp.ScaleWarning)
            function(lamp)
            warnings.simplefilter("error", sp.ScaleWarning)
            with pytest.raises(sp.ScaleWarning):
                function(lamp)
    scales: tuple[Literal["blender", "mitsuba", "luminance"], ...] = ("blender", "mitsuba", "luminance")
    meters = {scale: post.auto_exposure(lamp, scale=scale).log_average for scale in scales}
    assert meters["mitsuba"] / meters["blender"] == pytest.approx(106.857)
    assert meters["blender"] / meters["luminance"] == pytest.approx(683.0)
    assert post.auto_exposure(lamp, white_luminance=683.0).log_average == meters["blender"]
