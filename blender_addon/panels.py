# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel, once in the World properties and once in the sidebar of the 3D view: one description, two places."""

import bpy

from . import beside, choices, compat, live, operators, presets, readout, scene_probe, sequence, values, viewport_drawing


def _draw_top(layout, scene, settings):
    _draw_run(layout, scene, settings)
    live.ensure_readout(scene)
    shown = live.readout(scene)
    _draw_message(layout, shown.message)
    column = layout.column(align=True)
    for icon, text in readout.lines(shown, settings):
        column.label(text=text, icon=icon)


def _draw_message(layout, message):
    if not message:
        return
    # A label does not break its lines.
    box = layout.box().column(align=True)
    for number, line in enumerate(readout.wrapped(message)):
        box.label(text=line, icon="ERROR" if number == 0 else "BLANK1")


def _draw_run(layout, scene, settings):
    work = beside.current
    if work is not None:
        row = layout.row(align=True)
        compat.layout_progress(row, *work.progress())
        row.operator(beside.SKYPROBE_OT_cancel.bl_idname, text="", icon="X")
        return
    if not scene_probe.is_lit(scene):
        row = layout.row(align=True)
        row.scale_y = 1.4
        row.operator(operators.SKYPROBE_OT_add.bl_idname, icon="LIGHT_SUN")
        if scene_probe.has_anything(scene):
            row.operator(operators.SKYPROBE_OT_remove.bl_idname, text="", icon="X")
        return
    if settings.shown == "SEQUENCE":
        layout.label(text="Plays the rendered sequence", icon="SEQUENCE")
        row = layout.row(align=True)
        row.operator(sequence.SKYPROBE_OT_leave_sequence.bl_idname)
        row.operator(operators.SKYPROBE_OT_remove.bl_idname, text="", icon="X")
        return
    row = layout.row(align=True)
    row.scale_y = 1.4
    row.operator(operators.SKYPROBE_OT_render.bl_idname, icon="RENDER_STILL")
    row.prop(settings, "live", text="", icon="HIDE_OFF" if settings.live else "HIDE_ON", toggle=True)
    row.operator(operators.SKYPROBE_OT_remove.bl_idname, text="", icon="X")
    if settings.shown == "PREVIEW":
        layout.label(text="Preview; render for final pictures", icon="INFO")
    elif not operators.is_current(scene):
        layout.label(text="The settings have changed since this probe", icon="INFO")


def _draw_place(layout, scene, settings):
    layout.prop(settings, "place", icon="VIEWZOOM", text="")
    row = layout.row()
    row.alignment = "RIGHT"
    row.label(text=readout.place(settings))
    column = layout.column(align=True)
    column.prop(settings, "latitude")
    column.prop(settings, "longitude")
    layout.prop(settings, "elevation_m")
    layout.prop(settings, "north")


def _draw_time(layout, scene, settings):
    column = layout.column(align=True)
    column.prop(settings, "day")
    column.prop(settings, "month")
    column.prop(settings, "year")
    layout.prop(settings, "day_of_year", slider=True)
    layout.prop(settings, "hour", slider=True, text=f"Time {readout.time(settings)}")
    layout.prop(settings, "time_offset_h")
    layout.operator(operators.SKYPROBE_OT_now.bl_idname, icon="TIME")
    layout.prop(settings, "zone_mode")
    if settings.zone_mode == "NAME":
        layout.prop(settings, "zone_name")
    elif settings.zone_mode == "OFFSET":
        layout.prop(settings, "utc_offset")
    column = layout.column(align=True)
    for text in readout.zone(settings):
        row = column.row()
        row.alignment = "RIGHT"
        row.label(text=text)


def _draw_air(layout, scene, settings):
    layout.prop(settings, "preset")
    layout.prop(settings, "haze")
    if settings.haze != choices.OF_PRESET:
        layout.prop(settings, settings.haze)
    layout.prop(settings, "ground")


def _draw_air_details(layout, scene, settings):
    layout.prop(settings, "aerosol")
    for switch, name in values.OPTIONAL_AIR:
        row = layout.row(heading=settings.bl_rna.properties[name].name)
        row.prop(settings, switch, text="")
        value = row.row()
        value.active = getattr(settings, switch)
        value.prop(settings, name, text="")


def _draw_night(layout, scene, settings):
    layout.prop(settings, "night_when")
    column = layout.column()
    column.active = settings.night_when != "never"
    column.prop(settings, "star_limit")
    column.prop(settings, "solar_flux")
    column.prop(settings, "light_pollution")
    if settings.light_pollution != choices.NO_TOWNS:
        column.prop(settings, "led_share", slider=True)


def _draw_layers(layout, scene, settings):
    column = layout.column(align=True)
    for name, _, _ in choices.LAYERS:
        column.prop(settings, f"layer_{name}")


def _draw_filter(layout, scene, settings):
    layout.prop(settings, "filter_mode")
    if settings.filter_mode == "NONE":
        return
    layout.prop(settings, "filter_strength", slider=True)
    layout.prop(settings, "filter_angle")
    if settings.filter_mode == "HELD":
        column = layout.column(align=True)
        column.prop(settings, "filter_altitude")
        column.prop(settings, "filter_azimuth")


def _draw_probe(layout, scene, settings):
    column = layout.column()
    column.prop(settings, "width_choice")
    if settings.width_choice == "OTHER":
        column.prop(settings, "width")
    column.prop(settings, "quality")
    layout.prop(settings, "sun_mode")
    layout.prop(settings, "moon_mode")
    layout.prop(settings, "storage")
    if settings.storage == "FILE":
        layout.prop(settings, "directory")


def _draw_exposure(layout, scene, settings):
    layout.prop(settings, "auto_exposure")
    layout.prop(settings, "exposure_offset")
    layout.operator(operators.SKYPROBE_OT_expose.bl_idname, icon="CAMERA_DATA")
    layout.prop(scene.view_settings, "exposure", text="Scene Exposure")


def _draw_animation(layout, scene, settings):
    layout.operator(sequence.SKYPROBE_OT_time_lapse.bl_idname, text="Time-Lapse...", icon="TIME")
    layout.prop(settings, "sequence_directory")
    layout.operator(sequence.SKYPROBE_OT_render_sequence.bl_idname, icon="RENDER_ANIMATION")
    if compat.is_animated(scene, "skyprobe.") and settings.shown != "SEQUENCE":
        # Without a sequence the world changes while Blender renders.
        layout.prop(scene.render, "use_lock_interface")


def _draw_viewport(layout, scene, settings):
    layout.prop(settings, "preview_width")
    column = layout.column(heading="Show")
    column.prop(settings, "show_diurnal_path")
    column.prop(settings, "show_analemma")
    column.prop(settings, "show_north")
    layout.prop(settings, "helper_size")
    _draw_message(layout, viewport_drawing.failure())


# Name, title, what draws it, whether it is closed at first.
SECTIONS = (
    ("place", "Place", _draw_place, False),
    ("time", "Time", _draw_time, False),
    ("air", "Air", _draw_air, False),
    ("air_details", "Air in Detail", _draw_air_details, True),
    ("night", "Night", _draw_night, True),
    ("layers", "Layers", _draw_layers, True),
    ("filter", "Polarising Filter", _draw_filter, True),
    ("probe", "Probe", _draw_probe, False),
    ("exposure", "Exposure", _draw_exposure, True),
    ("animation", "Animation", _draw_animation, True),
    ("viewport", "Viewport", _draw_viewport, True),
)

# Name, where it is.
PLACES = (
    ("world", {"bl_space_type": "PROPERTIES", "bl_region_type": "WINDOW", "bl_context": "world"}),
    ("sidebar", {"bl_space_type": "VIEW_3D", "bl_region_type": "UI", "bl_category": "Sky"}),
)


class _Panel:
    """A panel that draws a function (layout, scene, settings)."""

    def draw(self, context):
        scene = context.scene
        layout = self.layout
        layout.use_property_split = True
        # Sections can be keyframed: the dots beside the values say so.
        layout.use_property_decorate = self.is_animatable
        layout.enabled = scene.library is None
        type(self).section(layout, scene, scene.skyprobe)


def _draw_presets(self, context):
    self.layout.menu(presets.SKYPROBE_MT_presets.bl_idname, text="", icon="PRESET")


def _classes():
    for place, where in PLACES:
        root = f"SKYPROBE_PT_{place}"
        content = {
            "bl_label": "Skyprobe",
            "section": staticmethod(_draw_top),
            "is_animatable": False,
            "draw_header_preset": _draw_presets,
        }
        yield type(root, (_Panel, bpy.types.Panel), {**where, **content})
        for name, title, section, closed in SECTIONS:
            yield type(
                f"{root}_{name}",
                (_Panel, bpy.types.Panel),
                {
                    **where,
                    "bl_label": title,
                    "bl_parent_id": root,
                    "bl_options": {"DEFAULT_CLOSED"} if closed else set(),
                    "section": staticmethod(section),
                    "is_animatable": name in {"place", "time", "air", "air_details", "night", "layers", "filter"},
                },
            )


CLASSES = tuple(_classes())


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
