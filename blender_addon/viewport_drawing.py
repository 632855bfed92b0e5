# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn in the 3D view: the ways of the Sun, where it and the Moon stand now, and where north is.

    settings ──> scenery (curves, labels and markers of a scene, kept until a setting changes) ──> lines in the scene, text and markers above it

Lines are part of the scene: things before them hide them. Nothing may raise while Blender draws, so a failure is told once and nothing more is
drawn until a setting changes.
"""

import bpy
from mathutils import Vector

from . import failures, interface, viewport_pens, viewport_scenery

_handles = []
_scenery = viewport_scenery.Keeper()
# What went wrong, until a setting changes.
_failure = None


def is_on(settings):
    """Whether there is anything to draw."""
    return any(getattr(settings, name, False) for name in viewport_scenery.SWITCHES)


def failure():
    """Return what went wrong in a word for the user, or None."""
    return _failure


def tag_redraw():
    """Have every 3D view drawn again, as after a change of what is drawn; what failed gets another chance."""
    global _failure
    _failure = None
    interface.redraw_views()


def follow(settings):
    """Draw again, if anything is drawn, after a change of a setting."""
    if is_on(settings):
        tag_redraw()


def _guarded(draw):
    """Return `draw` as a handler that never raises."""

    def handler():
        global _failure
        context = bpy.context
        settings = getattr(context.scene, "skyprobe", None)
        if _failure is not None or settings is None or not is_on(settings):
            return
        if not context.space_data.overlay.show_overlays:
            return
        try:
            draw(context, _scenery.of(settings))
        except Exception as error:
            _failure = failures.line(error)
            print(f"Skyprobe: nothing is drawn in the viewport until a setting changes: {_failure}")

    return handler


def _draw_lines(context, scenery):
    """Draw into the scene, in its coordinates."""
    scenery.make_batches(viewport_pens.line_batch)
    with viewport_pens.scene_state(context.region, context.preferences.system.ui_scale) as state:
        for batch, width in scenery.batches:
            state.draw(batch, width)


def _draw_above(context, scenery):
    """Draw labels and markers over the scene, in pixels."""
    region, view = context.region, context.region_data
    scale = context.preferences.system.ui_scale

    def project(point):
        """Return where a point is seen [pixels], None behind the eye or far outside."""
        seen = view.perspective_matrix @ Vector((*point, 1.0))
        if seen.w <= 0.0:
            return None
        x, y = (seen.x / seen.w + 1.0) * region.width / 2.0, (seen.y / seen.w + 1.0) * region.height / 2.0
        return (x, y) if -50.0 < x < region.width + 50.0 and -50.0 < y < region.height + 50.0 else None

    taken = []
    with viewport_pens.pixel_state():
        for marker in scenery.markers:
            place, towards = project(marker.point), marker.light_from and project(marker.light_from)
            if place is not None:
                taken.append(viewport_pens.draw_disc(place, scale, marker, towards))
    viewport_pens.draw_labels(scenery.labels, project, scale, taken)


def register():
    if _handles:
        return
    for draw, stage in ((_draw_lines, "POST_VIEW"), (_draw_above, "POST_PIXEL")):
        _handles.append(bpy.types.SpaceView3D.draw_handler_add(_guarded(draw), (), "WINDOW", stage))


def unregister():
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")
    _scenery.forget()
    tag_redraw()
