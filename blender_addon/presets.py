# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: configurations in files, those that come with the add-on and the user's own."""

import contextlib
import json
import os
from pathlib import Path

import bpy
from bpy.props import EnumProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from . import compat, configuration, live, operators
from .failures import Telling

OURS = Path(__file__).resolve().parent / "presets"
# Characters that some file system does not take.
FORBIDDEN = '<>:"/\\|?*'


def own_folder():
    """Return the folder of the user's presets, which need not exist."""
    return Path(compat.user_folder("presets"))


def all_of(folder):
    """Return (title, path) of the presets in `folder`, by title."""
    try:
        return sorted((path.stem, str(path)) for path in Path(folder).glob("*.json"))
    except OSError:
        return []


def write(path, content):
    """Write the configuration `content` to `path`, whole or not at all."""
    path = Path(path)
    if not path.name:
        raise ValueError(f"file = {path}: must be the name of a file")
    part = path.with_name(f".{path.name}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.write_text(json.dumps(content, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
        os.replace(part, path)
    except OSError as error:
        raise OSError(f"file = {path}: must be a short name in a folder that you may write to ({error.strerror})") from None
    finally:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)


def apply(scene, path):
    """Give `scene` the configuration in the file `path`; return what of it Blender does without, as texts.

    ValueError or OSError, before any change, if that cannot be.
    """
    content = configuration.load(path)
    with live.held(scene):
        try:
            return configuration.to_settings(content, scene.skyprobe)
        except ValueError as error:
            raise ValueError(f"{error} (in {Path(path).name})") from None


class _Applying(Telling):
    def run(self, context):
        notes = apply(context.scene, self.filepath)
        if notes:
            self.report({"WARNING"}, f"Skyprobe: {'; '.join(notes)}")
        return {"FINISHED"}


class SKYPROBE_OT_apply_preset(_Applying, bpy.types.Operator):
    """Set the sky to this preset. What the preset does not hold stays as it is"""

    bl_idname = "skyprobe.apply_preset"
    bl_label = "Apply Sky Preset"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    filepath: StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return operators.editable(cls, context)


class SKYPROBE_OT_save_preset(Telling, bpy.types.Operator):
    """Save the settings of the sky as a preset, for all scenes"""

    bl_idname = "skyprobe.save_preset"
    bl_label = "Save Sky Preset"

    title: StringProperty(name="Name", description="Name of the preset, and of its file")
    sections: EnumProperty(
        name="Keep",
        description="What the preset holds; the rest stays as it is when it is applied",
        options={"ENUM_FLAG"},
        items=(
            ("place", "Place", "Latitude, longitude, elevation"),
            ("time", "Time", "Date, time, zone"),
            ("air", "Air", "State of the air, ground, quality"),
            ("night", "Night", "Lights of the night, layers"),
            ("filter", "Filter", "The polarising filter"),
            ("probe", "Probe", "Resolution and where the Sun is"),
        ),
        default={"place", "time", "air", "night", "filter"},
    )

    @classmethod
    def poll(cls, context):
        return context.scene is not None

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self)

    def run(self, context):
        title = self.title.strip()
        if not title or title.startswith(".") or any(letter in FORBIDDEN or ord(letter) < 32 for letter in title):
            raise ValueError(f"name = {self.title!r}: must be a file's name, without {FORBIDDEN}")
        if not self.sections:
            raise ValueError("keep = nothing: must be at least one part of the settings")
        write(own_folder() / f"{title}.json", configuration.from_settings(context.scene.skyprobe, self.sections))
        self.report({"INFO"}, f"Skyprobe: saved {title}")
        return {"FINISHED"}


class SKYPROBE_OT_delete_preset(Telling, bpy.types.Operator):
    """Delete this preset of yours"""

    bl_idname = "skyprobe.delete_preset"
    bl_label = "Delete Sky Preset"

    title: StringProperty(options={"SKIP_SAVE"})

    def invoke(self, context, event):
        return context.window_manager.invoke_confirm(self, event)

    def run(self, context):
        paths = dict(all_of(own_folder()))
        if self.title not in paths:
            raise ValueError(f"name = {self.title!r}: must be one of {', '.join(paths) or 'your presets, and there are none'}")
        os.remove(paths[self.title])
        return {"FINISHED"}


class SKYPROBE_OT_import_configuration(_Applying, bpy.types.Operator, ImportHelper):
    """Read the settings from a configuration of the command line tool, a preset, or a picture of skyprobe"""

    bl_idname = "skyprobe.import_configuration"
    bl_label = "Import Configuration"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json;*.exr;*.hdr", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return operators.editable(cls, context)


class SKYPROBE_OT_export_configuration(Telling, bpy.types.Operator, ExportHelper):
    """Write the settings as a configuration: skyprobe render --config FILE makes the same probe without Blender"""

    bl_idname = "skyprobe.export_configuration"
    bl_label = "Export Configuration"

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return context.scene is not None

    def run(self, context):
        write(self.filepath, configuration.from_settings(context.scene.skyprobe))
        return {"FINISHED"}


class SKYPROBE_MT_presets(bpy.types.Menu):
    """Skies to begin with, and your own"""

    bl_label = "Sky Presets"
    bl_idname = "SKYPROBE_MT_presets"

    def draw(self, context):
        layout = self.layout
        own = all_of(own_folder())
        for title, path in all_of(OURS):
            layout.operator(SKYPROBE_OT_apply_preset.bl_idname, text=title).filepath = path
        if own:
            layout.separator()
        for title, path in own:
            layout.operator(SKYPROBE_OT_apply_preset.bl_idname, text=title).filepath = path
        layout.separator()
        layout.operator(SKYPROBE_OT_save_preset.bl_idname, text="Save Preset...", icon="ADD")
        if own:
            layout.menu(SKYPROBE_MT_delete_preset.bl_idname, icon="REMOVE")
        layout.operator(SKYPROBE_OT_import_configuration.bl_idname, text="Import...", icon="IMPORT")
        layout.operator(SKYPROBE_OT_export_configuration.bl_idname, text="Export...", icon="EXPORT")
        layout.separator()
        layout.operator(operators.SKYPROBE_OT_reset.bl_idname, icon="LOOP_BACK")


class SKYPROBE_MT_delete_preset(bpy.types.Menu):
    """Presets of yours"""

    bl_label = "Delete Preset"
    bl_idname = "SKYPROBE_MT_delete_preset"

    def draw(self, context):
        for title, _ in all_of(own_folder()):
            self.layout.operator(SKYPROBE_OT_delete_preset.bl_idname, text=title).title = title


CLASSES = (
    SKYPROBE_OT_apply_preset,
    SKYPROBE_OT_save_preset,
    SKYPROBE_OT_delete_preset,
    SKYPROBE_OT_import_configuration,
    SKYPROBE_OT_export_configuration,
    SKYPROBE_MT_presets,
    SKYPROBE_MT_delete_preset,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
