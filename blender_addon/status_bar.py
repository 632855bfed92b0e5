# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's line in the status bar: how far a work is, else what is wrong with the scene of each window."""

import bpy

from . import compat

_progress = ""
_messages = {}
# Names of the workspaces whose line is ours, so that no one else's is taken away.
_told = set()


def show_progress(text):
    """Tell how far a work is; an empty text when it is over."""
    global _progress
    _progress = text
    refresh()


def show_message(scene, text):
    """Tell what is wrong with `scene`, in the windows that show it; an empty text for nothing."""
    key = compat.key_of(scene)
    if _messages.get(key, "") != text:
        _messages[key] = text
        refresh()


def forget():
    """Tell nothing any more."""
    global _progress
    _progress = ""
    _messages.clear()
    refresh()


def refresh():
    """Bring the line of each window up to date."""
    window_manager = getattr(bpy.context, "window_manager", None)
    if bpy.app.background or window_manager is None:
        return
    for window in window_manager.windows:
        workspace = window.workspace
        text = _progress or _messages.get(compat.key_of(window.scene), "")
        if text:
            workspace.status_text_set(f"Skyprobe: {text}")
            _told.add(workspace.name)
        elif workspace.name in _told:
            workspace.status_text_set(None)
            _told.discard(workspace.name)
