# SPDX-License-Identifier: GPL-3.0-or-later
"""Work beside the interface: one at a time, its progress in the status bar, Esc, and an end that leaves nothing behind.

A work is what an operator waits for, and lives on the main thread. It has

    job               the jobs.ProbeJob that computes now, or None
    next()            begin the next job, or look for it for a while; whether there is anything left to do
    take()            use what the job has that has ended; raise its error
    when_cancelled()  what to tell then
    progress()        (0 to 1, text)
    leave()           bring back what it changed on its way, however it ended
    finish(report)    show what was made
"""

import bpy
import skyprobe

from . import compat, failures, interface, status_bar

# How often a waiting operator looks at its job [s].
PERIOD_S = 0.05
# How long the main thread waits for a cancelled job [s]. One that writes a large file cannot stop before it is whole; it ends alone.
PATIENCE_S = 0.25

# The work that runs now.
current = None
_cancelled = False
_timer = None


def refusal():
    """Return why no other work can begin now, or an empty text."""
    return "A probe is being rendered: wait, or cancel it" if current is not None else ""


def cancel():
    """Ask the current work for an early end."""
    global _cancelled
    if current is not None:
        _cancelled = True
        if current.job is not None:
            current.job.cancel()


def abandon():
    """End the current work at once, as nobody waits for it any more."""
    if current is None:
        return
    job = current.job
    if job is not None:
        job.abandon(PATIENCE_S)
    _end()


def _begin(work):
    global current, _cancelled
    current, _cancelled = work, False


def _end():
    global current, _timer
    work, timer = current, _timer
    if work is None:
        return
    try:
        work.leave()
    finally:
        current = _timer = None
        if timer is not None:
            bpy.context.window_manager.event_timer_remove(timer)
            bpy.context.window_manager.progress_end()
        status_bar.show_progress("")
        interface.redraw_panels()


def _next(work):
    """Begin the next job of `work`; whether there is anything left to do."""
    if _cancelled:
        raise skyprobe.Cancelled(work.when_cancelled())
    return work.next()


def _take(work):
    if work.job is None:
        return
    try:
        work.take()
    except skyprobe.Cancelled:
        raise skyprobe.Cancelled(work.when_cancelled()) from None


class Beside(failures.Telling):
    """A base of operators whose `make(scene)` returns a work: it is done beside the interface, or at once where there is none."""

    def run(self, context):
        work = self.make(context.scene)
        _begin(work)
        try:
            while _next(work):
                if work.job is not None:
                    work.job.run()
                    _take(work)
        finally:
            _end()
        work.finish(self.report)
        return {"FINISHED"}

    def invoke(self, context, event):
        # Timers never fire in background mode.
        if bpy.app.background:
            return self.execute(context)
        return self.told(lambda: self._run_beside(context))

    def modal(self, context, event):
        work = self._work
        if work is not current:
            return {"CANCELLED"}
        computing = work.job is not None and work.job.is_alive()
        # What is finished waits for a render of Blender's own, which may be what Esc is meant for.
        if event.type == "ESC" and (computing or not compat.is_rendering()):
            cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        # Under a render of Blender's own nothing may change.
        if computing or compat.is_rendering():
            self._show_progress(context)
            return {"PASS_THROUGH"}
        return self.told(self._go_on)

    def cancel(self, context):
        """Blender ends the operator itself, as when another file is opened or its window is closed."""
        if self._work is current:
            abandon()

    def told(self, work):
        answer = super().told(work)
        if "CANCELLED" in answer and getattr(self, "_work", None) is current:
            _end()
        return answer

    def _run_beside(self, context):
        global _timer
        self._work = self.make(context.scene)
        _begin(self._work)
        window_manager = context.window_manager
        window_manager.progress_begin(0.0, 1.0)
        _timer = window_manager.event_timer_add(PERIOD_S, window=context.window)
        answer = self._go_on()
        # Blender would keep the handler of an operator that is over.
        if "RUNNING_MODAL" in answer:
            window_manager.modal_handler_add(self)
        return answer

    def _go_on(self):
        work = self._work
        _take(work)
        if _next(work):
            if work.job is not None:
                work.job.start()
            return {"RUNNING_MODAL"}
        _end()
        work.finish(self.report)
        return {"FINISHED"}

    def _show_progress(self, context):
        fraction, text = self._work.progress()
        context.window_manager.progress_update(fraction)
        status_bar.show_progress(f"{text} (Esc cancels)")
        interface.redraw_panels()


class SKYPROBE_OT_cancel(bpy.types.Operator):
    """Stop what is being computed and leave the scene as it is"""

    bl_idname = "skyprobe.cancel"
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        cancel()
        return {"FINISHED"}


def register():
    bpy.utils.register_class(SKYPROBE_OT_cancel)


def unregister():
    bpy.utils.unregister_class(SKYPROBE_OT_cancel)
