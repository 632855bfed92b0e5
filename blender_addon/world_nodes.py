# SPDX-License-Identifier: GPL-3.0-or-later
"""The probe in the world's nodes: Texture Coordinate, Mapping (north), Environment Texture, Background, and nothing hidden.

The nodes go into a copy of the world that the scene had: the copy keeps its volume, mist and other settings, the old world stays
as it was for other scenes and comes back unchanged. All is plain Blender data, so a file shows its sky without the add-on.
"""

import contextlib
import math

import bpy

from . import compat

# Far above any sky and far below 65504, the largest value in EEVEE's copy of the world.
EEVEE_THRESHOLD = 1000.0

COORDINATE, MAPPING, ENVIRONMENT, BACKGROUND = "Skyprobe Direction", "Skyprobe North", "Skyprobe Environment", "Skyprobe Background"


def load_image(path, pack):
    """Load the probe at `path` as a new image, inside the .blend if `pack`; OSError if it is no picture, and nothing is loaded.

    Always a new datablock: Cycles keeps the old pixels of an image that changes in place.
    """
    try:
        image = bpy.data.images.load(path, check_existing=False)
    except RuntimeError:
        raise OSError(f"{path}: must be there until Blender has read it; render it again") from None
    try:
        compat.set_linear_rec709(image)
        image.alpha_mode = "NONE"
        if 0 in image.size:
            raise OSError(f"{path}: must be a picture that Blender can read; render it again")
        if pack:
            image.pack()
    except BaseException:
        bpy.data.images.remove(image)
        raise
    if pack:
        # The temporary file goes; this is where "Unpack" would put the picture.
        image.filepath_raw = "//" + bpy.path.basename(path)
    elif bpy.data.filepath:
        # On another drive than the .blend's a path stays absolute.
        with contextlib.suppress(ValueError):
            image.filepath_raw = bpy.path.relpath(path)
    return image


def load_sequence(path):
    """Load the sequence whose first picture is at `path`; OSError if that is no picture, and nothing is loaded."""
    image = load_image(path, pack=False)
    image.name = "Skyprobe Sequence"
    image.source = "SEQUENCE"
    return image


def new_world(old):
    """Return a world that can hold the probe: a copy of `old`, or an empty one for None."""
    world = old.copy() if old else bpy.data.worlds.new("World")
    world.name = "Skyprobe"
    compat.use_world_nodes(world)
    return world


def show(world, image, north):
    """Make `world` emit `image`, north turned by `north` [radians clockwise from +Y, seen from above]."""
    # The user may have switched them off.
    compat.use_world_nodes(world)
    nodes, links = world.node_tree.nodes, world.node_tree.links
    output = world.node_tree.get_output_node("ALL") or nodes.new("ShaderNodeOutputWorld")
    x, y = output.location
    coordinate = _node(nodes, COORDINATE, "ShaderNodeTexCoord", (x - 900.0, y - 300.0))
    mapping = _node(nodes, MAPPING, "ShaderNodeMapping", (x - 700.0, y - 300.0))
    environment = _node(nodes, ENVIRONMENT, "ShaderNodeTexEnvironment", (x - 500.0, y - 300.0))
    background = _node(nodes, BACKGROUND, "ShaderNodeBackground", (x - 200.0, y - 300.0))
    if environment.image != image:
        environment.image = image
    environment.projection = "EQUIRECTANGULAR"
    links.new(coordinate.outputs["Generated"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], environment.inputs["Vector"])
    links.new(environment.outputs["Color"], background.inputs["Color"])
    links.new(background.outputs["Background"], output.inputs["Surface"])
    set_north(world, north)


def set_north(world, north):
    """Turn the map, if it is there. A direction of the scene is turned back, counter-clockwise, before it is looked up."""
    mapping = _find(world, MAPPING, "ShaderNodeMapping")
    if mapping is not None:
        mapping.inputs["Rotation"].default_value = (0.0, 0.0, north)


def shown_image(world):
    """Return the image that `world` emits, or None."""
    environment = _find(world, ENVIRONMENT, "ShaderNodeTexEnvironment")
    return environment.image if environment else None


def with_pixels(image, name, width, pixels):
    """Give `image` (or, for None, a new one called `name`) `pixels`, flat RGBA float32 from the bottom, `width` wide; return it."""
    height = len(pixels) // (4 * width)
    if image is not None and (image.source != "GENERATED" or not image.is_float):
        # A packed one became a file of its own.
        image.source = "GENERATED"
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=False, float_buffer=True)
        compat.set_linear_rec709(image)
        image.alpha_mode = "NONE"
    if tuple(image.size) != (width, height):
        image.scale(width, height)
    image.pixels.foreach_set(pixels)
    image.update()
    return image


def pack_pixels(image):
    """Keep the pixels of an image that was never a file in the .blend."""
    if image.is_dirty or image.packed_file is None:
        image.pack()


def play_sequence(world, frames):
    """Let `world` play its image as a sequence of files from frame `frames[0]` to `frames[1]` of the scene, at rest before and after."""
    user = world.node_tree.nodes[ENVIRONMENT].image_user
    first, last = frames
    user.frame_start = first
    user.frame_duration = last - first + 1
    # The file's own number is the frame's.
    user.frame_offset = first - 1
    user.use_cyclic = False
    user.use_auto_refresh = True


def set_disc_in_map(world, lamp, width):
    """Tell both engines that the map of `width` pixels holds the disc of the jobs.Lamp `lamp`."""
    # Cycles finds the disc reliably when its importance map is twice as wide as the probe.
    compat.set_importance_map(world, 2 * width)
    # EEVEE makes a sun of what is brighter than the threshold. A tenth of the mean over the disc, or over the pixel that
    # holds it, takes all of a dim disc and none of the sky; a bright one EEVEE has clipped to half precision by then.
    radius = math.radians(lamp.diameter_deg) / 2.0
    pixel = (2.0 * math.pi / width) ** 2 * math.cos(math.radians(lamp.altitude_deg))
    threshold = min(0.1 * max(0.0, *lamp.irradiance) / max(math.pi * radius**2, pixel), EEVEE_THRESHOLD)
    compat.set_sun_extraction(world, threshold, 2.0 * radius)


def set_moon_in_map(world, width, sun_altitude_deg):
    """Tell Cycles that the map of `width` pixels holds a Moon that may be the brightest thing in it."""
    compat.set_importance_map(world, 2 * width if sun_altitude_deg < 0.0 else None)
    compat.set_sun_extraction(world, 0.0)


def set_discs_as_lamps(world):
    """Tell both engines that the map holds no Sun: EEVEE must not make a second one of a bright sky."""
    compat.set_importance_map(world, None)
    compat.set_sun_extraction(world, 0.0)


def _find(world, name, kind):
    """Return the node `name` of `world`, or None if it is gone or of another kind."""
    node = world.node_tree.nodes.get(name) if world.node_tree else None
    return node if node is not None and node.bl_idname == kind else None


def _node(nodes, name, kind, location):
    node = nodes.get(name)
    if node is not None and node.bl_idname != kind:
        # A node of the user's under our name.
        node.name = f"{name} (another)"
        node = None
    if node is None:
        node = nodes.new(kind)
        node.name = node.label = name
        node.location = location
    return node
