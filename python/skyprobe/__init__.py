"""The light of the sky for a place, a time and a state of the air, as a high dynamic range light probe.

The state of the air is an :class:`Atmosphere`; it is solved once. A :class:`Sky` is that air seen from a place at a time, and gives
the light that arrives there: spectral radiance in any direction, irradiance, illuminance, or a whole :class:`Probe` for a renderer.
Changing the place or the time never solves again, so share one ``Atmosphere`` between many skies.

>>> import skyprobe as sp
>>> air = sp.Atmosphere(preset="clear", turbidity=3.0, ground="grass")
>>> sky = sp.Sky(latitude=55.71, longitude=13.19, elevation_m=20, time="2005-06-21T13:00:00+02:00", atmosphere=air)
>>> probe = sky.render(width=2048)
>>> probe.pixels.shape
(1024, 2048, 3)
>>> probe.save("sky.exr")

A :class:`Scene` is all of that as one value, as the command line's configurations and the headers of pictures hold it:

>>> sp.Scene(place="Lund, Sweden", time="2005-06-21T13:00", atmosphere={"turbidity": 3.0}, probe={"width": 512}).render()

Conventions
-----------
- Directions are unit vectors, x = east, y = north, z = up. Azimuth in degrees from north through east, altitude in degrees
  above the horizon. Altitudes are geometric (airless) unless the name says ``apparent``.
- Wavelengths in nm; spectral radiance in W m-2 sr-1 nm-1; irradiance in W m-2 nm-1; illuminance in lx (CIE 1931 observer).
- Latitude-longitude probes: row 0 at the zenith, column at 1/4 + (azimuth + turn_deg) / 360 of the width (without turn north at 1/4, east in the centre).
- Long work releases the interpreter. ``progress(stage, fraction)`` is called on the thread that asked for the work; returning
  ``False`` from it raises :class:`Cancelled`.

Cache
-----
Solved light is kept on disk and used again, in the folder that the environment variable ``SKYPROBE_CACHE_DIR`` names or ``skyprobe`` in the
system's place for caches, 1 GB at most. ``SKYPROBE_CACHE=off`` or ``Atmosphere(cache=False)`` switches that off.

Errors
------
:class:`InputError` (a ``ValueError``) names the parameter, the value and the allowed range; :class:`DataError` (a
``RuntimeError``) says which data cannot be used; :class:`UnsolvedError` (a ``RuntimeError``) says that the light of this air cannot be found and what
would help; files raise ``OSError``; :class:`Cancelled` says that the callback stopped the work.
:class:`ScaleWarning` says that the luminance of a picture had to be assumed, :class:`SunlightOnlyWarning` that a result is of sunlight alone in the dark,
:class:`TimeWarning` what had to be assumed about a time.

Processes
---------
After ``fork`` (``multiprocessing``'s default on Linux up to Python 3.13) the child works with threads of its own. A child that was forked while another thread of
its parent was at work here raises ``RuntimeError`` at the first work: what that thread held would never be let go.
"""

from . import places
from ._core import (
    Atmosphere,
    Body,
    Cancelled,
    Component,
    DataError,
    Illuminance,
    InputError,
    Irradiance,
    LunarEclipse,
    Moon,
    Night,
    Phase,
    PolarisingFilter,
    Probe,
    RiseAndSet,
    ScaleWarning,
    Scene,
    Sky,
    SolarEclipse,
    SunEvents,
    SunlightOnlyWarning,
    TimeWarning,
    UnsolvedError,
    __version__,
    check_files,
)

__all__ = [
    "Atmosphere",
    "Body",
    "Cancelled",
    "Component",
    "DataError",
    "Illuminance",
    "InputError",
    "Irradiance",
    "LunarEclipse",
    "Moon",
    "Night",
    "Phase",
    "PolarisingFilter",
    "Probe",
    "RiseAndSet",
    "ScaleWarning",
    "Scene",
    "Sky",
    "SolarEclipse",
    "SunEvents",
    "SunlightOnlyWarning",
    "TimeWarning",
    "UnsolvedError",
    "__version__",
    "check_files",
    "places",
]
