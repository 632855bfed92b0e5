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
