# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of Blender's interface, to be drawn again."""

import bpy


def redraw_panels():
    """Draw what our panels are in again, and nothing else: a 3D view takes much longer than its sidebar."""
    for area in _areas():
        if area.type == "PROPERTIES":
            area.tag_redraw()
        elif area.type == "VIEW_3D":
            for region in area.regions:
                if region.type == "UI":
                    region.tag_redraw()


def redraw_views():
    """Draw every 3D view again."""
    for area in _areas():
        if area.type == "VIEW_3D":
            area.tag_redraw()


def _areas():
    for manager in bpy.data.window_managers:
        for window in manager.windows:
            yield from window.screen.areas
