"""Probes and pictures that the Mitsuba tests share; each is computed once a session."""

import sys
from pathlib import Path

import numpy as np
import pytest

# Not a package, and by design: a package named `mitsuba` would hide the renderer.
sys.path.insert(0, str(Path(__file__).parent))

import mitsuba as mi  # noqa: E402
import render_scene  # noqa: E402
import skyprobe as sp  # noqa: E402


@pytest.fixture(scope="session")
def scene():
    """The numbers of tests/scene.json."""
    return render_scene.scene_numbers()


@pytest.fixture(scope="session")
def probe(scene):
    """Function (azimuth_deg, width, rows, sun_disc) -> Probe of a sky with the scene's air and Sun altitude, in Mitsuba's unit."""
    air = sp.Atmosphere(**scene["air"])
    known = {}

    def make(azimuth_deg=scene["sun"]["azimuth_deg"], width=scene["probe_width"], rows="corner", sun_disc=True):
        key = (azimuth_deg, width, rows, sun_disc)
        if key not in known:
            sky = sp.Sky.with_sun(altitude_deg=scene["sun"]["altitude_deg"], azimuth_deg=azimuth_deg, atmosphere=air)
            known[key] = sky.render(width=width, scale="mitsuba", rows=rows, sun_disc=sun_disc)
        return known[key]

    return make


@pytest.fixture(scope="session")
def write_pixels():
    """Function (path, pixels) that writes an EXR as Mitsuba reads it: for skies that skyprobe itself never makes."""

    def write(path, pixels):
        mi.set_variant("scalar_rgb")
        mi.Bitmap(np.ascontiguousarray(pixels, dtype=np.float32)).write(str(path))
        return path

    return write


@pytest.fixture(scope="session", params=["scalar_rgb", "llvm_ad_rgb"])
def variant(request):
    """Each variant of Mitsuba that this machine can run."""
    if request.param.startswith("llvm") and render_scene.llvm_library() is None:
        pytest.skip("no LLVM that Dr.Jit can use (Debian: libllvm19)")
    return request.param
