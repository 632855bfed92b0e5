# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a probe, in the window without blocking it, or at once in background mode; and take it away again."""

import os

import bpy
import skyprobe

from . import compat, jobs, properties, scene_probe

# The job that runs now, for the panel and for unregister.
running_job = None


def request_of(scene):
    """Return the jobs.ProbeRequest of `scene`; ValueError for a folder that cannot be meant."""
    settings = scene.skyprobe
    place, time = properties.place(settings), properties.time(settings)
    stamp = time[:16].replace("-", "").replace(":", "")
    name = f"sky_{place['latitude']:+.4f}_{place['longitude']:+.4f}_{stamp}_{settings.width}.exr"
    return jobs.ProbeRequest(
        air=properties.air(settings),
        place=place,
        time=time,
        width=settings.width,
        sun_in_map=settings.sun_mode == "MAP",
        lamp_color_space=compat.working_color_space(),
        path=os.path.join(_folder(settings), name),
        pack=settings.storage == "PACKED",
        polarising_filter=properties.polarising_filter(settings),
        night=properties.night(settings),
    )


def _folder(settings):
    if settings.storage == "PACKED":
        return bpy.app.tempdir
    if settings.directory.startswith("//") and not bpy.data.filepath:
        raise ValueError(f"folder = {settings.directory}: must be absolute until the .blend is saved")
    return bpy.path.abspath(settings.directory)


class SKYPROBE_OT_render(bpy.types.Operator):
    """Compute the light of the sky for the place and time, and light the scene by it. Esc cancels"""

    bl_idname = "skyprobe.render"
    bl_label = "Render Probe"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if running_job is not None:
            cls.poll_message_set("A probe is being rendered")
            return False
        return context.scene is not None

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
        self._scene_name = context.scene.name
        try:
            self._job = jobs.ProbeJob(request_of(context.scene))
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
        for area in context.screen.areas if context.screen else ():
            if area.type in {"PROPERTIES", "VIEW_3D"}:
                area.tag_redraw()

    def _leave(self, context):
        global running_job
        running_job = None
        window_manager = context.window_manager
        window_manager.event_timer_remove(self._timer)
        window_manager.progress_end()
        if context.workspace:
            context.workspace.status_text_set(None)

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
            self.report({"WARNING"}, f"Skyprobe: the scene {self._scene_name} is gone")
            return {"CANCELLED"}
        scene_probe.apply(scene, job.result)
        if job.request.pack:
            os.remove(job.request.path)
        return {"FINISHED"}


class SKYPROBE_OT_remove(bpy.types.Operator):
    """Take the probe and its lamp away and give the scene its old world back"""

    bl_idname = "skyprobe.remove"
    bl_label = "Remove Probe"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return running_job is None and context.scene is not None and scene_probe.is_lit(context.scene)

    def execute(self, context):
        scene_probe.remove(context.scene)
        return {"FINISHED"}


CLASSES = (SKYPROBE_OT_render, SKYPROBE_OT_remove)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    if running_job is not None:
        running_job.cancel()
        running_job.join()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    jobs.forget_atmosphere()
