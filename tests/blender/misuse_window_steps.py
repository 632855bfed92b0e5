"""Misuse that needs a window: its event loop, its status bar, its panels. One Blender for all (window.run), whose complaints fail the test."""

import sys
import threading
import time
from pathlib import Path

import addon_utils
import bpy
import skyprobe
from window_steps import PACKAGE, area, context, enable, show_panels, window

# The library notices a cancellation within some 50 ms; this is for a busy machine [s].
SOON_S = 1.0
# How long a render that has ended may hold Blender's data [s].
LOCK_S = 5.0


def part(name):
    """Return a module of the add-on."""
    return sys.modules[f"{PACKAGE}.{name}"]


def quick():
    """Give the scene settings that are rendered in no time, and its panels and view their places."""
    settings = bpy.context.scene.skyprobe
    for name, value in {"quality": "draft", "width_choice": "OTHER", "width": 64, "preview_width": 64}.items():
        setattr(settings, name, value)
    return settings


class Told:
    """Remembers each line of the status bar."""

    def __init__(self):
        self.lines = []
        bar = part("status_bar")
        refresh = bar.refresh

        def remembered():
            refresh()
            self.lines.append(bar._progress or " ".join(bar._messages.values()))

        bar.refresh = remembered

    def ever(self, text):
        return any(text in line for line in self.lines)


class Gate:
    """A job that waits until it may go on."""

    def __init__(self):
        self._open = threading.Event()
        self._jobs = part("jobs")
        self._write = self._jobs.write
        self._jobs.write = self._slow_write

    def _slow_write(self, request, path, progress=None):
        while not self._open.wait(0.005):
            if progress is not None and not progress("solve", 0.5):
                raise skyprobe.Cancelled("cancelled")
        return self._write(request, path, progress)

    def open(self):
        self._open.set()
        self._jobs.write = self._write


def press(operator, where="VIEW_3D"):
    """Run an operator as a button does."""
    with context(where):
        return operator("INVOKE_DEFAULT")


def no_work_left():
    """Whether no thread, temporary file, timer or line in the status bar is left of a work."""
    threads = [thread for thread in threading.enumerate() if thread.name == "skyprobe"]
    files = [path for path in Path(bpy.app.tempdir).glob("*") if path.name.startswith(("sky_", ".skyprobe"))]
    return not threads and not files and part("beside").current is None and part("status_bar")._progress == ""


def is_locked():
    """Whether Blender lets no script change its data, as it does while it draws."""
    scene = bpy.context.scene
    try:
        # A mark for scripts, of which Blender keeps nothing.
        scene.tag = scene.tag
    except AttributeError:
        return True
    return False


def run(names=None):
    """Try one misuse after the other (all without `names`); tell "fine" or what is wrong for each."""
    enable()
    yield
    yield from show_panels()
    answers = {}
    for name, steps in CASES.items():
        if names and name not in names:
            continue
        quick()
        with context("VIEW_3D"):
            if not part("scene_probe").is_lit(bpy.context.scene):
                bpy.ops.skyprobe.add()
        yield 0.1
        try:
            yield from steps()
            yield 0.2
            answers[name] = "fine"
        except (AssertionError, RuntimeError) as error:
            answers[name] = f"line {_line(error)}: {error!r}"
        print(f"{name}: {answers[name]}", flush=True)
        if not hasattr(bpy.types.Scene, "skyprobe"):
            enable()
        until = time.monotonic() + LOCK_S
        yield lambda: not is_locked() or time.monotonic() > until
        if steps is blender_renders_meanwhile and is_locked():
            print("Blender itself is left locked: nothing can be rendered to show that all is well", flush=True)
            break
        with context("VIEW_3D"):
            bpy.ops.skyprobe.reset()
        quick()
        press(bpy.ops.skyprobe.render)
        yield lambda: part("beside").current is None
        if bpy.context.scene.skyprobe.shown != "PROBE":
            answers[name] += "; no probe is rendered any more"
    return answers


def _line(error):
    trace = error.__traceback__
    while trace.tb_next:
        trace = trace.tb_next
    return trace.tb_lineno


def wrong_date_is_told():
    """30 February, then a day that there is."""
    settings = bpy.context.scene.skyprobe
    told = Told()
    settings.month, settings.day = 2, 30
    yield 0.1
    assert "date = 2025-02-30" in part("live").readout(bpy.context.scene).message
    assert told.ever("date = 2025-02-30")
    settings.day = 20
    yield lambda: part("live").readout(bpy.context.scene).message == ""
    assert told.lines[-1] == ""


def time_that_is_no_number():
    """The panels are drawn all the same."""
    settings = bpy.context.scene.skyprobe
    settings.hour = float("nan")
    settings.latitude = float("nan")
    yield 0.2
    assert "must be a number" in part("live").readout(bpy.context.scene).message
    settings.hour, settings.latitude = 13.0, 0.9
    yield lambda: part("live").readout(bpy.context.scene).message == ""


def failure_in_the_worker():
    """An exception that nobody foresaw, on the worker's thread: told, and the next change is followed."""
    jobs, live = part("jobs"), part("live")
    render = jobs.render

    def fail(*_):
        raise ZeroDivisionError("of a fault")

    told = Told()
    jobs.render = fail
    bpy.context.scene.skyprobe.hour = 9.0
    yield lambda: "ZeroDivisionError of a fault" in live.readout(bpy.context.scene).message
    assert told.ever("ZeroDivisionError of a fault")
    yield 0.2
    jobs.render = render
    bpy.context.scene.skyprobe.hour = 9.5
    yield lambda: live.readout(bpy.context.scene).message == "" and "T09:30" in live.readout(bpy.context.scene).result.request.time


def undo_in_mid_render():
    """Ctrl Z while a probe is rendered."""
    with context("VIEW_3D"):
        bpy.ops.ed.undo_push(message="before")
        bpy.context.scene.skyprobe.latitude = 0.5
        bpy.ops.ed.undo_push(message="after")
    gate = Gate()
    press(bpy.ops.skyprobe.render)
    yield 0.1
    with context("VIEW_3D"):
        bpy.ops.ed.undo()
    yield 0.1
    gate.open()
    yield lambda: part("beside").current is None
    yield 0.1
    assert bpy.context.scene.skyprobe.shown == "PROBE"
    with context("VIEW_3D"):
        bpy.ops.ed.undo()
        bpy.ops.ed.redo()
    yield 0.1


def disabled_in_mid_render():
    """The add-on is switched off in the Preferences while a probe is rendered, with a complaint in the status bar, and on again."""
    gate = Gate()
    bpy.context.scene.skyprobe.month, bpy.context.scene.skyprobe.day = 1, 15
    press(bpy.ops.skyprobe.render)
    yield 0.2
    beside, live, bar = (part(name) for name in ("beside", "live", "status_bar"))
    assert beside.current is not None and bar._progress
    start = time.perf_counter()
    addon_utils.disable(PACKAGE, default_set=True)
    seconds = time.perf_counter() - start
    gate.open()
    yield 0.2
    assert seconds < SOON_S, seconds
    assert beside.current is None and not bar._progress and not bar._messages and live._worker is None
    assert not bpy.app.timers.is_registered(live._poll)
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("skyprobe")]
    enable()
    quick()
    yield 0.2


def window_closed_in_mid_render():
    """The window in which Render Probe was pressed is closed."""
    first = window()
    with bpy.context.temp_override(window=first, screen=first.screen):
        bpy.ops.wm.window_new()
    yield 0.3
    second = next(one for one in bpy.context.window_manager.windows if one != first)
    gate = Gate()
    where = max(second.screen.areas, key=lambda area: area.width * area.height)
    region = next(region for region in where.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=second, screen=second.screen, area=where, region=region):
        bpy.ops.skyprobe.render("INVOKE_DEFAULT")
    yield 0.2
    assert part("beside").current is not None
    # The other window shows the same progress and follows changes.
    bpy.context.scene.skyprobe.north = 0.5
    yield 0.1
    with bpy.context.temp_override(window=second, screen=second.screen):
        bpy.ops.wm.window_close()
    yield 0.5
    gate.open()
    assert len(bpy.context.window_manager.windows) == 1 and no_work_left()


def blender_renders_meanwhile():
    """Blender renders a picture while previews arrive and a probe is ready: both wait for its end, and Esc does not take the probe away."""
    bpy.context.preferences.view.render_display_type = "NONE"
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.time_limit, scene.cycles.use_denoising = 10_000_000, 12.0, False
    scene.cycles.use_adaptive_sampling = False
    scene.render.resolution_x = scene.render.resolution_y = 64
    if scene.camera is None:
        scene.collection.objects.link(bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera")))
        scene.camera = scene.objects["Camera"]
    with context("VIEW_3D"):
        bpy.ops.render.render("INVOKE_DEFAULT")
    yield lambda: bpy.app.is_job_running("RENDER")
    before = scene.world.node_tree.nodes["Skyprobe Environment"].image
    scene.skyprobe.hour = 16.0
    press(bpy.ops.skyprobe.render)
    yield 0.2
    yield lambda: not part("beside").current or not part("beside").current.job.is_alive()
    yield 0.2
    assert bpy.app.is_job_running("RENDER"), "the picture was ready too early for this to show anything"
    assert part("beside").current is not None and not part("beside").current.job.is_alive()
    assert scene.world.node_tree.nodes["Skyprobe Environment"].image == before
    view = area("VIEW_3D")
    x, y = view.x + view.width // 3, view.y + view.height // 2
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("ESC", "PRESS"), ("ESC", "RELEASE")):
        window().event_simulate(type=kind, value=value, x=x, y=y)
    yield lambda: not bpy.app.is_job_running("RENDER")
    yield lambda: part("beside").current is None
    assert scene.skyprobe.shown == "PROBE"
    yield 0.5


def file_opened_in_mid_render():
    """Another file is opened while a probe is rendered."""
    gate = Gate()
    press(bpy.ops.skyprobe.render)
    yield 0.2
    assert part("beside").current is not None
    start = time.perf_counter()
    with context("VIEW_3D"):
        bpy.ops.wm.read_homefile(use_empty=False)
    seconds = time.perf_counter() - start
    yield 0.5
    gate.open()
    assert no_work_left(), "something is left"
    assert bpy.context.scene.skyprobe.shown == "NOTHING", seconds
    area("PROPERTIES").spaces.active.context = "WORLD"
    yield 0.3


def scene_deleted_in_a_sequence():
    """The scene is deleted while its sequence is rendered."""
    first = bpy.context.scene
    first.skyprobe.sequence_directory = bpy.app.tempdir + "sequence"
    first.frame_start, first.frame_end = 1, 3
    gate = Gate()
    press(bpy.ops.skyprobe.render_sequence)
    yield 0.2
    with context("VIEW_3D"):
        bpy.ops.scene.new(type="NEW")
    bpy.data.scenes.remove(first)
    yield 0.2
    gate.open()
    yield lambda: part("beside").current is None
    yield 0.2
    assert part("status_bar")._progress == ""


# Blender 4.3 itself crashes when a scene is deleted that it has rendered, and a render in a window can leave Blender's data locked: that comes last.
CASES = {
    steps.__name__: steps
    for steps in (
        wrong_date_is_told,
        time_that_is_no_number,
        failure_in_the_worker,
        undo_in_mid_render,
        window_closed_in_mid_render,
        scene_deleted_in_a_sequence,
        file_opened_in_mid_render,
        disabled_in_mid_render,
        blender_renders_meanwhile,
    )
}
