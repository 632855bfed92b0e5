# SPDX-License-Identifier: GPL-3.0-or-later
"""A finished probe becomes the light of a scene, and goes again without a trace."""

import bpy

from . import sun_lamp, world_nodes


def apply(scene, result):
    """Light `scene` by the jobs.ProbeResult `result`: world, lamp, both engines."""
    settings = scene.skyprobe
    image = world_nodes.load_image(result.request.path, result.request.pack)
    # Nothing of the scene changes before the file has proved readable.
    if scene.world is None or scene.world != settings.probe_world:
        _forget_world(settings)
        settings.previous_world = scene.world
        settings.probe_world = world_nodes.new_world(scene.world)
        scene.world = settings.probe_world
    world = settings.probe_world
    world_nodes.show(world, image, settings.north)
    _replace_image(settings, image)
    if result.request.sun_in_map:
        _remove_lamp(settings)
        world_nodes.set_sun_in_map(world, result)
    else:
        settings.lamp = sun_lamp.place(scene, settings.lamp, result, settings.north)
        world_nodes.set_sun_as_lamp(world)
    settings.sun_altitude_deg = result.sun_altitude_deg
    settings.sun_azimuth_deg = result.sun_azimuth_deg


def remove(scene):
    """Give `scene` the world that it had before, and delete lamp, world and image of the probe."""
    settings = scene.skyprobe
    if scene.world == settings.probe_world:
        scene.world = settings.previous_world
    settings.previous_world = None
    _remove_lamp(settings)
    _forget_world(settings)
    _replace_image(settings, None)


def is_lit(scene):
    """Whether `scene` has a probe to remove."""
    return scene.skyprobe.probe_world is not None


def turn_north(scene):
    """Follow a change of the direction of north, without a new probe."""
    settings = scene.skyprobe
    if settings.probe_world:
        world_nodes.set_north(settings.probe_world, settings.north)
    if settings.lamp:
        sun_lamp.turn(settings.lamp, settings.sun_azimuth_deg, settings.north)


def _replace_image(settings, image):
    old, settings.image = settings.image, image
    if old and old.users == 0:
        bpy.data.images.remove(old)


def _forget_world(settings):
    old, settings.probe_world = settings.probe_world, None
    if old and old.users == 0:
        bpy.data.worlds.remove(old)


def _remove_lamp(settings):
    old, settings.lamp = settings.lamp, None
    if old:
        sun_lamp.remove(old)
