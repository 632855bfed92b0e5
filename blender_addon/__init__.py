# SPDX-License-Identifier: GPL-3.0-or-later
"""Skyprobe for Blender: the light of the sky for a place and a time, as the world of a scene.

    settings ──> values ──> jobs (threads, the skyprobe library, no bpy) ──> scene_probe ──> world_nodes, lamps
        └──> live (each change, at once, coarsely)
    operators, sequence (one probe, one a frame) ──> beside (one work at a time, with progress)

`world_sun` gives EEVEE the Sun of the map, `texture_cache` takes Cycles' tiles of our pictures away with them. `settings` holds what the user sets, `panels` shows it, `configuration` and `presets` keep it in files, `handlers` follows Blender's own
events, `failures` makes a line of what went wrong and `status_bar` shows it, `interface` has parts of the window drawn again, `compat` knows
what differs between Blender versions.
Conventions: +X east, +Y north (until the user turns north), +Z up.
"""

from . import beside, finish, handlers, operators, panels, presets, sequence, settings, viewport_drawing
from . import live, status_bar

# Read where the add-on runs from its folder, without blender_manifest.toml, which replaces it for an installed extension.
bl_info = {
    "name": "Skyprobe",
    "description": "Physically based light of the sky for a place and a time",
    "author": "The skyprobe contributors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "World properties; sidebar of the 3D view",
    "category": "Lighting",
}

# In the order in which they need each other.
MODULES = (settings, beside, operators, sequence, presets, panels, viewport_drawing, handlers, finish)


def register():
    for module in MODULES:
        module.register()


def unregister():
    beside.abandon()
    for module in reversed(MODULES):
        module.unregister()
    live.unregister()
    status_bar.forget()
