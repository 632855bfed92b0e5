# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user sets, kept with the scene. A change shows in the live preview at once."""

import bpy
from bpy.props import PointerProperty

from .air import Air, Filter
from .night import Layers, Night
from .place_and_time import PlaceAndTime
from .probe import Made, Preview, Probe


class SkyprobeSettings(PlaceAndTime, Air, Filter, Night, Layers, Probe, Preview, Made, bpy.types.PropertyGroup):
    """Settings of the scene's sky, and what was made from them."""


# What belongs to this scene's data rather than to the user's wishes.
MADE = frozenset(Made.__annotations__)


def register():
    bpy.utils.register_class(SkyprobeSettings)
    bpy.types.Scene.skyprobe = PointerProperty(type=SkyprobeSettings)


def unregister():
    del bpy.types.Scene.skyprobe
    bpy.utils.unregister_class(SkyprobeSettings)
