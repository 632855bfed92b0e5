# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a sky, render its probe, take it away again; small helps of the panel."""

import os

import bpy

from . import beside, compat, exposure, jobs, live, scene_probe, values
from .failures import Telling
from .settings import MADE


def editable(cls, context):
    """Whether the scene of `context` can be changed; the poll of `cls` says why not."""
    scene = context.scene
    if scene is None:
        return False
    if scene.library is not None:
        cls.poll_message_set("The scene is linked from another file: open that file, or make it local")
        return False
    return True


def free(cls, context):
    """The same, and whether nothing is being rendered for it."""
    if beside.refusal():
        cls.poll_message_set(beside.refusal())
        return False
    return editable(cls, context)


class SKYPROBE_OT_add(Telling, bpy.types.Operator):
    """Show the sky of the place and time in this scene's world. The scene's old world is kept and comes back when the sky is removed"""

    bl_idname = "skyprobe.add"
    bl_label = "Add Sky"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not editable(cls, context):
            return False
        if scene_probe.is_lit(context.scene):
            cls.poll_message_set("The scene has its sky")
            return False
        return True

    def run(self, context):
        live.update_now(context.scene, final=False)
        live.request(context.scene)
        return {"FINISHED"}


class _Probe:
    """The probe of a scene on its way (a work of beside)."""

    def __init__(self, scene):
        settings = scene.skyprobe
        self.job = None
        self._scene_name, self._scene_key = scene.name, compat.key_of(scene)
        self._pack = settings.storage == "PACKED"
        path = values.probe_path(settings)
        check_folder(os.path.dirname(path))
        self._jobs = [jobs.ProbeJob(values.final_request(scene), path, temporary=self._pack)]
        self._done = None

    def next(self):
        self.job = self._jobs.pop() if self._jobs else None
        return self.job is not None

    def take(self):
        self._done, self.job = self.job, None
        if self._done.error is not None:
            raise self._done.error

    def when_cancelled(self):
        return "cancelled; the scene is as it was"

    def progress(self):
        job = self.job or self._done
        return job.fraction, f"{job.stage} {job.fraction:.0%}"

    def leave(self):
        pass

    def finish(self, report):
        """Light the scene, or say why not and leave it as it was."""
        job = self._done
        try:
            scene = compat.scene_of(self._scene_key)
            if scene is None:
                kept = "nothing of it is kept" if self._pack else f"it is kept as {job.path}"
                raise ValueError(f"scene = {self._scene_name}: must be there until its probe is finished; {kept}")
            scene_probe.show_probe(scene, job.result, job.path, self._pack)
        finally:
            job.discard()
        live.readout(scene).result = job.result
        exposure.follow(scene, job.result.horizontal_lx)
        if is_current(scene):
            report({"INFO"}, f"Skyprobe: probe of {job.request.width} x {job.request.width // 2} pixels")
        else:
            report({"WARNING"}, "Skyprobe: the settings have changed since this probe was begun; render it again")


class SKYPROBE_OT_render(beside.Beside, bpy.types.Operator):
    """Compute the sky in full quality and light the scene by it. Goes on beside your work; Esc cancels"""

    bl_idname = "skyprobe.render"
    bl_label = "Render Probe"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return free(cls, context)

    def make(self, scene):
        return _Probe(scene)


class SKYPROBE_OT_remove(Telling, bpy.types.Operator):
    """Take the sky and its lamps away and give the scene its old world back"""

    bl_idname = "skyprobe.remove"
    bl_label = "Remove Sky"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return free(cls, context) and scene_probe.has_anything(context.scene)

    def run(self, context):
        scene_probe.remove(context.scene)
        return {"FINISHED"}


class SKYPROBE_OT_reset(Telling, bpy.types.Operator):
    """Give every setting of the sky its default; what lights the scene stays until it is rendered again"""

    bl_idname = "skyprobe.reset"
    bl_label = "Reset to Defaults"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return editable(cls, context)

    def run(self, context):
        settings = context.scene.skyprobe
        with live.held(context.scene):
            for name in settings.bl_rna.properties.keys():
                if name not in MADE and name not in {"rna_type", "name"} and settings.is_property_set(name):
                    settings.property_unset(name)
        return {"FINISHED"}


class SKYPROBE_OT_now(Telling, bpy.types.Operator):
    """Set date and time to this moment, as a clock at the place shows it"""

    bl_idname = "skyprobe.now"
    bl_label = "Now"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return editable(cls, context)

    def run(self, context):
        settings = context.scene.skyprobe
        now = values.now(settings)
        with live.held(context.scene):
            values.set_clock(settings, now)
        return {"FINISHED"}


class SKYPROBE_OT_expose(Telling, bpy.types.Operator):
    """Set the exposure of the scene (Color Management) so that a grey card on the open ground is rendered grey"""

    bl_idname = "skyprobe.expose"
    bl_label = "Expose for the Sky"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return editable(cls, context)

    def run(self, context):
        scene = context.scene
        result = live.readout(scene).result
        # In background mode nothing follows the settings.
        if result is None or bpy.app.background:
            result = jobs.preview(values.preview_request(scene))[1]
        exposure.expose(scene, result.horizontal_lx)
        self.report({"INFO"}, f"Skyprobe: {result.horizontal_lx:.3g} lx, exposure {scene.view_settings.exposure:+.1f} stops")
        return {"FINISHED"}


def is_current(scene):
    """Whether the rendered probe of `scene` is that of its settings."""
    try:
        return scene.skyprobe.image_key == values.final_request(scene).key
    except jobs.USER_ERRORS:
        return False


def check_folder(folder):
    """Raise OSError if no file can be written in `folder`."""
    if not os.path.isdir(folder):
        raise OSError(f"folder = {folder}: must be a folder that exists; choose another, or make it")
    if not os.access(folder, os.W_OK):
        raise OSError(f"folder = {folder}: must be one that you may write to; choose another")


CLASSES = (
    SKYPROBE_OT_add,
    SKYPROBE_OT_render,
    SKYPROBE_OT_remove,
    SKYPROBE_OT_reset,
    SKYPROBE_OT_now,
    SKYPROBE_OT_expose,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
