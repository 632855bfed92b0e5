# SPDX-License-Identifier: GPL-3.0-or-later
"""Light becomes that of a scene, as a preview, a rendered probe or a sequence of them, and goes again without a trace."""

import json

import bpy

from . import compat, exposure, jobs, lamps, texture_cache, world_nodes, world_sun

PREVIEW_NAME = "Skyprobe Preview"


def show_preview(scene, pixels, result):
    """Light `scene` by `pixels` (as jobs.preview returns them) and the lamps of `result`."""
    settings = scene.skyprobe
    _own(scene)
    width = result.request.width
    names = ("preview_b", "preview_a") if _shown_image(scene) == settings.preview_a else ("preview_a", "preview_b")
    image = world_nodes.with_pixels(getattr(settings, names[0]), PREVIEW_NAME, width, pixels)
    setattr(settings, names[0], image)
    _show(scene, image, result, "PREVIEW")


def show_probe(scene, result, path, pack):
    """Light `scene` by the file of a rendered probe, which goes into the .blend if `pack`."""
    settings = scene.skyprobe
    # Nothing of the scene changes before the file has proved readable.
    image = world_nodes.load_image(path, pack)
    _own(scene)
    old, settings.image = settings.image, image
    _show(scene, image, result, "PROBE")
    settings.image_key = result.request.key
    settings.image_result = json.dumps(jobs.result_content(result))
    _remove_image(old)


def show_again(scene, request):
    """Show the rendered probe again if it is the one of `request`; return whether it is shown."""
    settings = scene.skyprobe
    if settings.image is None or settings.image_key != request.key or not is_lit(scene):
        return False
    if settings.shown == "PROBE":
        return True
    try:
        result = jobs.result_from(json.loads(settings.image_result), request)
    except (ValueError, KeyError, TypeError):
        # Not what was written there.
        return False
    if 0 in settings.image.size:
        # Its file is gone.
        return False
    _own(scene)
    _show(scene, settings.image, result, "PROBE")
    return True


def show_sequence(scene, image, frames, result):
    """Light `scene` by an image sequence, one file a frame, from `frames[0]` to `frames[1]`; the lamps stand as in `result`."""
    settings = scene.skyprobe
    _own(scene)
    old, settings.image = settings.image, image
    settings.image_key = ""
    _show(scene, image, result, "SEQUENCE")
    world_nodes.play_sequence(settings.probe_world, frames)
    if old != image:
        _remove_image(old)


def remove(scene):
    """Give `scene` the world that it had before, and delete lamps, world and images of the probe."""
    settings = scene.skyprobe
    compat.forget_old_properties(scene)
    exposure.remove_keys(scene)
    if scene.world is not None and scene.world == settings.probe_world:
        scene.world = settings.previous_world
    settings.previous_world = None
    for name in ("sun_lamp", "moon_lamp"):
        _remove_lamp(scene, name)
    _forget_world(settings)
    for name in ("image", "preview_a", "preview_b"):
        old = getattr(settings, name)
        setattr(settings, name, None)
        _remove_image(old)
    settings.shown = "NOTHING"
    settings.image_key = settings.image_result = ""
    _shown_keys.pop(compat.key_of(scene), None)


def is_lit(scene):
    """Whether `scene` shows a sky of ours: it has one, and has not been given another world since."""
    world = scene.skyprobe.probe_world
    return world is not None and scene.world == world


def has_anything(scene):
    """Whether there is something of ours to remove from `scene`."""
    settings = scene.skyprobe
    return any(getattr(settings, name) for name in ("probe_world", "sun_lamp", "moon_lamp", "image", "preview_a", "preview_b"))


def shown_key(scene):
    """Return the jobs.SkyRequest.key of the light that `scene` shows, as far as this session knows."""
    return _shown_keys.get(compat.key_of(scene)) if is_lit(scene) else None


# By compat.key_of the scene.
_shown_keys = {}


def forget():
    """Forget what scenes show, as when another file is opened or an older state comes back."""
    _shown_keys.clear()


def pack_preview(scene):
    """Put the preview that `scene` shows, if it is one, into the .blend."""
    image = _shown_image(scene)
    if scene.library is None and image is not None and image in (scene.skyprobe.preview_a, scene.skyprobe.preview_b):
        world_nodes.pack_pixels(image)


def turn_north(scene):
    """Follow a change of the direction of north, without a new probe."""
    settings = scene.skyprobe
    if scene.library is not None or not has_anything(scene):
        return
    _own(scene)
    if settings.probe_world:
        world_nodes.set_north(settings.probe_world, settings.north)
    for lamp, azimuth in ((settings.sun_lamp, settings.sun_azimuth_deg), (settings.moon_lamp, settings.moon_azimuth_deg)):
        if lamp:
            lamps.turn(lamp, azimuth, settings.north)


def _show(scene, image, result, what):
    settings = scene.skyprobe
    if settings.shown == "SEQUENCE":
        _stop_sequence(scene)
    if scene.world is None or scene.world != settings.probe_world:
        _forget_world(settings)
        settings.previous_world = scene.world
        settings.probe_world = world_nodes.new_world(scene.world)
        scene.world = settings.probe_world
    world = settings.probe_world
    world_nodes.show(world, image, settings.north)
    sun_in_map, moon_in_map = result.request.sun_in_map, result.request.moon_in_map or result.moon is None
    for name, title, lamp, in_map in (
        ("sun_lamp", lamps.SUN, result.sun, sun_in_map),
        ("moon_lamp", lamps.MOON, result.moon, moon_in_map),
    ):
        if in_map:
            _remove_lamp(scene, name)
        else:
            thing = lamps.link(scene, getattr(settings, name), title)
            setattr(settings, name, thing)
            lamps.shine(thing, lamp, settings.north)
    disc = world_sun.disc_of(result)
    world_nodes.set_importance(world, result)
    world_nodes.set_disc(world, None if disc.is_dark else disc)
    settings.sun_azimuth_deg = result.sun.azimuth_deg
    settings.moon_azimuth_deg = result.moon.azimuth_deg if result.moon else 0.0
    settings.shown = what
    _shown_keys[compat.key_of(scene)] = result.request.key


def _stop_sequence(scene):
    """Take away the keys that the sequence gave lamps, world and exposure."""
    exposure.remove_keys(scene)
    world_sun.remove_keys(scene.skyprobe.probe_world)
    for lamp in (scene.skyprobe.sun_lamp, scene.skyprobe.moon_lamp):
        if lamp is not None:
            lamp.animation_data_clear()
            lamp.data.animation_data_clear()


def _own(scene):
    """Make sure that nothing else shows what this scene is about to change: a copied scene begins with the same world, lamps and previews."""
    settings = scene.skyprobe
    for name in ("preview_a", "preview_b"):
        if _is_foreign(scene, name):
            setattr(settings, name, None)
    for name in ("sun_lamp", "moon_lamp"):
        if _is_foreign(scene, name):
            old = getattr(settings, name)
            lamp = lamps.copy(old)
            _take_out(scene, name)
            scene.collection.objects.link(lamp)
            setattr(settings, name, lamp)
    if _is_foreign(scene, "probe_world"):
        world = settings.probe_world
        settings.probe_world = world.copy()
        for thing in (settings.probe_world, settings.probe_world.node_tree):
            compat.own_action(thing)
        if scene.world == world:
            scene.world = settings.probe_world


def _is_foreign(scene, name):
    """Whether what `scene` has under `name` belongs to another scene too, or to another file."""
    mine = getattr(scene.skyprobe, name)
    if mine is None:
        return False
    return mine.library is not None or any(getattr(other.skyprobe, name) == mine for other in bpy.data.scenes if other != scene)


def _take_out(scene, name):
    """Take a lamp that is another scene's too out of this one."""
    lamp = getattr(scene.skyprobe, name)
    setattr(scene.skyprobe, name, None)
    owners = [other for other in bpy.data.scenes if other != scene and other.library is None and getattr(other.skyprobe, name) == lamp]
    for collection in (scene.collection, *scene.collection.children_recursive):
        if collection.library is None and collection.objects.get(lamp.name) == lamp:
            collection.objects.unlink(lamp)
    # A collection that both scenes show had it for both.
    for other in owners:
        lamps.link(other, lamp, lamp.name)


def _shown_image(scene):
    world = scene.skyprobe.probe_world
    return world_nodes.shown_image(world) if world else None


def _remove_image(image):
    if image is not None and compat.is_unused(image):
        texture_cache.forget(image)
        bpy.data.images.remove(image)


def _forget_world(settings):
    old, settings.probe_world = settings.probe_world, None
    if old and compat.is_unused(old):
        bpy.data.worlds.remove(old)


def _remove_lamp(scene, name):
    if _is_foreign(scene, name):
        _take_out(scene, name)
        return
    old = getattr(scene.skyprobe, name)
    setattr(scene.skyprobe, name, None)
    if old:
        lamps.remove(old)
