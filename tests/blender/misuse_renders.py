"""What happens while a probe is being rendered, and failures that nobody foresaw: cases of misuse_steps.

Without a window there is no event loop: the modal operator's own methods are called as that would call them.
"""

import threading
import time
from pathlib import Path
from types import SimpleNamespace

import addon_utils
import bpy
import skyprobe
from misuse_steps import case, environment, replaced
from steps import PACKAGE, error_of, part, pixels_of

RENDERED = "probe of 64 x 32 pixels"
# The library notices a cancellation within some 50 ms; this is for a busy machine [s].
SOON_S = 0.5


class Waiting:
    """A modal operator that waits for a work as in a window, and the gate at which its job waits."""

    def __init__(self, operator="operators.SKYPROBE_OT_render"):
        module, name = operator.split(".")
        made = getattr(part(module), name)
        self.reports = []
        mixin = part("beside").Beside
        self._operator = type("Waiting", (mixin,), {"make": made.make, "report": lambda _, level, text: self.reports.append(text)})()
        self._context = SimpleNamespace(window=bpy.context.window, scene=bpy.context.scene, window_manager=self)
        self._gate = threading.Event()
        self._jobs = part("jobs")
        self._write = self._jobs.write
        self._jobs.write = self._slow_write
        self.answer = self._operator.told(lambda: self._operator._run_beside(self._context))

    # What the operator asks of the window manager.
    def progress_begin(self, start, end): ...
    def progress_update(self, fraction): ...
    def modal_handler_add(self, operator): ...

    def event_timer_add(self, period, window):
        return bpy.context.window_manager.event_timer_add(period, window=window)

    def _slow_write(self, request, path, progress=None):
        while not self._gate.wait(0.005):
            if progress is not None and not progress("solve", 0.5):
                raise skyprobe.Cancelled("cancelled")
        return self._write(request, path, progress)

    def event(self, kind):
        """Let the operator have an event; return its answer."""
        self.answer = self._operator.modal(self._context, SimpleNamespace(type=kind, value="PRESS"))
        return self.answer

    def finish(self):
        """Open the gate and wait for the operator's end; return what it reports."""
        self._gate.set()
        return self.wait()

    def wait(self):
        until = time.monotonic() + 20.0
        while self.answer & {"RUNNING_MODAL", "PASS_THROUGH"} and time.monotonic() < until:
            self.event("TIMER")
            time.sleep(0.002)
        self._jobs.write = self._write
        return " ".join(self.reports)

    def end(self):
        """Blender ends the operator, as when another file is opened; return how long that takes [s]."""
        start = time.perf_counter()
        self._operator.cancel(self._context)
        self._jobs.write = self._write
        return time.perf_counter() - start


def _threads():
    return [thread for thread in threading.enumerate() if thread.name.startswith("skyprobe")]


def _no_thread_left():
    until = time.monotonic() + SOON_S
    while _threads() and time.monotonic() < until:
        time.sleep(0.01)
    assert not _threads(), _threads()
    left = [path.name for path in Path(bpy.app.tempdir).glob("*") if path.name.startswith(("sky_", ".skyprobe"))]
    assert not left, left


@case(RENDERED)
def nothing_happens(stage):
    """A render beside the work, undisturbed: what the others are compared with."""
    stage.unmark()
    waiting = Waiting()
    for _ in range(3):
        assert waiting.event("TIMER") == {"PASS_THROUGH"} and waiting.event("MOUSEMOVE") == {"PASS_THROUGH"}
    return waiting.finish()


@case("cancelled; the scene is as it was")
def escape(stage):
    """Esc is pressed."""
    stage.add()
    waiting = Waiting()
    waiting.event("ESC")
    told = waiting.wait()
    _no_thread_left()
    return told


@case(RENDERED)
def scene_renamed(stage):
    """The scene gets another name, and another scene gets its name."""
    stage.unmark()
    waiting = Waiting()
    stage.scene.name = "Renamed"
    other = bpy.data.scenes.new("Scene")
    told = waiting.finish()
    assert stage.settings.shown == "PROBE" and other.world is None
    return told


@case("scene = Scene: must be there until its probe is finished; nothing of it is kept")
def scene_deleted(stage):
    """The scene is deleted."""
    stage.unmark()
    waiting = Waiting()
    first = stage.scene
    bpy.ops.scene.new(type="NEW")
    bpy.data.scenes.remove(first)
    told = waiting.finish()
    _no_thread_left()
    return told


@case(RENDERED)
def scene_switched(stage):
    """The window goes to another scene: the one that asked gets the probe."""
    stage.unmark()
    first = stage.scene
    waiting = Waiting()
    bpy.ops.scene.new(type="NEW")
    told = waiting.finish()
    assert stage.scene != first and first.skyprobe.shown == "PROBE" and stage.settings.shown == "NOTHING"
    bpy.data.scenes.remove(stage.scene)
    return told


@case("the settings have changed since this probe was begun; render it again")
def settings_changed(stage):
    """The time is moved."""
    stage.unmark()
    waiting = Waiting()
    stage.set(hour=15.0)
    return waiting.finish()


@case("nothing is left")
def file_opened(stage):
    """Another file is opened."""
    stage.unmark()
    waiting = Waiting()
    seconds = waiting.end()
    bpy.ops.wm.read_homefile(use_empty=True)
    assert seconds < SOON_S and part("beside").current is None
    _no_thread_left()
    return "nothing is left"


@case("nothing is left")
def disabled(stage):
    """The add-on is switched off, and on again."""
    stage.unmark()
    waiting = Waiting()
    start = time.perf_counter()
    addon_utils.disable(PACKAGE)
    seconds = time.perf_counter() - start
    _no_thread_left()
    handlers = [name for name in dir(bpy.app.handlers) for function in _functions(name) if PACKAGE in getattr(function, "__module__", "")]
    assert seconds < SOON_S and not handlers and not hasattr(bpy.types.Scene, "skyprobe"), (seconds, handlers)
    assert not bpy.app.timers.is_registered(part("live")._poll)
    addon_utils.enable(PACKAGE)
    assert waiting.event("TIMER") == {"CANCELLED"}
    waiting.end()
    return "nothing is left"


def _functions(name):
    found = getattr(bpy.app.handlers, name)
    return found if isinstance(found, list) else []


@case("nothing is left")
def disabled_while_a_large_file_is_written(stage):
    """The add-on is switched off while the library writes, which cannot be stopped: nobody waits, and the file goes when it is there."""
    stage.unmark()
    released, jobs = threading.Event(), part("jobs")

    def stubborn(request, path, progress=None):
        released.wait(20.0)
        Path(path).write_bytes(b"a picture")

    with replaced(jobs, "write", stubborn):
        waiting = Waiting()
        waiting._write, jobs.write = stubborn, waiting._slow_write
        waiting._gate.set()
        job = part("beside").current.job
        assert not job.join(0.05) and job.is_alive()
        start = time.perf_counter()
        addon_utils.disable(PACKAGE)
        assert time.perf_counter() - start < SOON_S and job.is_alive()
    released.set()
    job.join(10.0)
    _no_thread_left()
    addon_utils.enable(PACKAGE)
    return "nothing is left"


@case(RENDERED)
def undo_in_mid_render(stage):
    """A change is undone and done again while the probe is rendered."""
    stage.unmark()
    bpy.ops.ed.undo_push(message="before")
    stage.set(latitude=0.5)
    bpy.ops.ed.undo_push(message="after")
    waiting = Waiting()
    bpy.ops.ed.undo()
    bpy.ops.ed.redo()
    told = waiting.finish()
    assert stage.settings.shown == "PROBE"
    return told


@case("A probe is being rendered: wait, or cancel it")
def everything_at_once(stage):
    """A second probe, a sequence, a time-lapse and Remove while a probe is rendered."""
    stage.add()
    waiting = Waiting()
    operators = (bpy.ops.skyprobe.render, bpy.ops.skyprobe.render_sequence, bpy.ops.skyprobe.time_lapse, bpy.ops.skyprobe.remove)
    (message,) = {error_of(operator).split("poll() ")[-1] for operator in operators}
    bpy.ops.skyprobe.cancel()
    waiting.wait()
    return message


@case(RENDERED)
def while_blender_renders(stage):
    """Blender renders a picture when the probe is ready: it waits until that is over."""
    stage.unmark()
    waiting = Waiting()
    with replaced(part("compat"), "is_rendering", lambda: True):
        waiting._gate.set()
        part("beside").current.job.join(20.0)
        for _ in range(5):
            assert waiting.event("TIMER") == {"PASS_THROUGH"} and stage.settings.shown == "NOTHING"
    return waiting.wait()


def _sequence(stage, frames):
    stage.scene.frame_end = frames
    stage.set(sequence_directory=str(stage.folder))
    return Waiting("sequence.SKYPROBE_OT_render_sequence")


@case("cancelled; 0 finished frames are kept, Render Sequence goes on from there")
def sequence_cancelled(stage):
    """Esc is pressed in a sequence."""
    waiting = _sequence(stage, 5)
    waiting.event("ESC")
    told = waiting.wait()
    _no_thread_left()
    assert stage.scene.frame_current == 1
    return told


@case("scene = Scene: must be there until its sequence is finished; 1 finished frames are kept")
def scene_of_a_sequence_deleted(stage):
    """The scene is deleted in the middle of its sequence."""
    stage.unmark()
    waiting = _sequence(stage, 5)
    first = stage.scene
    bpy.ops.scene.new(type="NEW")
    bpy.data.scenes.remove(first)
    return waiting.finish()


@case("5 frames rendered, 0 were there")
def range_changed_in_a_sequence(stage):
    """The frame range is changed while the sequence is rendered: the frames that were asked for are made."""
    stage.unmark()
    waiting = _sequence(stage, 5)
    stage.scene.frame_end = 500
    told = waiting.finish()
    stage.scene.frame_end = 5
    return told


# Failures of the library that nobody foresaw.


def _failing(error):
    def fail(*_, **__):
        raise error

    return fail


@case("Skyprobe failed, which is a fault in it: ZeroDivisionError of a fault (misuse_renders.py")
def unforeseen_failure(stage):
    """The library raises what it never should."""
    stage.add()
    with replaced(part("jobs"), "render", _failing(ZeroDivisionError("of a fault"))):
        assert "fault in it" in error_of(lambda: bpy.ops.skyprobe.expose())
        return stage.render()


@case("Skyprobe failed, which is a fault in it: RuntimeError panic: index out of bounds")
def panic(stage):
    """The library panics, which Python knows as an exception that is none."""
    stage.add()
    panicking = type("PanicException", (BaseException,), {"__module__": "pyo3_runtime"})
    with replaced(part("jobs"), "render", _failing(panicking("index out of bounds"))):
        return stage.render()


@case("choose a smaller resolution")
def no_memory(stage):
    """There is no memory for the picture."""
    stage.add()
    with replaced(part("jobs"), "render", _failing(MemoryError())):
        return stage.render()


@case("Blender = locked: must let scripts change its data")
def locked(stage):
    """Blender refuses every change of its data, as it can after a render in a window."""
    stage.add()
    refusal = AttributeError("Writing to ID classes in this context is not allowed: Scene, Scene datablock, error setting SkyprobeSettings.image")
    with replaced(part("scene_probe"), "show_probe", _failing(refusal)):
        return stage.render()


@case("Skyprobe failed, which is a fault in it: ZeroDivisionError in the worker")
def failure_of_the_live_preview(stage):
    """The worker of the live preview meets a failure in the picture, and in the day: it tells, and lives on."""
    stage.add()
    live, jobs = part("live"), part("jobs")
    request, key = part("values").preview_request(stage.scene), part("compat").key_of(stage.scene)
    worker = live._worker = live._Worker()
    worker.start()

    def outcomes():
        worker.ask(key, request, True)
        until = time.monotonic() + 20.0
        while (worker._wanted or worker._now is not None) and time.monotonic() < until:
            time.sleep(0.005)
        live._poll()
        return stage.message()

    with replaced(jobs, "day", _failing(ZeroDivisionError("in the day"))):
        assert "in the day" in outcomes()
    with replaced(jobs, "render", _failing(ZeroDivisionError("in the worker"))):
        message = outcomes()
    assert worker.is_alive() and outcomes() == ""
    with replaced(part("scene_probe"), "show_preview", _failing(ZeroDivisionError("in the scene"))):
        assert "in the scene" in outcomes()
    assert outcomes() == ""
    stage.unmark()
    return message


@case("Skyprobe: frame 2: hour = nan: must be a number")
def failure_in_a_farm(stage):
    """Settings make no sense while an animation is rendered: the log tells, and the light stays."""
    stage.add()
    before = float(pixels_of(environment(stage.scene.world).image).mean())
    stage.set(hour=float("nan"))
    stage.scene.frame_set(2)
    assert before == float(pixels_of(environment(stage.scene.world).image).mean())
    return f"Skyprobe: frame 2: {stage.message()}"
