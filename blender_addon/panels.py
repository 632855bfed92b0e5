# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel, once in the World properties and once in the sidebar of the 3D view."""

import bpy

from . import compat, operators, properties, scene_probe


def draw(layout, scene):
    """Draw everything that the user sets, in the order in which one thinks of it."""
    settings = scene.skyprobe
    layout.use_property_split = True
    layout.use_property_decorate = False
    _draw_run(layout, scene, settings)
    for name, title, section, closed in SECTIONS:
        header, body = compat.layout_panel(layout, f"skyprobe_{name}", closed)
        header.label(text=title)
        if body:
            section(body, settings)


def _draw_run(layout, scene, settings):
    job = operators.running_job
    if job is not None:
        compat.layout_progress(layout, job.fraction, f"{job.stage} {job.fraction:.0%} (Esc cancels)")
        return
    row = layout.row(align=True)
    row.operator(operators.SKYPROBE_OT_render.bl_idname, icon="LIGHT_SUN")
    row.operator(operators.SKYPROBE_OT_remove.bl_idname, text="", icon="X")
    if scene_probe.is_lit(scene):
        layout.label(
            text=f"Sun {settings.sun_altitude_deg:.2f}\N{DEGREE SIGN} high, azimuth {settings.sun_azimuth_deg:.2f}\N{DEGREE SIGN}"
        )


def _draw_place(layout, settings):
    column = layout.column(align=True)
    column.prop(settings, "latitude")
    column.prop(settings, "longitude")
    layout.prop(settings, "elevation_m")
    layout.prop(settings, "north")


def _draw_time(layout, settings):
    column = layout.column(align=True)
    column.prop(settings, "year")
    column.prop(settings, "month")
    column.prop(settings, "day")
    layout.prop(settings, "hour", slider=True, text="Time {:02d}:{:02d}:{:02d}".format(*properties.clock(settings)))
    layout.prop(settings, "zone_mode")
    if settings.zone_mode == "NAME":
        layout.prop(settings, "zone_name")
    elif settings.zone_mode == "OFFSET":
        layout.prop(settings, "utc_offset")


def _draw_air(layout, settings):
    layout.prop(settings, "preset")
    layout.prop(settings, "haze")
    if settings.haze != properties.OF_PRESET:
        layout.prop(settings, settings.haze)
    layout.prop(settings, "ground")


def _draw_air_details(layout, settings):
    layout.prop(settings, "aerosol")
    for switch, name in properties.OPTIONAL_AIR:
        row = layout.row(heading=settings.bl_rna.properties[name].name)
        row.prop(settings, switch, text="")
        value = row.row()
        value.active = getattr(settings, switch)
        value.prop(settings, name, text="")


def _draw_night(layout, settings):
    layout.prop(settings, "night_when")
    column = layout.column()
    column.active = settings.night_when != "never"
    column.prop(settings, "star_limit")
    column.prop(settings, "light_pollution")
    column.prop(settings, "solar_flux")


def _draw_filter(layout, settings):
    layout.prop(settings, "filter_mode")
    if settings.filter_mode == "NONE":
        return
    layout.prop(settings, "filter_strength", slider=True)
    layout.prop(settings, "filter_angle")
    if settings.filter_mode == "HELD":
        column = layout.column(align=True)
        column.prop(settings, "filter_altitude")
        column.prop(settings, "filter_azimuth")


def _draw_probe(layout, settings):
    layout.prop(settings, "width")
    layout.prop(settings, "quality")
    layout.prop(settings, "sun_mode")
    layout.prop(settings, "storage")
    if settings.storage == "FILE":
        layout.prop(settings, "directory")


# Name, title, what draws it, whether it is closed at first.
SECTIONS = (
    ("place", "Place", _draw_place, False),
    ("time", "Time", _draw_time, False),
    ("air", "Air", _draw_air, False),
    ("air_details", "Air in Detail", _draw_air_details, True),
    ("night", "Night", _draw_night, True),
    ("filter", "Polarising Filter", _draw_filter, True),
    ("probe", "Probe", _draw_probe, False),
)


class SKYPROBE_PT_world(bpy.types.Panel):
    bl_label = "Skyprobe"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "world"

    def draw(self, context):
        draw(self.layout, context.scene)


class SKYPROBE_PT_sidebar(bpy.types.Panel):
    bl_label = "Skyprobe"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Sky"

    def draw(self, context):
        draw(self.layout, context.scene)


CLASSES = (SKYPROBE_PT_world, SKYPROBE_PT_sidebar)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
