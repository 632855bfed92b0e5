# SPDX-License-Identifier: GPL-3.0-or-later
"""What there is to draw for a scene's settings: curves with colours, labels and markers, in the scene's coordinates.

The centre is the origin of the scene, the radius `helper_size`. Colours are sRGB with alpha.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from . import sun_paths, values

SWITCHES = ("show_diurnal_path", "show_analemma", "show_north")

SUN = (1.0, 0.80, 0.32, 1.0)
PATH = (1.0, 0.77, 0.30, 0.95)
NIGHT = (0.55, 0.66, 0.88, 0.40)
ANALEMMA = (0.62, 0.74, 0.92, 0.50)
SEASONS = ((0.98, 0.62, 0.36, 0.42), (0.80, 0.80, 0.80, 0.32), (0.50, 0.68, 0.98, 0.42))
RING = (0.86, 0.88, 0.92, 0.50)
FAINT = (0.86, 0.88, 0.92, 0.20)
NORTH = (0.96, 0.42, 0.36, 0.95)
TEXT = (0.93, 0.94, 0.96, 0.92)
QUIET_TEXT = (0.86, 0.88, 0.92, 0.62)
SUN_TEXT = (1.0, 0.88, 0.55, 1.0)
MOON = (0.90, 0.92, 0.97, 1.0)
MOON_SHADE = (0.30, 0.33, 0.40, 1.0)

# Labels are told by their importance: where two would touch, the lesser one is left out.
NOW, FIRST, SECOND, THIRD, LAST = range(5)


@dataclass(frozen=True)
class Label:
    """Text near a point of the scene: pushed away on the screen from the centre, or beginning beside a marker."""

    text: str
    point: tuple
    color: tuple
    importance: int
    size: float = 11.0  # [points]
    push: float = 0.0  # [points]
    beside: float = None  # from the point to the beginning of the text [points]


@dataclass(frozen=True)
class Marker:
    """A disc of constant size on the screen; with `light_from` (a point) and `fraction` it is lit like the Moon."""

    point: tuple
    radius: float  # [points]
    color: tuple
    shade: tuple = MOON_SHADE
    light_from: tuple = None
    fraction: float = 1.0


@dataclass
class Scenery:
    """All that is drawn."""

    strokes: list = field(default_factory=list)  # (ends of separate lines (2 M, 3), RGBA of each, width [points])
    labels: list = field(default_factory=list)
    markers: list = field(default_factory=list)
    batches: list = None  # made by the first drawing, which has a graphics context

    def make_batches(self, make):
        """Turn the strokes into batches of one width each by `make(points, colors)`, once."""
        if self.batches is not None:
            return
        widths = {}
        for points, colors, width in self.strokes:
            widths.setdefault(width, []).append((points, colors))
        self.batches = [(make(*map(np.concatenate, zip(*parts))), width) for width, parts in widths.items()]


class Keeper:
    """Keeps the scenery of the last settings."""

    def __init__(self):
        self.forget()

    def forget(self):
        self._key, self._scenery = None, None

    def of(self, settings):
        """Return the Scenery of `settings`; raise jobs.USER_ERRORS for settings that make no sense."""
        key = _key(settings)
        if key != self._key:
            self._scenery = _make(*key)
            self._key = key
        return self._scenery


def _key(settings):
    """Return all that the scenery depends on."""
    switches = tuple(bool(getattr(settings, name, False)) for name in SWITCHES)
    place = tuple(values.place(settings).values())
    # A compass needs no time, and is there while a date is being typed.
    moment = values.civil_time(settings).time if switches[0] or switches[1] else None
    return switches, place, moment, settings.north, getattr(settings, "helper_size", 10.0)


def _make(switches, place, moment, north, radius):
    show_path, show_analemma, show_north = switches
    scenery = _Maker(north, radius)
    if show_north:
        scenery.compass()
    if show_path or show_analemma:
        offset_s = round(moment.utcoffset().total_seconds())
        if show_analemma:
            scenery.analemmas(sun_paths.analemmas(place, moment.year, offset_s), labelled=not show_path)
        if show_path:
            scenery.seasons(sun_paths.seasons(place, moment.year, offset_s))
            scenery.day(sun_paths.day(place, moment.date(), offset_s))
        scenery.bodies(*sun_paths.sun_and_moon(place, moment), f"{moment:%H:%M}")
    return scenery.scenery


class _Maker:
    """Puts curves of the unit sphere into the scene."""

    def __init__(self, north, radius):
        self.scenery = Scenery()
        self._radius = radius
        sine, cosine = math.sin(north), math.cos(north)
        # True north stands `north` clockwise from +Y.
        self._turn = radius * np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])

    def _placed(self, directions):
        return np.asarray(directions, dtype=float) @ self._turn

    def _point(self, direction):
        return tuple(self._placed(direction).tolist())

    def _segments(self, ends, color, width):
        """Add separate lines between pairs of `ends`, (2 M, 3); `color` is one for all or one for each end."""
        if len(ends):
            colors = np.broadcast_to(np.asarray(color, np.float32), (len(ends), 4))
            self.scenery.strokes.append((self._placed(ends).astype(np.float32), colors, width))

    def _curve(self, points, color, width):
        points = np.asarray(points)
        self._segments(np.stack([points[:-1], points[1:]], axis=1).reshape(-1, 3), color, width)

    def _label(self, text, direction, color, importance, size=11.0, push=0.0, beside=None):
        self.scenery.labels.append(Label(text, self._point(direction), color, importance, size, push, beside))

    def compass(self):
        """A ring with the points of the compass, and an arrow to the north."""
        self._curve(_on_ground(np.linspace(0.0, 360.0, 181), 1.0), RING, 1.4)
        for step, length, width in ((5, 0.015, 1.0), (15, 0.03, 1.0), (45, 0.05, 1.6)):
            degrees = np.arange(0, 360, step)
            ticks = np.stack([_on_ground(degrees, 1.0), _on_ground(degrees, 1.0 + length)], axis=1)
            self._segments(ticks.reshape(-1, 3), RING, width)
        for degrees in (90.0, 180.0, 270.0):
            self._curve(_on_ground([degrees, degrees], [0.0, 1.0]), FAINT, 1.0)
        self._curve(_on_ground([0.0, 0.0], [0.0, 1.16]), NORTH, 2.0)
        head = _on_ground([-2.6, 0.0, 2.6, -2.6], [1.06, 1.17, 1.06, 1.06])
        self._curve(head, NORTH, 2.0)
        for text, degrees in (("N", 0.0), ("E", 90.0), ("S", 180.0), ("W", 270.0)):
            north = text == "N"
            color, size = (NORTH, 15.0) if north else (TEXT, 13.0)
            self._label(text, _on_ground([degrees], 1.17 if north else 1.05)[0], color, FIRST, size, push=12.0)

    def day(self, day):
        """The way of the Sun on the date, with hours, sunrise and sunset."""
        self._segments(sun_paths.above_horizon(day.path), PATH, 2.6)
        self._segments(sun_paths.dashes_below_horizon(day.path), NIGHT, 1.4)
        for hour, mark in enumerate(day.hours):
            above = mark.direction[2] >= 0.0
            color = PATH if above else NIGHT
            length = 0.03 if hour % 3 == 0 else 0.018
            self._segments([mark.direction * (1.0 - length), mark.direction * (1.0 + length)], color, 2.0 if above else 1.2)
            if above:
                importance = SECOND if hour % 3 == 0 else THIRD
                self._label(mark.text, mark.direction * (1.0 + length), SUN_TEXT, importance, push=9.0)
        for name, mark in (("Sunrise", day.rise), ("Sunset", day.set)):
            if mark is not None:
                self._curve([mark.direction * 0.0, mark.direction], (*PATH[:3], 0.32), 1.2)
                self._segments([mark.direction * 0.97, mark.direction * 1.05], PATH, 2.6)
                self._label(f"{name} {mark.text}", mark.direction * 1.05, SUN_TEXT, FIRST, push=14.0)

    def seasons(self, seasons):
        """Where the Sun turns, faintly."""
        for (mark, path), color in zip(seasons, SEASONS):
            self._segments(sun_paths.above_horizon(path), color, 1.2)
            if mark.direction[2] > 0.0:
                self._label(mark.text, mark.direction, (*color[:3], 0.75), LAST, 10.0, push=9.0)

    def analemmas(self, analemmas, labelled):
        """Where the Sun stands through the year at each hour of the clock, what is above the horizon."""
        self._segments(sun_paths.above_horizon(analemmas), ANALEMMA, 1.3)
        if not labelled:
            return
        for hour, curve in enumerate(analemmas):
            highest = curve[np.argmax(curve[:, 2])]
            if highest[2] > 0.05:
                self._label(str(hour), highest, QUIET_TEXT, SECOND if hour % 3 == 0 else THIRD, push=10.0)

    def bodies(self, sun, moon, clock):
        """Sun and Moon as they stand now, each with a line to the centre, as faint as it stands below the horizon."""
        lit = (1.0 - float(np.clip(sun @ moon, -1.0, 1.0))) / 2.0
        for name, direction, color, radius in (("Moon", moon, MOON, 6.0), ("Sun", sun, SUN, 8.0)):
            up = direction[2] >= 0.0
            self._curve([direction * 0.0, direction], (*color[:3], 0.55 if up else 0.18), 1.4)
            if up:
                # Down to the ground and to the centre: which way, and how high.
                foot = direction * (1.0, 1.0, 0.0)
                self._segments(_dashed(direction, foot, 24), (*color[:3], 0.30), 1.0)
                self._segments(_dashed(foot, foot * 0.0, 24), (*color[:3], 0.30), 1.0)
            alpha = 1.0 if up else 0.4
            moonlike = {"light_from": self._point(moon + 0.05 * (sun - moon)), "fraction": lit} if name == "Moon" else {}
            shade = (*MOON_SHADE[:3], alpha)
            self.scenery.markers.append(Marker(self._point(direction), radius, (*color[:3], alpha), shade, **moonlike))
            text = f"Sun {clock}" if name == "Sun" else f"Moon {lit:.0%}"
            color = (*(SUN_TEXT if name == "Sun" else TEXT)[:3], 0.45 + 0.55 * up)
            self._label(text, direction, color, NOW, 12.0, beside=radius + 7.0)


def _on_ground(degrees, radius):
    """Return points of the ground at azimuths [degrees], (N, 3)."""
    angle = np.radians(np.asarray(degrees, dtype=float))
    return np.stack([radius * np.sin(angle), radius * np.cos(angle), 0.0 * angle], axis=1)


def _dashed(start, end, count):
    """Return the ends of `count` / 2 dashes from `start` to `end`, (count, 3)."""
    return start + (end - start) * np.linspace(0.0, 1.0, count + 1)[:count, None]
