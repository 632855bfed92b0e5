"""Pictures of the add-on for the documentation, taken in a window: python tests/blender/window.py WHEEL shots.panel picture='"panel.png"'."""

import bpy
from window_steps import area, context, enable, screenshot, show_panels, window


def panel(picture):
    """The panel in the sidebar beside a scene in late light, with the path of the Sun."""
    enable()
    yield
    yield from show_panels()
    scene = bpy.context.scene
    settings = scene.skyprobe
    for name in ("Cube", "Light", "Camera"):
        bpy.data.objects.remove(bpy.data.objects[name])
    _still_life()
    with context("VIEW_3D"):
        bpy.ops.skyprobe.add()
    settings.place = "Lund, Sweden"
    settings.month, settings.day, settings.hour = 8, 20, 18.6
    settings.auto_exposure = True
    settings.exposure_offset = -0.5
    settings.preview_width = 1024
    settings.show_diurnal_path = settings.show_north = True
    settings.helper_size = 7.0
    view = area("VIEW_3D")
    space = view.spaces.active
    space.shading.type = "RENDERED"
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False
    space.overlay.show_object_origins = False
    space.region_3d.view_perspective = "PERSP"
    space.region_3d.view_location = (0.0, 0.0, 2.2)
    space.region_3d.view_rotation = (0.620, 0.560, 0.370, 0.406)
    space.region_3d.view_distance = 17.0
    space.lens = 30.0
    bpy.ops.object.select_all(action="DESELECT")
    # A rendered view takes its time to draw without a graphics card.
    for _ in range(12):
        yield 1.0
    screenshot(picture)
    return {"shown": settings.shown, "windows": len(window().screen.areas)}


def _still_life():
    """A white plane with a grey ball, a box and a mirror ball."""
    for maker, size, place, colour, rough, metal in (
        (bpy.ops.mesh.primitive_plane_add, {"size": 300.0}, (0.0, 0.0, 0.0), (0.5, 0.5, 0.5), 0.9, 0.0),
        (bpy.ops.mesh.primitive_uv_sphere_add, {"radius": 1.2, "segments": 64, "ring_count": 32}, (-1.8, 0.6, 1.2), (0.8, 0.8, 0.8), 0.8, 0.0),
        (bpy.ops.mesh.primitive_uv_sphere_add, {"radius": 1.0, "segments": 64, "ring_count": 32}, (1.4, -1.0, 1.0), (0.9, 0.9, 0.9), 0.03, 1.0),
        (bpy.ops.mesh.primitive_cube_add, {"size": 1.8}, (1.8, 2.2, 0.9), (0.7, 0.25, 0.15), 0.6, 0.0),
    ):
        maker(location=place, **size)
        thing = bpy.context.object
        if "radius" in size:
            bpy.ops.object.shade_smooth()
        material = bpy.data.materials.new("material")
        material.use_nodes = True
        shader = material.node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = (*colour, 1.0)
        shader.inputs["Roughness"].default_value = rough
        shader.inputs["Metallic"].default_value = metal
        thing.data.materials.append(material)
