"""Keywords of the table of parameters: what is shown of them, what is read, and how wrong ones are told."""

from __future__ import annotations

import inspect
import json
import pathlib
from typing import Any

import numpy
import pytest

import skyprobe as sp

SCHEMA = json.loads((pathlib.Path(__file__).parent.parent / "docs" / "scene.schema.json").read_text(encoding="utf-8"))


def rows(table: str) -> dict[str, Any]:
    """The parameters of a table of the scene."""
    found: dict[str, Any] = SCHEMA["properties"][table]["anyOf"][0]["properties"]
    return found


CALLS: list[tuple[Any, dict[str, Any], set[str]]] = [
    (sp.Atmosphere, rows("atmosphere"), {"cache"}),
    (sp.Night, rows("night"), set()),
    (sp.PolarisingFilter, rows("polarising_filter"), set()),
    (sp.Sky.render, rows("probe"), {"self", "polarising_filter", "tolerance", "layers", "progress"}),
]


@pytest.mark.parametrize(("call", "table", "others"), CALLS)
def test_signatures_and_docstrings_have_every_parameter(call: Any, table: dict[str, Any], others: set[str]) -> None:
    shown = inspect.signature(call).parameters
    assert set(shown) == set(table) | others
    described = (call.__doc__ or "").splitlines()
    for name, row in table.items():
        assert shown[name].kind is inspect.Parameter.KEYWORD_ONLY
        assert shown[name].default == row.get("default"), name
        assert name in described, name


def test_files_are_asked_for_as_pictures_are() -> None:
    render, save, both = (inspect.signature(call).parameters for call in (sp.Sky.render, sp.Probe.save, sp.Sky.render_to_file))
    assert set(both) == set(render) | set(save) | {"separate_layers"}
    assert all(both[name].default == shown.default for signature in (render, save) for name, shown in signature.items())


def other(row: dict[str, Any]) -> Any:
    """A value that a parameter may have and that is not its default."""
    kind = row
    while "anyOf" in kind:
        kind = kind["anyOf"][0]
    if "enum" in kind:
        return kind["enum"][-1]
    if "prefixItems" in kind:
        return tuple(other(item) for item in kind["prefixItems"])
    if kind["type"] == "array":
        return [500.0, 600.0]
    if kind["type"] == "boolean":
        return not row["default"]
    value = kind["minimum"] + 0.05 * (kind["maximum"] - kind["minimum"])
    return 4 * (int(value) // 4) + 4 if kind["type"] == "integer" else value


def test_every_keyword_of_an_air_is_read() -> None:
    for name, row in rows("atmosphere").items():
        # What would be ignored is not in a scene.
        haze = {"stratospheric_aod550": 0.1} if name == "stratospheric_altitude_km" else {}
        air = sp.Atmosphere(**haze, **{name: other(row)})
        scene = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0, atmosphere=air).scene
        read = scene.to_dict()["atmosphere"] if scene is not None else None
        assert isinstance(read, dict) and read[name] == other(row) != row.get("default"), name


@pytest.mark.parametrize(("call", "table"), [(sp.Night, "night"), (sp.PolarisingFilter, "polarising_filter")])
def test_every_keyword_is_an_attribute(call: Any, table: str) -> None:
    for name, row in rows(table).items():
        assert getattr(call(**{name: other(row)}), name) == other(row) != getattr(call(), name), name


def test_a_picture_has_what_was_asked_for() -> None:
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0, atmosphere=sp.Atmosphere(quality="draft"))
    for name, row in rows("probe").items():
        probe = sky.render(**({"width": 64} | {name: other(row)}))
        assert getattr(probe, name) == other(row) != row["default"], name
    assert sky.render(width=64).turn_deg == 0.0


def test_numbers_of_numpy_are_numbers() -> None:
    night = sp.Night(bortle=numpy.int32(3), star_limit=numpy.float32(6.5), led_share=numpy.float64(0.25))  # type: ignore[arg-type]
    assert (night.bortle, night.star_limit, night.led_share) == (3, 6.5, 0.25) and isinstance(night.bortle, int)


@pytest.mark.parametrize(
    ("call", "keywords", "message"),
    [
        (sp.Night, {"bortel": 3}, r"^Night\(\) got an unexpected keyword argument 'bortel'. Did you mean 'bortle'\?$"),
        (sp.Atmosphere, {"ozone": 3}, r"^Atmosphere\(\) got an unexpected keyword argument 'ozone'. Did you mean 'ozone_du'\?$"),
        (sp.Atmosphere, {"chache": True}, r"Did you mean 'cache'\?$"),
        (sp.PolarisingFilter, {"colour": 3}, r"^PolarisingFilter\(\) got an unexpected keyword argument 'colour'$"),
    ],
)
def test_unknown_keywords_are_type_errors_that_name_the_nearest(call: Any, keywords: dict[str, Any], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        call(**keywords)
    with pytest.raises(TypeError, match="positional"):
        call(1)


def test_a_file_takes_no_layers_of_a_probe(tmp_path: pathlib.Path) -> None:
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0, atmosphere=sp.Atmosphere(quality="draft"))
    with pytest.raises(TypeError, match=r"Probe.save\(\) got an unexpected keyword argument 'layers'"):
        sky.render(width=64).save(tmp_path / "sky.exr", layers=True)  # type: ignore[call-arg]
    with pytest.raises(sp.InputError, match="exposure_stops = 50: must be a number from -20 to 20 stops"):
        sky.render_to_file(tmp_path / "sky.png", width=64, exposure_stops=50)
    for width in (65, -300, 1 << 40):
        with pytest.raises(sp.InputError, match=f"width = {width}: must be"):
            sky.sample_map(width=width)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("call", "keywords", "message"),
    [
        (sp.Atmosphere, {"ozone_du": "much"}, "ozone_du = 'much': must be a number from 0 to 1000 Dobson units"),
        (sp.Atmosphere, {"ground": [1]}, r"ground = \[1\]: must be grass, forest, .*, or a number from 0 to 1"),
        (sp.Atmosphere, {"ground": "0.3"}, 'ground = "0.3": must be one of grass'),
        (sp.Atmosphere, {"preset": None}, "preset = None: must be one of clear"),
        (sp.Atmosphere, {"polarisation": 2}, "polarisation = 2: must be True or False"),
        (sp.Atmosphere, {"wavelengths_nm": [float("nan")]}, "wavelengths_nm = NaN: must be a number from 300 to 1000 nm"),
        (sp.Night, {"star_limit": None}, r"night\.star_limit = None: must be a number from -2 to 8\.5 V"),
        (sp.Night, {"bortle": 2.5}, r"night\.bortle = 2\.5: must be a whole number from 1 to 9"),
        (sp.PolarisingFilter, {"held_towards_deg": (100, 0)}, r"polarising_filter\.held_towards_deg altitude = 100: must be"),
        (sp.PolarisingFilter, {"held_towards_deg": 3}, r"polarising_filter\.held_towards_deg = 3: must be altitude -90 to 90"),
    ],
)
def test_values_of_other_types_are_named(call: Any, keywords: dict[str, Any], message: str) -> None:
    with pytest.raises(sp.InputError, match=message):
        call(**keywords)


def test_none_is_as_left_out() -> None:
    def optional(table: str) -> dict[str, None]:
        return {name: None for name, row in rows(table).items() if "default" not in row}

    assert repr(sp.Atmosphere(**optional("atmosphere"))) == repr(sp.Atmosphere())
    for call, table in [(sp.Night, "night"), (sp.PolarisingFilter, "polarising_filter")]:
        assert repr(call(**optional(table))) == repr(call())
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0, atmosphere=sp.Atmosphere(quality="draft"))
    given, left_out = sky.render(width=64, polarising_filter=None, tolerance=None, layers=None), sky.render(width=64)
    assert (given.pixels == left_out.pixels).all()
