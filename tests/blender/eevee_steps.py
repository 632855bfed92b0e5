"""What tests/blender/test_light.py lets EEVEE do. Each function runs in a process of its own (hosts.run)."""

import math

import analysis
import bpy
import mathutils
import numpy as np
from render_scene import picture_of
from scene_geometry import load_scene
from steps import grey_world, light_with_sun, part, set_up


def in_eevee(scene, size=8, samples=4):
    """Render `scene` by EEVEE, `size` pixels square."""
    scene.render.engine = "BLENDER_EEVEE_NEXT" if bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.eevee.taa_render_samples = samples
    return picture_of(scene, 1)


def mean(picture):
    return picture.mean(axis=(0, 1), dtype=np.float64).tolist()


def white_plane(altitudes_deg):
    """Return, for each altitude of the Sun, the mean radiance of the white plane under it as a lamp and in the map, and the irradiance of the probe."""
    data = load_scene()
    answers = []
    for altitude in altitudes_deg:
        answer = {"reflectance": data["materials"]["white"]["reflectance"]}
        for name, sun_in_map in (("lamp", False), ("map", True)):
            scene = set_up(["plane"], "top_camera")
            sky = light_with_sun(scene, altitude, 200.0, 1024, sun_in_map)
            answer[name] = mean(in_eevee(scene))
        probe = sky.render(width=1024, scale="blender", color_space="lin_rec709", sun_disc=True)
        answers.append({**answer, "irradiance": analysis.horizontal_irradiance(np.asarray(probe.pixels), "centre").tolist()})
    return answers


def moonlit_plane():
    """Return the mean radiance of the white plane under the full Moon as a lamp and in the map."""
    answer = {}
    for name, moon_mode in (("lamp", "LAMP"), ("map", "MAP")):
        scene = set_up(["plane"], "top_camera", year=2005, month=1, day=25, hour=0.5, moon_mode=moon_mode, width=1024)
        bpy.ops.skyprobe.render()
        answer[name] = mean(in_eevee(scene))
    return answer


def shadows(norths_deg):
    """Return [north, azimuth of the pole's shadow] under the Sun of the map at azimuth 200."""
    data = load_scene()
    scene = set_up(["plane", "pole"], "top_camera")
    light_with_sun(scene, data["sun"]["altitude_deg"], 200.0, 1024, True)
    width, height = scene.render.resolution_x, scene.render.resolution_y
    answer = []
    for north in norths_deg:
        scene.skyprobe.north = math.radians(north)
        assert width == height
        answer.append([north, analysis.shadow_azimuth_deg(in_eevee(scene, width, 16), data["top_camera"])])
    return answer


def look_at_the_sun():
    """Look at the Sun of the map: 12 degrees in 120 pixels. Return how many pixels are as bright as no sky is, and the brightest."""
    scene = set_up(["plane"], "camera")
    sky = light_with_sun(scene, 40.0, 200.0, 4096, True)
    camera = scene.camera
    camera.location = (0.0, 0.0, 5.0)
    camera.rotation_mode = "XYZ"
    camera.rotation_euler = mathutils.Vector(sky.sun.apparent_direction).to_track_quat("-Z", "Y").to_euler()
    camera.data.type, camera.data.angle = "PERSP", math.radians(12.0)
    picture = in_eevee(scene, 120)
    return {"bright": int((picture[..., 1] > 5000.0).sum()), "brightest": float(picture.max())}


def sequence(folder):
    """Render a sequence of an evening with the Sun as a lamp and in the map, and each frame by EEVEE; tell what stays after it was left."""
    answer = {}
    for name, sun_mode in (("lamp", "LAMP"), ("map", "MAP")):
        scene = set_up(["plane"], "top_camera", sun_mode=sun_mode, sequence_directory=f"{folder}/{name}", hour=16.0)
        scene.frame_start, scene.frame_end = 1, 3
        for frame in (1, 2, 3):
            scene.skyprobe.time_offset_h = 1.5 * (frame - 1)
            scene.keyframe_insert("skyprobe.time_offset_h", frame=frame)
        bpy.ops.skyprobe.render_sequence()
        answer[name] = []
        for frame in (1, 2, 3):
            scene.frame_set(frame)
            answer[name].append(float(in_eevee(scene).mean()))
    bpy.ops.skyprobe.leave_sequence()
    world, curves = scene.world, part("compat").curves
    answer["curves_left"] = [curve.data_path for thing in (world, world.node_tree) for curve in curves(thing)]
    scene.skyprobe.sun_mode = "LAMP"
    part("live").update_now(scene, final=False, anew=True)
    answer["nodes_left"] = [node.name for node in world.node_tree.nodes if "EEVEE" in node.name]
    return answer


def own_output():
    """Light a scene whose world has an output of its own for EEVEE, in each way; tell the mean of the plane, and of one in a plain world."""
    answer = {}
    for name, parted in (("plain", False), ("parted", True)):
        scene = set_up(["plane"], "top_camera")
        scene.world = grey_world()
        if parted:
            tree = scene.world.node_tree
            background, output = tree.nodes.new("ShaderNodeBackground"), tree.nodes.new("ShaderNodeOutputWorld")
            output.target = "EEVEE"
            tree.links.new(background.outputs["Background"], output.inputs["Surface"])
        if name == "plain":
            light_with_sun(scene, 40.0, 200.0, 256, False)
            answer["plain"] = mean(in_eevee(scene))
            continue
        for way, sun_in_map in (("LAMP", False), ("MAP", True), ("LAMP again", False)):
            light_with_sun(scene, 40.0, 200.0, 256, sun_in_map)
            answer[way] = mean(in_eevee(scene))
    return answer
