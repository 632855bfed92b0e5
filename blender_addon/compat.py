# SPDX-License-Identifier: GPL-3.0-or-later
"""Every difference between Blender versions, and between builds with and without Cycles, that the add-on meets."""

import os

import bpy
import gpu

# Options of a property that holds a path which may begin with //. Before 4.5 there is no such option, and none is needed.
PATH_OPTIONS = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5, 0) else set()

# Names that bpy.data.colorspace.working_space can have, and what skyprobe calls the same space.
_WORKING_SPACES = {"Linear Rec.709": "lin_rec709", "Linear Rec.2020": "lin_rec2020", "ACEScg": "acescg"}


def use_world_nodes(world):
    """Make `world.node_tree` exist and count. From 5.0 on it always does, and the switch is deprecated."""
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True


def working_color_space():
    """Return skyprobe's name of the space in which lamp colours are given.

    Before 5.0 that is linear Rec.709 unless the OpenColorIO configuration was replaced; from 5.0 on a file can choose.
    """
    if bpy.app.version < (5, 0, 0):
        return "lin_rec709"
    name = bpy.data.colorspace.working_space
    if name not in _WORKING_SPACES:
        raise ValueError(f"working space = {name}: must be one of {', '.join(_WORKING_SPACES)}")
    return _WORKING_SPACES[name]


def set_importance_map(world, width):
    """Set the width of the map by which Cycles samples `world` [pixels]; None lets Cycles choose.

    A width over Cycles' own limit becomes that limit. Without the Cycles add-on worlds have no such setting.
    """
    cycles = getattr(world, "cycles", None)
    if cycles is None:
        return
    if width is None:
        cycles.sampling_method = "AUTOMATIC"
        return
    limit = cycles.bl_rna.properties["sample_map_resolution"].hard_max
    cycles.sampling_method = "MANUAL"
    cycles.sample_map_resolution = min(width, limit)


def has_sun_extraction():
    """Whether EEVEE makes a sun lamp of what is very bright in a world: from 4.2 on."""
    return bpy.app.version >= (4, 2, 0)


def set_sun_extraction(world, threshold, angle=None):
    """Let EEVEE make a sun of angular diameter `angle` [radians] out of what is brighter than `threshold`; 0 for no sun."""
    if not has_sun_extraction():
        return
    world.sun_threshold = threshold
    if angle is not None:
        world.sun_angle = angle


def node(nodes, name, kind, location):
    """Return the node `name` of `nodes`, made at `location` where there is none; one of another kind gives the name up."""
    found = nodes.get(name)
    if found is not None and found.bl_idname != kind:
        # A node of the user's under our name.
        found.name = f"{name} (another)"
        found = None
    if found is None:
        found = nodes.new(kind)
        found.name = found.label = name
        found.location = location
    return found


def key_of(thing):
    """Return what tells the datablock `thing` from all others of this session, whatever it is called. In old Blenders only the name does."""
    return getattr(thing, "session_uid", thing.name)


def scene_of(key):
    """Return the scene of which `key_of` made `key`, or None if it is gone."""
    return next((scene for scene in bpy.data.scenes if key_of(scene) == key), None)


def forget_old_properties(scene):
    """Delete the settings as Blender 4 kept them.

    Blender 5 moves them elsewhere when it opens such a file, and leaves the old ones as a custom property, which would hold on to our worlds,
    images and lamps for ever.
    """
    if bpy.app.version >= (5, 0, 0) and scene.library is None and hasattr(scene.get("skyprobe"), "to_dict"):
        del scene["skyprobe"]


def texture_cache_folder():
    """Return where Cycles keeps tiles of a picture (from 5.2 on), relative to the picture; None for a folder that is not beside it, or no cache."""
    if bpy.app.version < (5, 2, 0):
        return None
    folder = bpy.context.preferences.filepaths.texture_cache_directory or "blender_tx"
    return None if folder.startswith("//") or os.path.isabs(folder) else folder


def is_unused(thing):
    """Whether nothing uses the datablock `thing`. Blender 4.2 counts users of a copied scene that are not there."""
    return thing.users == 0 or not (thing.use_fake_user or bpy.data.user_map(subset={thing})[thing])


def layout_progress(layout, factor, text):
    """Show that `factor` (0 to 1) of a work is done. Before 4.0 there is no bar, only the text."""
    if bpy.app.version < (4, 0, 0):
        layout.label(text=text)
    else:
        layout.progress(factor=factor, text=text)


def is_rendering():
    """Whether a final render runs, under which no data may change."""
    return bpy.app.is_job_running("RENDER")


def user_folder(name):
    """Return the path of a folder of the user's for the add-on, which need not exist."""
    try:
        return bpy.utils.extension_path_user(__package__, path=name)
    except (AttributeError, ValueError):
        # Not an extension: run from a folder of add-ons, or by a Blender that has none.
        return bpy.utils.user_resource("SCRIPTS", path=f"presets/skyprobe/{name}")


def curves(thing):
    """Return the animation curves of `thing`, of whatever shape its action is."""
    data = thing.animation_data
    action = data.action if data else None
    if action is None:
        return []
    if hasattr(action, "fcurves"):
        return list(action.fcurves)
    if data.action_slot is None:
        return []
    # From 5.0 on curves are in bags by slot.
    bags = (strip.channelbag(data.action_slot) for layer in action.layers for strip in layer.strips)
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]


def is_animated(thing, path):
    """Whether a property of `thing` whose data path begins with `path` has keyframes or a driver."""
    data = thing.animation_data
    drivers = data.drivers if data else ()
    return any(curve.data_path.startswith(path) for curve in (*curves(thing), *drivers))


def check_animatable(thing, data_path):
    """Raise ValueError if the property `data_path` of `thing` can be given no keyframes."""
    data = thing.animation_data
    if data and data.action is not None and data.action.library is not None:
        raise ValueError(f"action = {data.action.name}: must not be linked from another file; make it local, or remove it")
    if any(curve.data_path == data_path and curve.lock for curve in curves(thing)):
        raise ValueError(f"curve = {data_path}: must not be locked; unlock it in the Graph Editor")
    if data and any(driver.data_path == data_path for driver in data.drivers):
        raise ValueError(f"driver = {data_path}: must not be there, as it overrules keyframes; delete it")


def make_linear(*things, only=""):
    """Let every curve of ours of `things`, whose data path begins with `only`, go straight from key to key."""
    for thing in things:
        for curve in curves(thing):
            if isinstance(thing, bpy.types.Scene) and not curve.data_path.startswith("skyprobe."):
                continue
            if not curve.data_path.startswith(only):
                continue
            for point in curve.keyframe_points:
                point.interpolation = "LINEAR"
            curve.update()


def shift_curve(curve, by):
    """Add `by` to the value of every key of `curve`."""
    for point in curve.keyframe_points:
        for place in (point.co, point.handle_left, point.handle_right):
            place.y += by
    curve.update()


def own_action(thing):
    """Make sure that no other data has the action of `thing`: a copy of a scene begins with the same one."""
    data = thing.animation_data if thing is not None else None
    if data is not None and data.action is not None and (data.action.users > 1 or data.action.library is not None):
        data.action = data.action.copy()


def key_frames(thing, data_path):
    """Return the set of frames, whole ones as such, at which a property of `thing` has keys."""
    return {point.co.x for curve in curves(thing) if curve.data_path == data_path for point in curve.keyframe_points}


def remove_keys(thing, data_path, frames):
    """Take the keys of one property of `thing` at `frames` away, and a curve that has no others."""
    for curve in curves(thing):
        if curve.data_path == data_path:
            for point in reversed(curve.keyframe_points):
                if point.co.x in frames:
                    curve.keyframe_points.remove(point)
            curve.update()
    if not key_frames(thing, data_path):
        remove_curve(thing, data_path)


def remove_curve(thing, data_path):
    """Take the animation of one property of `thing` away, if it has one."""
    data = thing.animation_data
    action = data.action if data else None
    for curve in curves(thing):
        if curve.data_path != data_path:
            continue
        if hasattr(action, "fcurves"):
            action.fcurves.remove(curve)
            continue
        for layer in action.layers:
            for strip in layer.strips:
                bag = strip.channelbag(data.action_slot)
                if bag is not None:
                    bag.fcurves.remove(curve)


def set_linear_rec709(image):
    """Let the pixels of `image` be linear Rec.709, which Blender before 4.0 calls Linear; ValueError if OpenColorIO has no such space."""
    name = "Linear" if bpy.app.version < (4, 0, 0) else "Linear Rec.709"
    try:
        image.colorspace_settings.name = name
    except TypeError:
        raise ValueError(f"color space = {name}: must be one of the OpenColorIO configuration; use one that has it, such as Blender's own") from None


def builtin_shader(name):
    """Return one of Blender's own shaders for points in space, by its name since 4.0."""
    return gpu.shader.from_builtin(name if bpy.app.version >= (4, 0, 0) else f"3D_{name}")
