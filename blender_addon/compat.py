# SPDX-License-Identifier: GPL-3.0-or-later
"""Every difference between Blender versions, and between builds with and without Cycles, that the add-on meets."""

import bpy

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


def set_sun_extraction(world, threshold, angle=None):
    """Let EEVEE make a sun of angular diameter `angle` [radians] out of what is brighter than `threshold`; 0 for no sun.

    Before 4.2 EEVEE takes no sun out of a world.
    """
    if bpy.app.version < (4, 2, 0):
        return
    world.sun_threshold = threshold
    if angle is not None:
        world.sun_angle = angle


def layout_panel(layout, name, default_closed):
    """Return the layouts (header, body) of a panel inside `layout`, body None while it is closed.

    Before 4.1 there is no such panel: a title over the content, always open.
    """
    if bpy.app.version < (4, 1, 0):
        return layout.row(), layout.column()
    return layout.panel(name, default_closed=default_closed)


def layout_progress(layout, factor, text):
    """Show that `factor` (0 to 1) of a work is done. Before 4.0 there is no bar, only the text."""
    if bpy.app.version < (4, 0, 0):
        layout.label(text=text)
    else:
        layout.progress(factor=factor, text=text)
