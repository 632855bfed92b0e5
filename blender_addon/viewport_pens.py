# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth lines, discs and text by Blender's graphics module. Sizes are in points, which the user's interface scale turns into pixels."""

import math
from contextlib import contextmanager

import blf
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from . import compat

FONT = 0
# Of a disc [corners].
CORNERS = 32
# Free space around a label [points].
MARGIN = 3.0


def line_batch(points, colors):
    """Return a batch of separate lines between pairs of `points`, (2 M, 3), with RGBA `colors`, (2 M, 4)."""
    shader = compat.builtin_shader("POLYLINE_SMOOTH_COLOR")
    return batch_for_shader(shader, "LINES", {"pos": points, "color": np.ascontiguousarray(colors)})


class _Lines:
    """Draws batches of lines with smooth edges."""

    def __init__(self, region, scale):
        self._shader = compat.builtin_shader("POLYLINE_SMOOTH_COLOR")
        self._scale = scale
        self._shader.bind()
        self._shader.uniform_float("viewportSize", (region.width, region.height))

    def draw(self, batch, width):
        """Draw a `batch` of line_batch, `width` points wide."""
        self._shader.uniform_float("lineWidth", width * self._scale)
        batch.draw(self._shader)


@contextmanager
def scene_state(region, scale):
    """Draw transparent lines into the scene, behind what stands before them."""
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    gpu.state.depth_mask_set(False)
    try:
        yield _Lines(region, scale)
    finally:
        gpu.state.depth_test_set("NONE")
        gpu.state.blend_set("NONE")


@contextmanager
def pixel_state():
    """Draw transparent things over the picture."""
    gpu.state.blend_set("ALPHA")
    try:
        yield
    finally:
        gpu.state.blend_set("NONE")


def draw_disc(place, scale, marker, towards):
    """Draw the viewport_scenery.Marker `marker` at `place` [pixels], its lit side towards the point `towards`, or up; return its box."""
    radius = marker.radius * scale
    circle = _circle(place, radius)
    box = (place[0] - radius, place[1] - radius, place[0] + radius, place[1] + radius)
    # A rim of shade sets it off from a bright sky.
    _draw_smooth(_circle(place, radius + 2.0 * scale), (0.0, 0.0, 0.0, 0.45 * marker.color[3]))
    if marker.light_from is None:
        _draw_smooth(circle, marker.color)
        return box
    _draw_smooth(circle, marker.shade)
    angle = math.atan2(towards[1] - place[1], towards[0] - place[0]) if towards else math.pi / 2.0
    _draw_smooth(_lit_part(place, radius, marker.fraction, angle), marker.color)
    return box


def _pushed(place, centre, distance):
    """Return `place` moved by `distance` away from `centre`, upwards where both are one."""
    if centre is None:
        return place[0], place[1] + distance
    x, y = place[0] - centre[0], place[1] - centre[1]
    length = math.hypot(x, y)
    if length < 1.0:
        x, y, length = 0.0, 1.0, 1.0
    return place[0] + distance * x / length, place[1] + distance * y / length


def _circle(centre, radius):
    angle = np.linspace(0.0, 2.0 * math.pi, CORNERS, endpoint=False)
    return np.stack([centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)], axis=1)


def _lit_part(centre, radius, fraction, angle):
    """Return the outline of the lit `fraction` of a disc's area, its bright limb towards `angle` [radians]."""
    across = np.linspace(-math.pi / 2.0, math.pi / 2.0, CORNERS // 2 + 1)
    limb = np.stack([np.cos(across), np.sin(across)], axis=1)
    # The terminator is half an ellipse; its other axis is what the fraction leaves.
    terminator = np.stack([(1.0 - 2.0 * fraction) * np.cos(across[::-1]), np.sin(across[::-1])], axis=1)
    outline = np.concatenate([limb, terminator[1:-1]])
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    return np.asarray(centre) + radius * outline @ turn


def _draw_smooth(outline, color):
    """Fill `outline`, (N, 2) [pixels], counterclockwise, with an edge that fades over a pixel."""
    centre = outline.mean(axis=0)
    outward = outline - centre
    outward /= np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-6)
    inner, outer = outline - 0.5 * outward, outline + 0.5 * outward
    count = len(outline)
    index = np.arange(count)
    after = (index + 1) % count
    middle = np.full(count, 2 * count)
    triangles = np.concatenate(
        [
            np.stack([middle, index, after], axis=1),
            np.stack([index, index + count, after + count], axis=1),
            np.stack([index, after + count, after], axis=1),
        ]
    ).astype(np.int32)
    points = np.zeros((2 * count + 1, 3), np.float32)
    points[:, :2] = np.concatenate([inner, outer, centre[None]])
    colors = np.tile(np.asarray(color, np.float32), (2 * count + 1, 1))
    colors[count : 2 * count, 3] = 0.0
    shader = compat.builtin_shader("SMOOTH_COLOR")
    batch_for_shader(shader, "TRIS", {"pos": points, "color": colors}, indices=triangles).draw(shader)


def draw_labels(labels, project, scale, taken):
    """Write viewport_scenery.Labels where `project(point)` puts them, the important ones first, none over another or a box that is `taken`."""
    taken = list(taken)
    centre = project((0.0, 0.0, 0.0))
    for label in sorted(labels, key=lambda label: label.importance):
        place = project(label.point)
        if place is None:
            continue
        blf.size(FONT, label.size * scale)
        width, height = blf.dimensions(FONT, label.text)
        x, y = _pushed(place, centre, label.push * scale)
        left, low = x - width / 2.0, y - height / 2.0
        if label.beside is not None:
            left = x + label.beside * scale
        box = (left - MARGIN * scale, low - MARGIN * scale, left + width + MARGIN * scale, low + height + MARGIN * scale)
        if any(box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3] for other in taken):
            continue
        taken.append(box)
        blf.enable(FONT, blf.SHADOW)
        blf.shadow(FONT, 3, 0.0, 0.0, 0.0, 0.75 * label.color[3])
        blf.shadow_offset(FONT, 0, 0)
        blf.color(FONT, *label.color)
        blf.position(FONT, round(left), round(low), 0.0)
        blf.draw(FONT, label.text)
        blf.disable(FONT, blf.SHADOW)
