"""What the tests of the finish let Blender do. Each function runs in a process of its own (hosts.run)."""

import math
import tempfile
from pathlib import Path

import bpy
import numpy as np
import steps
from render_scene import picture_of
from skyprobe import post


def lit_scene():
    """Build the test scene in twilight with a small lamp of 200 000 cd/m2 in view; return the scene."""
    scene = steps.set_up()
    world = steps.grey_world()
    background = world.node_tree.nodes["Background"]
    background.inputs["Strength"].default_value = 0.02
    scene.world = world
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.05, location=(0.4, 0.4, 1.9))
    lamp = bpy.context.object
    material = bpy.data.materials.new("lamp")
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    emission, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    emission.inputs["Strength"].default_value = 300.0
    material.node_tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    lamp.data.materials.append(material)
    return scene


def glare(out_path=None, **options):
    """Render, add glare by the operator, compare with the library; return what was found."""
    scene = lit_scene()
    rendered = picture_of(scene, 8)
    answer = bpy.ops.skyprobe.glare(**options)
    finish = steps.part("finish")
    image = bpy.data.images[finish.IMAGE_NAME]
    glared = steps.pixels_of(image)
    view = finish.view_of(scene)
    expected, report = post.glare(rendered, **view, scale="blender", state=options.get("state", "auto"), seed=options.get("seed", 0))
    again = sorted(bpy.ops.skyprobe.glare(**options))
    if out_path:
        np.save(out_path, np.stack([rendered, glared]))
    return {
        "answer": sorted(answer),
        "again": again,
        "images": sum(image.name.startswith(finish.IMAGE_NAME) for image in bpy.data.images),
        "scenes": len(bpy.data.scenes),
        "is_float": image.is_float,
        "size": list(image.size),
        "view": view,
        "state": report.state,
        "glaring_pixels": report.glaring_pixels,
        "read_back": float(np.abs(finish.rendered_pixels(scene) - rendered).max()),
        "largest_difference": float(np.abs(glared - expected).max() / expected.max()),
        "brightening": float((glared - rendered)[rendered.max(axis=2) < 1.0].mean()),
    }


def tone_mapped():
    """Render, add glare and map tones with every operator; return the largest difference from the library, of 255."""
    scene = lit_scene()
    scene.render.resolution_x, scene.render.resolution_y = 96, 64
    picture_of(scene, 4)
    finish = steps.part("finish")
    view = finish.view_of(scene)
    differences = {}
    for name, *_ in finish.TONES[1:]:
        bpy.ops.skyprobe.glare(tone=name, exposure_stops=-1.0)
        light = steps.pixels_of(bpy.data.images[finish.IMAGE_NAME])
        expected, _ = post.tone_map(light, name, exposure_stops=-1.0, scale="blender", **view)
        shown = bpy.data.images[finish.SCREEN_IMAGE_NAME]
        differences[name] = float(np.abs(steps.pixels_of(shown) * 255.0 - expected).max())
    return {"differences": differences, "is_float": shown.is_float, "color_space": shown.colorspace_settings.name}


def refused():
    """Ask for glare without a render, and with a camera that has no field of view; return the messages."""
    scene = lit_scene()
    answers = {"no_render": bpy.ops.skyprobe.glare.poll()}
    scene.render.resolution_x, scene.render.resolution_y = 32, 24
    picture_of(scene, 1)
    scene.camera.data.type = "ORTHO"
    try:
        bpy.ops.skyprobe.glare()
    except RuntimeError as error:
        answers["orthographic"] = str(error).strip()
    answers["own_view"] = sorted(bpy.ops.skyprobe.glare(own_view=True, field_of_view=math.radians(30.0)))
    return answers


def views():
    """Return the view of several cameras."""
    scene = lit_scene()
    finish = steps.part("finish")
    scene.render.engine = "CYCLES"
    camera = scene.camera.data
    camera.type, camera.sensor_fit, camera.lens, camera.sensor_width = "PERSP", "HORIZONTAL", 50.0, 36.0
    found = {"plain": finish.view_of(scene)}
    camera.shift_x = 0.3
    found["shifted"] = finish.view_of(scene)
    camera.type = "PANO"
    holder = camera if hasattr(camera, "panorama_type") else camera.cycles
    for kind in ("EQUIRECTANGULAR", "FISHEYE_EQUIDISTANT"):
        holder.panorama_type = kind
        found[kind] = finish.view_of(scene)
    return found


def black_and_white():
    """Render without colour and add glare; return the size of what came out."""
    scene = lit_scene()
    scene.render.resolution_x, scene.render.resolution_y = 48, 32
    scene.render.image_settings.color_mode = "BW"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "x.png")
        scene.cycles.samples = 1
        bpy.ops.render.render(write_still=True)
        kept = [scene.render.image_settings.file_format, scene.render.image_settings.color_mode]
        bpy.ops.skyprobe.glare(state="mesopic")
    after = [scene.render.image_settings.file_format, scene.render.image_settings.color_mode]
    return {"size": list(bpy.data.images[steps.part("finish").IMAGE_NAME].size), "settings_kept": kept == after}
