"""Tone mapping from Python: what goes in, what comes out, how it fails."""

from __future__ import annotations

import numpy
import pytest

import skyprobe as sp
from skyprobe import post

OPERATORS = ["sky", "filmic", "aces", "exposure", "reinhard", "reinhard_local", "ashikhmin", "logarithmic", "linear"]


@pytest.fixture(scope="module")
def pixels() -> numpy.ndarray:
    sky = sp.Sky.with_sun(altitude_deg=12.0, azimuth_deg=200.0, atmosphere=sp.Atmosphere(quality="draft"))
    return sky.render(width=256).pixels


@pytest.mark.parametrize("operator", OPERATORS)
def test_every_operator_gives_codes_and_light_that_belong_together(pixels: numpy.ndarray, operator: str) -> None:
    before = pixels.copy()
    eight, report = post.tone_map(pixels, operator, projection="latlong", scale="blender")
    sixteen, _ = post.tone_map(pixels, operator, projection="latlong", bits=16, scale="blender")
    light, _ = post.tone_map(pixels, operator, projection="latlong", bits=None, scale="blender")
    assert (eight.dtype, sixteen.dtype, light.dtype) == (numpy.uint8, numpy.uint16, numpy.float32)
    assert eight.shape == sixteen.shape == light.shape == pixels.shape
    assert light.min() >= 0.0 and light.max() <= 1.0
    signal = numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * numpy.power(light, 1 / 2.4, dtype=numpy.float64) - 0.055)
    assert numpy.abs(sixteen - 65535.0 * signal).max() <= 0.52
    assert numpy.abs(eight - 255.0 * signal).max() <= 1.02
    assert report.repairs == (0, 0, 0) and report.ev100 > 5.0
    assert (pixels == before).all()


def test_numbers_and_exposures_are_taken_and_refused_by_name(pixels: numpy.ndarray) -> None:
    brighter, report = post.tone_map(pixels, exposure_stops=1.0, projection="latlong", bits=None, scale="blender")
    plain, first = post.tone_map(pixels, projection="latlong", bits=None, scale="blender")
    assert report.ev100 == pytest.approx(first.ev100 - 1.0)
    assert brighter.mean() > plain.mean()
    by_value, _ = post.tone_map(pixels, "linear", ev100=12.0, bits=None, scale="blender")
    by_camera, report = post.tone_map(pixels, "linear", aperture=8.0, shutter_s=1 / 64, iso=100.0, bits=None, scale="blender")
    assert report.ev100 == pytest.approx(12.0)
    numpy.testing.assert_allclose(by_value, by_camera)
    numpy.testing.assert_allclose(by_value, numpy.clip(pixels * 683.0 / (1.2 * 2.0**12), 0.0, 1.0), rtol=1e-5)
    for keywords, message in [
        ({"operator": "drago"}, "operator = \"drago\": must be one of sky"),
        ({"operator": "linear", "key": 1.0}, "key = 1: must be left out: the operator linear has white"),
        ({"shoulder": 9.0}, "shoulder = 9: must be a number from 0.2 to 2"),
        ({"key": "bright"}, "key = bright: must be a number"),
        ({"bits": 10}, "bits = 10: must be 8, 16 or None"),
        ({"ev100": 3.0, "aperture": 8.0}, "ev100 = 3: must be None"),
        ({"aperture": 8.0}, "shutter_s = None: must be given"),
        ({"ev100": 3.0, "exposure_stops": 1.0}, "exposure_stops = 1: must be 0"),
        ({"display": "crt"}, "display = \"crt\": must be one of srgb"),
        ({"adaptation": -1.0}, "adaptation = -1: must be"),
        ({"projection": "cube"}, "projection"),
    ]:
        with pytest.raises(sp.InputError) as caught:
            post.tone_map(pixels, scale="blender", **keywords)
        assert str(caught.value).startswith(message), str(caught.value)


def test_what_no_light_can_be_is_repaired_and_counted(pixels: numpy.ndarray) -> None:
    broken = pixels.copy()
    broken[3, 4] = [numpy.nan, numpy.inf, 1e-42]
    shown, report = post.tone_map(broken, projection="latlong", scale="blender")
    assert report.repairs == (1, 1, 1)
    assert numpy.isnan(broken[3, 4, 0])


def test_a_film_of_a_dusk_does_not_flicker(pixels: numpy.ndarray) -> None:
    eye = post.Adaptation()
    assert eye.luminance is None
    generator = numpy.random.default_rng(5)
    found = []
    for frame in range(60):
        dimmed = pixels * numpy.float32(0.8**frame * generator.uniform(0.95, 1.05))
        found.append(eye.step(post.auto_exposure(dimmed, projection="latlong", scale="blender").adaptation, 1 / 24))
    assert eye.luminance == found[-1]
    changes = numpy.diff(numpy.log(found))
    assert (changes[12:] < 0.0).all() and numpy.abs(numpy.diff(changes[12:])).max() < 0.01
    shown, report = post.tone_map(pixels, adaptation=found[-1], projection="latlong", scale="blender")
    assert report.adaptation == pytest.approx(found[-1])
    eye.reset()
    assert eye.luminance is None
    with pytest.raises(sp.InputError, match="seconds = -1"):
        eye.step(1.0, -1.0)
    assert post.Adaptation.eye().step(2.0, 0.0) == pytest.approx(2.0)


def test_meters_know_luminance_and_exposure() -> None:
    even = numpy.full((32, 64, 3), 6.0, dtype=numpy.float32)
    meter = post.auto_exposure(even, projection="latlong", scale="blender")
    assert meter.log_average == pytest.approx(6.0 * 683.0, rel=1e-5)
    assert meter.bright == meter.lowest == meter.highest == pytest.approx(meter.adaptation, rel=1e-5)
    assert meter.meter_ev100 == pytest.approx(numpy.log2(6.0 * 683.0 * 100.0 / 12.5), abs=1e-4)
    assert meter.meter_ev100 - meter.ev100 == pytest.approx(0.79, abs=0.005)


def test_a_probe_is_saved_by_any_operator(tmp_path) -> None:
    probe = sp.Sky.with_sun(altitude_deg=12.0, azimuth_deg=200.0, atmosphere=sp.Atmosphere(quality="draft")).render(width=64)
    probe.save(tmp_path / "sky.png")
    probe.save(tmp_path / "linear.png", operator="linear")
    assert (tmp_path / "sky.png").read_bytes() != (tmp_path / "linear.png").read_bytes()
    with pytest.raises(sp.InputError, match="operator"):
        probe.save(tmp_path / "no.png", operator="none")  # type: ignore[arg-type]
