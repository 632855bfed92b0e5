# SPDX-License-Identifier: GPL-3.0-or-later
"""Animated skies: a probe for each frame, as files that play as an image sequence, and keyframes for a time-lapse."""

import time
from pathlib import Path

import bpy

from . import beside, compat, exposure, jobs, lamps, live, operators, scene_probe, sequence_files, values, world_nodes, world_sun
from .failures import Telling

FIRST_FRAME = 0
# The largest number that Blender gives a frame.
LAST_FRAME = 1048574
# How long the main thread looks for the next frame that is not finished before the interface has its turn [s].
LOOK_S = 0.05


def is_running():
    """Whether a sequence is being rendered, which changes frames itself."""
    return isinstance(beside.current, _Sequence)


class _Sequence:
    """The frames of a scene on their way to files (a work of beside)."""

    def __init__(self, scene):
        settings = scene.skyprobe
        if scene.frame_start < FIRST_FRAME:
            raise ValueError(f"frame_start = {scene.frame_start}: must be {FIRST_FRAME} or more for a sequence of files")
        self.job = None
        self._scene_name, self._scene_key = scene.name, compat.key_of(scene)
        self._frames = range(scene.frame_start, scene.frame_end + 1)
        self._results = {}
        self._done = 0
        self._skipped = 0
        self._files = sequence_files.SequenceFiles(values.folder(settings, settings.sequence_directory))
        refuse_folder_in_use(scene, self._files.folder)
        values.check_path(self._files.picture(self._frames[-1]))
        values.final_request(scene)
        self._files.prepare(len(self._frames), values.width(settings))
        self._frame_before = scene.frame_current

    def next(self):
        scene = self._scene()
        until = time.monotonic() + LOOK_S
        while self._done < len(self._frames):
            frame = self._frames[self._done]
            scene.frame_set(frame)
            request = values.final_request(scene)
            found = self._files.finished(frame, request)
            if found is None:
                self.job = jobs.ProbeJob(request, self._files.picture(frame))
                return True
            self._results[frame] = found
            self._done += 1
            self._skipped += 1
            if time.monotonic() > until:
                return True
        return False

    def take(self):
        job, self.job = self.job, None
        if job.error is not None:
            raise job.error
        frame = self._frames[self._done]
        self._files.finish(frame, job.result)
        self._results[frame] = job.result
        self._done += 1
        if bpy.app.background:
            print(f"Skyprobe: {self._done} of {len(self._frames)} frames", flush=True)

    def when_cancelled(self):
        return f"cancelled; {self._done} finished frames are kept, Render Sequence goes on from there"

    def progress(self):
        return self._done / len(self._frames), f"frame {self._done + 1} of {len(self._frames)}"

    def leave(self):
        """Go back to the frame at which it began."""
        scene = compat.scene_of(self._scene_key)
        if scene is not None:
            scene.frame_set(self._frame_before)

    def finish(self, report):
        """Let the world and the lamps of the scene play the finished sequence."""
        scene = self._scene()
        first, last = self._frames[0], self._frames[-1]
        image = world_nodes.load_sequence(self._files.picture(first))
        scene_probe.show_sequence(scene, image, (first, last), self._results[first])
        complaint = animate(scene, self._results)
        made = len(self._frames) - self._skipped
        text = f"Skyprobe: {made} frames rendered, {self._skipped} were there, in {self._files.folder}"
        report({"WARNING" if complaint else "INFO"}, f"{text}; {complaint}" if complaint else text)

    def _scene(self):
        scene = compat.scene_of(self._scene_key)
        if scene is None:
            raise ValueError(f"scene = {self._scene_name}: must be there until its sequence is finished; {self._done} finished frames are kept")
        return scene


def refuse_folder_in_use(scene, folder):
    """Raise ValueError if another scene of this file plays a sequence from `folder` (a path), whose pictures would change under it."""
    for other in bpy.data.scenes:
        settings = other.skyprobe
        image = settings.image
        if other == scene or settings.shown != "SEQUENCE" or image is None or image == scene.skyprobe.image:
            continue
        if Path(bpy.path.abspath(image.filepath_raw)).parent == folder:
            raise ValueError(f"sequence_directory = {scene.skyprobe.sequence_directory}: must be another; the scene {other.name} plays its sequence from there")


def animate(scene, results):
    """Keyframe lamps and, if it follows the sky, exposure of `scene` by `results` (jobs.SkyResult by frame); return what could not be, or an empty text."""
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
    for lamp in (settings.sun_lamp, settings.moon_lamp):
        if lamp is not None:
            compat.make_linear(lamp, lamp.data)
    discs = {frame: world_sun.disc_of(result) for frame, result in results.items()}
    if not all(disc.is_dark for disc in discs.values()):
        world_nodes.set_disc(settings.probe_world, discs[min(discs)])
        world_sun.insert_keys(settings.probe_world, discs)
    if not settings.auto_exposure:
        return ""
    return exposure.insert_keys(scene, {frame: result.horizontal_lx for frame, result in results.items()})


class SKYPROBE_OT_render_sequence(beside.Beside, bpy.types.Operator):
    """Render a probe for each frame of the scene into the sequence folder, and let the world play them. Frames that are finished are skipped: after a break it goes on where it was. Esc cancels"""

    bl_idname = "skyprobe.render_sequence"
    bl_label = "Render Sequence"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return operators.free(cls, context)

    def make(self, scene):
        return _Sequence(scene)


class SKYPROBE_OT_leave_sequence(Telling, bpy.types.Operator):
    """Stop playing the rendered sequence and go back to the live preview; the files stay"""

    bl_idname = "skyprobe.leave_sequence"
    bl_label = "Back to the Live Preview"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return operators.free(cls, context) and context.scene.skyprobe.shown == "SEQUENCE"

    def run(self, context):
        live.update_now(context.scene, final=False, anew=True)
        return {"FINISHED"}


class SKYPROBE_OT_time_lapse(Telling, bpy.types.Operator):
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
        return operators.free(cls, context)

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self)

    def run(self, context):
        scene = context.scene
        settings = scene.skyprobe
        first = max(scene.frame_start, FIRST_FRAME)
        last = first + self.frames - 1
        if last > LAST_FRAME:
            raise ValueError(f"frames = {self.frames}: must end at frame {LAST_FRAME} or before; begin earlier than at {first}")
        compat.check_animatable(scene, "skyprobe.time_offset_h")
        start, hours = values.span(settings, self.span)
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
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
