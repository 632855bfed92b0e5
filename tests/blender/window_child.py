"""What window.run lets a windowed Blender start with: calls one step function between passes of the event loop, and ends.

A step function is a generator. What it yields says when it goes on; until then Blender handles events, runs timers and modal
operators, and draws:

    yield              after the next drawing
    yield 0.5          after so many seconds
    yield condition    as soon as the callable `condition` returns true; RuntimeError after PATIENCE_S seconds. Only this draws nothing by itself:
                       in software a window takes a while to draw, which would pass for the time that is waited for

What it returns is the answer.
"""

import importlib
import json
import os
import sys
import time
import traceback
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
PATIENCE_S = 60.0
# Between two looks at whether the steps can go on: short, but time for the event loop; shorter where a wait may be measured.
PERIOD_S, CONDITION_PERIOD_S = 0.02, 0.002

if "--" in sys.argv:  # this is the script that Blender runs, not an import
    SITE, QUESTION, ANSWER = map(Path, sys.argv[sys.argv.index("--") + 1 :][:3])


class Driver:
    """The timer that carries a step function from yield to yield."""

    def __init__(self, question):
        sys.path[:0] = [str(HERE), str(HERE.parent), str(SITE)]
        self._question = question
        self._steps = None
        self._go_on = lambda: True
        self._give_up = float("inf")
        self._period = PERIOD_S

    def __call__(self):
        try:
            if self._steps is None:
                module, name = self._question["function"].rsplit(".", 1)
                self._steps = getattr(importlib.import_module(module), name)(**self._question["arguments"])
            if self._go_on():
                self._wait_for(next(self._steps))
            elif time.monotonic() > self._give_up:
                self._steps.throw(RuntimeError(f"what was waited for did not happen within {PATIENCE_S} s"))
        except StopIteration as end:
            finish({"answer": end.value})
        except BaseException:
            finish({"error": traceback.format_exc()})
        return self._period

    def _wait_for(self, what):
        now = time.monotonic()
        self._give_up = now + PATIENCE_S
        if callable(what):
            self._go_on, self._period = what, CONDITION_PERIOD_S
            return
        self._go_on, self._period = lambda: time.monotonic() >= now + (what or 0.0), PERIOD_S
        for window in bpy.context.window_manager.windows:
            for area in window.screen.areas:
                area.tag_redraw()


def finish(content):
    """Write the answer and end at once: Blender can hang or crash while it winds down."""
    ANSWER.write_text(json.dumps(content), encoding="utf-8")
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


if __name__ == "__main__":
    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(Driver(json.loads(QUESTION.read_text(encoding="utf-8"))), first_interval=0.5, persistent=True)
