# SPDX-License-Identifier: GPL-3.0-or-later
"""Sun and Moon as lamps: each lights exactly as its disc in the map would, without noise.

A Sun lamp of strength S [W/m2] and colour c gives a surface that faces it the irradiance S c, in the unit whose radiance the
pixels of the probe hold; so S c is the direct normal irradiance through the air.
"""

import math

import bpy

from . import compat

SUN, MOON = "Skyprobe Sun", "Skyprobe Moon"


def rotation(altitude_deg, azimuth_deg, north):
    """Return the XYZ Euler angles [radians] of a lamp that shines from this direction.

    `north` is the bearing of true north from the scene's +Y axis, clockwise seen from above [radians].
    """
    return (math.radians(altitude_deg) - math.pi / 2.0, 0.0, -(math.radians(azimuth_deg) + north))


def strength_and_color(irradiance):
    """Split an RGB irradiance into a strength [W/m2] and a colour of components 0 to 1."""
    # Light outside the gamut of the space has a negative component, which a lamp cannot have.
    positive = [max(value, 0.0) for value in irradiance]
    strength = max(positive)
    if strength == 0.0:
        return 0.0, (1.0, 1.0, 1.0)
    return strength, tuple(value / strength for value in positive)


def link(scene, lamp, name):
    """Return `lamp` (an object, or None to make one called `name`), in `scene`."""
    if lamp is None:
        lamp = bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN"))
    if scene.objects.get(lamp.name) != lamp:
        scene.collection.objects.link(lamp)
    return lamp


def shine(lamp, light_of, north):
    """Set the object `lamp` to the jobs.Lamp `light_of`."""
    if lamp.data.type != "SUN":
        lamp.data.type = "SUN"
    # Another type of light is another Python object.
    light = lamp.data
    light.energy, light.color = strength_and_color(light_of.irradiance)
    light.angle = math.radians(light_of.diameter_deg)
    lamp.rotation_mode = "XYZ"
    # The disc in the map is drawn where refraction lifts it to; the lamp must agree.
    lamp.rotation_euler = rotation(light_of.altitude_deg, light_of.azimuth_deg, north)


def turn(lamp, azimuth_deg, north):
    """Turn `lamp`, whose first key if it is animated is for this azimuth, after a change of `north` alone."""
    angle = -(math.radians(azimuth_deg) + north)
    for curve in compat.curves(lamp):
        if (curve.data_path, curve.array_index) == ("rotation_euler", 2) and curve.keyframe_points:
            compat.shift_curve(curve, angle - nearest_turn(curve.keyframe_points[0].co.y, angle))
    lamp.rotation_euler.z = angle


def copy(lamp):
    """Return a copy of `lamp`, of its light and of their animation."""
    new = lamp.copy()
    new.data = lamp.data.copy()
    for thing in (new, new.data):
        compat.own_action(thing)
    return new


def nearest_turn(angle, before):
    """Return `angle` plus whole turns, as close to `before` as can be [radians]."""
    return angle + 2.0 * math.pi * round((before - angle) / (2.0 * math.pi))


def remove(lamp):
    """Delete the lamp and, if nothing else uses it, its light."""
    light = lamp.data
    bpy.data.objects.remove(lamp)
    if light is not None and compat.is_unused(light):
        bpy.data.lights.remove(light)
