"""Renders the scene of mitsuba_scenes/probe_scene.xml for the tests.

`render_mitsuba` is the half of the comparison that Mitsuba makes; tests/blender/render_scene.py has the other. The scene, its light and
its materials come from the XML that users get; only the top camera, which is a measuring instrument, is built here from tests/scene.json.
"""

import glob
import json
import os
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SCENE_XML = ROOT / "mitsuba_scenes" / "probe_scene.xml"
SCENE_JSON = ROOT / "tests" / "scene.json"


def llvm_library():
    """Path of an LLVM that Mitsuba's `llvm_ad_*` variants can use, or None.

    Debian's LLVM 15 is taken by Dr.Jit but fails while it compiles on recent processors, so it does not count.
    """
    named = os.environ.get("DRJIT_LIBLLVM_PATH")
    if named:
        return named
    found = [path for version in (20, 19, 18, 17) for path in glob.glob(f"/usr/lib/*/libLLVM.so.{version}*")]
    return found[0] if found else None


# Dr.Jit looks once, when it is loaded.
if llvm_library():
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", llvm_library())

import mitsuba as mi  # noqa: E402


def scene_numbers():
    """The content of tests/scene.json."""
    return json.loads(SCENE_JSON.read_text())


def load_scene(probe_path, **parameters):
    """The scene of the XML, lit by the probe; parameters replace the defaults of the file. A variant must be set."""
    texts = {name: str(value) for name, value in parameters.items()}
    # Optimisation would merge the shapes into one that has no name.
    return mi.load_file(str(SCENE_XML), probe=str(probe_path), optimize=False, **texts)


def chosen_shapes(scene, objects):
    """The shapes of a loaded scene whose names are in `objects`, all of them for None."""
    shapes = {shape.id(): shape for shape in scene.shapes()}
    missing = set(objects or ()) - set(shapes)
    if missing:
        raise ValueError(f"objects = {sorted(missing)}: not in {SCENE_XML.name}")
    return {name: shape for name, shape in shapes.items() if objects is None or name in objects}


def top_camera(resolution):
    """The measuring camera of tests/scene.json, straight above; `resolution` is (width, height) or None for its own."""
    camera = scene_numbers()["top_camera"]
    width, height = resolution or camera["resolution"]
    to_world = mi.ScalarTransform4f().look_at(origin=camera["origin"], target=camera["target"], up=camera["up"])
    half = camera["width"] / 2
    return {
        "type": "orthographic",
        "to_world": to_world @ mi.ScalarTransform4f().scale([half, half, 1.0]),
        "film": {
            "type": "hdrfilm",
            "width": width,
            "height": height,
            "pixel_format": "rgb",
            "component_format": "float32",
            "filter": {"type": "box"},
        },
        "sampler": {"type": "independent"},
    }


def render_mitsuba(probe_path, out_path=None, *, variant="scalar_rgb", view="camera", objects=None, resolution=None, spp=64, seed=0):
    """Renders the scene lit by a probe with corner rows and returns the picture, (H, W, 3) float32, linear Rec.709, row 0 at the top.

    view: "camera" for the camera of the XML, "top" for the one straight above.
    objects: names of the shapes of the XML, by default all for "camera", plane and pole for "top".
    resolution: (width, height) [pixels], by default that of tests/scene.json.
    out_path: written as .npy if given.
    """
    mi.set_variant(variant)
    max_depth = scene_numbers()["max_bounces"] + 2
    if view == "camera":
        width, height = resolution or scene_numbers()["camera"]["resolution"]
        full = load_scene(probe_path, width=width, height=height, max_depth=max_depth)
        sensor = full.sensors()[0]
    elif view == "top":
        full = load_scene(probe_path, max_depth=max_depth)
        sensor, objects = top_camera(resolution), objects or ("plane", "pole", "pole_cap")
    else:
        raise ValueError(f'view = {view!r}: must be "camera" or "top"')
    scene = mi.load_dict(
        {
            "type": "scene",
            "integrator": full.integrator(),
            "sky": full.environment(),
            "camera": sensor,
            **chosen_shapes(full, objects),
        }
    )
    # The vectorised variants hold all samples of a pass in memory.
    passes = -(-spp // 256)
    pictures = (np.array(mi.render(scene, seed=seed * passes + number, spp=spp // passes)) for number in range(passes))
    picture = np.asarray(sum(pictures) / passes, dtype=np.float32)[:, :, :3]
    if out_path is not None:
        np.save(out_path, picture)
    return picture
