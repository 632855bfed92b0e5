# SPDX-License-Identifier: GPL-3.0-or-later
"""The live preview: a change is computed on a thread of its own, the latest one wins, and the main thread only puts the pixels in.

    changed ──> worker (skyprobe, no bpy) ──> _poll (a timer on the main thread) ──> scene_probe.show_preview

In background mode timers never fire: there `update_now` does all at once.
"""

import threading
from contextlib import contextmanager
from dataclasses import dataclass, replace

import bpy
import skyprobe

from . import compat, exposure, jobs, scene_probe, values, viewport_drawing

# How often the main thread looks for results while there is work [s].
POLL_S = 0.004
# While Blender renders nothing may change under it [s].
WAIT_S = 0.25
# Width of a probe that only numbers are wanted of [pixels].
NUMBERS_WIDTH = 64


@dataclass
class Readout:
    """What the panel tells of a scene's sky."""

    result: jobs.SkyResult | None = None
    day: jobs.Day | None = None
    message: str = ""


# By the scene's name.
readouts = {}
_held = 0


class _Worker(threading.Thread):
    """Computes what is wanted of each scene, the latest wish only."""

    def __init__(self):
        super().__init__(name="skyprobe preview", daemon=True)
        self._lock = threading.Condition()
        self._wanted = {}
        self._done = []
        self._now = None
        self._ended = False
        self._days = {}

    def ask(self, scene_name, request, picture):
        """Want the preview of a scene, or only its numbers; a wish of the same scene that was not begun is forgotten."""
        with self._lock:
            self._wanted[scene_name] = (request, picture)
            self._lock.notify()

    def take(self):
        """Return and forget the outcomes so far: (scene's name, pixels or None, SkyResult or Day or error, picture was wanted)."""
        with self._lock:
            done, self._done = self._done, []
            return done

    def is_idle(self):
        """Whether nothing is wanted, being made, or waiting to be taken."""
        with self._lock:
            return not self._wanted and self._now is None and not self._done

    def clear(self):
        """Forget all that was wanted and done."""
        with self._lock:
            self._wanted.clear()
            self._done.clear()
            self._days.clear()
            # What is being made now finds that nobody waits for it.
            self._now = None

    def end(self):
        """Stop soon and wait for that."""
        with self._lock:
            self._ended = True
            self._wanted.clear()
            self._lock.notify()
        self.join()

    def run(self):
        while True:
            with self._lock:
                while not self._wanted and not self._ended:
                    self._lock.wait()
                if self._ended:
                    return
                scene_name = next(iter(self._wanted))
                request, picture = self._wanted.pop(scene_name)
                self._now = token = (scene_name, request)
            try:
                pixels, outcome = jobs.preview(request, self._progress)
            except skyprobe.Cancelled:
                self._put(token)
                continue
            except BaseException as error:  # the main thread tells it
                pixels, outcome = None, error
            self._put(token, (scene_name, pixels if picture else None, outcome, picture), more=True)
            self._make_day(token)
            self._put(token)

    def _progress(self, stage, fraction):
        """Go on unless the work is for nothing. A picture of the same air is always finished, so that a long drag shows something."""
        with self._lock:
            if self._ended or self._now is None:
                return False
            scene_name, request = self._now
            newer = self._wanted.get(scene_name)
            return newer is None or newer[0].air_key == request.air_key

    def _make_day(self, token):
        scene_name, request = token
        key = (tuple(request.place.items()), request.time[:10], request.time[19:])
        with self._lock:
            if self._wanted or self._ended or self._days.get(scene_name) == key:
                return
            self._days[scene_name] = key
        try:
            day = jobs.day(request)
        except jobs.USER_ERRORS:
            return
        self._put(token, (scene_name, None, day, False), more=True)

    def _put(self, token, outcome=None, more=False):
        with self._lock:
            if self._now is not token:
                return
            if outcome is not None:
                self._done.append(outcome)
            if not more:
                self._now = None


_worker = None


def changed(settings, context):
    """Follow a change of a property: the update function of all that the light depends on."""
    viewport_drawing.tag_redraw()
    request(settings.id_data)


@contextmanager
def held(scene):
    """Change many properties of `scene` and follow once, at the end."""
    global _held
    _held += 1
    try:
        yield
    finally:
        _held -= 1
    request(scene)


def request(scene):
    """Ask for the preview of `scene` as its settings are now, or only for its numbers if it shows none."""
    # Settings of a linked scene cannot change, and their world is not ours.
    if _held or scene.library is not None:
        return
    try:
        wanted = values.preview_request(scene)
        if scene_probe.show_again(scene, values.final_request(scene)):
            picture = False
        else:
            picture = _wants_picture(scene)
    except jobs.USER_ERRORS as error:
        complain(scene, str(error))
        return
    if bpy.app.background:
        return
    if not picture:
        wanted = replace(wanted, width=NUMBERS_WIDTH)
    _ask(scene.name, wanted, picture)


def _wants_picture(scene):
    settings = scene.skyprobe
    return settings.live and scene_probe.is_lit(scene) and settings.shown != "SEQUENCE"


def _ask(scene_name, wanted, picture):
    global _worker
    if _worker is None or not _worker.is_alive():
        _worker = _Worker()
        _worker.start()
    _worker.ask(scene_name, wanted, picture)
    if not bpy.app.timers.is_registered(_poll):
        bpy.app.timers.register(_poll, first_interval=POLL_S)


def _poll():
    """Take what the worker has made to the scenes. Returns the time until the next look [s], None when all is done."""
    if _worker is None:
        return None
    if compat.is_rendering():
        return WAIT_S
    for scene_name, pixels, outcome, picture in _worker.take():
        scene = bpy.data.scenes.get(scene_name)
        if scene is None:
            readouts.pop(scene_name, None)
        elif isinstance(outcome, jobs.Day):
            readout(scene).day = outcome
        elif isinstance(outcome, BaseException):
            _fail(scene, outcome)
        else:
            _arrive(scene, pixels, outcome, picture)
    _redraw()
    return None if _worker.is_idle() else POLL_S


def _arrive(scene, pixels, result, picture):
    readout(scene).result = result
    complain(scene, "")
    # The scene may have got another world, or a rendered probe, in the meantime.
    if picture and _wants_picture(scene):
        scene_probe.show_preview(scene, pixels, result)
    if scene_probe.is_lit(scene):
        exposure.follow(scene, result.horizontal_lx)


def _fail(scene, error):
    if isinstance(error, jobs.USER_ERRORS):
        complain(scene, str(error))
    else:
        complain(scene, f"the preview failed: {error!r}")


def update_now(scene, final):
    """Bring the light of `scene` up to date before this returns, as the live preview or as the probe to render; raise jobs.USER_ERRORS."""
    wanted = values.final_request(scene) if final else values.preview_request(scene)
    if scene_probe.show_again(scene, values.final_request(scene)) or scene_probe.shown_key(scene) == wanted.key:
        return
    pixels, result = jobs.preview(wanted)
    readout(scene).result = result
    scene_probe.show_preview(scene, pixels, result)
    exposure.follow(scene, result.horizontal_lx)


def readout(scene):
    """Return the Readout of `scene`, an empty one at first."""
    return readouts.setdefault(scene.name, Readout())


def ensure_readout(scene):
    """Have numbers made for a scene that the panel shows for the first time."""
    if scene.name not in readouts and not bpy.app.background:
        readout(scene)
        request(scene)


def complain(scene, message):
    """Tell in the panel and in the status bar what is wrong with `scene`, or nothing any more."""
    was, readout(scene).message = readout(scene).message, message
    if bpy.app.background or was == message:
        return
    for window in bpy.context.window_manager.windows:
        window.workspace.status_text_set(f"Skyprobe: {message}" if message else None)


def _redraw():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"PROPERTIES", "VIEW_3D"}:
                area.tag_redraw()


def forget():
    """Forget all scenes, as when another file is opened."""
    readouts.clear()
    if _worker is not None:
        _worker.clear()


def unregister():
    global _worker
    if bpy.app.timers.is_registered(_poll):
        bpy.app.timers.unregister(_poll)
    if _worker is not None:
        _worker.end()
        _worker = None
    readouts.clear()
    jobs.forget_atmospheres()
