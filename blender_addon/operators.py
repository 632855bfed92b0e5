# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a sky, render its probe, take it away again; small helps of the panel."""

import os

import bpy
import skyprobe

from . import exposure, jobs, live, scene_probe, values
from .settings import MADE

# The job that runs now, for the panel and for unregister.
running_job = None


def editable(cls, context):
    """Whether the scene of `context` can be changed; the poll of `cls` says why not."""
    scene = context.scene
    if scene is None:
        return False
    if scene.library is not None:
        cls.poll_message_set("The scene is linked from another file: open that file, or make it local")
        return False
    return True


class SKYPROBE_OT_add(bpy.types.Operator):
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

    def execute(self, context):
        try:
            live.update_now(context.scene, final=False)
        except jobs.USER_ERRORS as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        live.request(context.scene)
        return {"FINISHED"}


class SKYPROBE_OT_render(bpy.types.Operator):
    """Compute the sky in full quality and light the scene by it. Goes on beside your work; Esc cancels"""

    bl_idname = "skyprobe.render"
    bl_label = "Render Probe"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if running_job is not None:
            cls.poll_message_set("A probe is being rendered")
            return False
        return editable(cls, context)

    def execute(self, context):
        return self._start(context) or self._run_here(context)

    def invoke(self, context, event):
        # Timers never fire in background mode.
        if bpy.app.background:
            return self.execute(context)
        return self._start(context) or self._run_beside(context)

    def modal(self, context, event):
        if event.type == "ESC":
            self._job.cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if self._job.is_alive():
            self._show_progress(context)
            return {"PASS_THROUGH"}
        self._leave(context)
        return self._finish()

    def cancel(self, context):
        """Blender ends the operator itself, as when another file is opened."""
        self._job.cancel()
        self._job.join()
        self._leave(context)

    def _start(self, context):
        """Make the job; None, or what the operator must return because the settings make no sense."""
        scene = context.scene
        self._scene_name = scene.name
        self._pack = scene.skyprobe.storage == "PACKED"
        try:
            path = values.probe_path(scene.skyprobe)
            check_folder(os.path.dirname(path))
            self._job = jobs.ProbeJob(values.final_request(scene), path)
        except jobs.USER_ERRORS as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return None

    def _run_here(self, context):
        self._job.run()
        return self._finish()

    def _run_beside(self, context):
        global running_job
        running_job = self._job
        self._job.start()
        window_manager = context.window_manager
        window_manager.progress_begin(0.0, 1.0)
        self._timer = window_manager.event_timer_add(0.1, window=context.window)
        window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _show_progress(self, context):
        job = self._job
        context.window_manager.progress_update(job.fraction)
        if context.workspace:
            context.workspace.status_text_set(f"Skyprobe: {job.stage} {job.fraction:.0%} (Esc cancels)")
        redraw(context)

    def _leave(self, context):
        global running_job
        running_job = None
        window_manager = context.window_manager
        window_manager.event_timer_remove(self._timer)
        window_manager.progress_end()
        if context.workspace:
            context.workspace.status_text_set(None)
        redraw(context)

    def _finish(self):
        """Use what the ended job has: light the scene, or say why not and leave it as it was."""
        job = self._job
        if isinstance(job.error, skyprobe.Cancelled):
            self.report({"INFO"}, "Skyprobe: cancelled")
            return {"CANCELLED"}
        if isinstance(job.error, jobs.USER_ERRORS):
            self.report({"ERROR"}, str(job.error))
            return {"CANCELLED"}
        if job.error is not None:
            raise job.error
        scene = bpy.data.scenes.get(self._scene_name)
        if scene is None:
            self.report({"WARNING"}, f"Skyprobe: the scene {self._scene_name} is gone; the probe is {job.path}")
            return {"CANCELLED"}
        try:
            scene_probe.show_probe(scene, job.result, job.path, self._pack)
        except jobs.USER_ERRORS as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if self._pack:
            os.remove(job.path)
        live.readout(scene).result = job.result
        exposure.follow(scene, job.result.horizontal_lx)
        if not is_current(scene):
            self.report({"WARNING"}, "Skyprobe: the settings have changed since this probe was begun; render it again")
        else:
            self.report({"INFO"}, f"Skyprobe: probe of {job.request.width} x {job.request.width // 2} pixels")
        return {"FINISHED"}


class SKYPROBE_OT_cancel(bpy.types.Operator):
    """Stop what is being computed and leave the scene as it is"""

    bl_idname = "skyprobe.cancel"
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        if running_job is not None:
            running_job.cancel()
        return {"FINISHED"}


class SKYPROBE_OT_remove(bpy.types.Operator):
    """Take the sky and its lamps away and give the scene its old world back"""

    bl_idname = "skyprobe.remove"
    bl_label = "Remove Sky"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if running_job is not None:
            cls.poll_message_set("A probe is being rendered: cancel that first")
            return False
        return editable(cls, context) and scene_probe.has_anything(context.scene)

    def execute(self, context):
        scene_probe.remove(context.scene)
        return {"FINISHED"}


class SKYPROBE_OT_reset(bpy.types.Operator):
    """Give every setting of the sky its default; what lights the scene stays until it is rendered again"""

    bl_idname = "skyprobe.reset"
    bl_label = "Reset to Defaults"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return editable(cls, context)

    def execute(self, context):
        settings = context.scene.skyprobe
        with live.held(context.scene):
            for name in settings.bl_rna.properties.keys():
                if name not in MADE and name not in {"rna_type", "name"} and settings.is_property_set(name):
                    settings.property_unset(name)
        return {"FINISHED"}


class SKYPROBE_OT_now(bpy.types.Operator):
    """Set date and time to this moment, as a clock at the place shows it"""

    bl_idname = "skyprobe.now"
    bl_label = "Now"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return editable(cls, context)

    def execute(self, context):
        settings = context.scene.skyprobe
        try:
            now = values.now(settings)
        except jobs.USER_ERRORS as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        with live.held(context.scene):
            values.set_clock(settings, now)
        return {"FINISHED"}


class SKYPROBE_OT_expose(bpy.types.Operator):
    """Set the exposure of the scene (Color Management) so that a grey card on the open ground is rendered grey"""

    bl_idname = "skyprobe.expose"
    bl_label = "Expose for the Sky"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return editable(cls, context)

    def execute(self, context):
        scene = context.scene
        result = live.readout(scene).result
        if result is None:
            try:
                result = jobs.preview(values.preview_request(scene))[1]
            except jobs.USER_ERRORS as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
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
        raise OSError(f"folder = {folder}: must be one that you may write to")


def redraw(context):
    """Draw the panels again."""
    for area in context.screen.areas if context.screen else ():
        if area.type in {"PROPERTIES", "VIEW_3D"}:
            area.tag_redraw()


CLASSES = (
    SKYPROBE_OT_add,
    SKYPROBE_OT_render,
    SKYPROBE_OT_cancel,
    SKYPROBE_OT_remove,
    SKYPROBE_OT_reset,
    SKYPROBE_OT_now,
    SKYPROBE_OT_expose,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    if running_job is not None:
        running_job.cancel()
        running_job.join()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
