"""Where the light in Blender comes from and how much of it there is: shadows and a white plane against the probe's own numbers."""

import math

import numpy as np
import pytest
from scene_geometry import angle_between_azimuths_deg

from blender import hosts

# EEVEE compiles its shaders anew in each process, which takes software some ten seconds.
NEWEST = pytest.mark.parametrize("host", hosts.VERSIONS[-1:], indirect=True)


@pytest.mark.parametrize("sun_in_map", [False, True], ids=["lamp", "map"])
def test_the_poles_shadow_points_away_from_the_sun(host, sun_in_map):
    measured = host.run("steps.shadows", sun_in_map=sun_in_map)
    assert len(measured) == 4
    for azimuth, shadow in measured:
        assert angle_between_azimuths_deg(shadow, azimuth + 180.0) < 0.5, f"Sun {azimuth}, shadow {shadow}"


def test_north_turns_lamp_and_map_together_clockwise(host):
    # Sun at azimuth 110, north 30 degrees clockwise of +Y: the Sun stands 140 degrees clockwise of +Y.
    for way, shadow in host.run("steps.turned_shadow", north_deg=30.0).items():
        assert angle_between_azimuths_deg(shadow, 110.0 + 30.0 + 180.0) < 0.5, f"{way}: {shadow}"


@pytest.mark.parametrize("sun_in_map", [False, True], ids=["lamp", "map"])
@pytest.mark.parametrize("altitude_deg", [40.0, 8.0])
def test_a_white_plane_radiates_the_irradiance_of_the_probe_over_pi(host, altitude_deg, sun_in_map):
    answer = host.run("steps.white_plane", altitude_deg=altitude_deg, width=512, sun_in_map=sun_in_map, samples=128)
    expected = np.array(answer["irradiance"]) * answer["reflectance"] / math.pi
    assert np.array(answer["radiance"]) == pytest.approx(expected, rel=0.01)


def test_eevee_has_the_sun_once_as_a_lamp_and_in_the_map(host):
    high, low = host.run("eevee_steps.white_plane", altitudes_deg=[40.0, 5.0])
    expected = np.array(high["irradiance"]) * high["reflectance"] / math.pi
    # EEVEE keeps four numbers of the sky's light, good to some percent under a high Sun. Without the Sun about a quarter would be left, with
    # two of them nearly twice as much.
    assert np.array(high["lamp"]) == pytest.approx(expected, rel=0.15)
    for answer in (high, low):
        print(f"lamp {answer['lamp']}, map {answer['map']}")
        assert np.array(answer["map"]) == pytest.approx(answer["lamp"], rel=0.02)


def test_the_sun_of_the_map_throws_shadows_in_eevee_and_turns_with_north(host):
    # Sun at azimuth 200, north 30 degrees clockwise of +Y.
    for north, shadow in host.run("eevee_steps.shadows", norths_deg=[0.0, 30.0]):
        assert angle_between_azimuths_deg(shadow, 200.0 + north + 180.0) < 0.5, f"north {north}: {shadow}"


@NEWEST
def test_the_camera_sees_the_disc_of_the_map_in_eevee_and_not_the_wider_one_that_lights(host):
    answer = host.run("eevee_steps.look_at_the_sun")
    # Pixels of a tenth of a degree: 22 of the disc, some more of the map's filter. The disc that lights has some hundred.
    assert 10 <= answer["bright"] < 80, answer
    assert answer["brightest"] > 10000.0


@NEWEST
def test_eevee_has_the_moon_of_the_map(host):
    answer = host.run("eevee_steps.moonlit_plane")
    ratio = np.array(answer["map"]) / answer["lamp"]
    print(ratio)
    # EEVEE's half floats are coarse for a sun that dim: a thousand times brighter all of it would be there. As a mere spot of the map it would
    # be 0.60, 0.32, 0.32.
    assert 0.7 < ratio.min() and ratio.max() < 1.1


@NEWEST
def test_a_sequence_with_the_sun_in_the_map_is_right_in_eevee_and_leaves_nothing(host, tmp_path):
    answer = host.run("eevee_steps.sequence", folder=str(tmp_path))
    assert len(answer["lamp"]) == 3
    assert answer["map"] == pytest.approx(answer["lamp"], rel=0.03)
    assert answer["lamp"][0] > 1.5 * answer["lamp"][2], "the Sun sinks"
    assert answer["curves_left"] == [] and answer["nodes_left"] == []


@NEWEST
def test_an_output_of_ones_own_for_eevee_does_not_hide_the_sky(host):
    answer = host.run("eevee_steps.own_output")
    assert answer["LAMP"] == pytest.approx(answer["plain"], rel=1e-3)
    assert answer["MAP"] == pytest.approx(answer["plain"], rel=0.02)
    assert answer["LAMP again"] == pytest.approx(answer["plain"], rel=1e-3)


def test_lamp_and_disc_give_the_same_light(host):
    # The Sun's disc in a map of 4096 pixels is six pixels wide: a plane and the terminator of a sphere do not see the difference.
    answer = host.run("steps.lamp_or_disc", width=4096, samples=256)
    lamp, disc = answer["lamp"], answer["map"]
    print(f"plane {disc['plane'] / lamp['plane'] - 1.0:+.4%}, bands", [f"{b / a - 1.0:+.2%}" for a, b in zip(lamp["bands"], disc["bands"])])
    assert disc["plane"] == pytest.approx(lamp["plane"], rel=0.01)
    assert disc["bands"] == pytest.approx(lamp["bands"], rel=0.01)
    assert lamp["bands"][0] > 3.0 * lamp["bands"][-1], "the sphere has a lit side"
