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

from . import compat, exposure, failures, interface, jobs, scene_probe, status_bar, values, viewport_drawing

# How often the main thread looks for results while there is work [s].
POLL_S = 0.004
# While Blender renders nothing may change under it [s].
WAIT_S = 0.25
# How long the main thread waits for the end of the worker, which otherwise ends alone [s].
PATIENCE_S = 0.25
# Width of a probe that only numbers are wanted of [pixels].
NUMBERS_WIDTH = 64


@dataclass
class Readout:
    """What the panel tells of a scene's sky."""

    result: jobs.SkyResult | None = None
    day: jobs.Day | None = None
    message: str = ""


# By compat.key_of the scene.
readouts = {}
# Scenes that a panel shows for the first time.
_first_looks = set()
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

    def ask(self, scene_key, request, picture):
        """Want the preview of a scene, or only its numbers; a wish of the same scene that was not begun is forgotten."""
        with self._lock:
            self._wanted[scene_key] = (request, picture)
            self._lock.notify()

    def take(self):
        """Return and forget the outcomes so far: (scene's key, pixels or None, SkyResult or Day or error, picture was wanted)."""
        with self._lock:
            done, self._done = self._done, []
            return done

    def is_idle(self):
        """Whether nothing is wanted, being made, or waiting to be taken."""
        with self._lock:
            return not self._wanted and self._now is None and not self._done

    def drop(self, scene_key):
        """Forget what is wanted, made and done of a scene."""
        with self._lock:
            self._wanted.pop(scene_key, None)
            self._done = [outcome for outcome in self._done if outcome[0] != scene_key]
            if self._now is not None and self._now[0] == scene_key:
                self._now = None

    def clear(self):
        """Forget all that was wanted and done."""
        with self._lock:
            self._wanted.clear()
            self._done.clear()
            self._days.clear()
            # What is being made now finds that nobody waits for it.
            self._now = None

    def end(self):
        """Stop soon, and wait a little for that."""
        with self._lock:
            self._ended = True
            self._wanted.clear()
            self._lock.notify()
        self.join(PATIENCE_S)

    def run(self):
        while True:
            with self._lock:
                while not self._wanted and not self._ended:
                    self._lock.wait()
                if self._ended:
                    return
                scene_key = next(iter(self._wanted))
                request, picture = self._wanted.pop(scene_key)
                self._now = token = (scene_key, request)
            try:
                pixels, outcome = jobs.preview(request, self._progress)
            except skyprobe.Cancelled:
                self._put(token)
                continue
            except BaseException as error:  # the main thread tells it
                pixels, outcome = None, error
            self._put(token, (scene_key, pixels if picture else None, outcome, picture), more=True)
            self._make_day(token)
            self._put(token)

    def _progress(self, stage, fraction):
        """Go on unless the work is for nothing. A picture of the same air is always finished, so that a long drag shows something."""
        with self._lock:
            if self._ended or self._now is None:
                return False
            scene_key, request = self._now
            newer = self._wanted.get(scene_key)
            return newer is None or newer[0].air_key == request.air_key

    def _make_day(self, token):
        scene_key, request = token
        key = (tuple(request.place.items()), request.time[:10], request.time[19:])
        with self._lock:
            if self._wanted or self._ended or self._days.get(scene_key) == key:
                return
            self._days[scene_key] = key
        try:
            day = jobs.day(request)
        except jobs.USER_ERRORS:
            return
        except Exception as error:  # the main thread tells it
            day = error
        self._put(token, (scene_key, None, day, False), more=True)

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
    viewport_drawing.follow(settings)
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
    """Ask for the preview of `scene` as its settings are now, or only for its numbers if it shows none; complain if that cannot be."""
    # Settings of a linked scene cannot change, and their world is not ours.
    if _held or scene.library is not None:
        return
    try:
        wanted = values.preview_request(scene)
        if scene_probe.show_again(scene, values.final_request(scene)):
            picture = False
        else:
            picture = _wants_picture(scene)
    except Exception as error:
        # What was asked for before must not arrive as if all were well.
        if _worker is not None:
            _worker.drop(compat.key_of(scene))
        complain(scene, failures.line(error))
        return
    if bpy.app.background:
        complain(scene, "")
        return
    if not picture:
        wanted = replace(wanted, width=NUMBERS_WIDTH)
    _ask(compat.key_of(scene), wanted, picture)


def _wants_picture(scene):
    settings = scene.skyprobe
    return settings.live and scene_probe.is_lit(scene) and settings.shown != "SEQUENCE"


def _ask(scene_key, wanted, picture):
    global _worker
    if _worker is None or not _worker.is_alive():
        _worker = _Worker()
        _worker.start()
    _worker.ask(scene_key, wanted, picture)
    _look_out()


def _look_out():
    if not bpy.app.timers.is_registered(_poll):
        bpy.app.timers.register(_poll, first_interval=POLL_S)


def _poll():
    """Take what the worker has made to the scenes. Returns the time until the next look [s], None when all is done."""
    if compat.is_rendering():
        return WAIT_S
    looked = bool(_first_looks)
    while _first_looks:
        scene = compat.scene_of(_first_looks.pop())
        if scene is not None:
            request(scene)
    if looked:
        # What is wrong with a scene is known at once.
        interface.redraw_panels()
    if _worker is None:
        return None
    outcomes = _worker.take()
    for scene_key, pixels, outcome, picture in outcomes:
        scene = compat.scene_of(scene_key)
        if scene is None:
            readouts.pop(scene_key, None)
            continue
        try:
            _arrive(scene, pixels, outcome, picture)
        except Exception as error:
            complain(scene, failures.line(error))
    if outcomes:
        interface.redraw_panels()
    return None if _worker.is_idle() else POLL_S


def _arrive(scene, pixels, outcome, picture):
    if isinstance(outcome, BaseException):
        raise outcome if isinstance(outcome, Exception) else RuntimeError(repr(outcome))
    if isinstance(outcome, jobs.Day):
        readout(scene).day = outcome
        return
    readout(scene).result = outcome
    complain(scene, "")
    # The scene may have got another world, or the rendered probe of its settings, in the meantime.
    if picture and _wants_picture(scene) and not scene_probe.show_again(scene, values.final_request(scene)):
        scene_probe.show_preview(scene, pixels, outcome)
    if scene_probe.is_lit(scene):
        exposure.follow(scene, outcome.horizontal_lx)


def update_now(scene, final, anew=False):
    """Bring the light of `scene` up to date before this returns, as the live preview or as the probe to render; `anew` whatever it shows now.

    Raises what values and jobs raise, and the scene is as it was.
    """
    wanted = values.final_request(scene) if final else values.preview_request(scene)
    if not anew and (scene_probe.show_again(scene, values.final_request(scene)) or scene_probe.shown_key(scene) == wanted.key):
        return
    pixels, result = jobs.preview(wanted)
    readout(scene).result = result
    scene_probe.show_preview(scene, pixels, result)
    exposure.follow(scene, result.horizontal_lx)
    complain(scene, "")


def readout(scene):
    """Return the Readout of `scene`, an empty one at first."""
    return readouts.setdefault(compat.key_of(scene), Readout())


def ensure_readout(scene):
    """Have numbers made for a scene that the panel shows for the first time. While a panel is drawn no data may change, so a bit later."""
    key = compat.key_of(scene)
    if key not in readouts and not bpy.app.background:
        readout(scene)
        _first_looks.add(key)
        _look_out()


def complain(scene, message):
    """Tell in the panel and in the status bar what is wrong with `scene`, or nothing any more."""
    readout(scene).message = message
    status_bar.show_message(scene, message)


def forget():
    """Forget all scenes, as when another file is opened."""
    readouts.clear()
    _first_looks.clear()
    status_bar.forget()
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
    _first_looks.clear()
    jobs.forget_atmospheres()
