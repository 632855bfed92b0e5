"""The Python face: what goes in, what comes out, how it fails."""

from __future__ import annotations

import datetime
import pathlib
import subprocess
import sys
import warnings
from typing import Any

import numpy
import pytest

import skyprobe as sp
from skyprobe import mitsuba as sp_mitsuba

DIRECTIONS = numpy.array([[0.0, 0.0, 1.0], [0.0, -0.6, 0.8], [1.0, 0.0, 0.0]])
WAVELENGTHS_NM = numpy.array([450.0, 550.0, 650.0])


@pytest.fixture(scope="module")
def air() -> sp.Atmosphere:
    return sp.Atmosphere(quality="draft")


@pytest.fixture(scope="module")
def sky(air: sp.Atmosphere) -> sp.Sky:
    return sp.Sky(latitude=55.71, longitude=13.19, elevation_m=20, time="2005-06-21T13:00:00+02:00", atmosphere=air)


@pytest.fixture(scope="module")
def probe(sky: sp.Sky) -> sp.Probe:
    return sky.render(width=64)


def test_the_example_of_the_documentation_runs(tmp_path: pathlib.Path) -> None:
    air = sp.Atmosphere(
        preset="clear", aerosol="continental_clean", aod550=0.1, ozone_du=300, ground="grass", quality="draft", polarisation=True
    )
    sky = sp.Sky(latitude=55.71, longitude=13.19, elevation_m=20, time="2005-06-21T13:00:00+02:00", atmosphere=air)
    assert sky.sun.name == "Sun"
    assert 57.0 < sky.sun.altitude_deg < sky.sun.apparent_altitude_deg < 58.0
    assert 170.0 < sky.sun.azimuth_deg < 180.0
    assert [body.name for body in sky.bodies()][:3] == ["Sun", "Moon", "Mercury"]
    probe = sky.render(width=128, scale="blender", color_space="lin_rec709", sun_disc=True, progress=lambda stage, fraction: None)
    assert probe.pixels.shape == (64, 128, 3)
    for name in ["sky.exr", "sky.hdr", "sky.png"]:
        probe.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 100
    assert len(list(tmp_path.iterdir())) == 3


def test_arrays_have_the_documented_shapes_and_types(sky: sp.Sky, probe: sp.Probe) -> None:
    radiance = sky.spectral_radiance(DIRECTIONS, WAVELENGTHS_NM)
    assert radiance.shape == (3, 3) and radiance.dtype == numpy.float64
    assert numpy.isfinite(radiance).all() and (radiance > 0).all()
    # Anything that numpy takes will do.
    again = sky.spectral_radiance(DIRECTIONS.astype(numpy.float32).tolist(), [450, 550, 650])
    numpy.testing.assert_allclose(again, radiance, rtol=1e-4)
    irradiance = sky.irradiance(WAVELENGTHS_NM)
    for values in (irradiance.direct_normal, irradiance.direct_horizontal, irradiance.diffuse_horizontal):
        assert values.shape == (3,) and values.dtype == numpy.float64 and (values > 0).all()
    assert probe.pixels.shape == (32, 64, 3) and probe.pixels.dtype == numpy.float32
    assert probe.pixels.flags.c_contiguous
    assert (probe.width, probe.height, probe.projection, probe.rows) == (64, 32, "latlong", "centre")
    assert len(sky.sun_irradiance_rgb(scale="luminance", color_space="xyz")) == 3


def test_the_parts_of_the_light_belong_together(sky: sp.Sky) -> None:
    sine = numpy.sin(numpy.radians(sky.sun.apparent_altitude_deg))
    irradiance = sky.irradiance(WAVELENGTHS_NM)
    numpy.testing.assert_allclose(irradiance.direct_horizontal, irradiance.direct_normal * sine, rtol=2e-3)
    light = sky.illuminance()
    parts = light.direct_horizontal_lx + light.moon_horizontal_lx + light.diffuse_horizontal_lx
    assert light.global_horizontal_lx == pytest.approx(parts)
    # Y of the Sun in the three scales is the direct illuminance, by definition of the scales.
    assert sky.sun_irradiance_rgb(scale="luminance", color_space="xyz")[1] == pytest.approx(light.direct_normal_lx, rel=1e-3)
    assert sky.sun_irradiance_rgb(scale="blender", color_space="xyz")[1] * 683.0 == pytest.approx(light.direct_normal_lx, rel=1e-3)
    # The probe's own integral agrees with what was computed without it.
    probe = sky.render(width=256, scale="luminance", color_space="xyz")
    assert probe.irradiance()[1] == pytest.approx(light.global_horizontal_lx, rel=3e-3)
    assert probe.irradiance([0.0, 0.0, 2.0]) == pytest.approx(probe.irradiance())


def test_pixels_are_one_array_and_saving_sees_what_is_written_to_it(sky: sp.Sky, tmp_path: pathlib.Path) -> None:
    probe = sky.render(width=64, sun_disc=False)
    probe.save(tmp_path / "before.hdr")
    assert probe.pixels is probe.pixels
    probe.save(tmp_path / "same.hdr")
    assert (tmp_path / "same.hdr").read_bytes() == (tmp_path / "before.hdr").read_bytes()
    up = probe.irradiance()
    probe.pixels[...] *= 2.0
    assert probe.irradiance() == pytest.approx([2.0 * value for value in up])
    probe.save(tmp_path / "after.hdr")
    assert (tmp_path / "after.hdr").read_bytes() != (tmp_path / "before.hdr").read_bytes()
    probe.pixels[0, 0, 0] = numpy.nan
    with pytest.raises(sp.DataError, match="not finite"):
        probe.save(tmp_path / "nan.exr")
    assert not (tmp_path / "nan.exr").exists()


def test_pixels_outlive_their_probe(sky: sp.Sky) -> None:
    pixels = sky.render(width=64, sun_disc=False).pixels
    assert numpy.isfinite(pixels).all() and pixels.max() > 0


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"latitude": 91.0}, r"latitude = 91: must be a number from -90 to 90 degrees"),
        ({"longitude": float("nan")}, r"longitude = NaN: must be"),
        ({"elevation_m": 1e6}, r"elevation_m = 1000000: must be"),
        ({"time": "yesterday"}, r'time = "yesterday": must be'),
        ({"time": datetime.datetime(2005, 6, 21, 13)}, r"time = .*: must be a datetime with a time zone"),
        ({"time": 12}, r"time = 12: must be a text or a datetime"),
        ({"zone": "Mars/Olympus"}, r'zone = "Mars/Olympus": must be'),
        ({"sun_model": "flat"}, r'sun_model = "flat": must be iau or thesis'),
    ],
)
def test_a_wrong_place_or_time_is_named(air: sp.Atmosphere, keywords: dict[str, object], message: str) -> None:
    given: dict[str, object] = {"latitude": 55.71, "longitude": 13.19, "time": "2005-06-21T13:00:00+02:00", "atmosphere": air}
    with pytest.raises(sp.InputError, match=message) as caught:
        sp.Sky(**(given | keywords))  # type: ignore[arg-type]
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"turbidity": -1}, r"turbidity = -1: must be a number from 1 to 64"),
        ({"aod550": float("nan")}, r"aod550 = NaN: must be"),
        ({"aod550": 0.1, "turbidity": 3}, r"turbidity = 3: must be left out when aod550 is given"),
        ({"aerosol": "smoke"}, r'aerosol = "smoke": must be one of none, continental_clean'),
        ({"preset": "nice"}, r'preset = "nice": must be one of'),
        ({"relative_humidity": 100}, r"relative_humidity = 100: must be a number from 0 to 99 %"),
        ({"phase_function": "mie", "asymmetry": 0.7}, r'phase_function = "mie": must be henyey_greenstein or cornette_shanks'),
        ({"stratospheric_aod550": 2}, r"stratospheric_aod550 = 2: must be"),
        ({"stratospheric_altitude_km": 5}, r"stratospheric_altitude_km = 5: must be"),
        ({"ground": "lava"}, r'ground = "lava": must be one of'),
        ({"ground": 1.5}, r"ground = 1.5: must be"),
        ({"ground": None, "quality": "best"}, r'quality = "best": must be'),
        ({"wavelengths_nm": [500.0, 400.0]}, r"wavelengths_nm = 400: must be larger than the wavelength before it"),
    ],
)
def test_wrong_air_is_named(keywords: dict[str, object], message: str) -> None:
    with pytest.raises(sp.InputError, match=message):
        sp.Atmosphere(**keywords)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"width": 0}, r"width = 0: must be a whole number from 64 to 16384 pixels"),
        ({"width": -5}, r"width = -5: must be"),
        ({"width": 65}, r"width = 65: must be even"),
        ({"scale": "nits"}, r'scale = "nits": must be'),
        ({"color_space": "srgb"}, r'color_space = "srgb": must be'),
        ({"rows": "center"}, r'rows = "center": must be centre or corner'),
        ({"gamut": "wide"}, r'gamut = "wide": must be'),
    ],
)
def test_a_wrong_image_is_named(sky: sp.Sky, keywords: dict[str, object], message: str) -> None:
    with pytest.raises(sp.InputError, match=message):
        sky.render(**keywords)  # type: ignore[arg-type]


def test_wrong_arrays_are_named(sky: sp.Sky, probe: sp.Probe) -> None:
    wrong_directions: list[tuple[Any, str]] = [
        ([[0.0, 0.0, 2.0]], r"directions\[0\] = \(0, 0, 2\): must be a vector of length 1"),
        ([[0.0, 0.0, float("nan")]], r"directions\[0\] = "),
        ([[0.0, 1.0]], r"directions = array of shape \(1, 2\): must be an array of shape \(N, 3\)"),
        ("up", r"directions = .*must be an array of numbers"),
    ]
    for directions, message in wrong_directions:
        with pytest.raises(sp.InputError, match=message):
            sky.spectral_radiance(directions, WAVELENGTHS_NM)
    wrong_wavelengths: list[Any] = [[[550.0]], [float("nan")], [10.0]]
    for wavelengths_nm in wrong_wavelengths:
        with pytest.raises(sp.InputError, match="wavelengths_nm"):
            sky.irradiance(wavelengths_nm)
    wrong_normals: list[tuple[Any, str]] = [
        ([0.0, 0.0, 0.0], r"normal = \(0, 0, 0\): must be a vector \(east, north, up\) longer than 0"),
        ([[0.0, 0.0, 1.0], [0.0, float("nan"), 1.0]], r"normal\[1\] = \(0, NaN, 1\): must be"),
        ([[1.0, 0.0]], r"normal = array of shape \(1, 2\): must be"),
    ]
    for normal, message in wrong_normals:
        with pytest.raises(sp.InputError, match=message):
            probe.irradiance(normal)


def test_files_fail_as_files_do(sky: sp.Sky, probe: sp.Probe, tmp_path: pathlib.Path) -> None:
    with pytest.raises(OSError, match="nowhere"):
        probe.save(tmp_path / "nowhere" / "sky.exr")
    (tmp_path / "folder.exr").mkdir()
    with pytest.raises(OSError, match="directory"):
        probe.save(tmp_path / "folder.exr")
    with pytest.raises(sp.InputError, match=r"\.exr, \.hdr or \.png"):
        probe.save(tmp_path / "sky.jpg")
    with pytest.raises(sp.InputError, match="half"):
        probe.save(tmp_path / "sky.exr", half="maybe")  # type: ignore[arg-type]
    bright = sky.render(width=64)
    bright.pixels[0, 0, 0] = 1e6
    with pytest.raises(sp.InputError, match="65504"):
        bright.save(tmp_path / "sky.exr", half=True)
    assert [path.name for path in tmp_path.iterdir()] == ["folder.exr"]


def test_times_are_aware_and_the_zone_is_that_of_the_place(air: sp.Atmosphere) -> None:
    here = {"latitude": 55.71, "longitude": 13.19, "atmosphere": air}
    expected = datetime.datetime(2005, 6, 21, 11, tzinfo=datetime.timezone.utc)
    local = sp.Sky(time="2005-06-21T13:00", **here)  # type: ignore[arg-type]
    aware = sp.Sky(time=expected.astimezone(datetime.timezone(datetime.timedelta(hours=-4))), **here)  # type: ignore[arg-type]
    assert local.time == aware.time == expected
    assert local.zone == "Europe/Stockholm" and aware.zone is None
    assert local.sun.altitude_deg == aware.sun.altitude_deg
    events = local.sun_events()
    assert events.sunrise is not None and events.sunset is not None
    assert events.sunrise < events.solar_noon < events.sunset
    assert events.solar_noon.date() == datetime.date(2005, 6, 21)
    # In Lund the Sun does not sink to -18 degrees in June.
    assert events.astronomical_dusk is None


def test_what_had_to_be_assumed_about_a_time_is_a_warning(air: sp.Atmosphere) -> None:
    here = {"latitude": 55.71, "longitude": 13.19, "atmosphere": air}
    times: list[tuple[object, str, str]] = [
        ("2005-03-27T02:30", "2005-03-27T03:30:00+02:00", "does not exist in Europe/Stockholm"),
        ("2005-10-30T02:30", "2005-10-30T02:30:00+02:00", "exists twice"),
        (datetime.date(2005, 6, 21), "2005-06-21T12:00:00+02:00", "its noon"),
    ]
    for given, taken, words in times:
        with pytest.warns(sp.TimeWarning, match=words) as told:
            sky = sp.Sky(time=given, **here)  # type: ignore[arg-type]
        assert sky.time is not None and sky.time.isoformat() == taken
        assert sky.time_notice is not None and words in sky.time_notice
        # It is told where the sky is made, so that it can be filtered there.
        assert told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for text in ("2005-03-27T03:30", "2005-10-30T02:30+01:00", "now"):
            assert sp.Sky(time=text, **here).time_notice is None  # type: ignore[arg-type]
        with pytest.raises(sp.TimeWarning):
            sp.Sky(time="2005-06-21", **here)  # type: ignore[arg-type]


def test_a_sun_that_is_put_has_no_place(air: sp.Atmosphere) -> None:
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, elevation_m=100, atmosphere=air)
    assert (sky.sun.altitude_deg, sky.sun.azimuth_deg) == (30.0, 180.0)
    assert (sky.latitude, sky.time, sky.zone, sky.elevation_m) == (None, None, None, 100.0)
    assert sky.atmosphere is air
    numpy.testing.assert_allclose(sky.sun.direction, [0.0, -numpy.sqrt(0.75), 0.5], atol=1e-12)
    with pytest.raises(sp.InputError, match="place and time"):
        sky.sun_events()
    with pytest.raises(sp.InputError, match="altitude_deg = 95"):
        sp.Sky.with_sun(altitude_deg=95.0, azimuth_deg=0.0, atmosphere=air)


def test_the_command_line_is_the_same_from_python(tmp_path: pathlib.Path) -> None:
    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([sys.executable, "-m", "skyprobe", *arguments], capture_output=True, text=True, cwd=tmp_path, check=False)

    good = run("render", "--sun-altitude", "30", "--sun-azimuth", "180", "--quality", "draft", "--width", "64", "-o", "sky.exr")
    assert (good.returncode, good.stderr) == (0, "")
    assert (tmp_path / "sky.exr").is_file()
    bad = run("render", "--lat", "91", "--lon", "0", "--time", "2005-06-21T13:00Z", "-o", "bad.exr")
    assert bad.returncode == 2
    assert bad.stderr == "error: --latitude = 91: must be a number from -90 to 90 degrees\n"
    assert not (tmp_path / "bad.exr").exists()


def test_the_transform_for_mitsuba_puts_the_sky_upright_and_north_to_the_north() -> None:
    def image_direction(azimuth_deg: float, altitude_deg: float) -> numpy.ndarray:
        """Mitsuba's direction for a point of our map: u = 1/4 + azimuth / 360 = 1/2 + atan2(x, -z) / (2 pi), measured as +Z centred."""
        turn = 2.0 * numpy.pi * (0.25 + azimuth_deg / 360.0 - 0.5)
        altitude = numpy.radians(altitude_deg)
        return numpy.array([-numpy.sin(turn) * numpy.cos(altitude), numpy.sin(altitude), numpy.cos(turn) * numpy.cos(altitude)])

    z_up, y_up = sp_mitsuba.to_world()[:3, :3], sp_mitsuba.to_world("y")[:3, :3]
    for azimuth, altitude in [(0, 0), (90, 0), (180, 20), (270, 0), (37, 50)]:
        a, h = numpy.radians(azimuth), numpy.radians(altitude)
        east, north, up = numpy.sin(a) * numpy.cos(h), numpy.cos(a) * numpy.cos(h), numpy.sin(h)
        numpy.testing.assert_allclose(z_up @ image_direction(azimuth, altitude), [east, north, up], atol=1e-12)
        numpy.testing.assert_allclose(y_up @ image_direction(azimuth, altitude), [east, up, -north], atol=1e-12)
        for up_axis, expected in [("z", [north, -east, up]), ("y", [north, up, east])]:
            turned = sp_mitsuba.to_world(up_axis, north_deg=90.0)[:3, :3]
            numpy.testing.assert_allclose(turned @ image_direction(azimuth, altitude), expected, atol=1e-12)
    with pytest.raises(sp.InputError, match="up = 'x'"):
        sp_mitsuba.to_world("x")


@pytest.mark.parametrize("up", ["z", "y"])
def test_mitsuba_sees_the_sky_where_it_is(air: sp.Atmosphere, tmp_path: pathlib.Path, up: str) -> None:
    mitsuba = pytest.importorskip("mitsuba")
    mitsuba.set_variant("scalar_rgb")
    sky = sp.Sky.with_sun(altitude_deg=40.0, azimuth_deg=120.0, atmosphere=air)
    probe = sky.render(width=256, rows="corner", sun_disc=False)
    probe.save(tmp_path / "sky.exr")
    column = int((0.25 + 120.0 / 360.0) * 256)
    for source in (probe, tmp_path / "sky.exr"):
        emitter = mitsuba.load_dict(sp_mitsuba.envmap(source, up=up, scale=2.0))
        for altitude_deg in (10.0, 40.0, 80.0):
            azimuth, altitude = numpy.radians((column + 0.5) / 256 * 360.0 - 90.0), numpy.radians(altitude_deg)
            east, north, height = (
                numpy.sin(azimuth) * numpy.cos(altitude),
                numpy.cos(azimuth) * numpy.cos(altitude),
                numpy.sin(altitude),
            )
            seen = mitsuba.SurfaceInteraction3f()
            seen.wi = mitsuba.Vector3f(*[-v for v in ([east, north, height] if up == "z" else [east, height, -north])])
            row = (1.0 - altitude_deg / 90.0) * 0.5 * (probe.height - 1)
            low = int(row)
            share = row - low
            expected = 2.0 * ((1 - share) * probe.pixels[low, column] + share * probe.pixels[low + 1, column])
            numpy.testing.assert_allclose(numpy.array(emitter.eval(seen)), expected, rtol=2e-3)
    with pytest.raises(sp.InputError, match="full latlong"):
        sp_mitsuba.envmap(sky.render(width=64, projection="fisheye"))
    with pytest.warns(UserWarning, match='rows="corner"'):
        sp_mitsuba.envmap(sky.render(width=64))


@pytest.mark.parametrize("altitude_deg", [10.0, 2.0, 1.0, 0.0, -0.5, -4.0])
def test_the_sun_as_a_lamp_has_a_colour_that_renderers_can_have(air: sp.Atmosphere, altitude_deg: float) -> None:
    sky = sp.Sky.with_sun(altitude_deg=altitude_deg, azimuth_deg=0.0, atmosphere=air)
    luminance = sky.sun_irradiance_rgb(color_space="xyz")[1]
    spaces: list[Any] = ["lin_rec709", "acescg", "lin_rec2020", "xyz"]
    for color_space in spaces:
        assert min(sky.sun_irradiance_rgb(color_space=color_space)) >= 0.0
    red_green_blue = numpy.array(sky.sun_irradiance_rgb())
    assert red_green_blue @ [0.212639, 0.715169, 0.072192] == pytest.approx(luminance, rel=1e-5)
    kept = sky.sun_irradiance_rgb(gamut="keep")
    assert (min(kept) < 0.0) == (-0.8 < altitude_deg < 2.5)
    assert sky.sun_irradiance_rgb(gamut="clip") == tuple(max(value, 0.0) for value in kept)
    with pytest.raises(sp.InputError, match="gamut"):
        sky.sun_irradiance_rgb(gamut="wide")  # type: ignore[arg-type]


def test_many_planes_are_lit_at_once_as_each_alone(sky: sp.Sky) -> None:
    normals = numpy.random.default_rng(3).normal(size=(40, 3))
    for settings in ({"rows": "centre"}, {"rows": "corner"}, {"extent": "upper"}, {"projection": "fisheye"}):
        probe = sky.render(width=64, **settings)  # type: ignore[arg-type]
        together = probe.irradiance(normals)
        assert isinstance(together, numpy.ndarray) and together.shape == (40, 3) and together.dtype == numpy.float64
        alone = [probe.irradiance(normal) for normal in normals]
        assert isinstance(alone[0], tuple)
        numpy.testing.assert_array_equal(together, alone)
    one = probe.irradiance([[0.0, 0.0, 1.0]])
    assert isinstance(one, numpy.ndarray) and tuple(one[0]) == probe.irradiance() == probe.irradiance([0.0, 0.0, 2.0])
    none = probe.irradiance(numpy.empty((0, 3)))
    assert isinstance(none, numpy.ndarray) and none.shape == (0, 3)


def test_a_turned_probe_is_the_probe_rolled_and_lights_alike(sky: sp.Sky, tmp_path: pathlib.Path) -> None:
    plain, turned = sky.render(width=128), sky.render(width=128, turn_deg=360.0 * 20 / 128)
    assert (plain.turn_deg, turned.turn_deg) == (0.0, 56.25)
    numpy.testing.assert_allclose(turned.pixels, numpy.roll(plain.pixels, 20, axis=1), rtol=1e-5, atol=1e-6)
    for normal in ([0.0, 0.0, 1.0], [0.4, -0.8, 0.1]):
        assert turned.irradiance(normal) == pytest.approx(plain.irradiance(normal), rel=1e-4)
    samples = sky.sample_map(width=128, turn_deg=56.25)
    assert samples.shape == (64, 128, 3) and (samples == 255).all(axis=2).sum() > 100
    sky.render_to_file(tmp_path / "turned.exr", width=128, turn_deg=56.25)
    assert b"skyprobe.turn_deg" in (tmp_path / "turned.exr").read_bytes()
    with pytest.raises(sp.InputError, match="turn_deg = 400: must be a number from -360 to 360 degrees"):
        sky.render(width=64, turn_deg=400.0)


def test_mitsuba_turns_a_turned_probe_back(air: sp.Atmosphere, tmp_path: pathlib.Path) -> None:
    mitsuba = pytest.importorskip("mitsuba")
    mitsuba.set_variant("scalar_rgb")
    sky = sp.Sky.with_sun(altitude_deg=40.0, azimuth_deg=120.0, atmosphere=air)
    plain, turned = (sky.render(width=256, rows="corner", sun_disc=False, turn_deg=turn) for turn in (0.0, 77.3))
    sources: list[Any] = [turned]
    for name in ("sky.exr", "sky.hdr"):
        turned.save(tmp_path / name)
        sources.append(tmp_path / name)

    def seen(source: Any, direction: list[float]) -> numpy.ndarray:
        point = mitsuba.SurfaceInteraction3f()
        point.wi = mitsuba.Vector3f(*[-value for value in direction])
        return numpy.array(mitsuba.load_dict(sp_mitsuba.envmap(source)).eval(point)).ravel()

    for direction in ([0.0, 0.8, 0.6], [-0.8, 0.0, 0.6], [0.36, -0.48, 0.8]):
        for source in sources:
            numpy.testing.assert_allclose(seen(source, direction), seen(plain, direction), rtol=2e-2)
