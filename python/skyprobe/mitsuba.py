"""Probes as Mitsuba 3 environment maps.

Mitsuba's ``envmap`` takes y as up, puts +Z in the centre column and row centres on the poles. So a probe for it has
``rows="corner"``, and needs the transform that :func:`to_world` gives. In XML, for a scene with z up (x east, y north)::

    <emitter type="envmap">
        <string name="filename" value="sky.exr"/>
        <transform name="to_world">
            <rotate x="1" angle="90"/>
            <rotate z="1" angle="90"/>
        </transform>
    </emitter>

and for a scene with y up, as exporters from Blender write it (x east, z south): ``<rotate y="1" angle="90"/>`` alone.
"""

from __future__ import annotations

import os
import re
import warnings
from typing import Any

import numpy
from numpy.typing import NDArray

from ._core import InputError, Probe

__all__ = ["envmap", "to_world"]

_TURN = "skyprobe.turn_deg"

# Columns are the images of Mitsuba's x, y (up) and z (centre of the map) axes: north, up and east turned so that the centre is east.
_UP = {
    "z": numpy.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
    "y": numpy.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]),
}
_UP_AXIS = {"z": 2, "y": 1}


def to_world(up: str = "z", north_deg: float = 0.0) -> NDArray[numpy.float64]:
    """The 4 x 4 matrix that turns an ``envmap`` of a skyprobe file into the scene.

    Parameters
    ----------
    up
        Axis of the scene that points up. ``"z"``: x is east and y is north; ``"y"``: x is east and z is south.
    north_deg
        Turns the sky clockwise seen from above: 90 puts its north where east was. [degrees]
    """
    if up not in _UP:
        raise InputError(f"up = {up!r}: must be 'z' or 'y'")
    if not numpy.isfinite(north_deg):
        raise InputError(f"north_deg = {north_deg}: must be a finite number of degrees")
    angle = -numpy.radians(north_deg)
    cosine, sine = numpy.cos(angle), numpy.sin(angle)
    axis = _UP_AXIS[up]
    first, second = (axis + 1) % 3, (axis + 2) % 3
    turn = numpy.eye(3)
    turn[first, first] = turn[second, second] = cosine
    turn[second, first], turn[first, second] = sine, -sine
    matrix = numpy.eye(4)
    matrix[:3, :3] = turn @ _UP[up]
    return matrix


def envmap(
    probe: Probe | str | os.PathLike[str],
    *,
    up: str = "z",
    north_deg: float = 0.0,
    scale: float = 1.0,
) -> dict[str, Any]:
    """The ``envmap`` emitter of a probe or of a file, for ``mitsuba.load_dict``. A Mitsuba variant must have been set.

    Parameters
    ----------
    probe
        A full latitude-longitude probe, best with ``rows="corner"``, or the path of an EXR or HDR file of one. If its sky is turned (``turn_deg``), it is
        turned back.
    up, north_deg
        As in :func:`to_world`.
    scale
        Factor on the radiance.
    """
    import mitsuba

    turn_deg = probe.turn_deg if isinstance(probe, Probe) else _turn_of_file(probe)
    emitter: dict[str, Any] = {
        "type": "envmap",
        "scale": scale,
        "to_world": mitsuba.ScalarTransform4f(to_world(up, north_deg - turn_deg)),
    }
    if not isinstance(probe, Probe):
        emitter["filename"] = os.fspath(probe)
        return emitter
    if probe.projection != "latlong" or probe.extent != "full":
        raise InputError(f"probe = {probe.projection}, {probe.extent}: must be a full latlong probe")
    if probe.rows != "corner":
        warnings.warn(
            'render the probe with rows="corner" for Mitsuba: with centred rows the sky is up to half a pixel too high',
            stacklevel=2,
        )
    emitter["bitmap"] = mitsuba.Bitmap(probe.pixels)
    return emitter


def _turn_of_file(path: str | os.PathLike[str]) -> float:
    """How far the sky in a file is turned, by its header: text after a name in OpenEXR's attributes or in a line of Radiance's. [degrees]"""
    with open(path, "rb") as file:
        header = file.read(1 << 16)
    if header.startswith(b"#?"):
        found = re.search(rf"^{re.escape(_TURN)}=(\S+)".encode(), header.partition(b"\n\n")[0], re.MULTILINE)
    else:
        found = re.search(_TURN.encode() + rb"\0string\0(.{4})", header, re.DOTALL)
        if found:
            text = header[found.end() :][: int.from_bytes(found[1], "little")]
            return float(text)
    return float(found[1]) if found else 0.0
