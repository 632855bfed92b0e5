"""What a white plane shows in Mitsuba is the probe's own irradiance, times reflectance / pi."""

import analysis
import numpy as np
import pytest
import render_scene


@pytest.mark.parametrize("sun_disc", [True, False])
def test_a_white_plane_shows_the_irradiance_of_the_probe(probe, scene, tmp_path, variant, sun_disc):
    made = probe(sun_disc=sun_disc)
    path = tmp_path / "sky.exr"
    made.save(path)
    picture = render_scene.render_mitsuba(path, variant=variant, view="top", objects=["plane"], resolution=(64, 64), spp=256)
    reflectance = np.array(scene["materials"]["white"]["reflectance"])
    expected = reflectance / np.pi * analysis.horizontal_irradiance(np.asarray(made.pixels), "corner")
    np.testing.assert_allclose(picture.mean(axis=(0, 1)), expected, rtol=0.01)


def test_both_row_conventions_hold_the_same_irradiance(probe):
    for sun_disc in (True, False):
        centre, corner = (
            analysis.horizontal_irradiance(np.asarray(probe(rows=rows, sun_disc=sun_disc).pixels), rows) for rows in ("centre", "corner")
        )
        np.testing.assert_allclose(corner, centre, rtol=0.003)
