# SPDX-License-Identifier: GPL-3.0-or-later
"""The Sun of the map for EEVEE, at night the Moon, in an output of the world that only EEVEE takes.

EEVEE keeps the world in half floats, which end at 65504, a thirtieth of the Sun's disc, and lose small discs of dim nights; and it makes a sun
lamp of what is brighter than the world's threshold. So EEVEE is given the same energy in a disc that is as much wider as that limit asks for: it becomes a sun lamp of the true
angle, strength and direction. The map's own disc is cut down to what the sky can be; of it, too, nothing is lost:

    disc = (irradiance - cut disc of the map) / solid angle

What the camera sees is the map itself. Cycles keeps the plain chain of world_nodes. All is plain Blender data.
"""

import math
from dataclasses import dataclass

from . import compat, jobs

# All our nodes for EEVEE begin with it.
PREFIX = "Skyprobe EEVEE"
OUTPUT, MIX, CAMERA, LIGHT, SUM = (f"{PREFIX} {name}" for name in ("Output", "Seen or Lighting", "Seen", "Light", "Sky and Sun"))
SKY, SUN, DISC, DIRECTION = (f"{PREFIX} {name}" for name in ("Sky", "Sun", "Disc", "Direction"))
# Of the disc that EEVEE is given; far below what it can hold, as several texels share a border.
MOST_RADIANCE = 30000.0
# The widest disc [radians of its radius]. Light of more energy than fits is brighter than EEVEE can hold.
WIDEST = math.radians(20.0)
# What EEVEE makes a sun of, and what a sky without its disc stays below.
HIGHEST_THRESHOLD, BRIGHTEST_SKY = 300.0, 1000.0
NO_LIMIT = 1e30
# The threshold in parts of a disc's mean: less than a dim disc, more than the sky beside it. What stays below is lost in half floats at night.
SUN_SHARE, MOON_SHARE = 0.1, 0.01
# How much brighter than the mean of the sky a disc must be at least.
CLEARANCE = 30.0


@dataclass(frozen=True)
class Disc:
    """The values of the nodes, and of EEVEE's threshold, for one place of Sun or Moon."""

    direction: tuple  # in the map: x east, y north, z up
    cosine: float  # of the disc's radius
    radiance: tuple  # RGB; zero for a dark disc
    sky_limit: float  # what the map is cut at
    threshold: float  # of the world
    angle: float  # diameter of Sun or Moon [radians]

    @property
    def is_dark(self):
        """Whether there is nothing to shine."""
        return max(self.radiance) == 0.0


def disc_of(result):
    """Return the Disc that stands for the Sun in the map of the jobs.SkyResult `result`, or for its Moon if no sky outshines it; else a dark one."""
    request, sun, moon = result.request, result.sun, result.moon
    if request.sun_in_map and max(sun.irradiance) > 0.0:
        return _disc(sun, request.width, SUN_SHARE)
    if request.moon_in_map and moon is not None and max(moon.irradiance) > 0.0:
        disc = _disc(moon, request.width, MOON_SHARE)
        # What is brighter than the threshold must be the Moon alone, and no glow at the horizon.
        if disc.threshold > CLEARANCE * result.horizontal_lx / (math.pi * jobs.LUMINOUS_EFFICACY):
            return disc
    return Disc((0.0, 0.0, 1.0), 1.0, (0.0, 0.0, 0.0), NO_LIMIT, 0.0, math.radians(sun.diameter_deg))


def _disc(lamp, width, share):
    radius = math.radians(lamp.diameter_deg) / 2.0
    altitude, azimuth = math.radians(lamp.altitude_deg), math.radians(lamp.azimuth_deg)
    direction = (math.cos(altitude) * math.sin(azimuth), math.cos(altitude) * math.cos(azimuth), math.sin(altitude))
    light = [max(value, 0.0) for value in lamp.irradiance]
    # The disc of the map is as large as itself, or as the pixel that holds it.
    in_map = max(math.pi * radius**2, (2.0 * math.pi / width) ** 2 * math.cos(altitude))
    border = share * max(light) / in_map
    limit, threshold = min(border, BRIGHTEST_SKY), min(border, HIGHEST_THRESHOLD)
    solid_angle = min(max(math.pi * radius**2, max(light) / MOST_RADIANCE), 2.0 * math.pi * (1.0 - math.cos(WIDEST)))
    radiance = tuple(max(value - min(value, limit * in_map), 0.0) / solid_angle for value in light)
    return Disc(direction, 1.0 - solid_angle / (2.0 * math.pi), radiance, limit, threshold, 2.0 * radius)


def shine(world, disc, vector, color, seen):
    """Give EEVEE the `disc` beside the map of `world`: sockets of the direction in the map, its colour, and the background that is seen."""
    if not compat.has_sun_extraction():
        return
    nodes, links = world.node_tree.nodes, world.node_tree.links
    output = world.node_tree.get_output_node("ALL")
    x, y = output.location if output else (0.0, 0.0)

    def node(name, kind, column, row, **properties):
        found = compat.node(nodes, name, kind, (x - 900.0 + 200.0 * column, y - 600.0 - 180.0 * row))
        for key, value in properties.items():
            setattr(found, key, value)
        return found

    direction = node(DIRECTION, "ShaderNodeVectorMath", 0, 1, operation="DOT_PRODUCT")
    inside = node(DISC, "ShaderNodeMath", 1, 1, operation="GREATER_THAN")
    sun = node(SUN, "ShaderNodeVectorMath", 2, 1, operation="SCALE")
    sky = node(SKY, "ShaderNodeVectorMath", 2, 0, operation="MINIMUM")
    both = node(SUM, "ShaderNodeVectorMath", 3, 0, operation="ADD")
    light = node(LIGHT, "ShaderNodeBackground", 4, 0)
    camera = node(CAMERA, "ShaderNodeLightPath", 4, 1)
    mix = node(MIX, "ShaderNodeMixShader", 5, 0)
    own = node(OUTPUT, "ShaderNodeOutputWorld", 6, 0, target="EEVEE")
    _activate(nodes, own)
    for source, target in (
        (vector, direction.inputs[0]),
        (direction.outputs["Value"], inside.inputs[0]),
        (inside.outputs["Value"], sun.inputs["Scale"]),
        (color, sky.inputs[0]),
        (sky.outputs["Vector"], both.inputs[0]),
        (sun.outputs["Vector"], both.inputs[1]),
        (both.outputs["Vector"], light.inputs["Color"]),
        (camera.outputs["Is Camera Ray"], mix.inputs[0]),
        (light.outputs["Background"], mix.inputs[1]),
        (seen, mix.inputs[2]),
        (mix.outputs["Shader"], own.inputs["Surface"]),
    ):
        links.new(source, target)
    # Air in the world is the same for both engines.
    for link in output.inputs["Volume"].links if output else ():
        links.new(link.from_socket, own.inputs["Volume"])
    set_disc(world, disc)


def set_disc(world, disc):
    """Give the nodes of `shine`, and EEVEE's threshold, the values of `disc`."""
    if not compat.has_sun_extraction():
        return
    for node, number, value in _values(disc):
        world.node_tree.nodes[node].inputs[number].default_value = value
    compat.set_sun_extraction(world, disc.threshold, disc.angle)


def insert_keys(world, discs):
    """Keyframe the nodes of `shine`, and the threshold, by `discs` (a Disc by frame)."""
    if not compat.has_sun_extraction():
        return
    for thing in (world, world.node_tree):
        compat.own_action(thing)
    for frame, disc in sorted(discs.items()):
        set_disc(world, disc)
        world.keyframe_insert("sun_threshold", frame=frame)
        for node, number, _ in _values(disc):
            world.node_tree.keyframe_insert(_path(node, number), frame=frame)
    compat.make_linear(world.node_tree, only=f'nodes["{PREFIX}')


def remove_keys(world):
    """Take the keys of `insert_keys` away."""
    if world is None or world.node_tree is None:
        return
    paths = {curve.data_path for curve in compat.curves(world.node_tree) if curve.data_path.startswith(f'nodes["{PREFIX}')}
    if paths:
        compat.remove_curve(world, "sun_threshold")
    for path in paths:
        compat.remove_curve(world.node_tree, path)


def remove(world):
    """Take the nodes of `shine` out of `world`: EEVEE shows what Cycles does."""
    if world.node_tree is None:
        return
    remove_keys(world)
    nodes = world.node_tree.nodes
    for node in [node for node in nodes if node.name.startswith(PREFIX)]:
        nodes.remove(node)
    _activate(nodes, next(iter(_outputs(nodes)), None))


def _outputs(nodes):
    return [node for node in nodes if node.bl_idname == "ShaderNodeOutputWorld" and node.target == "EEVEE"]


def _activate(nodes, output):
    """Let EEVEE take `output` of all that are made for it."""
    for node in _outputs(nodes):
        node.is_active_output = node == output


def _values(disc):
    """Yield (node, number of its input, value) of what changes with the disc."""
    yield DIRECTION, 1, disc.direction
    yield DISC, 1, disc.cosine
    yield SUN, 0, disc.radiance
    yield SKY, 1, (disc.sky_limit,) * 3


def _path(node, number):
    return f'nodes["{node}"].inputs[{number}].default_value'
