"""One scene, one sky, two renderers: Cycles and Mitsuba draw the same picture."""

import analysis
import numpy as np
import pytest
import render_scene as mitsuba_half
import skyprobe as sp
from blender import hosts
from blender.render_scene import render_blender
from scene_geometry import diffuse_mask, load_scene

BLENDER = "4.5"
SCENE = load_scene()
# Without the Sun's disc glass throws caustics that both path tracers can sample. With it, it throws some that neither can, and a pixel that
# one of a million paths makes a hundred times brighter compares nothing.
PARTS_IN_SUN = ["plane", "pole", "box", "metal_sphere"]


@pytest.mark.parametrize(
    ("sun_disc", "parts", "cycles_samples", "mitsuba_samples"),
    [(True, PARTS_IN_SUN, 768, 1536), (False, None, 384, 1024)],
    ids=["in the Sun", "under the sky alone, with glass"],
)
def test_cycles_and_mitsuba_agree_on_diffuse_pixels(tmp_path, sun_disc, parts, cycles_samples, mitsuba_samples):
    air = sp.Atmosphere(**SCENE["air"])
    sky = sp.Sky.with_sun(altitude_deg=SCENE["sun"]["altitude_deg"], azimuth_deg=SCENE["sun"]["azimuth_deg"], atmosphere=air)
    check_agreement(tmp_path, sky, SCENE, sun_disc, parts, (cycles_samples, mitsuba_samples))


def test_they_agree_by_starlight(tmp_path):
    # Thousands of pixels with a star each and light of 1e-9: half the resolution is enough for it.
    camera = {**SCENE["camera"], "resolution": [size // 2 for size in SCENE["camera"]["resolution"]]}
    place = {"latitude": -24.6272, "longitude": -70.4042, "elevation_m": 2635.0}
    sky = sp.Sky(**place, time="2005-07-06T04:00:00Z", atmosphere=sp.Atmosphere(**SCENE["air"]))
    check_agreement(tmp_path, sky, {**SCENE, "camera": camera}, True, PARTS_IN_SUN, (512, 1024))


def check_agreement(folder, sky, scene, sun_disc, parts, samples):
    """Assert that both renderers draw `scene` alike where it is diffuse; `samples` of Cycles and of Mitsuba."""
    hosts.python_of(BLENDER)
    (cycles_samples, mitsuba_samples), resolution = samples, scene["camera"]["resolution"]
    probes = {}
    # Each renderer gets the rows that it reads; the unit is the same, so the pictures compare as they are.
    for rows in ("centre", "corner"):
        probes[rows] = folder / f"{rows}.exr"
        sky.render(width=scene["probe_width"], scale="mitsuba", rows=rows, sun_disc=sun_disc).save(probes[rows])

    variant = "llvm_ad_rgb" if mitsuba_half.llvm_library() else "scalar_rgb"
    objects = parts and [*parts, "pole_cap"]
    in_mitsuba = mitsuba_half.render_mitsuba(
        probes["corner"], folder / "mitsuba.npy", variant=variant, objects=objects, spp=mitsuba_samples, resolution=resolution
    )
    in_cycles = render_blender(
        probes["centre"], folder / "cycles.npy", version=BLENDER, samples=cycles_samples, parts=parts, resolution=resolution
    )

    mask = diffuse_mask(scene)
    in_mitsuba, _ = analysis.halved(in_mitsuba, mask)
    in_cycles, mask = analysis.halved(in_cycles, mask)
    assert mask.mean() > 0.5
    np.testing.assert_allclose(in_cycles[mask].mean(axis=0) / in_mitsuba[mask].mean(axis=0), 1.0, atol=0.005)
    # Half of what is allowed is noise; smoothed over 8 x 8 pixels the pictures agree within 0.5 %.
    difference = analysis.relative_rms(in_cycles, in_mitsuba, mask)
    assert (difference < 0.02).all(), f"rms difference {difference} of the mean"
