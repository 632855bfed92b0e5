"""The compiled part of skyprobe."""

import datetime
import os
from collections.abc import Callable, Sequence
from typing import Literal, TypeAlias, final

import numpy
from numpy.typing import ArrayLike, NDArray

_Quality: TypeAlias = Literal["draft", "standard", "high", "reference"]
_Preset: TypeAlias = Literal[
    "clear", "pure", "hazy", "polluted", "urban", "maritime", "desert", "antarctic", "fog", "volcanic", "thesis"
]
_Aerosol: TypeAlias = Literal[
    "none",
    "continental_clean",
    "continental_average",
    "continental_polluted",
    "urban",
    "maritime_clean",
    "maritime_polluted",
    "maritime_tropical",
    "desert",
    "arctic",
    "antarctic",
    "fog",
    "thesis",
]
_PhaseFunction: TypeAlias = Literal["mie", "henyey_greenstein", "cornette_shanks"]
_Ground: TypeAlias = Literal["grass", "forest", "soil", "desert", "snow", "sea", "city", "asphalt"]
_Scale: TypeAlias = Literal["blender", "mitsuba", "luminance"]
_ColorSpace: TypeAlias = Literal["lin_rec709", "acescg", "lin_rec2020", "xyz"]
_Model: TypeAlias = Literal["scattering", "preetham", "thesis", "thesis_single"]
_Progress: TypeAlias = Callable[[str, float], bool | None]

__all__ = [
    "Atmosphere",
    "Body",
    "Cancelled",
    "Component",
    "DataError",
    "Illuminance",
    "InputError",
    "Irradiance",
    "Phase",
    "PolarisingFilter",
    "Probe",
    "Sky",
    "SunEvents",
    "__version__",
    "run_command_line",
]

__version__: str

class InputError(ValueError):
    """A value that cannot be used. The message names the parameter, the value given and the allowed range; nothing was computed."""

class DataError(RuntimeError):
    """A table or file whose content cannot be used."""

class Cancelled(Exception):
    """The progress callback returned False; nothing was left behind."""

@final
class Phase:
    """Where a scatterer sends the light: a phase function, normalised to 4 pi over the sphere."""

    @staticmethod
    def rayleigh(depolarisation: ArrayLike | None = None) -> Phase:
        """Molecules.

        Parameters
        ----------
        depolarisation
            Depolarisation ratio of natural light, 0 to 1: one for each wavelength, or a number. Default 0.
        """

    @staticmethod
    def henyey_greenstein(asymmetry: float) -> Phase:
        """The function of Henyey and Greenstein (1941) with an asymmetry from -0.99 to 0.99."""

    @staticmethod
    def cornette_shanks(asymmetry: float) -> Phase:
        """The function of Cornette and Shanks (1992) with the parameter g from -0.99 to 0.99."""

    @staticmethod
    def tabulated(angles_deg: ArrayLike, values: ArrayLike) -> Phase:
        """A function given by numbers. Between the angles its logarithm is linear.

        It is scaled so that its integral over the sphere is 4 pi, and refused if it is further than 5 % from that.

        Parameters
        ----------
        angles_deg
            Scattering angles, ascending from 0 to 180, shape (A,): close together where the function bends. [degrees]
        values
            Shape (A,), or (W, A) with a row for each wavelength of the profile; not negative.
        """

@final
class Component:
    """One kind of particle or gas of an explicit profile.

    Parameters
    ----------
    scattering, absorption
        Coefficients, shape (Z, W): altitudes, wavelengths. [1/km]
    phase
        Phase function; None for a component that only absorbs.
    name
        Name for messages.
    """

    def __new__(
        cls, *, scattering: ArrayLike, absorption: ArrayLike, phase: Phase | None, name: str | None = None
    ) -> Component: ...

@final
class Atmosphere:
    """The state of the air. It is solved on first use, once, and can be shared by any number of skies and threads.

    What is left out comes from the preset. At most one of ``aod550``, ``turbidity`` and ``visibility_km`` is given.

    Parameters
    ----------
    preset
        Where to start from: "clear", "pure", "hazy", "polluted", "urban", "maritime", "desert", "antarctic", "fog", "volcanic" or
        "thesis".
    aerosol
        Kind of haze: "none", "continental_clean", "continental_average", "continental_polluted", "urban", "maritime_clean",
        "maritime_polluted", "maritime_tropical", "desert", "arctic", "antarctic", "fog" or "thesis".
    relative_humidity
        With which the particles grow, 0 to 99; 80 by default. [%]
    aod550
        Vertical optical depth of the haze at 550 nm, 0 to 50.
    turbidity
        Optical depth of haze and molecules over that of the molecules at 550 nm, 1 (pure air) to 64.
    visibility_km
        Horizontal visibility at the ground, from 0.05. [km]
    ozone_du
        Ozone column, 0 to 1000. [Dobson units]
    ground
        "grass", "forest", "soil", "desert", "snow", "sea", "city", "asphalt", or one albedo from 0 to 1.
    angstrom_exponent
        Replaces the spectral slope of the haze's extinction, -1 to 4.
    single_scattering_albedo
        Replaces the haze's single scattering albedo, 0 to 1.
    asymmetry
        Replaces the haze's asymmetry parameter, -0.99 to 0.99, and so its phase function.
    phase_function
        How the haze scatters: "mie", "henyey_greenstein" or "cornette_shanks"; "mie" by default, "henyey_greenstein" if ``asymmetry`` is
        given.
    aerosol_scale_height_km
        Replaces the haze's scale height, or the depth of a layer of fog, 0.1 to 20. [km]
    stratospheric_aod550
        Vertical optical depth at 550 nm of volcanic sulphuric acid in the stratosphere, 0 to 1; it comes on top of ``aod550``.
    stratospheric_altitude_km
        Altitude of its middle, 12 to 40; 20 by default. [km]
    standard_atmosphere
        Profile of temperature and density, such as "us_standard_1976" or "tropical".
    surface_pressure_hpa
        Pressure at the ground, 100 to 1100. [hPa]
    quality
        "draft", "standard", "high" or "reference".
    polarisation
        Whether light is solved with its polarisation. As a scalar it is wrong by several per cent: only to compare with scalar codes.
    wavelengths_nm
        Wavelengths at which light is solved instead of those of the quality: ascending, 300 to 1000, shape (W,). A probe and an illuminance
        need at least four, from 450 or less to 650 or more. [nm]
    cache
        Whether light that was solved earlier is used again, and what is solved is kept, on this machine (see ``SKYPROBE_CACHE_DIR``; drafts
        are not kept).
    """

    def __new__(
        cls,
        *,
        preset: _Preset = "clear",
        aerosol: _Aerosol | None = None,
        relative_humidity: float | None = None,
        aod550: float | None = None,
        turbidity: float | None = None,
        visibility_km: float | None = None,
        ozone_du: float | None = None,
        ground: _Ground | float | None = None,
        angstrom_exponent: float | None = None,
        single_scattering_albedo: float | None = None,
        asymmetry: float | None = None,
        phase_function: _PhaseFunction | None = None,
        aerosol_scale_height_km: float | None = None,
        stratospheric_aod550: float | None = None,
        stratospheric_altitude_km: float | None = None,
        standard_atmosphere: str | None = None,
        surface_pressure_hpa: float | None = None,
        quality: _Quality = "standard",
        polarisation: bool = True,
        wavelengths_nm: ArrayLike | None = None,
        cache: bool = True,
    ) -> Atmosphere: ...
    @staticmethod
    def from_profile(
        altitudes_km: ArrayLike,
        wavelengths_nm: ArrayLike,
        components: Sequence[Component],
        *,
        solar_irradiance: ArrayLike,
        ground_albedo: ArrayLike | None = None,
        planet_radius_km: float = 6371.0,
        sun_angular_radius_deg: float = 0.2664,
        quality: _Quality = "standard",
        polarisation: bool = True,
        cache: bool = True,
    ) -> Atmosphere:
        """An air given in full: another code's, or another planet's. Coefficients are linear between the altitudes.

        Parameters
        ----------
        altitudes_km
            Ascending from 0, shape (Z,); the last is the top of the air. [km]
        wavelengths_nm
            Ascending, shape (W,). [nm]
        components
            What the air is made of.
        solar_irradiance
            At the top of the air at 1 au, shape (W,) or a number. [W m-2 nm-1]
        ground_albedo
            Lambertian, 0 to 1, shape (W,) or a number. Default 0.
        planet_radius_km
            Radius of the ground. [km]
        sun_angular_radius_deg
            Angular radius of the Sun's disc. [degrees]
        quality
            "draft", "standard", "high" or "reference".
        polarisation
            Whether light is solved with its polarisation. As a scalar it is wrong by several per cent: only to compare with scalar codes.
        cache
            As for ``Atmosphere``.
        """

    def solve(self, progress: _Progress | None = None) -> None:
        """Solve the light now instead of on first use. Solving twice costs nothing."""

    @property
    def quality(self) -> _Quality:
        """Name of the quality level."""

    @property
    def altitudes_km(self) -> NDArray[numpy.float64]:
        """Altitudes of the optical profile, shape (Z,). [km]"""

    @property
    def wavelengths_nm(self) -> NDArray[numpy.float64]:
        """Wavelengths of the optical profile, shape (W,). [nm]"""

@final
class Body:
    """A body as it stands in the sky."""

    @property
    def name(self) -> str:
        """English name, such as "Sun"."""

    @property
    def altitude_deg(self) -> float:
        """Airless altitude of the centre. [degrees]"""

    @property
    def azimuth_deg(self) -> float:
        """Azimuth from north through east. [degrees]"""

    @property
    def apparent_altitude_deg(self) -> float:
        """Altitude of the centre as refraction shows it. [degrees]"""

    @property
    def distance_au(self) -> float:
        """Distance from the observer. [au]"""

    @property
    def angular_diameter_deg(self) -> float:
        """Angular diameter without refraction. [degrees]"""

    @property
    def magnitude(self) -> float | None:
        """Visual magnitude outside the air, where it is known."""

    @property
    def phase_angle_deg(self) -> float | None:
        """Angle at the body between Sun and observer, of bodies that shine by sunlight. [degrees]"""

    @property
    def illuminated_fraction(self) -> float | None:
        """Fraction of the disc that is lit, of bodies that shine by sunlight."""

    @property
    def direction(self) -> tuple[float, float, float]:
        """Unit vector (east, north, up) to the airless position."""

    @property
    def apparent_direction(self) -> tuple[float, float, float]:
        """Unit vector (east, north, up) to the refracted position."""

@final
class SunEvents:
    """The Sun's day at a place, in the zone of the sky's time. An event that does not happen is None.

    Sunrise and sunset are those of almanacs: the Sun's centre at -50 arcminutes, a level horizon.
    """

    @property
    def astronomical_dawn(self) -> datetime.datetime | None:
        """The Sun's centre rises through -18 degrees."""

    @property
    def nautical_dawn(self) -> datetime.datetime | None:
        """The Sun's centre rises through -12 degrees."""

    @property
    def civil_dawn(self) -> datetime.datetime | None:
        """The Sun's centre rises through -6 degrees."""

    @property
    def sunrise(self) -> datetime.datetime | None:
        """The Sun's upper limb appears."""

    @property
    def solar_noon(self) -> datetime.datetime:
        """The Sun is in the meridian."""

    @property
    def noon_altitude_deg(self) -> float:
        """Airless altitude at solar noon. [degrees]"""

    @property
    def sunset(self) -> datetime.datetime | None:
        """The Sun's upper limb disappears."""

    @property
    def civil_dusk(self) -> datetime.datetime | None:
        """The Sun's centre sinks through -6 degrees."""

    @property
    def nautical_dusk(self) -> datetime.datetime | None:
        """The Sun's centre sinks through -12 degrees."""

    @property
    def astronomical_dusk(self) -> datetime.datetime | None:
        """The Sun's centre sinks through -18 degrees."""

@final
class Irradiance:
    """Spectral irradiance, each of shape (W,). [W m-2 nm-1]"""

    @property
    def direct_normal(self) -> NDArray[numpy.float64]:
        """Of the Sun's disc, on a plane that faces it. [W m-2 nm-1]"""

    @property
    def direct_horizontal(self) -> NDArray[numpy.float64]:
        """Of the Sun's disc, on the horizontal plane. [W m-2 nm-1]"""

    @property
    def diffuse_horizontal(self) -> NDArray[numpy.float64]:
        """Of the sky without the disc, on the horizontal plane. [W m-2 nm-1]"""

@final
class Illuminance:
    """Illuminance, CIE 1931 observer. [lx]"""

    @property
    def direct_normal_lx(self) -> float:
        """Of the Sun's disc, on a plane that faces it. [lx]"""

    @property
    def direct_horizontal_lx(self) -> float:
        """Of the Sun's disc, on the horizontal plane. [lx]"""

    @property
    def diffuse_horizontal_lx(self) -> float:
        """Of the sky without the disc, on the horizontal plane. [lx]"""

    @property
    def global_horizontal_lx(self) -> float:
        """Of disc and sky, on the horizontal plane. [lx]"""

@final
class PolarisingFilter:
    """A polarising filter between the sky and the picture: what is seen is I + strength (Q cos 2c + U sin 2c), where c is the angle of its
    axis from the vertical. The half of the light that any filter takes is made up for by the exposure.

    Parameters
    ----------
    strength
        0 (no filter) to 1 (ideal).
    angle_deg
        Angle of the axis from the vertical, clockwise as one sees it, -180 to 180. [degrees]
    held_towards_deg
        Altitude and azimuth towards which the filter is held, one piece of glass for the whole picture; the closer one looks along its axis, the less
        it does. None: it turns with the view, its axis at the same angle from the vertical in every direction. [degrees]
    """

    def __new__(
        cls, *, strength: float = 1.0, angle_deg: float = 0.0, held_towards_deg: tuple[float, float] | None = None
    ) -> PolarisingFilter: ...
    @property
    def strength(self) -> float:
        """0 (no filter) to 1 (ideal)."""

    @property
    def angle_deg(self) -> float:
        """Angle of the axis from the vertical, clockwise as one sees it. [degrees]"""

    @property
    def held_towards_deg(self) -> tuple[float, float] | None:
        """Altitude and azimuth towards which the filter is held; None if it turns with the view. [degrees]"""

@final
class Sky:
    """An atmosphere seen from a place at a time.

    Parameters
    ----------
    latitude
        Geodetic, north positive, -90 to 90. [degrees]
    longitude
        East positive, -180 to 180. [degrees]
    time
        ISO 8601 text, or an aware ``datetime``. A text without offset is local time in ``zone``.
    atmosphere
        The air.
    elevation_m
        Height of the observer above the sea, -500 to 60000. [m]
    zone
        IANA time zone, such as "Europe/Stockholm"; by default the zone of the place, found offline.
    sun_model
        By which theory the Sun stands where it does: "iau", or "thesis" (low precision).
    model
        By which model the sky is rendered: "scattering" (solved light: day, twilight, night) "preetham" (the analytic sky of 1999, by day at
        turbidities from 2 to 10), "thesis" or "thesis_single" (ray marching with random steps, light scattered at most twice or once:
        noisy, for small images). Spectra, irradiance and illuminance are those of "scattering".
    """

    def __new__(
        cls,
        *,
        latitude: float,
        longitude: float,
        time: str | datetime.datetime,
        atmosphere: Atmosphere,
        elevation_m: float = 0.0,
        zone: str | None = None,
        sun_model: Literal["iau", "thesis"] = "iau",
        model: _Model = "scattering",
    ) -> Sky: ...
    @staticmethod
    def with_sun(
        *,
        altitude_deg: float,
        azimuth_deg: float,
        atmosphere: Atmosphere,
        elevation_m: float = 0.0,
        model: _Model = "scattering",
    ) -> Sky:
        """The sky under a Sun that is put, without place and time.

        Parameters
        ----------
        altitude_deg
            Airless, -90 to 90. [degrees]
        azimuth_deg
            From north through east. [degrees]
        atmosphere
            The air.
        elevation_m
            Height of the observer above the sea, -500 to 60000. [m]
        model
            As for ``Sky``.
        """

    @property
    def latitude(self) -> float | None:
        """Latitude of the place. [degrees]"""

    @property
    def longitude(self) -> float | None:
        """Longitude of the place. [degrees]"""

    @property
    def model(self) -> _Model:
        """By which model the sky is rendered."""

    @property
    def elevation_m(self) -> float:
        """Height of the observer above the sea. [m]"""

    @property
    def time(self) -> datetime.datetime | None:
        """The time, with its offset."""

    @property
    def zone(self) -> str | None:
        """IANA zone of the time; None for a fixed offset."""

    @property
    def atmosphere(self) -> Atmosphere:
        """The air."""

    @property
    def sun(self) -> Body:
        """The Sun."""

    def bodies(self) -> list[Body]:
        """All bodies that light this sky."""

    def sun_events(self) -> SunEvents:
        """Sunrise, sunset, twilights and noon on the local date of this sky's time."""

    def spectral_radiance(
        self, directions: ArrayLike, wavelengths_nm: ArrayLike, *, progress: _Progress | None = None
    ) -> NDArray[numpy.float64]:
        """Spectral radiance of sky and ground without the Sun's disc, shape (N, W). [W m-2 sr-1 nm-1]

        Parameters
        ----------
        directions
            Unit vectors (east, north, up) that one looks along, shape (N, 3).
        wavelengths_nm
            Shape (W,), within the atmosphere's wavelengths. [nm]
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def stokes(
        self, directions: ArrayLike, wavelengths_nm: ArrayLike, *, progress: _Progress | None = None
    ) -> NDArray[numpy.float64]:
        """Stokes parameters I, Q, U of sky and ground without the Sun's disc, shape (N, W, 3). [W m-2 sr-1 nm-1]

        Q > 0 is polarised vertically, in the plane of the direction and the zenith; U > 0 along the line 45 degrees clockwise from the vertical
        as one sees it. The degree of linear polarisation is hypot(Q, U) / I, and the angle of the vibration from the vertical, clockwise,
        arctan2(U, Q) / 2. Circular polarisation is neglected.

        Parameters
        ----------
        directions
            Unit vectors (east, north, up) that one looks along, shape (N, 3).
        wavelengths_nm
            Shape (W,), within the atmosphere's wavelengths. [nm]
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def irradiance(self, wavelengths_nm: ArrayLike, *, progress: _Progress | None = None) -> Irradiance:
        """Spectral irradiance of Sun and sky. [W m-2 nm-1]

        Parameters
        ----------
        wavelengths_nm
            Shape (W,), within the atmosphere's wavelengths. [nm]
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def illuminance(self, *, progress: _Progress | None = None) -> Illuminance:
        """Illuminance of Sun and sky. [lx]"""

    def sun_irradiance_rgb(
        self,
        *,
        scale: _Scale = "blender",
        color_space: _ColorSpace = "lin_rec709",
        progress: _Progress | None = None,
    ) -> tuple[float, float, float]:
        """Irradiance of the Sun's disc on a plane that faces it, in the units of a probe with this scale and colour space times sr."""

    def render(
        self,
        *,
        width: int = 2048,
        projection: Literal["latlong", "fisheye"] = "latlong",
        rows: Literal["centre", "corner"] = "centre",
        extent: Literal["full", "upper"] = "full",
        ground: Literal["on", "off", "mirrored"] = "on",
        sun_disc: bool = True,
        scale: _Scale = "blender",
        color_space: _ColorSpace = "lin_rec709",
        gamut: Literal["desaturate", "clip", "keep"] = "desaturate",
        polarising_filter: PolarisingFilter | None = None,
        tolerance: float | None = None,
        progress: _Progress | None = None,
    ) -> Probe:
        """An image of the light from all directions.

        Parameters
        ----------
        width
            Even, 64 to 16384; the height follows. [pixels]
        projection
            "latlong", or "fisheye" with the zenith in the centre.
        rows
            "centre" (Blender and most viewers), or "corner" for Mitsuba: first and last row on the poles.
        extent
            The "full" sphere or the "upper" half.
        ground
            What is seen below the horizon: "on", "off" (black) or "mirrored".
        sun_disc
            Whether the Sun's disc is drawn, with its exact energy at every width.
        scale
            What 1.0 means: "blender" (luminance / 683), "mitsuba" (mean W m-2 sr-1 nm-1) or "luminance" (cd m-2).
        color_space
            "lin_rec709", "acescg", "lin_rec2020" or "xyz"; always linear.
        gamut
            What happens to a colour outside the space: "desaturate" towards the grey of its luminance, "clip" negative values, or
            "keep" them.
        polarising_filter
            What is held before the sky.
        tolerance
            Relative error that interpolated directions may have, 0.0001 to 0.5: light is gathered in as many directions as that needs. None: in as
            many as the quality says.
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def render_to_file(
        self,
        path: str | os.PathLike[str],
        *,
        width: int = 2048,
        projection: Literal["latlong", "fisheye"] = "latlong",
        rows: Literal["centre", "corner"] = "centre",
        extent: Literal["full", "upper"] = "full",
        ground: Literal["on", "off", "mirrored"] = "on",
        sun_disc: bool = True,
        scale: _Scale = "blender",
        color_space: _ColorSpace = "lin_rec709",
        gamut: Literal["desaturate", "clip", "keep"] = "desaturate",
        polarising_filter: PolarisingFilter | None = None,
        tolerance: float | None = None,
        half: bool | Literal["off", "refuse", "scale"] | None = None,
        exposure_stops: float = 0.0,
        progress: _Progress | None = None,
    ) -> None:
        """Render straight into a file, which appears whole or not at all: the same picture as ``render(...).save(path)``, without ever being in memory
        as a whole (but for a PNG).

        Parameters
        ----------
        path
            Its suffix says the format: .exr (float), .hdr (Radiance RGBE) or .png (tone mapped, to look at).
        width, projection, rows, extent, ground, sun_disc, scale, color_space, gamut, polarising_filter, tolerance
            As for ``render``.
        half, exposure_stops
            As for ``Probe.save``.
        progress
            Called with stage and fraction; returning False raises Cancelled, and no file is left behind.
        """

    def sample_map(
        self,
        *,
        width: int = 1024,
        polarising_filter: PolarisingFilter | None = None,
        tolerance: float | None = None,
        progress: _Progress | None = None,
    ) -> NDArray[numpy.uint8]:
        """A picture of the directions in which the light of a probe is gathered, to look at: latitude-longitude, 8-bit sRGB, shape (H, W, 3), white points
        on the darkened sky. They lie on one side of the Sun, as the other follows by symmetry.

        Parameters
        ----------
        width
            Even, 64 to 16384. [pixels]
        polarising_filter, tolerance
            As for ``render``.
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

@final
class Probe:
    """A rendered image of the light from all directions."""

    @property
    def pixels(self) -> NDArray[numpy.float32]:
        """The pixels, linear, shape (H, W, 3): always the same array, not a copy. What is written to it is what ``save`` saves."""

    @property
    def width(self) -> int:
        """Width. [pixels]"""

    @property
    def height(self) -> int:
        """Height. [pixels]"""

    @property
    def projection(self) -> str:
        """As asked for in ``Sky.render``."""

    @property
    def rows(self) -> str:
        """As asked for in ``Sky.render``."""

    @property
    def extent(self) -> str:
        """As asked for in ``Sky.render``."""

    @property
    def ground(self) -> str:
        """As asked for in ``Sky.render``."""

    @property
    def sun_disc(self) -> bool:
        """As asked for in ``Sky.render``."""

    @property
    def scale(self) -> str:
        """As asked for in ``Sky.render``."""

    @property
    def color_space(self) -> str:
        """As asked for in ``Sky.render``."""

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        half: bool | Literal["off", "refuse", "scale"] | None = None,
        exposure_stops: float = 0.0,
    ) -> None:
        """Write the probe; the file appears whole or not at all.

        Parameters
        ----------
        path
            Its suffix says the format: .exr (float), .hdr (Radiance RGBE) or .png (tone mapped, to look at).
        half
            EXR with half floats, which end at 65504. True or "refuse": a brighter pixel, such as the Sun's disc, is an InputError;
            "scale": all pixels are multiplied by a power of two, which the header states.
        exposure_stops
            Exposure of a PNG relative to the automatic one, -20 to 20. [stops]
        """

    def irradiance(self, normal: ArrayLike | None = None) -> tuple[float, float, float]:
        """Irradiance of a plane: the integral of pixels times cosine, in the probe's units times sr.

        Parameters
        ----------
        normal
            Vector (east, north, up) that the plane faces; up by default.
        """

def run_command_line(arguments: Sequence[str]) -> int:
    """Run the command line tool with `arguments`, the first being the program's name, and return its exit code."""
