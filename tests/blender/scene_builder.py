"""Builds the scene of tests/scene.json in Blender, by script, from an empty file."""

import math

import bpy
from mathutils import Matrix, Vector


def build(scene_data, parts=None, camera="camera"):
    """Empty the file and build the `parts` (names of scene.json; all by default) seen by `camera`; return the scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    makers = {"plane": _plane, "pole": _pole, "box": _box, "metal_sphere": _sphere, "glass_sphere": _sphere}
    for name in parts or makers:
        part = scene_data[name]
        thing = makers[name](part)
        thing.name = name
        thing.data.materials.append(_material(part["material"], scene_data["materials"][part["material"]]))
    scene.camera = _camera(scene_data[camera])
    scene.render.resolution_x, scene.render.resolution_y = scene_data[camera]["resolution"]
    scene.render.resolution_percentage = 100
    _plain_path_tracing(scene, scene_data["max_bounces"])
    return scene


def _plain_path_tracing(scene, max_bounces):
    """Cycles without its helpers: nothing clamped, smoothed, guessed or cut."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_denoising = False
    cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.blur_glossy = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.use_light_tree = True
    cycles.pixel_filter_type = "BOX"
    for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces"):
        setattr(cycles, name, max_bounces)
    cycles.seed = 1
    scene.render.threads_mode = "FIXED"
    scene.render.threads = 2


def _plane(part):
    bpy.ops.mesh.primitive_plane_add(size=part["size"], location=part["centre"])
    return bpy.context.object


def _pole(part):
    middle = Vector(part["base"]) + Vector((0.0, 0.0, part["height"] / 2.0))
    bpy.ops.mesh.primitive_cylinder_add(vertices=64, radius=part["radius"], depth=part["height"], location=middle)
    return bpy.context.object


def _box(part):
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=part["centre"])
    bpy.context.object.scale = part["size"]
    return bpy.context.object


def _sphere(part):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=192, ring_count=96, radius=part["radius"], location=part["centre"])
    bpy.ops.object.shade_smooth()
    return bpy.context.object


def _material(name, data):
    """A single shader: `diffuse` without roughness, `rough_conductor` and `dielectric` with GGX and no Fresnel tint."""
    material = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    if data["type"] == "diffuse":
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Roughness"].default_value = 0.0
        shader.inputs["Color"].default_value = (*data["reflectance"], 1.0)
    elif data["type"] == "rough_conductor":
        shader = nodes.new("ShaderNodeBsdfAnisotropic")
        shader.distribution = "GGX"
        # Cycles squares its roughness to get the width of the microfacets.
        shader.inputs["Roughness"].default_value = math.sqrt(data["alpha"])
        shader.inputs["Color"].default_value = (*data["reflectance"], 1.0)
    elif data["type"] == "dielectric":
        shader = nodes.new("ShaderNodeBsdfGlass")
        shader.inputs["Roughness"].default_value = 0.0
        shader.inputs["IOR"].default_value = data["ior"]
        shader.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    else:
        raise ValueError(f"material type = {data['type']}: must be diffuse, rough_conductor or dielectric")
    links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    return material


def _camera(data):
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit = "HORIZONTAL"
    if data["type"] == "orthographic":
        lens.type = "ORTHO"
        lens.ortho_scale = data["width"]
    else:
        lens.angle_x = math.radians(data["horizontal_fov_deg"])
    lens.clip_end = 1000.0
    thing = bpy.data.objects.new("camera", lens)
    origin, target, up = (Vector(data[name]) for name in ("origin", "target", "up"))
    backward = (origin - target).normalized()
    right = up.cross(backward).normalized()
    # A camera looks along its own -Z, with +Y up.
    axes = Matrix((right, backward.cross(right), backward)).transposed()
    thing.matrix_world = Matrix.Translation(origin) @ axes.to_4x4()
    bpy.context.scene.collection.objects.link(thing)
    return thing
