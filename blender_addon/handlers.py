# SPDX-License-Identifier: GPL-3.0-or-later
"""What follows when Blender changes frames, undoes, loads and saves."""

import bpy
from bpy.app.handlers import persistent

from . import compat, failures, live, scene_probe, sequence

_rendering = False


@persistent
def _frame_changed(scene, depsgraph=None):
    """Follow animated settings, and give a picture that is about to be rendered the light in full quality."""
    if sequence.is_running() or scene.library is not None or not scene_probe.is_lit(scene):
        return
    animated = compat.is_animated(scene, "skyprobe.")
    # What was rendered on purpose stays.
    if scene.skyprobe.shown == "SEQUENCE" or not (animated or scene.skyprobe.shown == "PREVIEW"):
        return
    if not (_rendering or bpy.app.background):
        if animated:
            live.request(scene)
        return
    # In a window a render runs beside the interface, which must not find data that change without need.
    if not (animated or bpy.app.background or scene.render.use_lock_interface):
        return
    try:
        live.update_now(scene, final=True)
    except Exception as error:
        # A render goes on with the light that it has; a farm's log tells why.
        print(f"Skyprobe: frame {scene.frame_current}: {failures.line(error)}", flush=True)
        live.complain(scene, failures.line(error))


@persistent
def _render_began(scene, depsgraph=None):
    global _rendering
    _rendering = True


@persistent
def _render_ended(scene, depsgraph=None):
    global _rendering
    _rendering = False


@persistent
def _undone(scene, depsgraph=None):
    """Undo brings back settings and nodes, but not the pixels of the preview."""
    scene_probe.forget()
    for each in bpy.data.scenes:
        if each.library is not None or not scene_probe.is_lit(each) or each.skyprobe.shown != "PREVIEW":
            continue
        live.request(each)
        if bpy.app.background:
            _guarded(each, lambda scene: live.update_now(scene, final=False))


def _guarded(scene, work):
    """Let `work` do something to `scene`; complain if it cannot."""
    try:
        work(scene)
    except Exception as error:
        live.complain(scene, failures.line(error))


@persistent
def _loading(*_):
    live.forget()
    scene_probe.forget()


@persistent
def _loaded(*_):
    """A file of an older Blender loses what would keep our data in it for ever."""
    for scene in bpy.data.scenes:
        _guarded(scene, compat.forget_old_properties)


@persistent
def _saving(*_):
    """A preview is in memory only: it goes into the file, which shows its sky without the add-on."""
    for scene in bpy.data.scenes:
        _guarded(scene, scene_probe.pack_preview)


_HANDLERS = (
    ("frame_change_post", _frame_changed),
    ("render_init", _render_began),
    ("render_complete", _render_ended),
    ("render_cancel", _render_ended),
    ("undo_post", _undone),
    ("redo_post", _undone),
    ("load_pre", _loading),
    ("load_post", _loading),
    ("load_post", _loaded),
    ("save_pre", _saving),
)


def register():
    for name, function in _HANDLERS:
        getattr(bpy.app.handlers, name).append(function)


def unregister():
    for name, function in _HANDLERS:
        handlers = getattr(bpy.app.handlers, name)
        if function in handlers:
            handlers.remove(function)
