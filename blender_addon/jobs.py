# SPDX-License-Identifier: GPL-3.0-or-later
"""The computation of a probe, on a thread of its own. Nothing here touches bpy, which only the main thread may use."""

import threading
from dataclasses import dataclass

import skyprobe

# What a user can understand and mend: wrong values, files that cannot be written, a library with damaged data.
USER_ERRORS = (ValueError, OSError, skyprobe.DataError)


@dataclass(frozen=True)
class ProbeRequest:
    """What to compute, in plain values."""

    air: dict  # keywords of skyprobe.Atmosphere
    place: dict  # latitude, longitude [degrees], elevation_m [m]
    time: str  # ISO 8601
    width: int  # [pixels]
    sun_in_map: bool  # draw the Sun's disc into the map
    lamp_color_space: str  # of ProbeResult.sun_irradiance
    path: str  # file to write, absolute
    pack: bool  # move the file into the .blend afterwards
    polarising_filter: dict | None = None  # keywords of skyprobe.PolarisingFilter
    night: dict | None = None  # keywords of skyprobe.Night


@dataclass(frozen=True)
class ProbeResult:
    """What came out, in plain values. The Sun's altitude is the apparent one, where the map shows the disc."""

    request: ProbeRequest
    sun_altitude_deg: float
    sun_azimuth_deg: float
    sun_diameter_deg: float
    sun_irradiance: tuple  # direct normal RGB, in the unit of a Blender Sun lamp's strength times colour


class ProbeJob(threading.Thread):
    """Computes one probe and writes its file. After it ended exactly one of `result` and `error` is set."""

    def __init__(self, request):
        super().__init__(name="skyprobe", daemon=True)
        self.request = request
        self.result = None
        self.error = None
        self.stage = "start"
        self.fraction = 0.0
        self._cancel = threading.Event()

    def cancel(self):
        """Ask for an early end; the thread ends soon after, with skyprobe.Cancelled as its error."""
        self._cancel.set()

    def run(self):
        try:
            self.result = compute(self.request, self._report)
        except BaseException as error:  # handed to the main thread, which reports or raises it
            self.error = error

    def _report(self, stage, fraction):
        self.stage = stage
        self.fraction = fraction
        return not self._cancel.is_set()


# The air of the last probe. A solved atmosphere serves every place and time, so only a change of air costs a solve.
_last_air = (None, None)
_air_lock = threading.Lock()


def atmosphere(air):
    """Return the skyprobe.Atmosphere for the keywords `air`, the one used last if they are the same."""
    global _last_air
    key = tuple(sorted(air.items()))
    with _air_lock:
        if _last_air[0] != key:
            _last_air = (key, skyprobe.Atmosphere(**air))
        return _last_air[1]


def forget_atmosphere():
    """Free the memory of the last atmosphere."""
    global _last_air
    with _air_lock:
        _last_air = (None, None)


def compute(request, progress):
    """Compute and write the probe of `request`; `progress(stage, fraction)` returns False to cancel."""
    night = skyprobe.Night(**(request.night or {}))
    sky = skyprobe.Sky(**request.place, time=request.time, atmosphere=atmosphere(request.air), night=night)
    return render(sky, request, progress)


def render(sky, request, progress):
    """Render and write the probe of the skyprobe.Sky `sky`, with the width, file and Sun of `request`."""
    held = request.polarising_filter
    probe = sky.render(
        width=request.width,
        scale="blender",
        color_space="lin_rec709",
        sun_disc=request.sun_in_map,
        polarising_filter=None if held is None else skyprobe.PolarisingFilter(**held),
        progress=progress,
    )
    irradiance = sky.sun_irradiance_rgb(scale="blender", color_space=request.lamp_color_space)
    if not progress("write", 0.0):
        raise skyprobe.Cancelled("cancelled")
    probe.save(request.path)
    return ProbeResult(
        request=request,
        sun_altitude_deg=sky.sun.apparent_altitude_deg,
        sun_azimuth_deg=sky.sun.azimuth_deg,
        sun_diameter_deg=sky.sun.angular_diameter_deg,
        sun_irradiance=tuple(float(value) for value in irradiance),
    )
