"""The sky stands upright, unturned and unmirrored in Mitsuba: shadows point away from the Sun."""

import analysis
import mitsuba as mi
import numpy as np
import pytest
import render_scene
import skyprobe as sp

SUN_AZIMUTHS_DEG = render_scene.scene_numbers()["sun"]["shadow_azimuths_deg"]


def shadow_picture(probe_path, variant="scalar_rgb"):
    return render_scene.render_mitsuba(probe_path, variant=variant, view="top", spp=64)


@pytest.mark.parametrize("sun_azimuth_deg", SUN_AZIMUTHS_DEG)
def test_the_shadow_points_away_from_the_sun(probe, scene, tmp_path, variant, sun_azimuth_deg):
    path = tmp_path / "sky.exr"
    probe(sun_azimuth_deg).save(path)
    analysis.check_shadow(shadow_picture(path, variant), scene["top_camera"], sun_azimuth_deg)


def test_the_shadow_test_sees_a_mirrored_sky(probe, scene, tmp_path, write_pixels):
    azimuth = SUN_AZIMUTHS_DEG[0]
    path = write_pixels(tmp_path / "mirrored.exr", probe(azimuth).pixels[:, ::-1])
    picture = shadow_picture(path)
    with pytest.raises(AssertionError, match="deg off"):
        analysis.check_shadow(picture, scene["top_camera"], azimuth)
    # Mirroring the columns turns azimuth A into 180 - A.
    analysis.check_shadow(picture, scene["top_camera"], 180.0 - azimuth)


def test_the_shadow_test_sees_a_rotated_sky(probe, scene, tmp_path, write_pixels):
    azimuth, pixels = SUN_AZIMUTHS_DEG[0], probe(SUN_AZIMUTHS_DEG[0]).pixels
    columns = 3
    path = write_pixels(tmp_path / "rotated.exr", np.roll(pixels, columns, axis=1))
    picture = shadow_picture(path)
    with pytest.raises(AssertionError, match="deg off"):
        analysis.check_shadow(picture, scene["top_camera"], azimuth)
    analysis.check_shadow(picture, scene["top_camera"], azimuth + 360.0 * columns / pixels.shape[1])


def test_the_shadow_test_sees_that_there_is_no_sun(probe, scene, tmp_path):
    path = tmp_path / "sunless.exr"
    probe(SUN_AZIMUTHS_DEG[0], sun_disc=False).save(path)
    with pytest.raises(analysis.NoShadow):
        analysis.check_shadow(shadow_picture(path), scene["top_camera"], SUN_AZIMUTHS_DEG[0])


def environment_radiance(path, directions):
    """What the scene's envmap sends from each direction of an (N, 3) array, shape (N, 3)."""
    mi.set_variant("scalar_rgb")
    light = render_scene.load_scene(path).environment()
    interaction = mi.SurfaceInteraction3f()
    radiance = []
    for direction in directions:
        interaction.wi = mi.Vector3f(*(-direction))
        radiance.append(np.array(light.eval(interaction)))
    return np.array(radiance)


def unit_vectors(altitude_deg, azimuth_deg):
    altitude, azimuth = np.radians(altitude_deg), np.radians(azimuth_deg)
    return np.stack([np.cos(altitude) * np.sin(azimuth), np.cos(altitude) * np.cos(azimuth), np.sin(altitude)], axis=-1)


def test_mitsuba_reads_each_corner_pixel_where_skyprobe_put_it(probe, tmp_path):
    made = probe(width=64, sun_disc=False)
    path = tmp_path / "sky.exr"
    made.save(path)
    pixels = np.asarray(made.pixels)
    directions = analysis.pixel_directions(*pixels.shape[:2], "corner")
    rows, columns = [1, 7, 14, 20, 27], slice(None, None, 5)
    seen = environment_radiance(path, directions[rows, columns].reshape(-1, 3))
    np.testing.assert_allclose(seen, pixels[rows, columns].reshape(-1, 3), rtol=1e-3)


def sun_altitude_in_mitsuba(path_with_sun, path_without, around_altitude_deg, azimuth_deg):
    """Altitude of the centre of the Sun's light as the envmap shows it [deg], by summing over 8 x 8 degrees."""
    offsets = np.arange(-4.0, 4.0, 0.1) + 0.05
    altitudes, azimuths = np.meshgrid(around_altitude_deg + offsets, azimuth_deg + offsets / np.cos(np.radians(around_altitude_deg)))
    directions = unit_vectors(altitudes.ravel(), azimuths.ravel())
    sun = environment_radiance(path_with_sun, directions) - environment_radiance(path_without, directions)
    weight = analysis.luminance(sun) * np.cos(np.radians(altitudes.ravel()))
    return np.sum(weight * altitudes.ravel()) / np.sum(weight)


def sun_altitude_in_pixels(with_sun, without, rows):
    """The same from the pixels of two probes and what their rows mean."""
    sun = analysis.luminance(np.asarray(with_sun.pixels, dtype=np.float64) - np.asarray(without.pixels))
    height, width = sun.shape
    weight = sun.sum(axis=1) * analysis.pixel_solid_angles(height, width, rows)
    return 90.0 - np.degrees(np.sum(weight * analysis.row_angles(height, rows)) / np.sum(weight))


def test_rows_on_the_corners_keep_the_suns_height_and_centred_rows_do_not(probe, scene, tmp_path):
    width, altitude = 256, scene["sun"]["altitude_deg"]
    written, shown = {}, {}
    for rows in ("corner", "centre"):
        probes = [probe(width=width, rows=rows, sun_disc=disc) for disc in (True, False)]
        paths = [tmp_path / f"{rows}_{number}.exr" for number in range(2)]
        for path, made in zip(paths, probes, strict=True):
            made.save(path)
        written[rows] = sun_altitude_in_pixels(*probes, rows)
        shown[rows] = sun_altitude_in_mitsuba(*paths, altitude, scene["sun"]["azimuth_deg"])
    assert shown["corner"] == pytest.approx(written["corner"], abs=0.03)
    # The trap: Mitsuba takes row j for pi j / (H - 1), so a file with centred rows shows the Sun too high by half a row x altitude / 90.
    too_high = 0.5 * 180.0 / (width // 2) * altitude / 90.0
    assert shown["centre"] - written["centre"] == pytest.approx(too_high, abs=0.03)
