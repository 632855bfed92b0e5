"""Run by a Python that has bpy: the luminance of Blender's Sky Texture along the Sun's meridian.

    python blender_sky.py ALTITUDE_DEG... > luminance.json

Renders the world with Cycles through an equirectangular camera that faces the Sun, one row a degree, without the Sun's disc. Prints a list for each Sun: from
the horizon under the Sun over the zenith to the opposite horizon, 180 values [cd m-2].
"""

import json
import os
import sys
import tempfile

import bpy
import numpy as np


def sky_node(scene: "bpy.types.Scene") -> "bpy.types.Node":
    world = bpy.data.worlds.new("sky")
    scene.world = world
    if world.node_tree is None:
        world.use_nodes = True
    nodes = world.node_tree.nodes
    background = next((node for node in nodes if node.type == "BACKGROUND"), None) or nodes.new("ShaderNodeBackground")
    output = next((node for node in nodes if node.type == "OUTPUT_WORLD"), None) or nodes.new("ShaderNodeOutputWorld")
    sky = nodes.new("ShaderNodeTexSky")
    names = {item.identifier for item in sky.bl_rna.properties["sky_type"].enum_items}
    sky.sky_type = "MULTIPLE_SCATTERING" if "MULTIPLE_SCATTERING" in names else "NISHITA"
    sky.sun_disc = False
    sky.sun_rotation = 0.0
    world.node_tree.links.new(sky.outputs["Color"], background.inputs["Color"])
    world.node_tree.links.new(background.outputs["Background"], output.inputs["Surface"])
    return sky


def main() -> None:
    scene = bpy.context.scene
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    sky = sky_node(scene)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    camera.rotation_euler = (np.pi / 2, 0.0, 0.0)
    camera.data.type = "PANO"
    scene.camera = camera
    for settings in (camera.data, getattr(camera.data, "cycles", None)):
        if hasattr(settings, "panorama_type"):
            settings.panorama_type = "EQUIRECTANGULAR"
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 4
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 360, 180, 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    result = {"version": bpy.app.version_string, "sky_type": sky.sky_type}
    with tempfile.TemporaryDirectory() as folder:
        for altitude in map(float, sys.argv[1:]):
            sky.sun_elevation = np.radians(altitude)
            scene.render.filepath = os.path.join(folder, f"sky{altitude}.exr")
            bpy.ops.render.render(write_still=True)
            image = bpy.data.images.load(scene.render.filepath)
            pixels = np.array(image.pixels[:]).reshape(180, 360, 4)[90:, :, :3] @ [0.2126, 0.7152, 0.0722] * 683
            under, opposite = pixels[:, 179:181].mean(axis=1), pixels[:, [0, -1]].mean(axis=1)
            result[f"{altitude:g}"] = [*under, *opposite[::-1]]
    sys.stdout.flush()
    print("\nRESULT " + json.dumps(result), flush=True)
    os._exit(0)


main()
