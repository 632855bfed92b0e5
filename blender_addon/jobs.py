# SPDX-License-Identifier: GPL-3.0-or-later
"""What is computed for Blender, on whatever thread asks. Nothing here touches bpy, which only the main thread may use."""

import contextlib
import hashlib
import json
import math
import os
import threading
from dataclasses import asdict, dataclass

import numpy as np
import skyprobe

# What a user can understand and mend: wrong values, files that cannot be written, a library with damaged data, air too thick to be solved.
USER_ERRORS = (ValueError, OSError, skyprobe.DataError, skyprobe.UnsolvedError)

# Luminance of linear Rec.709 over the library's radiance unit for Blender [lm/W].
LUMINOUS_EFFICACY = 683.0
LUMINANCE = (0.2126, 0.7152, 0.0722)


@dataclass(frozen=True)
class SkyRequest:
    """What light to compute, in plain values."""

    air: dict  # keywords of skyprobe.Atmosphere
    place: dict  # latitude, longitude [degrees], elevation_m [m]
    time: str  # ISO 8601
    width: int  # [pixels]
    sun_in_map: bool  # draw the Sun's disc into the map
    lamp_color_space: str  # of Lamp.irradiance
    moon_in_map: bool = True  # draw the Moon's disc into the map
    night: dict | None = None  # keywords of skyprobe.Night
    layers: dict | None = None  # factors on layers of the light
    polarising_filter: dict | None = None  # keywords of skyprobe.PolarisingFilter

    @property
    def key(self):
        """A text that is equal for equal requests only."""
        return json.dumps(asdict(self), sort_keys=True)

    @property
    def digest(self):
        """The SHA-256 of `key`, in hexadecimal digits."""
        return hashlib.sha256(self.key.encode()).hexdigest()

    @property
    def air_key(self):
        """A text that is equal for requests with equal air only."""
        return json.dumps(self.air, sort_keys=True)


@dataclass(frozen=True)
class Lamp:
    """A disc in the sky as a lamp. The altitude is the apparent one, where the map would show the disc."""

    altitude_deg: float
    azimuth_deg: float
    diameter_deg: float
    irradiance: tuple  # direct normal RGB, in the unit of a Blender Sun lamp's strength times colour


@dataclass(frozen=True)
class SkyResult:
    """What came out beside the picture, in plain values."""

    request: SkyRequest
    sun: Lamp
    moon: Lamp | None
    moon_fraction: float  # illuminated fraction of the Moon's disc
    horizontal_lx: float  # illuminance of the horizontal ground by all that the request asks for


def result_content(result):
    """Return what JSON can keep of a SkyResult: all but its request."""
    content = asdict(result)
    del content["request"]
    return content


def result_from(content, request):
    """Return the SkyResult of which `result_content` made `content`; ValueError, TypeError or KeyError for anything else."""
    return SkyResult(
        request=request,
        sun=_lamp_from(content["sun"]),
        moon=None if content["moon"] is None else _lamp_from(content["moon"]),
        moon_fraction=_finite(content["moon_fraction"]),
        horizontal_lx=_finite(content["horizontal_lx"]),
    )


def _lamp_from(content):
    red, green, blue = content["irradiance"]
    angles = (_finite(content[name]) for name in ("altitude_deg", "azimuth_deg", "diameter_deg"))
    return Lamp(*angles, irradiance=(_finite(red), _finite(green), _finite(blue)))


def _finite(value):
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ValueError(f"{value!r} is no number")
    return float(value)


# The air of the last probes. A solved atmosphere serves every place and time, so only a change of air costs a solve.
_KEPT = 4
_airs = {}
_air_lock = threading.Lock()


def atmosphere(air):
    """Return the skyprobe.Atmosphere for the keywords `air`, a former one if they are the same."""
    key = json.dumps(air, sort_keys=True)
    with _air_lock:
        found = _airs.pop(key, None) or skyprobe.Atmosphere(**air)
        _airs[key] = found
        while len(_airs) > _KEPT:
            del _airs[next(iter(_airs))]
        return found


def forget_atmospheres():
    """Free the memory of the last atmospheres."""
    with _air_lock:
        _airs.clear()


@contextlib.contextmanager
def _without_panics():
    """Let a panic of the library, which is no Exception, be one."""
    try:
        yield
    except BaseException as error:
        if type(error).__module__ != "pyo3_runtime":
            raise
        raise RuntimeError(f"panic: {error}") from error


def sky_of(request):
    """Return the skyprobe.Sky of `request`."""
    night = skyprobe.Night(**(request.night or {}))
    # The panel tells what had to be assumed about the time, and here nothing is left to assume.
    civil = skyprobe.places.civil_time(request.time, request.place["latitude"], request.place["longitude"])
    return skyprobe.Sky(**request.place, time=civil.time, zone=civil.zone, atmosphere=atmosphere(request.air), night=night)


def render(sky, request, progress=None):
    """Render `sky` as `request` says; return the skyprobe.Probe and the SkyResult."""
    factors = request.layers or {}
    sun_factor, moon_factor = factors.get("sun", 1.0), factors.get("moon", 1.0)
    # A layer that this sky has not is no error: the factor waits for the night.
    factors = {name: factor for name, factor in factors.items() if name in sky.layer_names}
    held = request.polarising_filter
    probe = sky.render(
        width=request.width,
        scale="blender",
        color_space="lin_rec709",
        sun_disc=request.sun_in_map,
        moon_disc=request.moon_in_map,
        polarising_filter=None if held is None else skyprobe.PolarisingFilter(**held),
        layers=factors or None,
        progress=progress,
    )
    sun_rgb = _scaled(sky.sun_irradiance_rgb(scale="blender", color_space=request.lamp_color_space), sun_factor)
    sun = Lamp(sky.sun.apparent_altitude_deg, sky.sun.azimuth_deg, sky.sun.angular_diameter_deg, sun_rgb)
    moon, fraction = None, 0.0
    if sky.moon is not None:
        moon_rgb = _scaled(sky.moon_irradiance_rgb(scale="blender", color_space=request.lamp_color_space), moon_factor)
        moon = Lamp(sky.moon.apparent_altitude_deg, sky.moon.azimuth_deg, sky.moon.angular_diameter_deg, moon_rgb)
        fraction = sky.moon.illuminated_fraction or 0.0
    horizontal_lx = LUMINOUS_EFFICACY * float(np.dot(probe.irradiance(), LUMINANCE))
    in_lux = {"scale": "luminance", "color_space": "xyz"}
    if not request.sun_in_map:
        horizontal_lx += sun_factor * sky.sun_irradiance_rgb(**in_lux)[1] * _sine(sun)
    if moon is not None and not request.moon_in_map:
        horizontal_lx += moon_factor * sky.moon_irradiance_rgb(**in_lux)[1] * _sine(moon)
    return probe, SkyResult(
        request=request,
        sun=sun,
        moon=moon,
        moon_fraction=fraction,
        horizontal_lx=max(horizontal_lx, 0.0),
    )


@_without_panics()
def preview(request, progress=None):
    """Return the pixels of `request` as Blender keeps them (flat RGBA, float32, rows from the bottom) and its SkyResult."""
    probe, result = render(sky_of(request), request, progress)
    pixels = np.ones((probe.height, probe.width, 4), dtype=np.float32)
    pixels[:, :, :3] = probe.pixels[::-1]
    return pixels.ravel(), result


@_without_panics()
def write(request, path, progress=None):
    """Write the probe of `request` to `path`, whole or not at all; return its SkyResult."""
    probe, result = render(sky_of(request), request, progress)
    if progress is not None and not progress("write", 0.0):
        raise skyprobe.Cancelled("cancelled")
    try:
        probe.save(path)
    except OSError as error:
        raise OSError(f"{error}; make room there, or choose another folder") from None
    return result


@dataclass(frozen=True)
class Day:
    """What happens on the local date of a sky, as aware datetimes or None for what does not happen."""

    sun: skyprobe.SunEvents
    moon_rise: object
    moon_set: object


@_without_panics()
def day(request):
    """Return the Day of `request`."""
    sky = sky_of(request)
    moon = sky.rise_and_set("Moon")
    return Day(sky.sun_events(), moon.rise, moon.set)


def _sine(lamp):
    return max(math.sin(math.radians(lamp.altitude_deg)), 0.0)


def _scaled(rgb, factor):
    return tuple(factor * float(value) for value in rgb)


class ProbeJob(threading.Thread):
    """Writes the probe of `request` to `path` on its thread. After it ended exactly one of `result` and `error` is set.

    A `temporary` file goes when nobody waits for it any more.
    """

    def __init__(self, request, path, temporary=False):
        super().__init__(name="skyprobe", daemon=True)
        self.request = request
        self.path = path
        self.temporary = temporary
        self.result = None
        self.error = None
        self.stage = "start"
        self.fraction = 0.0
        self._cancel = threading.Event()
        self._abandoned = threading.Event()

    def cancel(self):
        """Ask for an early end; the thread ends soon after, with skyprobe.Cancelled as its error."""
        self._cancel.set()

    def abandon(self, patience_s):
        """Ask for an early end, for which nobody waits longer than `patience_s` [s], and leave no temporary file."""
        self._abandoned.set()
        self.cancel()
        if self.is_alive():
            self.join(patience_s)
        if not self.is_alive():
            self.discard()

    def discard(self):
        """Delete the file if it is temporary."""
        if self.temporary:
            # A system may hold on to a file that was just read; it is in a folder that goes with Blender.
            with contextlib.suppress(OSError):
                os.remove(self.path)

    def run(self):
        try:
            self.result = write(self.request, self.path, self._report)
        except BaseException as error:  # handed to the main thread, which reports it
            self.error = error
        if self._abandoned.is_set():
            self.discard()

    def _report(self, stage, fraction):
        self.stage = stage
        self.fraction = fraction
        return not self._cancel.is_set()
