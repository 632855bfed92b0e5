# SPDX-License-Identifier: GPL-3.0-or-later
"""Animated skies: a probe for each frame, as files that play as an image sequence, and keyframes for a time-lapse."""

import bpy
import skyprobe

from . import compat, exposure, jobs, lamps, live, operators, scene_probe, sequence_files, values

_running = None

FIRST_FRAME = 0


def is_running():
    """Whether a sequence is being rendered, which changes frames itself."""
    return _running is not None


def progress():
    """Return (frames done, frames in all) of the sequence that is being rendered, or None."""
    return (_running.done, len(_running.frames)) if _running else None


class _Sequence:
    """The frames of a scene on their way to files. Lives on the main thread; one jobs.ProbeJob at a time computes."""

    def __init__(self, scene):
        settings = scene.skyprobe
        if scene.frame_start < FIRST_FRAME:
            raise ValueError(f"frame_start = {scene.frame_start}: must be {FIRST_FRAME} or more for a sequence of files")
        self.scene_name = scene.name
        self.frames = range(scene.frame_start, scene.frame_end + 1)
        self.width = values.width(settings)
        self.results = {}
        self.done = 0
        self.skipped = 0
        self.job = None
        directory = settings.sequence_directory
        self.files = sequence_files.SequenceFiles(values.folder(settings, directory))
        values.final_request(scene)
        self.files.prepare(len(self.frames), self.width)
        self._frame_before = scene.frame_current

    def step(self, scene):
        """Begin the next frame that is not finished. Returns whether there was one; raise jobs.USER_ERRORS."""
        while self.done < len(self.frames):
            frame = self.frames[self.done]
            scene.frame_set(frame)
            request = values.final_request(scene)
            found = self.files.finished(frame, request)
            if found is None:
                self.job = jobs.ProbeJob(request, self.files.picture(frame))
                return True
            self.results[frame] = found
            self.done += 1
            self.skipped += 1
        return False

    def take(self):
        """Note the frame of the job that has ended; raise its error."""
        job, self.job = self.job, None
        if job.error is not None:
            raise job.error
        frame = self.frames[self.done]
        self.files.finish(frame, job.result)
        self.results[frame] = job.result
        self.done += 1

    def leave(self):
        """Go back to the frame at which it began."""
        scene = bpy.data.scenes.get(self.scene_name)
        if scene is not None:
            scene.frame_set(self._frame_before)

    def show(self, scene):
        """Let the world and the lamps of `scene` play the finished sequence."""
        first, last = self.frames[0], self.frames[-1]
        image = bpy.data.images.load(self.files.picture(first), check_existing=False)
        image.name = "Skyprobe Sequence"
        image.source = "SEQUENCE"
        compat.set_linear_rec709(image)
        image.alpha_mode = "NONE"
        if bpy.data.filepath:
            image.filepath_raw = bpy.path.relpath(self.files.picture(first))
        scene_probe.show_sequence(scene, image, (first, last), self.results[first])
        animate(scene, self.results)


def animate(scene, results):
    """Keyframe lamps and, if it follows the sky, exposure of `scene` by `results` (jobs.SkyResult by frame)."""
    settings = scene.skyprobe
    turns = {}
    for frame, result in sorted(results.items()):
        for name, lamp_of in (("sun_lamp", result.sun), ("moon_lamp", result.moon)):
            lamp = getattr(settings, name)
            if lamp is None or lamp_of is None:
                continue
            lamps.shine(lamp, lamp_of, settings.north)
            # The short way round from frame to frame.
            before = turns.get(name, lamp.rotation_euler.z)
            lamp.rotation_euler.z = turns[name] = lamps.nearest_turn(lamp.rotation_euler.z, before)
            lamp.keyframe_insert("rotation_euler", frame=frame)
            for path in ("energy", "color", "angle"):
                lamp.data.keyframe_insert(path, frame=frame)
        if settings.auto_exposure:
            exposure.expose(scene, result.horizontal_lx)
            scene.keyframe_insert("view_settings.exposure", frame=frame)
    for lamp in (settings.sun_lamp, settings.moon_lamp):
        if lamp is not None:
            compat.make_linear(lamp, lamp.data)


class SKYPROBE_OT_render_sequence(bpy.types.Operator):
    """Render a probe for each frame of the scene into the sequence folder, and let the world play them. Frames that are finished are skipped: after a break it goes on where it was. Esc cancels"""

    bl_idname = "skyprobe.render_sequence"
    bl_label = "Render Sequence"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        if operators.running_job is not None or is_running():
            cls.poll_message_set("A probe is being rendered")
            return False
        return operators.editable(cls, context)

    def execute(self, context):
        return self._start(context) or self._run_here(context)

    def invoke(self, context, event):
        # Timers never fire in background mode.
        if bpy.app.background:
            return self.execute(context)
        return self._start(context) or self._run_beside(context)

    def modal(self, context, event):
        if event.type == "ESC" and self._sequence.job is not None:
            self._sequence.job.cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        job = self._sequence.job
        if job.is_alive():
            self._show_progress(context)
            return {"PASS_THROUGH"}
        scene = bpy.data.scenes.get(self._sequence.scene_name)
        if scene is None:
            self._leave(context)
            self.report({"WARNING"}, "Skyprobe: the scene of the sequence is gone; the finished frames are kept")
            return {"CANCELLED"}
        try:
            self._sequence.take()
            if self._sequence.step(scene):
                self._sequence.job.start()
                return {"PASS_THROUGH"}
        except (skyprobe.Cancelled, *jobs.USER_ERRORS) as error:
            self._leave(context)
            return self._fail(error)
        self._leave(context)
        return self._finish(scene)

    def cancel(self, context):
        """Blender ends the operator itself, as when another file is opened."""
        if self._sequence.job is not None:
            self._sequence.job.cancel()
            self._sequence.job.join()
        self._leave(context)

    def _start(self, context):
        global _running
        try:
            self._sequence = _running = _Sequence(context.scene)
        except jobs.USER_ERRORS as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return None

    def _run_here(self, context):
        global _running
        scene, sequence = context.scene, self._sequence
        try:
            while sequence.step(scene):
                sequence.job.run()
                sequence.take()
                print(f"Skyprobe: {sequence.done} of {len(sequence.frames)} frames", flush=True)
        except (skyprobe.Cancelled, *jobs.USER_ERRORS) as error:
            return self._fail(error)
        finally:
            sequence.leave()
            _running = None
        return self._finish(scene)

    def _run_beside(self, context):
        global _running
        try:
            begun = self._sequence.step(context.scene)
        except jobs.USER_ERRORS as error:
            self._sequence.leave()
            _running = None
            return self._fail(error)
        if not begun:
            self._sequence.leave()
            _running = None
            return self._finish(context.scene)
        self._sequence.job.start()
        window_manager = context.window_manager
        window_manager.progress_begin(0.0, 1.0)
        self._timer = window_manager.event_timer_add(0.05, window=context.window)
        window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _show_progress(self, context):
        sequence = self._sequence
        context.window_manager.progress_update(sequence.done / len(sequence.frames))
        if context.workspace:
            context.workspace.status_text_set(f"Skyprobe: frame {sequence.done + 1} of {len(sequence.frames)} (Esc cancels)")
        operators.redraw(context)

    def _leave(self, context):
        global _running
        _running = None
        self._sequence.leave()
        window_manager = context.window_manager
        window_manager.event_timer_remove(self._timer)
        window_manager.progress_end()
        if context.workspace:
            context.workspace.status_text_set(None)
        operators.redraw(context)

    def _fail(self, error):
        if isinstance(error, skyprobe.Cancelled):
            done = self._sequence.done
            self.report({"INFO"}, f"Skyprobe: cancelled; {done} finished frames are kept, Render Sequence goes on from there")
        else:
            self.report({"ERROR"}, str(error))
        return {"CANCELLED"}

    def _finish(self, scene):
        sequence = self._sequence
        sequence.show(scene)
        made = len(sequence.frames) - sequence.skipped
        self.report({"INFO"}, f"Skyprobe: {made} frames rendered, {sequence.skipped} were there, in {sequence.files.folder}")
        return {"FINISHED"}


class SKYPROBE_OT_leave_sequence(bpy.types.Operator):
    """Stop playing the rendered sequence and go back to the live preview; the files stay"""

    bl_idname = "skyprobe.leave_sequence"
    bl_label = "Back to the Live Preview"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return operators.editable(cls, context) and context.scene.skyprobe.shown == "SEQUENCE"

    def execute(self, context):
        settings = context.scene.skyprobe
        for lamp in (settings.sun_lamp, settings.moon_lamp):
            if lamp is not None:
                lamp.animation_data_clear()
                lamp.data.animation_data_clear()
        settings.shown = "NOTHING"
        try:
            live.update_now(context.scene, final=False)
        except jobs.USER_ERRORS as error:
            self.report({"ERROR"}, str(error))
        return {"FINISHED"}


class SKYPROBE_OT_time_lapse(bpy.types.Operator):
    """Animate the time: set the start and two keyframes of the time offset. Play the animation to see it, then Render Sequence"""

    bl_idname = "skyprobe.time_lapse"
    bl_label = "Time-Lapse"
    bl_options = {"REGISTER", "UNDO"}

    span: bpy.props.EnumProperty(
        name="Span",
        description="Which time the animation runs through",
        items=(
            ("DAY", "Dawn to Dusk", "From the beginning of civil twilight to its end"),
            ("SUNRISE", "Sunrise", "The hour before and the hour after sunrise"),
            ("SUNSET", "Sunset", "The hour before and the hour after sunset"),
            ("NIGHT", "Dusk to Dawn", "From sunset to the sunrise of the next day"),
            ("WHOLE", "24 Hours", "From midnight to midnight"),
            ("YEAR", "A Year", "The same hour of 365 days"),
        ),
        default="DAY",
    )
    frames: bpy.props.IntProperty(
        name="Frames", description="How many frames it takes", min=2, max=100000, soft_max=2000, default=240
    )

    @classmethod
    def poll(cls, context):
        return operators.editable(cls, context)

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        scene = context.scene
        settings = scene.skyprobe
        try:
            start, hours = values.span(settings, self.span)
        except jobs.USER_ERRORS as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        first = max(scene.frame_start, FIRST_FRAME)
        last = first + self.frames - 1
        with live.held(scene):
            compat.remove_curve(scene, "skyprobe.time_offset_h")
            if start is not None:
                values.set_clock(settings, start)
            # A year goes from day to day, not by hours.
            keys = (
                [(first + k, 24.0 * round(365.0 * k / (self.frames - 1))) for k in range(self.frames)]
                if self.span == "YEAR"
                else [(first, 0.0), (last, hours)]
            )
            for frame, offset in keys:
                settings.time_offset_h = offset
                scene.keyframe_insert("skyprobe.time_offset_h", frame=frame)
            compat.make_linear(scene)
            scene.frame_start, scene.frame_end = first, last
            scene.frame_set(first)
        self.report({"INFO"}, f"Skyprobe: {hours:.1f} hours in frames {first} to {last}")
        return {"FINISHED"}


CLASSES = (SKYPROBE_OT_render_sequence, SKYPROBE_OT_leave_sequence, SKYPROBE_OT_time_lapse)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    if _running is not None and _running.job is not None:
        _running.job.cancel()
        _running.job.join()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
