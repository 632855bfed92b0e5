# SPDX-License-Identifier: GPL-3.0-or-later
"""The probe, the lamps beside it, the preview, and what is drawn in the viewport."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, IntVectorProperty, PointerProperty, StringProperty

from .. import choices, compat, live, viewport_drawing

SUN_WAYS = (
    ("LAMP", "As a Lamp", "A Sun lamp of the right size, colour and strength: free of noise"),
    (
        "MAP",
        "In the Map",
        "The disc is drawn into the probe and seen in reflections. EEVEE makes a lamp of its own of it",
    ),
)


def _live_changed(settings, context):
    if settings.live:
        live.changed(settings, context)


def _helper_changed(settings, context):
    viewport_drawing.tag_redraw()


class Probe:
    """Properties of the probe to render and of the lamps beside it."""

    width_choice: EnumProperty(
        name="Resolution",
        description="Width of the rendered probe; its height is half of that. Its Sun is exact at every one",
        items=choices.WIDTHS,
        default="2048",
    )
    width: IntProperty(
        name="Width",
        description="Width of the probe, an even number of pixels; its height is half of that",
        subtype="PIXEL",
        min=64,
        max=16384,
        soft_min=512,
        soft_max=8192,
        default=2048,
        step=512,
    )
    quality: EnumProperty(
        name="Quality",
        description="How finely the light in the air is computed for the rendered probe; once for an air, whatever the time",
        items=choices.QUALITIES,
        default="standard",
    )
    sun_mode: EnumProperty(
        name="Sun",
        description="Where the light of the Sun's disc comes from",
        items=SUN_WAYS,
        default="LAMP",
        update=live.changed,
    )
    moon_mode: EnumProperty(
        name="Moon",
        description="Where the light of the Moon's disc comes from. The disc in the map shows its face",
        items=(
            ("MAP", "In the Map", "The disc with its seas is drawn into the probe"),
            ("LAMP", "As a Lamp", "A lamp of the right size, colour and strength: free of noise, but not seen"),
        ),
        default="MAP",
        update=live.changed,
    )
    storage: EnumProperty(
        name="Keep Probe",
        description="Where the rendered picture of the sky is kept",
        items=(
            ("PACKED", "In the .blend", "Packed: the file can go anywhere alone"),
            ("FILE", "As a File", "OpenEXR in a folder"),
        ),
        default="PACKED",
    )
    directory: StringProperty(
        name="Folder",
        description="Folder for OpenEXR files; // is where the .blend is",
        subtype="DIR_PATH",
        options={"ANIMATABLE"} | compat.PATH_OPTIONS,
        default="//",
    )
    sequence_directory: StringProperty(
        name="Sequence Folder",
        description="Folder for the OpenEXR files of an animated sky, one a frame; // is where the .blend is",
        subtype="DIR_PATH",
        options={"ANIMATABLE"} | compat.PATH_OPTIONS,
        default="//sky",
    )


class Preview:
    """Properties of the live preview and the helpers in the viewport."""

    live: BoolProperty(
        name="Live Preview",
        description="Show each change of place, time and air at once, coarsely, in the world of the scene",
        default=True,
        update=_live_changed,
    )
    preview_width: IntProperty(
        name="Preview Width",
        description="Width of the live preview; its height is half of that",
        subtype="PIXEL",
        min=64,
        max=4096,
        soft_min=256,
        soft_max=2048,
        default=512,
        step=256,
        update=live.changed,
    )
    auto_exposure: BoolProperty(
        name="Auto Exposure",
        description="Let the scene's exposure follow the light of the sky, so that dusk and night can be seen",
        default=False,
        update=live.changed,
    )
    exposure_offset: FloatProperty(
        name="Offset",
        description="Stops brighter than a grey card in the open would need",
        min=-20.0,
        max=20.0,
        soft_min=-5.0,
        soft_max=5.0,
        default=0.0,
        precision=1,
        step=50,
        update=live.changed,
    )
    show_diurnal_path: BoolProperty(
        name="Path of the Sun",
        description="Draw the way of the Sun on this date in the viewport, with hours",
        default=False,
        update=_helper_changed,
    )
    show_analemma: BoolProperty(
        name="Analemmas",
        description="Draw where the Sun stands at each full hour of the clock through the year",
        default=False,
        update=_helper_changed,
    )
    show_north: BoolProperty(
        name="Compass",
        description="Draw north, east, south and west round the origin of the scene",
        default=False,
        update=_helper_changed,
    )
    helper_size: FloatProperty(
        name="Size",
        description="Radius of what is drawn",
        subtype="DISTANCE",
        min=0.01,
        soft_max=1000.0,
        default=10.0,
        update=_helper_changed,
    )


class Made:
    """What was made from the settings; never shown as settings."""

    previous_world: PointerProperty(type=bpy.types.World)
    probe_world: PointerProperty(type=bpy.types.World)
    # The rendered probe, or sequence of probes.
    image: PointerProperty(type=bpy.types.Image)
    # The live preview changes between two: Cycles keeps the pixels of an image that changes in place.
    preview_a: PointerProperty(type=bpy.types.Image)
    preview_b: PointerProperty(type=bpy.types.Image)
    sun_lamp: PointerProperty(type=bpy.types.Object)
    moon_lamp: PointerProperty(type=bpy.types.Object)
    sun_azimuth_deg: FloatProperty()
    moon_azimuth_deg: FloatProperty()
    # What the world shows.
    shown: EnumProperty(
        items=(
            ("NOTHING", "Nothing", ""),
            ("PREVIEW", "Preview", ""),
            ("PROBE", "Rendered Probe", ""),
            ("SEQUENCE", "Rendered Sequence", ""),
        ),
        default="NOTHING",
    )
    # jobs.SkyRequest.key of `image`, so that the way back to its settings brings it back.
    image_key: StringProperty()
    # The rest of its jobs.SkyResult, as JSON.
    image_result: StringProperty()
    # The frames at which the exposure of the scene has keyframes of the sequence: the first, and the one after the last.
    exposure_keys: IntVectorProperty(size=2)
