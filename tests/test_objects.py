"""Objects as values: they say what they are, pickle and copy, and take what numpy users give."""

import concurrent.futures
import copy
import multiprocessing
import pickle
from typing import Any

import numpy
import pytest
import skyprobe as sp
from skyprobe import post

UP = [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]]


@pytest.fixture(scope="module")
def air() -> sp.Atmosphere:
    return sp.Atmosphere(preset="urban", aod550=0.3, ground=0.25, wavelengths_nm=[420.0, 500.0, 550.0, 660.0], quality="draft")


def profile_air() -> sp.Atmosphere:
    altitudes, wavelengths = [0.0, 2.0, 50.0], [450.0, 500.0, 600.0, 700.0]
    scattering = numpy.outer([1e-2, 8e-3, 0.0], [1.0, 0.8, 0.5, 0.3])
    angles = numpy.linspace(0.0, 180.0, 181)
    values = 1.0 + 0.3 * numpy.cos(numpy.radians(angles))
    components = [
        sp.Component(scattering=scattering, absorption=0.1 * scattering, phase=sp.Phase.rayleigh(0.03), name="air"),
        sp.Component(scattering=scattering, absorption=0.0 * scattering, phase=sp.Phase.tabulated(angles, values)),
        sp.Component(scattering=0.0 * scattering, absorption=scattering, phase=None, name="gas"),
    ]
    return sp.Atmosphere.from_profile(altitudes, wavelengths, components, solar_irradiance=1.5, ground_albedo=0.1, quality="draft")


def light(atmosphere: sp.Atmosphere) -> numpy.ndarray:
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=120.0, atmosphere=atmosphere)
    return sky.spectral_radiance(UP, [450.0, 600.0])


def test_air_pickles_with_its_light(air: sp.Atmosphere) -> None:
    for way in (lambda value: pickle.loads(pickle.dumps(value)), copy.copy, copy.deepcopy):
        numpy.testing.assert_array_equal(light(way(air)), light(air))
    # Logarithms of a table and degrees of its angles are rounded on the way.
    numpy.testing.assert_allclose(light(pickle.loads(pickle.dumps(profile_air()))), light(profile_air()), rtol=1e-9)


def test_copies_of_an_air_share_its_light_and_keep_it_scalar() -> None:
    air = sp.Atmosphere(quality="draft", polarisation=False, cache=False)
    assert copy.copy(air) is air and copy.deepcopy({"air": air})["air"] is air
    assert "polarisation=False" in repr(air) and repr(pickle.loads(pickle.dumps(air))) == repr(air)
    assert repr(eval(repr(air), {"Atmosphere": sp.Atmosphere})) == repr(air)


def test_kept_light_is_found_by_what_was_pickled(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SKYPROBE_CACHE", "on")
    monkeypatch.setenv("SKYPROBE_CACHE_DIR", str(tmp_path))
    kept = sp.Atmosphere(aod550=0.123, wavelengths_nm=[450.0, 550.0], quality="standard")
    stages: list[str] = []
    kept.solve(progress=lambda stage, _: stages.append(stage))
    assert len(stages) > 2
    stages.clear()
    assert len(list(tmp_path.iterdir())) == 1
    pickle.loads(pickle.dumps(kept)).solve(progress=lambda stage, _: stages.append(stage))
    assert len(list(tmp_path.iterdir())) == 1 and len(stages) <= 2


def test_skies_nights_and_filters_pickle(air: sp.Atmosphere) -> None:
    night = sp.Night(bortle=4, star_limit=6.5)
    skies = [
        sp.Sky(latitude=55.71, longitude=13.19, elevation_m=20.0, time="2005-01-25T00:30", atmosphere=air, night=night),
        sp.Sky(latitude=-24.6, longitude=-70.4, time="2005-06-21T15:00Z", atmosphere=air, sun_model="thesis", model="preetham"),
        sp.Sky.with_sun(altitude_deg=12.5, azimuth_deg=-20.0, elevation_m=300.0, atmosphere=air),
    ]
    for sky in skies:
        again = pickle.loads(pickle.dumps(sky))
        assert (again.time, again.zone, again.scene) == (sky.time, sky.zone, sky.scene)
        assert (repr(again), repr(again.night)) == (repr(sky), repr(sky.night))
        assert again.sun.altitude_deg == sky.sun.altitude_deg and again.elevation_m == sky.elevation_m
    numpy.testing.assert_array_equal(pickle.loads(pickle.dumps(skies[0])).render(width=64).pixels, skies[0].render(width=64).pixels)
    held = sp.PolarisingFilter(strength=0.5, angle_deg=10.0, held_towards_deg=(20.0, 90.0))
    for value in (night, sp.Night(), held, sp.PolarisingFilter()):
        assert repr(pickle.loads(pickle.dumps(value))) == repr(value) == repr(copy.deepcopy(value))


def test_probes_pickle_with_their_pixels_and_what_is_known_of_them(air: sp.Atmosphere, tmp_path: Any) -> None:
    probe = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0, atmosphere=air).render(width=64, projection="fisheye", scale="mitsuba")
    probe.pixels[3, 4] = [1.0, 2.0, 3.0]
    again = pickle.loads(pickle.dumps(probe))
    numpy.testing.assert_array_equal(again.pixels, probe.pixels)
    assert repr(again) == repr(probe) and again.scene == probe.scene
    for name, value in (("a.exr", probe), ("b.exr", again)):
        value.save(tmp_path / name)
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()
    independent = copy.deepcopy(probe)
    independent.pixels[:] = 0.0
    assert probe.pixels.max() > 0.0


def test_a_pickle_that_is_no_probe_is_refused() -> None:
    class Forged:
        def __init__(self, *arguments: object) -> None:
            self.arguments = arguments

        def __reduce__(self) -> tuple[Any, tuple[object, ...]]:
            return sp.Probe._restore, self.arguments  # type: ignore[attr-defined]

    good = numpy.zeros((32, 64, 3), numpy.float32)
    settings = '{"width": 64}'
    pickle.loads(pickle.dumps(Forged(settings, "{}", good)))
    for arguments in [
        ('{"width": 1000000}', "{}", good),
        ('{"width": 128}', "{}", good),
        ("[", "{}", good),
        (settings, '{"x": 1}', good),
        (settings, "{}", good[:, ::2]),
        (settings, "{}", good[:, ::-1]),
    ]:
        with pytest.raises(sp.InputError):
            pickle.loads(pickle.dumps(Forged(*arguments)) if arguments[2] is good else pickle.dumps(Forged(*arguments[:2], good[:16])))


def test_skies_go_to_other_processes_and_probes_come_back(air: sp.Atmosphere) -> None:
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0, atmosphere=air)
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=context) as pool:
        probe = pool.submit(sky.render, width=64).result(timeout=120)
    numpy.testing.assert_array_equal(probe.pixels, sky.render(width=64).pixels)


def test_a_sky_without_an_air_has_the_clear_one() -> None:
    sky = sp.Sky(latitude=55.71, longitude=13.19, time="2005-06-21T13:00")
    other = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0)
    assert sky.atmosphere is other.atmosphere and repr(sky.atmosphere) == "Atmosphere(preset='clear', quality='standard')"


def test_numbers_and_arrays_of_one_element_are_wavelengths(air: sp.Atmosphere) -> None:
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=120.0, atmosphere=air)
    expected = sky.spectral_radiance(UP, [550.0])
    for one in (550.0, 550, numpy.float64(550.0), numpy.array([550.0]), numpy.array(550.0), (550.0,), numpy.array([550], numpy.int32)):
        numpy.testing.assert_array_equal(sky.spectral_radiance(UP, one), expected)
        assert sky.irradiance(one).direct_normal.shape == (1,)
    with pytest.raises(sp.InputError, match="wavelengths_nm"):
        sky.spectral_radiance(UP, [[550.0, 600.0]])


def test_every_object_says_what_it_is(air: sp.Atmosphere) -> None:
    sky = sp.Sky(latitude=55.71, longitude=13.19, time="2005-01-25T00:30", atmosphere=air)
    probe = sky.render(width=64)
    report = post.auto_exposure(probe.pixels, scale="blender")
    values: list[Any] = [
        air,
        profile_air(),
        sp.Component(scattering=[[1.0]], absorption=[[0.0]], phase=sp.Phase.henyey_greenstein(0.5), name="dust"),
        sp.Phase.rayleigh(),
        sky,
        sky.night,
        sky.sun,
        sky.moon,
        sky.scene,
        probe,
        sky.illuminance(),
        sp.PolarisingFilter(),
        sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0, atmosphere=air).irradiance([550.0]),
        sky.sun_events(),
        post.Adaptation(),
        report,
        sp.places.search("Lund")[0],
    ]
    for value in values:
        text = repr(value)
        assert type(value).__name__ in text and " object at 0x" not in text and "\n" not in text and len(text) < 300, text
