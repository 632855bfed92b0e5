# SPDX-License-Identifier: GPL-3.0-or-later
"""Skyprobe for Blender: the light of the sky for a place and a time, as the world of a scene.

    properties ──> operators ──> jobs (a thread, the skyprobe library, no bpy) ──> scene_probe ──> world_nodes, sun_lamp

`properties` holds what the user sets, `panels` shows it, `compat` knows what differs between Blender versions.
Conventions: +X east, +Y north (until the user turns north), +Z up.
"""

from . import finish, operators, panels, properties

MODULES = (properties, operators, panels, finish)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
