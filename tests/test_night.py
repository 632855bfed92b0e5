"""The night from Python: bodies, events, eclipses, layers, moonlight, and how wrong input fails."""

from __future__ import annotations

import warnings
import datetime
import pathlib
from typing import Any

import numpy
import pytest

import skyprobe as sp

LUND: dict[str, Any] = {"latitude": 55.7047, "longitude": 13.191, "elevation_m": 50.0}
PARANAL: dict[str, Any] = {"latitude": -24.6272, "longitude": -70.4042, "elevation_m": 2635.0}
MAUNA_KEA: dict[str, Any] = {"latitude": 19.8207, "longitude": -155.4681, "elevation_m": 4205.0}
# Hours from the full Moon of 2005-01-25, and of the new Moon of 2005-07-06.
FULL_MOON, NEW_MOON = "2005-01-25T00:30:00+01:00", "2005-07-06T04:00:00Z"
# Magnitude per square arcsecond of a luminance of 1 cd m-2 in V: 12.58 (Garstang 1986, PASP 98, 364, rounded as usual).
ZERO_POINT = 12.58


@pytest.fixture(scope="module")
def air() -> sp.Atmosphere:
    return sp.Atmosphere(quality="draft")


def sky_at(air: sp.Atmosphere, place: dict[str, Any], time: str, **more: Any) -> sp.Sky:
    return sp.Sky(**place, time=time, atmosphere=air, **more)


def test_the_bodies_stand_where_an_almanac_has_them(air: sp.Atmosphere) -> None:
    sky = sky_at(air, LUND, "1999-08-11T12:45:00+02:00")
    bodies = {body.name: body for body in sky.bodies()}
    assert list(bodies) == ["Sun", "Moon", "Mercury", "Venus", "Mars", "Jupiter", "Saturn", "Uranus", "Neptune"]
    # checked against: Skyfield 1.55 with JPL DE421: altitude, azimuth [degrees], distance [au], magnitude after Mallama & Hilton 2018.
    expected: dict[str, tuple[float, float, float, float | None]] = {
        "Sun": (49.281182, 169.812777, 1.013548986, None),
        "Moon": (49.167191, 169.813797, 0.002462709, None),
        "Venus": (36.653852, 157.670064, 0.300484008, -4.193),
        "Mars": (-15.154846, 100.678011, 1.068160244, 0.100),
        "Jupiter": (3.633202, 285.685295, 4.614201473, -2.527),
        "Saturn": (12.676134, 277.353575, 9.133974274, 0.247),
    }
    for name, (altitude, azimuth, distance, magnitude) in expected.items():
        assert bodies[name].altitude_deg == pytest.approx(altitude, abs=0.0006), name
        assert bodies[name].azimuth_deg == pytest.approx(azimuth, abs=0.0006), name
        assert bodies[name].distance_au == pytest.approx(distance, rel=1e-5), name
        assert magnitude is None or bodies[name].magnitude == pytest.approx(magnitude, abs=0.05), name
    assert isinstance(bodies["Moon"], sp.Moon) and not isinstance(bodies["Sun"], sp.Moon)
    assert sky.moon is not None and sky.moon.altitude_deg == bodies["Moon"].altitude_deg
    assert bodies["Sun"].phase_angle_deg is None and bodies["Sun"].illuminated_fraction is None
    venus = bodies["Venus"]
    assert venus.phase_angle_deg is not None and venus.illuminated_fraction is not None
    assert venus.illuminated_fraction == pytest.approx((1.0 + numpy.cos(numpy.radians(venus.phase_angle_deg))) / 2.0)


def test_the_moon_is_turned_and_lit_as_an_almanac_has_it(air: sp.Atmosphere) -> None:
    place = {"latitude": -77.8419, "longitude": 166.6863, "elevation_m": 10.0}
    moon = sky_at(air, place, "2026-11-22T01:00:00Z").moon
    assert moon is not None
    # checked against: Skyfield 1.55 with JPL DE421 and its orientation of the Moon.
    assert moon.distance_km == pytest.approx(374024.663, abs=2.0)
    assert moon.illuminated_fraction == pytest.approx(0.909855, abs=0.0001)
    assert moon.elongation_deg == pytest.approx(144.97841, abs=0.001)
    assert moon.angular_diameter_deg == pytest.approx(0.532297, rel=1e-3)
    assert moon.sub_observer_deg == pytest.approx((-5.8933, -6.4180), abs=0.02)
    assert moon.sub_solar_deg == pytest.approx((28.8099, -1.5368), abs=0.02)
    assert moon.bright_limb_position_angle_deg == pytest.approx(255.4821, abs=0.02)
    assert moon.bright_limb_from_zenith_deg == pytest.approx(66.7460, abs=0.02)
    assert moon.axis_position_angle_deg == pytest.approx(338.9420, abs=0.02)
    # Zenith and celestial north differ by the parallactic angle, the same for axis and limb.
    gap = moon.axis_position_angle_deg - moon.axis_from_zenith_deg
    gap -= moon.bright_limb_position_angle_deg - moon.bright_limb_from_zenith_deg
    assert (gap + 180.0) % 360.0 - 180.0 == pytest.approx(0.0, abs=1e-9)


def test_rise_and_set_are_those_of_an_almanac(air: sp.Atmosphere) -> None:
    sky = sky_at(air, {**LUND, "elevation_m": 0.0}, "2005-06-21T12:00:00+02:00")
    # checked against: Skyfield 1.55 with DE421 (tests/reference/ephemeris_rise_and_set.csv).
    expected = {
        "Moon": ("2005-06-21T20:14:43Z", None, "2005-06-21T00:48:11Z"),
        "venus": ("2005-06-21T04:01:56Z", "2005-06-21T12:43:21Z", "2005-06-21T21:23:37Z"),
    }
    for name, times in expected.items():
        found = sky.rise_and_set(name)
        for ours, theirs in zip((found.rise, found.transit, found.set), times):
            assert (ours is None) == (theirs is None), name
            if ours is not None and theirs is not None:
                assert abs(ours - datetime.datetime.fromisoformat(theirs)) <= datetime.timedelta(seconds=2), name
                assert ours.utcoffset() == datetime.timedelta(hours=2)
    assert sky.rise_and_set("Moon").up_at_midnight and sky.rise_and_set("Moon").transit_altitude_deg is None
    sun, events = sky.rise_and_set("sun"), sky.sun_events()
    assert (sun.rise, sun.transit, sun.set) == (events.sunrise, events.solar_noon, events.sunset)
    with pytest.raises(sp.InputError, match='name = "Pluto": must be Sun, Moon, Mercury, Venus'):
        sky.rise_and_set("Pluto")


def test_the_phases_of_the_moon_come_in_order(air: sp.Atmosphere) -> None:
    phases = sky_at(air, LUND, "2026-11-02T00:00:00Z").moon_phases()
    # checked against: Skyfield 1.55 with DE421 (tests/reference/ephemeris_moon_phases.csv).
    expected = [
        ("new", "2026-11-09T07:02:07Z"),
        ("first quarter", "2026-11-17T11:47:50Z"),
        ("full", "2026-11-24T14:53:34Z"),
        ("last quarter", "2026-12-01T06:08:40Z"),
    ]
    assert [name for name, _ in phases] == [name for name, _ in expected]
    for (_, ours), (_, theirs) in zip(phases, expected):
        assert abs(ours - datetime.datetime.fromisoformat(theirs)) <= datetime.timedelta(seconds=5)


def test_the_eclipse_of_1999_over_lund(air: sp.Atmosphere) -> None:
    sky = sky_at(air, LUND, "1999-08-11T12:45:00+02:00")
    eclipse = sky.solar_eclipse
    assert eclipse is not None and eclipse.kind == "partial" and sky.lunar_eclipse is None
    # checked against: shared reference, case C05: separation 0.113993 degrees; the radii of the two discs are 0.2629 and 0.2702 degrees.
    assert eclipse.separation_deg == pytest.approx(0.113993, abs=2e-4)
    assert eclipse.magnitude == pytest.approx(0.797, abs=0.002)
    assert eclipse.obscuration == pytest.approx(0.750, abs=0.005)
    # The crescent is the darker limb.
    assert 0.7 * (1.0 - eclipse.obscuration) < eclipse.visible_fraction < 1.0 - eclipse.obscuration
    assert eclipse.moon_from_zenith_deg == pytest.approx(180.33, abs=0.2)
    # The disc's light, and so its irradiance, drops by what is covered.
    before = sky_at(air, LUND, "1999-08-11T14:45:00+02:00")
    assert before.solar_eclipse is None
    dimmed, whole = sky.illuminance().direct_normal_lx, before.illuminance().direct_normal_lx
    assert dimmed / whole == pytest.approx(eclipse.visible_fraction, rel=0.03)


def test_totality_leaves_a_dark_sky_with_a_bright_horizon(air: sp.Atmosphere) -> None:
    place = {"latitude": 45.08, "longitude": 24.2917}
    sky = sky_at(air, place, "1999-08-11T11:03:07Z")
    eclipse = sky.solar_eclipse
    # checked against: NASA RP 1398 (Espenak & Anderson 1997), greatest eclipse: magnitude 1.0286.
    assert eclipse is not None and (eclipse.kind, eclipse.obscuration, eclipse.visible_fraction) == ("total", 1.0, 0.0)
    assert eclipse.magnitude == pytest.approx(1.0286, abs=0.001)
    light = sky.illuminance()
    # checked against: a few lux as eclipse watchers measure (Mollmann & Vollmer 2006, European Journal of Physics 27, 1299).
    assert light.diffuse_horizontal_lx == pytest.approx(3.0, rel=0.2)
    probe = sky.render(width=512, scale="luminance", color_space="xyz", layers={"sun": 0.0})
    assert probe.irradiance()[1] == pytest.approx(light.diffuse_horizontal_lx, rel=0.01)
    # Round the Sun's place the corona shines, in the picture and in numbers, and stars are out.
    assert sky.render(width=512, scale="luminance", color_space="xyz").irradiance()[1] == pytest.approx(light.global_horizontal_lx, rel=0.01)
    assert light.direct_horizontal_lx == pytest.approx(0.1, abs=0.03) and sky.irradiance([550.0]).direct_normal[0] > 0.0
    assert {"stars", "zodiacal"} < set(sky.layer_names)


def test_the_total_eclipse_of_the_moon_of_2018_is_dark_and_red(air: sp.Atmosphere) -> None:
    sky = sky_at(air, MAUNA_KEA, "2018-01-31T13:29:50Z")
    eclipse = sky.lunar_eclipse
    assert eclipse is not None and eclipse.kind == "total" and sky.solar_eclipse is None
    # checked against: NASA's Five Millennium Catalog (Espenak & Meeus 2009): penumbral 2.2941, umbral 1.3155.
    assert eclipse.penumbral_magnitude == pytest.approx(2.2941, abs=0.003)
    assert eclipse.umbral_magnitude == pytest.approx(1.3155, abs=0.003)
    light, two_days_later = sky.illuminance(), sky_at(air, MAUNA_KEA, "2018-02-02T13:29:50Z")
    assert two_days_later.lunar_eclipse is None
    # Danjon's scale: totality is 10 to 16 magnitudes fainter than the full Moon.
    assert 1e-7 < light.moon_normal_lx / two_days_later.illuminance().moon_normal_lx < 1e-3
    everything_else = {name: 0.0 for name in sky.layer_names if name != "moon"}
    red, _, blue = sky.render(width=512, layers=everything_else).irradiance([0.0, 0.0, 1.0])
    assert red > 2.0 * blue > 0.0


def test_the_full_moon_lights_the_ground(air: sp.Atmosphere) -> None:
    sky = sky_at(air, LUND, FULL_MOON)
    light = sky.illuminance()
    assert sky.moon is not None
    sine = numpy.sin(numpy.radians(sky.moon.apparent_altitude_deg))
    assert light.moon_horizontal_lx == pytest.approx(light.moon_normal_lx * sine, rel=1e-6)
    total = light.direct_horizontal_lx + light.moon_horizontal_lx + light.diffuse_horizontal_lx
    assert light.global_horizontal_lx == pytest.approx(total, rel=1e-12)
    # checked against: full Moon up to 0.32 lx (Kyba, Mohar & Posch 2017, Astronomy & Geophysics 58, 1.31), here at 58 degrees.
    assert 0.15 < light.global_horizontal_lx < 0.32 and light.direct_normal_lx == 0.0
    # The picture holds the same light as was computed without it.
    probe = sky.render(width=1024, scale="luminance", color_space="xyz")
    assert probe.irradiance()[1] == pytest.approx(light.global_horizontal_lx, rel=0.01)
    assert repr(light).startswith("<Illuminance on the horizontal: Sun 0.0000 lx, Moon 0.1")
    # Spectra are of the same light, and so is its polarisation.
    spectral = sky.irradiance([500.0, 550.0, 600.0])
    assert spectral.global_horizontal == pytest.approx(spectral.direct_horizontal + spectral.moon_horizontal + spectral.diffuse_horizontal, rel=1e-12)
    assert spectral.moon_horizontal == pytest.approx(spectral.moon_normal * sine, rel=1e-6) and (spectral.moon_normal > 1e-6).all()
    assert spectral.direct_normal.max() < 1e-12 < spectral.diffuse_horizontal.min()
    # A right angle from the Moon, on the other side of the zenith, where the air polarises most: across the plane through both.
    altitude, azimuth = numpy.radians([90.0 - sky.moon.altitude_deg, sky.moon.azimuth_deg + 180.0])
    across = [[numpy.cos(altitude) * numpy.sin(azimuth), numpy.cos(altitude) * numpy.cos(azimuth), numpy.sin(altitude)]]
    i, q, u = sky.stokes(across, [550.0])[0, 0]
    assert i == pytest.approx(sky.spectral_radiance(across, [550.0])[0, 0], rel=1e-12, abs=0.0)
    assert -0.9 < q / i < -0.3 and abs(u / i) < 0.01


def test_spectra_have_the_night_and_say_where_there_is_none(air: sp.Atmosphere) -> None:
    def ask(sky: sp.Sky) -> tuple[list[str], float]:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            radiance = sky.spectral_radiance([[0.0, 0.0, 1.0]], [550.0])[0, 0]
            sky.stokes([[0.0, 0.0, 1.0]], [550.0])
            sky.irradiance([550.0])
        assert all(warning.category is sp.SunlightOnlyWarning and warning.filename == __file__ for warning in caught)
        return [str(warning.message).partition(":")[0] for warning in caught], float(radiance)

    assert issubclass(sp.SunlightOnlyWarning, UserWarning)
    told, radiance = ask(sky_at(air, LUND, FULL_MOON))
    assert told == [] and radiance > 1e-8
    told, radiance = ask(sky_at(air, LUND, FULL_MOON, night=sp.Night(when="never")))
    assert told == [] and radiance < 1e-20
    noon = "2005-01-25T12:00:00+01:00"
    assert ask(sky_at(air, LUND, noon)) == ask(sky_at(air, LUND, noon, night=sp.Night(when="never")))
    assert ask(sky_at(air, LUND, noon, night=sp.Night(when="always")))[1] > ask(sky_at(air, LUND, noon))[1]
    assert ask(sp.Sky.with_sun(altitude_deg=-6.0, azimuth_deg=0.0, atmosphere=air))[0] == []
    low = sp.Sky.with_sun(altitude_deg=-30.0, azimuth_deg=0.0, atmosphere=air)
    assert ask(low)[0] == ["spectral_radiance", "stokes", "irradiance"]
    with pytest.warns(sp.SunlightOnlyWarning, match="irradiance: of sunlight alone, with the Sun at -30.00 degrees"):
        low.irradiance([550.0])
    with warnings.catch_warnings():
        warnings.simplefilter("error", sp.SunlightOnlyWarning)
        with pytest.raises(sp.SunlightOnlyWarning, match="without place and time"):
            low.spectral_radiance([[0.0, 0.0, 1.0]], [550.0])


def zenith_magnitude(sky: sp.Sky) -> float:
    """V per square arcsecond of what is between the stars, within 3 degrees of the zenith."""
    rows = sky.render(width=512, scale="luminance", color_space="xyz", layers={"stars": 0.0}).pixels[:4, :, 1].astype(float)
    weights = numpy.sin(numpy.radians((numpy.arange(4) + 0.5) * 180.0 / 256.0))
    luminance = float((rows.mean(axis=1) * weights).sum() / weights.sum())
    return float(ZERO_POINT - 2.5 * numpy.log10(luminance))


def test_a_moonless_night_is_as_dark_as_it_is_measured(air: sp.Atmosphere) -> None:
    # The zenith is 70 degrees from the ecliptic and 60 from the Milky Way.
    place, time = {"latitude": 55.0, "longitude": 0.0}, "2005-02-10T05:00:00Z"
    quiet, mean, active = (sky_at(air, place, time, night=sp.Night(solar_flux_sfu=flux)) for flux in (70.0, 130.0, 200.0))
    # checked against: Benn & Ellison 1998, New Astronomy Reviews 42, 503: V 21.9 at solar minimum at high latitudes.
    assert zenith_magnitude(quiet) == pytest.approx(21.9, abs=0.2)
    # checked against: natural nights have V 21.6 to 22.0 (Patat 2003, A&A 400, 1183: 21.6 at solar maximum; Falchi et al. 2016, Science Advances 2, e1600377: 22).
    assert zenith_magnitude(mean) == pytest.approx(21.8, abs=0.15)
    light = mean.illuminance()
    # checked against: starlit and airglow-lit ground of a moonless night, 0.0005-0.002 lx.
    assert 0.0005 < quiet.illuminance().global_horizontal_lx < light.global_horizontal_lx < 0.002
    assert active.illuminance().global_horizontal_lx > 1.1 * light.global_horizontal_lx and light.moon_normal_lx == 0.0
    # The brightness that a town is given is that of its zenith, natural light of 22.0 included: our own natural light takes the place of that.
    town = sky_at(air, place, time, night=sp.Night(zenith_brightness=18.0))
    assert zenith_magnitude(town) == pytest.approx(18.0, abs=0.03)
    assert town.illuminance().global_horizontal_lx > 20.0 * light.global_horizontal_lx


def test_night_is_switched_and_its_layers_are_named(air: sp.Atmosphere) -> None:
    by_day, by_night = "2005-01-25T12:00:00+01:00", FULL_MOON
    night = ["stars", "milky_way", "zodiacal", "airglow"]

    def names(time: str, **keywords: Any) -> set[str]:
        return set(sky_at(air, LUND, time, night=sp.Night(**keywords)).layer_names)

    assert names(by_day) == {"sky", "sun", "moon", "planets"}
    assert names(by_night) == names(by_day, when="always") == {"sky", "sun", "moon", "planets", *night}
    assert names(by_night, bortle=5) - names(by_night) == {"light_pollution"}
    assert names(by_night, when="never") == {"sky", "sun"}
    assert sky_at(air, LUND, by_day, model="preetham").layer_names == ["sky", "sun"]
    sky = sky_at(air, LUND, by_night)
    assert sky.night is not None and repr(sky.night) == repr(sp.Night())
    assert (sky.night.when, sky.night.star_limit, sky.night.solar_flux_sfu, sky.night.bortle) == ("auto", 8.5, 130.0, None)
    put = sp.Sky.with_sun(altitude_deg=-20.0, azimuth_deg=0.0, atmosphere=air)
    assert (put.moon, put.night, put.solar_eclipse, put.lunar_eclipse) == (None, None, None, None)
    assert put.layer_names == ["sky", "sun"] and [body.name for body in put.bodies()] == ["Sun"]
    for ask in (put.moon_phases, lambda: put.rise_and_set("Moon")):
        with pytest.raises(sp.InputError, match="place and time"):
            ask()


def test_layers_add_up_and_are_scaled(air: sp.Atmosphere) -> None:
    sky = sky_at(air, PARANAL, NEW_MOON, night=sp.Night(bortle=3, star_limit=6.5))
    whole = sky.render(width=128, color_space="xyz", gamut="keep").pixels.astype(float)
    parts = {
        name: sky.render(
            width=128, color_space="xyz", gamut="keep", layers={other: 0.0 for other in sky.layer_names if other != name}
        ).pixels.astype(float)
        for name in sky.layer_names
    }
    numpy.testing.assert_allclose(sum(parts.values()), whole, rtol=1e-4, atol=1e-5 * whole.mean())
    # Sun and Moon are far below the horizon: neither their discs are there nor their light in the air.
    assert {name for name, pixels in parts.items() if pixels.max() == 0.0} == {"sky", "sun", "moon"}
    twice = sky.render(width=128, color_space="xyz", gamut="keep", layers={"stars": 2.0, "milky_way": 0.5}).pixels
    numpy.testing.assert_allclose(twice, whole + parts["stars"] - 0.5 * parts["milky_way"], rtol=1e-4, atol=1e-5 * whole.mean())


def test_each_layer_can_be_a_channel(air: sp.Atmosphere, tmp_path: pathlib.Path) -> None:
    OpenEXR = pytest.importorskip("OpenEXR")
    sky = sky_at(air, PARANAL, NEW_MOON, night=sp.Night(star_limit=6.5))
    sky.render_to_file(tmp_path / "layers.exr", width=128, layers={"airglow": 0.0}, separate_layers=True)
    channels = OpenEXR.File(str(tmp_path / "layers.exr"), separate_channels=True).channels()
    expected = {f"{name}.{c}" for name in set(sky.layer_names) - {"airglow"} for c in "RGB"} | set("RGB")
    assert set(channels) == expected
    for c in "RGB":
        total = sum(channels[name].pixels.astype(float) for name in expected if name.endswith(f".{c}"))
        numpy.testing.assert_allclose(total, channels[c].pixels, rtol=1e-5, atol=1e-12)
    sky.render_to_file(tmp_path / "plain.exr", width=128, layers={"airglow": 0.0})
    assert set(OpenEXR.File(str(tmp_path / "plain.exr"), separate_channels=True).channels()) == set("RGB")
    with pytest.raises(sp.InputError, match=r"separate_layers = True: must be False for a file that is not \.exr"):
        sky.render_to_file(tmp_path / "sky.hdr", width=128, separate_layers=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["layers.exr", "plain.exr"]


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"when": "dusk"}, r'night\.when = "dusk": must be auto, always or never'),
        ({"star_limit": 9.0}, r"night\.star_limit = 9: must be a number from -2 to 8\.5"),
        ({"star_limit": float("nan")}, r"night\.star_limit = NaN: must be"),
        ({"solar_flux_sfu": 0.0}, r"night\.solar_flux_sfu = 0: must be a number from 60 to 300 solar flux units"),
        ({"zenith_brightness": 25.0}, r"night\.zenith_brightness = 25: must be a number from 15 to 22 mag arcsec-2"),
        ({"bortle": 0}, r"night\.bortle = 0: must be a whole number from 1 to 9"),
        ({"bortle": -300}, r"night\.bortle = -300: must be a whole number from 1 to 9"),
        ({"bortle": 4, "zenith_brightness": 20.0}, r"night\.bortle = given: must be left out where night\.zenith_brightness is given"),
        ({"led_share": 1.5}, r"night\.led_share = 1\.5: must be a number from 0 to 1"),
    ],
)
def test_a_wrong_night_is_named(keywords: dict[str, Any], message: str) -> None:
    with pytest.raises(sp.InputError, match=message):
        sp.Night(**keywords)


def test_wrong_layers_are_named(air: sp.Atmosphere) -> None:
    sky = sky_at(air, LUND, FULL_MOON)
    wrong: list[tuple[dict[Any, float], str]] = [
        ({"comets": 1.0}, r'layers = "comets": must be one of sky, sun, moon, stars, planets, milky_way, zodiacal, airglow, light_pollution'),
        ({"stars": -1.0}, r"layers\.stars = -1: must be a number from 0 to 1000000000"),
        ({"stars": float("nan")}, r"layers\.stars = NaN: must be"),
    ]
    for layers, message in wrong:
        with pytest.raises(sp.InputError, match=message):
            sky.render(width=64, layers=layers)
    # A layer that this sky does not have is no mistake: by day there are no stars.
    day = sky_at(air, LUND, "2005-01-25T12:00:00+01:00")
    numpy.testing.assert_array_equal(day.render(width=64, layers={"stars": 5.0}).pixels, day.render(width=64).pixels)


def test_the_moon_as_a_lamp_is_the_moon_of_the_probe(air: sp.Atmosphere) -> None:
    sky = sky_at(air, LUND, FULL_MOON)
    lamp = numpy.array(sky.moon_irradiance_rgb())
    with_moon, without = (numpy.array(sky.render(width=512, layers=layers).irradiance()) for layers in ({}, {"moon": 0.0}))
    sine = numpy.sin(numpy.radians(sky.moon.apparent_altitude_deg if sky.moon else 0.0))
    assert lamp * sine == pytest.approx(with_moon - without, rel=2e-3)
    assert 683.0 * lamp @ [0.2126, 0.7152, 0.0722] == pytest.approx(sky.illuminance().moon_normal_lx, rel=1e-3)
    never = sky_at(air, LUND, FULL_MOON, night=sp.Night(when="never"))
    assert never.moon_irradiance_rgb() == (0.0, 0.0, 0.0)
    assert sky_at(air, LUND, "2005-01-25T12:00:00+01:00").moon_irradiance_rgb() == (0.0, 0.0, 0.0)


def test_the_discs_of_sun_and_moon_are_left_out_each_by_itself(air: sp.Atmosphere) -> None:
    sky = sky_at(air, LUND, FULL_MOON)
    with_moon, without = sky.render(width=128), sky.render(width=128, moon_disc=False)
    assert with_moon.moon_disc and not without.moon_disc
    assert numpy.array_equal(without.pixels, sky.render(width=128, layers={"moon": 0.0}).pixels)
    assert numpy.array_equal(with_moon.pixels, sky.render(width=128, sun_disc=False).pixels)
    assert with_moon.pixels.mean() > 2.0 * without.pixels.mean()
