# SPDX-License-Identifier: GPL-3.0-or-later
"""The Sun as a lamp: it lights exactly as the Sun's disc in the map would, without noise.

A Sun lamp of strength S [W/m2] and colour c gives a surface that faces it the irradiance S c, in the unit whose radiance the
pixels of the probe hold; so S c is the direct normal irradiance of the Sun through the air.
"""

import math

import bpy

NAME = "Skyprobe Sun"


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


def place(scene, lamp, result, north):
    """Set `lamp` (an object, or None to make one) to the Sun of the jobs.ProbeResult `result`; return it."""
    if lamp is None:
        lamp = bpy.data.objects.new(NAME, bpy.data.lights.new(NAME, "SUN"))
    if lamp.name not in scene.objects:
        scene.collection.objects.link(lamp)
    light = lamp.data
    light.energy, light.color = strength_and_color(result.sun_irradiance)
    light.angle = math.radians(result.sun_diameter_deg)
    lamp.rotation_mode = "XYZ"
    # The disc in the map is drawn where refraction lifts it to; the lamp must agree.
    lamp.rotation_euler = rotation(result.sun_altitude_deg, result.sun_azimuth_deg, north)
    return lamp


def turn(lamp, result_azimuth_deg, north):
    """Turn `lamp` after a change of `north` alone."""
    lamp.rotation_euler.z = -(math.radians(result_azimuth_deg) + north)


def remove(lamp):
    """Delete the lamp and, if nothing else uses it, its light."""
    light = lamp.data
    bpy.data.objects.remove(lamp)
    if light.users == 0:
        bpy.data.lights.remove(light)
