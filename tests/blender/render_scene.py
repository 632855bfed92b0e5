"""The Blender half of "one scene, two renderers": a probe file in, a linear picture out.

    from blender.render_scene import render_blender          # with tests/ on the path
    picture = render_blender(probe_path, out_path, version="4.5", samples=128)

Any Python may call it; the work is done by the bpy of `version` (see hosts.py), without the add-on, so that nothing but the probe's
own convention decides where the light comes from.
"""

import tempfile
from pathlib import Path

import numpy as np
from scene_geometry import load_scene


def render_blender(probe_path, out_path, version="4.5", samples=64, parts=None, camera="camera", resolution=None):
    """Render the test scene lit by the probe at `probe_path` (any rows="centre" file); write and return the picture.

    The picture is (H, W, 3) float32, linear Rec.709, row 0 at the top; `out_path` ends in .npy. `parts` are the names of
    scene.json to build (all by default), `camera` is "camera" or "top_camera", `resolution` replaces the camera's own.
    """
    from blender import hosts

    with tempfile.TemporaryDirectory() as resources:
        hosts.run(
            version,
            "render_scene.render_in_blender",
            resources,
            probe_path=str(Path(probe_path).resolve()),
            out_path=str(Path(out_path).resolve()),
            samples=samples,
            parts=parts,
            camera=camera,
            resolution=resolution,
        )
    return np.load(out_path)


def render_in_blender(probe_path, out_path, samples, parts, camera, resolution):
    """The part of render_blender that runs inside Blender."""
    import bpy
    import scene_builder

    scene = scene_builder.build(load_scene(), parts, camera)
    if resolution:
        scene.render.resolution_x, scene.render.resolution_y = resolution
    image = bpy.data.images.load(probe_path)
    image.colorspace_settings.name = "Linear Rec.709"
    scene.world = bpy.data.worlds.new("probe")
    if bpy.app.version < (5, 0, 0):
        scene.world.use_nodes = True
    nodes, links = scene.world.node_tree.nodes, scene.world.node_tree.links
    nodes.clear()
    environment = nodes.new("ShaderNodeTexEnvironment")
    environment.image = image
    background = nodes.new("ShaderNodeBackground")
    output = nodes.new("ShaderNodeOutputWorld")
    links.new(environment.outputs["Color"], background.inputs["Color"])
    links.new(background.outputs["Background"], output.inputs["Surface"])
    # The automatic map of 1024 x 512 misses parts of the Sun's disc in larger probes.
    scene.world.cycles.sampling_method = "MANUAL"
    scene.world.cycles.sample_map_resolution = min(2 * image.size[0], 8192)
    np.save(out_path, picture_of(scene, samples))
    return {"version": bpy.app.version_string}


def picture_of(scene, samples):
    """Render `scene` inside Blender and return its picture, (H, W, 3) float32, linear Rec.709, row 0 at the top."""
    import bpy

    scene.cycles.samples = samples
    with tempfile.TemporaryDirectory() as folder:
        settings = scene.render.image_settings
        settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
        scene.render.filepath = str(Path(folder) / "picture.exr")
        bpy.ops.render.render(write_still=True, scene=scene.name)
        image = bpy.data.images.load(scene.render.filepath)
        width, height = image.size
        flat = np.empty(width * height * image.channels, dtype=np.float32)
        image.pixels.foreach_get(flat)
        bpy.data.images.remove(image)
    # Blender counts rows from the bottom.
    return flat.reshape(height, width, -1)[::-1, :, :3].copy()
