# SPDX-License-Identifier: GPL-3.0-or-later
"""The probe in the world's nodes: Texture Coordinate, Mapping (north), Environment Texture, Background, and nothing hidden.

The nodes go into a copy of the world that the scene had: the copy keeps its volume, mist and other settings, the old world stays
as it was for other scenes and comes back unchanged. All is plain Blender data, so a file shows its sky without the add-on.
"""

import contextlib

import bpy

from . import compat, world_sun

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
    outputs = _outputs(world.node_tree) or [nodes.new("ShaderNodeOutputWorld")]
    x, y = outputs[0].location
    coordinate = compat.node(nodes, COORDINATE, "ShaderNodeTexCoord", (x - 900.0, y - 300.0))
    mapping = compat.node(nodes, MAPPING, "ShaderNodeMapping", (x - 700.0, y - 300.0))
    environment = compat.node(nodes, ENVIRONMENT, "ShaderNodeTexEnvironment", (x - 500.0, y - 300.0))
    background = compat.node(nodes, BACKGROUND, "ShaderNodeBackground", (x - 200.0, y - 300.0))
    if environment.image != image:
        environment.image = image
    environment.projection = "EQUIRECTANGULAR"
    links.new(coordinate.outputs["Generated"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], environment.inputs["Vector"])
    links.new(environment.outputs["Color"], background.inputs["Color"])
    for output in outputs:
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


def set_importance(world, result):
    """Tell Cycles what discs the map of the jobs.SkyResult `result` holds."""
    request, sun, moon = result.request, result.sun, result.moon
    # By day the Moon in the map is too dim to be sampled by itself, in twilight the sky outshines it; at night it may be the brightest.
    moon_counts = moon is not None and request.moon_in_map and moon.altitude_deg > sun.altitude_deg and sun.altitude_deg < 0.0
    # Cycles finds a disc reliably when its importance map is twice as wide as the probe.
    compat.set_importance_map(world, 2 * request.width if request.sun_in_map or moon_counts else None)


def set_disc(world, disc):
    """Give EEVEE the world_sun.Disc `disc` beside the map of `world`, or for None nothing: it must not make a sun of a bright sky."""
    if disc is None:
        world_sun.remove(world)
        compat.set_sun_extraction(world, 0.0)
        return
    nodes = world.node_tree.nodes
    sockets = (nodes[MAPPING].outputs["Vector"], nodes[ENVIRONMENT].outputs["Color"], nodes[BACKGROUND].outputs["Background"])
    world_sun.shine(world, disc, *sockets)


def _outputs(tree):
    """Return the outputs that the engines take, but for ours: one, or one for each engine where the user has parted them."""
    found = []
    for engine in ("ALL", "CYCLES", "EEVEE"):
        output = tree.get_output_node(engine)
        if output is not None and output.name != world_sun.OUTPUT and output not in found:
            found.append(output)
    return found


def _find(world, name, kind):
    """Return the node `name` of `world`, or None if it is gone or of another kind."""
    node = world.node_tree.nodes.get(name) if world.node_tree else None
    return node if node is not None and node.bl_idname == kind else None
