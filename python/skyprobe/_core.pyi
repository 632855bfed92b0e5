"""The compiled part of skyprobe."""

import datetime
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Literal, TypeAlias, final, overload

import numpy
from numpy.typing import ArrayLike, NDArray
from typing_extensions import disjoint_base

# Made by `skyprobe schema --format python-stub`: words
_SunModel: TypeAlias = Literal["iau", "thesis"]
_Preset: TypeAlias = Literal[
    "clear",
    "pure",
    "hazy",
    "polluted",
    "urban",
    "maritime",
    "desert",
    "antarctic",
    "fog",
    "volcanic",
    "thesis",
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
_AtmosphereGround: TypeAlias = Literal["grass", "forest", "soil", "desert", "snow", "sea", "city", "asphalt"]
_PhaseFunction: TypeAlias = Literal["mie", "henyey_greenstein", "cornette_shanks"]
_StandardAtmosphere: TypeAlias = Literal[
    "us_standard_1976",
    "tropical",
    "midlatitude_summer",
    "midlatitude_winter",
    "subarctic_summer",
    "subarctic_winter",
]
_Quality: TypeAlias = Literal["draft", "standard", "high", "reference"]
_When: TypeAlias = Literal["auto", "always", "never"]
_Projection: TypeAlias = Literal["latlong", "fisheye"]
_Rows: TypeAlias = Literal["centre", "corner"]
_Extent: TypeAlias = Literal["full", "upper"]
_ProbeGround: TypeAlias = Literal["on", "off", "mirrored"]
_Scale: TypeAlias = Literal["blender", "mitsuba", "luminance"]
_ColorSpace: TypeAlias = Literal["lin_rec709", "acescg", "lin_rec2020", "xyz"]
_Gamut: TypeAlias = Literal["desaturate", "clip", "keep"]
_Model: TypeAlias = Literal["scattering", "preetham", "thesis", "thesis_single"]
_Half: TypeAlias = Literal["off", "refuse", "scale"]
_Operator: TypeAlias = Literal[
    "sky",
    "filmic",
    "aces",
    "exposure",
    "reinhard",
    "reinhard_local",
    "ashikhmin",
    "logarithmic",
    "linear",
]
# Until here.
_PhaseName: TypeAlias = Literal["new", "first quarter", "full", "last quarter"]
_CoordinateStyle: TypeAlias = Literal["decimal", "minutes", "seconds"]
_Progress: TypeAlias = Callable[[str, float], bool | None]

__all__ = [
    "Adaptation",
    "Atmosphere",
    "Body",
    "Cancelled",
    "CivilTime",
    "Component",
    "DataError",
    "GlareReport",
    "Illuminance",
    "InputError",
    "Irradiance",
    "Location",
    "LunarEclipse",
    "Metering",
    "Moon",
    "NearestPlace",
    "Night",
    "Phase",
    "Place",
    "PolarisingFilter",
    "Probe",
    "RiseAndSet",
    "ScaleWarning",
    "Scene",
    "Sky",
    "SolarEclipse",
    "SunEvents",
    "SunlightOnlyWarning",
    "TimeFields",
    "TimeWarning",
    "ToneReport",
    "UnsolvedError",
    "__version__",
    "auto_exposure",
    "check_files",
    "civil_time",
    "elevation_m",
    "format_coordinates",
    "glare",
    "locate_place",
    "nearest_place",
    "parse_coordinates",
    "parse_time",
    "point_spread_function",
    "run_command_line",
    "search_places",
    "suggest_places",
    "tone_map",
    "zone_of_place",
]

__version__: str

class InputError(ValueError):
    """A value that cannot be used. The message names the parameter, the value given and the allowed range; nothing was computed."""

class DataError(RuntimeError):
    """A table or file whose content cannot be used."""

class UnsolvedError(RuntimeError):
    """The light of this air cannot be found, or not well enough. The message says what is too thick and what would help; nothing was returned."""

class Cancelled(Exception):
    """The progress callback returned False; nothing was left behind."""

class ScaleWarning(UserWarning):
    """The luminance that a picture's numbers stand for was not said, and had to be assumed: glare and tone mapping depend on it."""

class SunlightOnlyWarning(UserWarning):
    """A result lacks the light of a night that may outshine it: a spectrum of a sky without place and time whose Sun is below -18 degrees; at night what the air along a line of sight scatters."""

class TimeWarning(UserWarning):
    """Something had to be assumed about a time: its clocks show it never or twice, it is a date alone, or it has a second 60. The message says which instant is taken."""

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
    # Made by `skyprobe schema --format python-stub`: Atmosphere
    """The state of the air. It is solved on first use, once, and can be shared by any number of skies and threads.

    What is left out comes from the preset. At most one of ``aod550``, ``turbidity`` and ``visibility_km`` is given.

    Parameters
    ----------
    preset
        Where to start from. "clear", "pure", "hazy", "polluted", "urban", "maritime", "desert", "antarctic", "fog",
        "volcanic" or "thesis". A preset fills in what is left out: the kind and amount of aerosol, the ground, ozone
        and temperature.
    aerosol
        Kind of aerosol. "none", "continental_clean", "continental_average", "continental_polluted", "urban",
        "maritime_clean", "maritime_polluted", "maritime_tropical", "desert", "arctic", "antarctic", "fog" or "thesis";
        by default the preset's.
    aod550
        Amount of aerosol as its vertical optical depth at 550 nm. 0 to 50; by default the preset's. Clear is 0.1, murky
        0.5, fog 2 and more.
    turbidity
        Amount of aerosol as turbidity: the optical depth of aerosol and molecules over that of the molecules at 550 nm.
        1 to 64; by default the preset's. Pure air is 1, clear 2, hazy 4 to 6, light fog 64.
    visibility_km
        Amount of aerosol as horizontal visibility at the ground. 0.05 to 4000; by default the preset's. At most that of
        pure air, about 340 km at the sea; the optical depth must not exceed 50. [km]
    ozone_du
        Ozone column. 0 to 1000; by default the preset's, mostly 300. It makes the twilight blue. [Dobson units]
    ground
        The ground by name, or its albedo. "grass", "forest", "soil", "desert", "snow", "sea", "city" or "asphalt", or a
        number from 0 to 1; by default the preset's.
    stratospheric_aod550
        Optical depth at 550 nm of volcanic haze in the stratosphere. 0 to 1; by default the preset's, mostly 0.
        Droplets of sulphuric acid, as after a great eruption; they come on top of the aerosol near the ground.
    stratospheric_altitude_km
        Altitude of the middle of the volcanic haze. 12 to 40; by default 20. [km]
    relative_humidity
        Relative humidity, with which the particles grow. 0 to 99; by default 80. Amounts are those of the grown
        particles. [%]
    phase_function
        How the aerosol scatters. "mie", "henyey_greenstein" or "cornette_shanks"; by default mie; henyey_greenstein if
        an asymmetry is given or the aerosol is not made of particles.
    angstrom_exponent
        Spectral slope of the aerosol's extinction, which becomes (wavelength / 550 nm)^-exponent. -1 to 4; by default
        the aerosol's own spectrum.
    single_scattering_albedo
        Share of the aerosol's extinction that is scattering, at all wavelengths. 0 to 1; by default the aerosol's own
        spectrum.
    asymmetry
        Asymmetry parameter: how much the aerosol scatters forward, by the function of Henyey and Greenstein. -0.99 to
        0.99; by default the aerosol's.
    aerosol_scale_height_km
        Height in which the aerosol thins out to 1/e, or depth of a layer of fog. 0.1 to 20; by default the aerosol's.
        [km]
    standard_atmosphere
        Profile of temperature and density, and shape of the ozone profile. "us_standard_1976", "tropical",
        "midlatitude_summer", "midlatitude_winter", "subarctic_summer" or "subarctic_winter"; by default the preset's.
    surface_pressure_hpa
        Pressure at the ground, which scales the molecules at all altitudes. 100 to 1100; by default that of the
        standard atmosphere. [hPa]
    quality
        How finely the light is solved. "draft", "standard", "high" or "reference".
    polarisation
        Solve light with its polarisation. As a scalar it is wrong by several per cent: only to compare with scalar
        codes.
    wavelengths_nm
        Wavelengths at which light is solved instead of those of the quality. Ascending, 300 to 1000, shape (W,). A
        probe and an illuminance need at least four, from 450 or less to 650 or more. [nm]
    cache
        Whether light that was solved earlier is used again, and what is solved is kept, on this machine (see
        ``SKYPROBE_CACHE_DIR``; drafts are not kept).
    """

    def __new__(
        cls,
        *,
        preset: _Preset = "clear",
        aerosol: _Aerosol | None = None,
        aod550: float | None = None,
        turbidity: float | None = None,
        visibility_km: float | None = None,
        ozone_du: float | None = None,
        ground: _AtmosphereGround | float | None = None,
        stratospheric_aod550: float | None = None,
        stratospheric_altitude_km: float | None = None,
        relative_humidity: float | None = None,
        phase_function: _PhaseFunction | None = None,
        angstrom_exponent: float | None = None,
        single_scattering_albedo: float | None = None,
        asymmetry: float | None = None,
        aerosol_scale_height_km: float | None = None,
        standard_atmosphere: _StandardAtmosphere | None = None,
        surface_pressure_hpa: float | None = None,
        quality: _Quality = "standard",
        polarisation: bool = True,
        wavelengths_nm: ArrayLike | None = None,
        cache: bool = True,
    ) -> Atmosphere: ...
    # Until here.
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

    def __copy__(self) -> Atmosphere:
        """The air itself, which cannot be changed, with its solved light."""

    def __deepcopy__(self, _memo: object, /) -> Atmosphere:
        """The air itself, which cannot be changed, with its solved light."""

@disjoint_base
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
        """Angle at the body between Sun and observer, 0 (full) to 180 (new), of bodies that shine by sunlight. [degrees]"""

    @property
    def illuminated_fraction(self) -> float | None:
        """Fraction of the disc that is lit, 0 to 1, of bodies that shine by sunlight."""

    @property
    def direction(self) -> tuple[float, float, float]:
        """Unit vector (east, north, up) to the airless position."""

    @property
    def apparent_direction(self) -> tuple[float, float, float]:
        """Unit vector (east, north, up) to the refracted position."""

@final
class Moon(Body):
    """The Moon as it stands in the sky: a body of which more is known. Its magnitude is that outside the Earth's shadow."""

    @property
    def distance_km(self) -> float:
        """Distance from the observer to the Moon's centre. [km]"""

    @property
    def elongation_deg(self) -> float:
        """Angle between Moon and Sun in the sky. [degrees]"""

    @property
    def sub_observer_deg(self) -> tuple[float, float]:
        """Longitude (positive towards Mare Crisium) and latitude of the point of the Moon that has the observer in its zenith: the topocentric libration.
        [degrees]
        """

    @property
    def sub_solar_deg(self) -> tuple[float, float]:
        """Longitude and latitude of the point of the Moon that has the Sun in its zenith. [degrees]"""

    @property
    def bright_limb_position_angle_deg(self) -> float:
        """Position angle of the middle of the bright limb, from celestial north through east. [degrees]"""

    @property
    def bright_limb_from_zenith_deg(self) -> float:
        """The same from the zenith, counterclockwise as one sees it: 0 is lit from above, 90 from the left. [degrees]"""

    @property
    def axis_position_angle_deg(self) -> float:
        """Position angle of the Moon's north pole, from celestial north through east. [degrees]"""

    @property
    def axis_from_zenith_deg(self) -> float:
        """The same from the zenith, counterclockwise as one sees it. [degrees]"""

@final
class RiseAndSet:
    """When a body rises, stands highest and sets on the local date of a sky, in its zone. What does not happen on that date is None.

    The horizon is level, with 34 arcminutes of refraction; Sun and Moon count with their upper limb.
    """

    @property
    def rise(self) -> datetime.datetime | None:
        """It appears above the horizon."""

    @property
    def transit(self) -> datetime.datetime | None:
        """It passes the meridian above the pole."""

    @property
    def transit_altitude_deg(self) -> float | None:
        """Its airless altitude then. [degrees]"""

    @property
    def set(self) -> datetime.datetime | None:
        """It disappears below the horizon."""

    @property
    def up_at_midnight(self) -> bool:
        """It is above the horizon when the date begins: with neither rise nor set, all day."""

@final
class SolarEclipse:
    """The Moon before the Sun, as seen from the place of a sky at its time, airless, whether the Sun is above the horizon or not."""

    @property
    def kind(self) -> Literal["partial", "annular", "total"]:
        """"partial", "annular" or "total", here and now."""

    @property
    def magnitude(self) -> float:
        """Covered part of the Sun's diameter; while it is total or annular, the Moon's diameter over the Sun's."""

    @property
    def obscuration(self) -> float:
        """Covered part of the Sun's area, 0 to 1."""

    @property
    def visible_fraction(self) -> float:
        """Part of the Sun's light at 550 nm that is left, 0 to 1: other than 1 - obscuration, because the limb is darker than the middle."""

    @property
    def separation_deg(self) -> float:
        """Angle between the centres of Sun and Moon. [degrees]"""

    @property
    def moon_position_angle_deg(self) -> float:
        """Position angle of the Moon's centre seen from the Sun's, from celestial north through east. [degrees]"""

    @property
    def moon_from_zenith_deg(self) -> float:
        """The same from the zenith, counterclockwise as one sees it. [degrees]"""

@final
class LunarEclipse:
    """The Moon in the Earth's shadow, the same for all places, whether the Moon is above the horizon or not. Angles are seen from the Earth's centre."""

    @property
    def kind(self) -> Literal["penumbral", "partial", "total"]:
        """"penumbral", "partial" or "total", now."""

    @property
    def umbral_magnitude(self) -> float:
        """Part of the Moon's diameter that is in the umbra: below 0 outside, 1 and more in totality."""

    @property
    def penumbral_magnitude(self) -> float:
        """Part of the Moon's diameter that is in the penumbra."""

    @property
    def umbra_radius_deg(self) -> float:
        """Angular radius of the umbra at the Moon's distance. [degrees]"""

    @property
    def penumbra_radius_deg(self) -> float:
        """Angular radius of the penumbra at the Moon's distance. [degrees]"""

    @property
    def moon_axis_angle_deg(self) -> float:
        """Angle between the Moon's centre and the axis of the shadow. [degrees]"""

    @property
    def axis_from_zenith_deg(self) -> float:
        """Direction of the shadow's axis from the Moon's centre, from the zenith of the place counterclockwise as one sees it. [degrees]"""

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
        """Of the Sun's disc, at a total eclipse of its corona, on a plane that faces it. [W m-2 nm-1]"""

    @property
    def direct_horizontal(self) -> NDArray[numpy.float64]:
        """Of the same, on the horizontal plane. [W m-2 nm-1]"""

    @property
    def moon_normal(self) -> NDArray[numpy.float64]:
        """Of the Moon's disc, on a plane that faces it. [W m-2 nm-1]"""

    @property
    def moon_horizontal(self) -> NDArray[numpy.float64]:
        """Of the Moon's disc, on the horizontal plane. [W m-2 nm-1]"""

    @property
    def diffuse_horizontal(self) -> NDArray[numpy.float64]:
        """Of the sky with all that shines in it but the discs of Sun and Moon, on the horizontal plane. [W m-2 nm-1]"""

    @property
    def global_horizontal(self) -> NDArray[numpy.float64]:
        """Of discs and sky, on the horizontal plane. [W m-2 nm-1]"""

@final
class Illuminance:
    """Illuminance, CIE 1931 observer. [lx]"""

    @property
    def direct_normal_lx(self) -> float:
        """Of the Sun's disc, at a total eclipse of its corona, on a plane that faces it. [lx]"""

    @property
    def direct_horizontal_lx(self) -> float:
        """Of the same, on the horizontal plane. [lx]"""

    @property
    def moon_normal_lx(self) -> float:
        """Of the Moon's disc, on a plane that faces it. [lx]"""

    @property
    def moon_horizontal_lx(self) -> float:
        """Of the Moon's disc, on the horizontal plane. [lx]"""

    @property
    def diffuse_horizontal_lx(self) -> float:
        """Of the sky with all that shines in it but the discs of Sun and Moon, on the horizontal plane. [lx]"""

    @property
    def global_horizontal_lx(self) -> float:
        """Of discs and sky, on the horizontal plane. [lx]"""

@final
class PolarisingFilter:
    # Made by `skyprobe schema --format python-stub`: PolarisingFilter
    """A polarising filter between the sky and the picture: what is seen is I + strength (Q cos 2c + U sin 2c), where c is
    the angle of its axis from the vertical. The half of the light that any filter takes is made up for by the exposure.

    Parameters
    ----------
    strength
        See the sky through a polarising filter of this strength: 1 is ideal. 0 to 1. Exposed so that unpolarised light
        stays as it is.
    angle_deg
        Angle of the filter's axis from the vertical, clockwise as one sees it. -180 to 180. [degrees]
    held_towards_deg
        Altitude and azimuth towards which the filter is held, one piece of glass for the whole picture. Altitude -90 to
        90, azimuth -360 to 360; by default it turns with the view. The closer one looks along its axis, the less it
        does. [degrees]
    """

    def __new__(
        cls,
        *,
        strength: float = 1.0,
        angle_deg: float = 0.0,
        held_towards_deg: tuple[float, float] | None = None,
    ) -> PolarisingFilter: ...

    @property
    def strength(self) -> float:
        """See the sky through a polarising filter of this strength: 1 is ideal."""

    @property
    def angle_deg(self) -> float:
        """Angle of the filter's axis from the vertical, clockwise as one sees it. [degrees]"""

    @property
    def held_towards_deg(self) -> tuple[float, float] | None:
        """Altitude and azimuth towards which the filter is held, one piece of glass for the whole picture; None: it turns with the view. [degrees]"""
    # Until here.

@final
class Night:
    # Made by `skyprobe schema --format python-stub`: Night
    """What of the night is in a sky with place and time, and how bright what varies is.

    At most one of ``zenith_brightness`` and ``bortle`` is given.

    Parameters
    ----------
    when
        When Moon, stars and the other lights of the night are in the sky. "auto", "always" or "never". auto: Moon and
        planets always, all else while the Sun's centre is below the horizon or the Sun totally eclipsed; by day it is
        less than a thousandth of the light. A Sun that is put has no night.
    star_limit
        Stars to this magnitude are drawn one by one. -2 to 8.5. The light of fainter ones is part of the Milky Way. [V]
    solar_flux_sfu
        Solar radio flux at 10.7 cm, on which the airglow depends. 60 to 300. 70 at the Sun's minimum, 130 on average,
        200 at its maximum. [solar flux units]
    zenith_brightness
        Brightness of the moonless zenith over a lit country, natural light (22.0) included. 15 to 22; by default no
        artificial light. [mag arcsec-2]
    bortle
        The same as a class of light pollution on Bortle's scale: 1 is as dark as it gets, 9 an inner city. 1 to 9; by
        default no artificial light.
    led_share
        Share of the artificial light that comes from white LEDs; the rest is that of sodium lamps. 0 to 1.
    """

    def __new__(
        cls,
        *,
        when: _When = "auto",
        star_limit: float = 8.5,
        solar_flux_sfu: float = 130.0,
        zenith_brightness: float | None = None,
        bortle: int | None = None,
        led_share: float = 0.5,
    ) -> Night: ...

    @property
    def when(self) -> _When:
        """When Moon, stars and the other lights of the night are in the sky."""

    @property
    def star_limit(self) -> float:
        """Stars to this magnitude are drawn one by one. [V]"""

    @property
    def solar_flux_sfu(self) -> float:
        """Solar radio flux at 10.7 cm, on which the airglow depends. [solar flux units]"""

    @property
    def zenith_brightness(self) -> float | None:
        """Brightness of the moonless zenith over a lit country, natural light (22.0) included; None: no artificial light. [mag arcsec-2]"""

    @property
    def bortle(self) -> int | None:
        """The same as a class of light pollution on Bortle's scale: 1 is as dark as it gets, 9 an inner city; None: no artificial light."""

    @property
    def led_share(self) -> float:
        """Share of the artificial light that comes from white LEDs; the rest is that of sodium lamps."""
    # Until here.

@final
class Scene:
    """All that a probe is made from: place and time or a Sun that is put, air, night, picture and files. It reads and writes the configurations of the command line, and what
    the headers of pictures hold.

    Keys are those of a configuration (``skyprobe schema``); tables such as ``atmosphere`` are dictionaries. What is left out has its default; unknown keys, values
    out of range, what contradicts itself and what would be ignored, such as ``bortle`` under a Sun that is put, are an :class:`InputError`.

    >>> scene = sp.Scene(place="Lund, Sweden", time="2005-06-21T13:00", atmosphere={"turbidity": 3}, probe={"width": 512})
    >>> probe = scene.render()

    Scenes are equal if all of their values are; they pickle and copy.
    """

    def __new__(cls, **keys: object) -> Scene: ...
    @classmethod
    def without_ignored(cls, **keys: object) -> Scene:
        """The scene of these keys without what would be ignored: for hosts that keep settings which are out of force."""

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """The scene of a file: JSON, or a picture of skyprobe (.exr, .hdr), whose header holds what it was made from."""

    @classmethod
    def from_json(cls, text: str) -> Scene:
        """The scene of a JSON text."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene as JSON, every value written out; the file appears whole or not at all."""

    def to_json(self) -> str:
        """The scene as JSON, every value written out."""

    def to_dict(self) -> dict[str, object]:
        """The scene as a dictionary, every value written out."""

    def replace(self, **keys: object) -> Scene:
        """The same scene with other values. A table that is given as a dictionary changes the keys that it has; None takes a value away. What the others put out of force
        is left out: the place of a Sun that is put, one of three amounts of haze, the rest of a night that is never shown.

        >>> evening = scene.replace(time="2005-06-21T21:30", probe={"width": 1024})
        """

    def atmosphere(self, *, cache: bool = True) -> Atmosphere:
        """The air of the scene, not solved yet. One air serves all scenes that differ in place, time, night and picture only.

        Parameters
        ----------
        cache
            As for ``Atmosphere``.
        """

    def sky(self, atmosphere: Atmosphere | None = None) -> Sky:
        """The sky of the scene.

        Parameters
        ----------
        atmosphere
            The air, if it is there already; None for that of the scene.
        """

    def render(
        self, atmosphere: Atmosphere | None = None, *, progress: _Progress | None = None
    ) -> Probe:
        """Render the picture of the scene.

        Parameters
        ----------
        atmosphere
            As for ``sky``.
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def render_to_files(
        self,
        paths: Sequence[str | os.PathLike[str]] | None = None,
        atmosphere: Atmosphere | None = None,
        *,
        progress: _Progress | None = None,
    ) -> None:
        """Render the picture of the scene into files, which appear together or not at all.

        Parameters
        ----------
        paths
            Names of files that end in .exr, .hdr or .png; None for those of the scene's ``output``.
        atmosphere
            As for ``sky``.
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def __copy__(self) -> Scene:
        """The scene itself, which cannot be changed."""

    def __deepcopy__(self, _memo: object, /) -> Scene:
        """The scene itself, which cannot be changed."""

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
        ISO 8601 text, an aware ``datetime``, or a ``date``, which is its noon. A text without offset is local time in ``zone``; it may be a date alone
        or "now". What has to be assumed (clocks show it never or twice, noon) is a :class:`TimeWarning`, and ``time_notice``.
    atmosphere
        The air; None for ``Atmosphere()``, the clear one, which is solved once in a process.
    elevation_m
        Height of the observer above the sea, -500 to 60000. [m]
    zone
        IANA time zone, such as "Europe/Stockholm"; by default the zone of the place, found offline.
    sun_model
        By which theory Sun and Moon stand where they do: "iau" (IAU, ELP/MPP02), or "thesis" (low precision, the Moon without parallax: eclipses are a
        degree off).
    model
        By which model the sky is rendered: "scattering" (solved light: day, twilight, night) "preetham" (the analytic sky of 1999, by day at
        turbidities from 2 to 10), "thesis" or "thesis_single" (ray marching with random steps, light scattered at most twice or once:
        noisy, for small images). Spectra, irradiance and illuminance are those of "scattering", and the others know no night.
    night
        What of the night is in the sky; None for ``Night()``.
    """

    def __new__(
        cls,
        *,
        latitude: float,
        longitude: float,
        time: str | datetime.datetime | datetime.date,
        atmosphere: Atmosphere | None = None,
        elevation_m: float = 0.0,
        zone: str | None = None,
        sun_model: _SunModel = "iau",
        model: _Model = "scattering",
        night: Night | None = None,
    ) -> Sky: ...
    @staticmethod
    def with_sun(
        *,
        altitude_deg: float,
        azimuth_deg: float,
        atmosphere: Atmosphere | None = None,
        elevation_m: float = 0.0,
        model: _Model = "scattering",
    ) -> Sky:
        """The sky under a Sun that is put, without place and time, and so without Moon, stars and the other lights of the night.

        Parameters
        ----------
        altitude_deg
            Airless, -90 to 90. [degrees]
        azimuth_deg
            From north through east. [degrees]
        atmosphere
            The air; None for ``Atmosphere()``, the clear one, which is solved once in a process.
        elevation_m
            Height of the observer above the sea, -500 to 60000. [m]
        model
            As for ``Sky``.
        """

    @property
    def scene(self) -> Scene | None:
        """The scene that makes this sky again, with the picture that ``render`` makes by default; None if its air was given as a profile."""

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
    def time_notice(self) -> str | None:
        """What had to be assumed about the time, in a sentence: that clocks show it never or twice and which instant is taken, that a date alone is its
        noon, that a second 60 is the one before; None for a time that says all."""

    @property
    def zone(self) -> str | None:
        """IANA zone of the time; None for a fixed offset."""

    @property
    def atmosphere(self) -> Atmosphere:
        """The air."""

    @property
    def sun(self) -> Body:
        """The Sun."""

    @property
    def moon(self) -> Moon | None:
        """The Moon; None for a sky without place and time."""

    @property
    def night(self) -> Night | None:
        """What of the night is in this sky; None for a sky without place and time."""

    @property
    def layer_names(self) -> list[str]:
        """Names of the layers that the light of this sky is made of, of "sky" (light scattered by the air, and the ground), "sun", "moon", "stars",
        "planets", "milky_way", "zodiacal", "airglow" and "light_pollution". They are the keys of ``layers`` in ``render``.
        """

    def bodies(self) -> list[Body]:
        """Sun, Moon and planets from Mercury to Neptune, above and below the horizon, the Moon as a ``Moon``; of a Sun that is put, that Sun alone."""

    def sun_events(self) -> SunEvents:
        """Sunrise, sunset, twilights and noon on the local date of this sky's time."""

    def positions(self, name: str, times: ArrayLike) -> NDArray[numpy.float64]:
        """Where a body stands at other times, from the same place through the same air, shape (N, 3): airless altitude, azimuth from north through
        east, apparent altitude. [degrees]

        Parameters
        ----------
        name
            Name of one of ``bodies()``, such as "Sun" or "Moon", in any case.
        times
            Seconds since 1970 as ``datetime.timestamp()`` gives them, within the years 1000 to 3000, shape (N,). [s]

        Each time costs some 0.2 ms on one core; the Sun of a sky with ``sun_model="thesis"`` (within 0.02 degrees) under a microsecond.
        """

    def rise_and_set(self, name: str) -> RiseAndSet:
        """When a body rises, stands highest and sets on the local date of this sky's time.

        Parameters
        ----------
        name
            Name of one of ``bodies()``, such as "Moon" or "Venus", in any case.
        """

    def moon_phases(self) -> list[tuple[_PhaseName, datetime.datetime]]:
        """The next four phases of the Moon after this sky's time, in the order of their dates: name ("new", "first quarter", "full", "last quarter") and
        when, the same for all places.
        """

    @property
    def solar_eclipse(self) -> SolarEclipse | None:
        """How the Moon stands before the Sun; None if it does not."""

    @property
    def lunar_eclipse(self) -> LunarEclipse | None:
        """How the Moon stands in the Earth's shadow; None if no part of it does."""

    def spectral_radiance(
        self, directions: ArrayLike, wavelengths_nm: ArrayLike, *, progress: _Progress | None = None
    ) -> NDArray[numpy.float64]:
        """Spectral radiance of sky and ground, shape (N, W). [W m-2 sr-1 nm-1]

        It is that of the pictures of this sky, night and all: light of the Sun and of the Moon in the air, zodiacal light, Milky Way, airglow, light of towns.
        Discs (Sun, Moon) and points (stars, planets) have no radiance in a direction and are left out; ``irradiance`` has them. Lights are means over 10 nm.

        A sky without place and time has the light of its Sun alone; with the Sun below -18 degrees a ``SunlightOnlyWarning`` says so, unless the sky's night is
        ``Night(when="never")``.

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
        """Stokes parameters I, Q, U of sky and ground, shape (N, W, 3). [W m-2 sr-1 nm-1]

        Q > 0 is polarised vertically, in the plane of the direction and the zenith; U > 0 along the line 45 degrees clockwise from the vertical
        as one sees it. The degree of linear polarisation is hypot(Q, U) / I, and the angle of the vibration from the vertical, clockwise,
        arctan2(U, Q) / 2. Circular polarisation is neglected.

        The light is that of ``spectral_radiance``, which is I. The air polarises moonlight as it does sunlight; zodiacal light, Milky Way, airglow and light of towns are
        taken as unpolarised.

        A sky without place and time has the light of its Sun alone; with the Sun below -18 degrees a ``SunlightOnlyWarning`` says so, unless the sky's night is
        ``Night(when="never")``.

        Parameters
        ----------
        directions
            Unit vectors (east, north, up) that one looks along, shape (N, 3).
        wavelengths_nm
            Shape (W,), within the atmosphere's wavelengths. [nm]
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def segment(
        self, directions: ArrayLike, distances_m: ArrayLike, wavelengths_nm: ArrayLike, *, progress: _Progress | None = None
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
        """Light of parts of the lines of sight: the transmittance from the observer to distances, and the radiance that the air before them scatters to the
        observer, two arrays of shape (N, D, W). [1, W m-2 sr-1 nm-1]

        A surface of radiance L at a distance is seen as L times the transmittance plus the radiance: this is aerial perspective. A line of sight ends on the ground or in space, and
        distances beyond find what its end has; the light of the ground is not in it. The transmittance is that of light that is neither scattered nor absorbed: what haze turns into the line of sight from beside it is in the radiance, with the clear sky's light around the line.

        The radiance is light of the Sun and, at night, of the Moon. Where the air scatters other light, at night and in a total eclipse, a ``SunlightOnlyWarning`` says so, unless the sky's night is
        ``Night(when="never")``; in a sky without place and time, if the Sun is below -18 degrees.

        Parameters
        ----------
        directions
            Unit vectors (east, north, up) that one looks along, shape (N, 3).
        distances_m
            From the observer along the line of sight, 0 to infinity, in any order, shape (D,) or a number. [m]
        wavelengths_nm
            Shape (W,), within the atmosphere's wavelengths. [nm]
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def irradiance(self, wavelengths_nm: ArrayLike, *, progress: _Progress | None = None) -> Irradiance:
        """Spectral irradiance of Sun, Moon and sky, with all that shines in it. [W m-2 nm-1]

        Stars and planets are part of the sky at night; by day planets, a billionth of the light, are left out.

        A sky without place and time has the light of its Sun alone; with the Sun below -18 degrees a ``SunlightOnlyWarning`` says so, unless the sky's night is
        ``Night(when="never")``.

        Parameters
        ----------
        wavelengths_nm
            Shape (W,), within the atmosphere's wavelengths. [nm]
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """

    def illuminance(self, *, progress: _Progress | None = None) -> Illuminance:
        """Illuminance of Sun, Moon and sky, with all that shines in it. [lx]"""

    def sun_irradiance_rgb(
        self,
        *,
        scale: _Scale = "blender",
        color_space: _ColorSpace = "lin_rec709",
        gamut: _Gamut = "desaturate",
        progress: _Progress | None = None,
    ) -> tuple[float, float, float]:
        """Irradiance of the Sun's disc, at a total eclipse of its corona, on a plane that faces it, in the units of a probe with this scale and colour space times sr.

        ``gamut`` says what happens to a colour outside the space, as in ``render``: a Sun below some 2.5 degrees (clear air; higher in haze) is redder than Rec. 709. A lamp with this colour belongs where the disc is
        seen, at ``sun.apparent_altitude_deg``.
        """

    def moon_irradiance_rgb(
        self,
        *,
        scale: _Scale = "blender",
        color_space: _ColorSpace = "lin_rec709",
        gamut: _Gamut = "desaturate",
        progress: _Progress | None = None,
    ) -> tuple[float, float, float]:
        """Irradiance of the Moon's disc on a plane that faces it, as ``sun_irradiance_rgb``; zeros if the Moon is below the horizon or the night is never
        shown.
        """

    # Made by `skyprobe schema --format python-stub`: Sky.render
    def render(
        self,
        *,
        width: int = 2048,
        projection: _Projection = "latlong",
        rows: _Rows = "centre",
        extent: _Extent = "full",
        turn_deg: float = 0.0,
        ground: _ProbeGround = "on",
        sun_disc: bool = True,
        moon_disc: bool = True,
        scale: _Scale = "blender",
        color_space: _ColorSpace = "lin_rec709",
        gamut: _Gamut = "desaturate",
        polarising_filter: PolarisingFilter | None = None,
        tolerance: float | None = None,
        layers: Mapping[str, float] | None = None,
        progress: _Progress | None = None,
    ) -> Probe:
        """An image of the light from all directions.

        Parameters
        ----------
        width
            Width of the picture, an even number. 64 to 16384. The height follows: half of it for a full latitude-longitude
            picture, a quarter for its upper half, the same for a fisheye. [pixels]
        projection
            How directions are laid out. "latlong" or "fisheye". A fisheye has the zenith in its centre.
        rows
            Where the rows of a latitude-longitude picture lie. "centre" or "corner". centre is for Blender and most
            viewers, corner for Mitsuba: first and last row on the poles.
        extent
            The full sphere, or its upper half. "full" or "upper".
        turn_deg
            How far the sky in the picture is turned clockwise as seen from above, to the right. -360 to 360. In a
            latitude-longitude picture by turn / 360 of its width. [degrees]
        ground
            What is seen below the horizon: the lit ground, black, or the sky again. "on", "off" or "mirrored".
        sun_disc
            Draw the Sun's disc. With its exact energy at every width; left out to light the scene with a Sun lamp.
        moon_disc
            Draw the Moon's disc; planets and stars always are. Left out to light the scene with a lamp for it.
        scale
            What the number 1.0 in a pixel stands for. "blender", "mitsuba" or "luminance". blender: luminance / 683;
            mitsuba: mean W m-2 sr-1 nm-1; luminance: cd m-2.
        color_space
            Colour space of the pixels, always linear. "lin_rec709", "acescg", "lin_rec2020" or "xyz".
        gamut
            What becomes of colours outside that space. "desaturate", "clip" or "keep". desaturate: towards the grey of
            their luminance. clip: negative numbers become 0. keep: they stay negative.
        polarising_filter
            What is held before the sky.
        tolerance
            Relative error that interpolated directions may have. 0.0001 to 0.5; by default as many directions as the
            quality says.
        layers
            Factors on the light of layers, 0 to leave one out, as in stars=2. 0 to 1000000000 for each, such as
            ``{"moon": 0.0, "stars": 10.0}``; see ``layer_names``.
        progress
            Called with stage and fraction; returning False raises Cancelled.
        """
    # Until here.

    # Made by `skyprobe schema --format python-stub`: Sky.render_to_file
    def render_to_file(
        self,
        path: str | os.PathLike[str],
        *,
        width: int = 2048,
        projection: _Projection = "latlong",
        rows: _Rows = "centre",
        extent: _Extent = "full",
        turn_deg: float = 0.0,
        ground: _ProbeGround = "on",
        sun_disc: bool = True,
        moon_disc: bool = True,
        scale: _Scale = "blender",
        color_space: _ColorSpace = "lin_rec709",
        gamut: _Gamut = "desaturate",
        polarising_filter: PolarisingFilter | None = None,
        tolerance: float | None = None,
        layers: Mapping[str, float] | None = None,
        separate_layers: bool = False,
        half: bool | _Half | None = None,
        exposure_stops: float = 0.0,
        operator: _Operator = "sky",
        progress: _Progress | None = None,
    ) -> None:
        """Render straight into a file, which appears whole or not at all: the same picture as ``render(...).save(path)``,
        without ever being in memory as a whole (but for a PNG).

        Parameters
        ----------
        path
            Its suffix says the format: .exr (float), .hdr (Radiance RGBE) or .png (tone mapped, to look at).
        width, projection, rows, extent, turn_deg, ground, sun_disc, moon_disc, scale, color_space, gamut, polarising_filter, tolerance, layers
            As for ``render``.
        separate_layers
            Whether an EXR file holds each layer beside their sum, in channels such as ``stars.R``.
        half, exposure_stops, operator
            As for ``Probe.save``.
        progress
            Called with stage and fraction; returning False raises Cancelled, and no file is left behind.
        """
    # Until here.

    def sample_map(
        self,
        *,
        width: int = 1024,
        turn_deg: float = 0.0,
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
        turn_deg, polarising_filter, tolerance
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
    def scene(self) -> Scene | None:
        """The scene that makes this probe again; None if its air was given as a profile."""

    @property
    def height(self) -> int:
        """Height. [pixels]"""

    # Made by `skyprobe schema --format python-stub`: Probe
    @property
    def width(self) -> int:
        """Width of the picture, an even number. [pixels]"""

    @property
    def projection(self) -> _Projection:
        """How directions are laid out."""

    @property
    def rows(self) -> _Rows:
        """Where the rows of a latitude-longitude picture lie."""

    @property
    def extent(self) -> _Extent:
        """The full sphere, or its upper half."""

    @property
    def turn_deg(self) -> float:
        """How far the sky in the picture is turned clockwise as seen from above, to the right. [degrees]"""

    @property
    def ground(self) -> _ProbeGround:
        """What is seen below the horizon: the lit ground, black, or the sky again."""

    @property
    def sun_disc(self) -> bool:
        """Draw the Sun's disc."""

    @property
    def moon_disc(self) -> bool:
        """Draw the Moon's disc; planets and stars always are."""

    @property
    def scale(self) -> _Scale:
        """What the number 1.0 in a pixel stands for."""

    @property
    def color_space(self) -> _ColorSpace:
        """Colour space of the pixels, always linear."""

    @property
    def gamut(self) -> _Gamut:
        """What becomes of colours outside that space."""
    # Until here.

    # Made by `skyprobe schema --format python-stub`: Probe.save
    def save(
        self,
        path: str | os.PathLike[str],
        *,
        half: bool | _Half | None = None,
        exposure_stops: float = 0.0,
        operator: _Operator = "sky",
        progress: _Progress | None = None,
    ) -> None:
        """Write the probe; the file appears whole or not at all.

        Parameters
        ----------
        path
            Its suffix says the format: .exr (float), .hdr (Radiance RGBE) or .png (tone mapped, to look at).
        half
            EXR with half floats, which end at 65504. True or "refuse": a brighter pixel, such as the Sun's disc, is an
            InputError; "scale": all pixels are multiplied by a power of two, which the header states.
        exposure_stops
            Exposure of PNG files relative to the automatic one. -20 to 20. [stops]
        operator
            Tone mapping operator of PNG files. "sky", "filmic", "aces", "exposure", "reinhard", "reinhard_local",
            "ashikhmin", "logarithmic" or "linear". More choices: skyprobe tonemap, on an EXR or HDR file.
        progress
            Called with stage and fraction; returning False raises Cancelled, and no file is left behind.
        """
    # Until here.

    @overload
    def irradiance(self, normal: None = None) -> tuple[float, float, float]: ...
    @overload
    def irradiance(self, normal: tuple[float, float, float] | list[float]) -> tuple[float, float, float]: ...
    @overload
    def irradiance(self, normal: ArrayLike | None = None) -> tuple[float, float, float] | NDArray[numpy.float64]:
        """Irradiance of planes: the integral of pixels times cosine, in the probe's units times sr. One plane gives a tuple of three, planes of shape (N, 3) an
        array of that shape. A thousand cost some 40 times what one costs (latlong), or 4 times (fisheye).

        Parameters
        ----------
        normal
            Vector (east, north, up) that the plane faces, of any length but 0, or several of them, shape (N, 3); up by default.
        """

@final
class Place:
    """A place of the gazetteer: a town, a village, an observatory, a country, a region, an island or a landmark."""

    @property
    def name(self) -> str:
        """Its name, as GeoNames writes it: mostly that of its country's language, in Latin letters."""

    @property
    def region(self) -> str:
        """The state, province or county that it lies in; empty where none is known."""

    @property
    def country(self) -> str:
        """English name of the country."""

    @property
    def country_code(self) -> str:
        """Code of the country, two letters (ISO 3166-1)."""

    @property
    def kind(self) -> Literal["town", "observatory", "country", "region", "island", "landmark"]:
        """"town" (or a village, or a part of one), "observatory", "country", "region", "island" or "landmark"."""

    @property
    def seat(self) -> str:
        """The town whose coordinates, elevation and zone stand for a country (its capital), a region (its seat) or an island (its chief town); empty for
        others."""

    @property
    def latitude(self) -> float:
        """Geodetic latitude, positive north, to 0.001. [degrees]"""

    @property
    def longitude(self) -> float:
        """Longitude, positive east, to 0.001. [degrees]"""

    @property
    def elevation_m(self) -> float:
        """Height above the sea. [m]"""

    @property
    def population(self) -> int | None:
        """Inhabitants, to two digits; None if unknown."""

    @property
    def time_zone(self) -> str:
        """IANA time zone that GeoNames states; near borders that of :func:`zone_of_place` may differ."""

    @property
    def label(self) -> str:
        """Name, region and country, such as "Lund, Skåne, Sweden", and the town that stands for it: "Iceland (Reykjavík)"."""

@final
class NearestPlace:
    """The town or observatory nearest to coordinates, and where they are seen from it."""

    @property
    def place(self) -> Place:
        """The place."""

    @property
    def distance_km(self) -> float:
        """From the place to the coordinates, along the ground. [km]"""

    @property
    def azimuth_deg(self) -> float:
        """Direction from the place to the coordinates, from north through east. [degrees]"""

    @property
    def label(self) -> str:
        """Such as "12 km N of Lund, Skåne, Sweden"; the place alone within 2 km of it."""

@final
class Location:
    """Where a text says to be: a name that was found, or coordinates that were read."""

    @property
    def latitude(self) -> float:
        """Geodetic latitude, positive north. [degrees]"""

    @property
    def longitude(self) -> float:
        """Longitude, positive east. [degrees]"""

    @property
    def elevation_m(self) -> float:
        """Height above the sea: of the place that was named, or roughly of the land at coordinates. [m]"""

    @property
    def place(self) -> Place | None:
        """The place that was named; None for coordinates."""

    @property
    def label(self) -> str:
        """What to call it: "Lund, Skåne, Sweden", or "12 km N of Lund, Skåne, Sweden"."""

@final
class CivilTime:
    """A time as the clocks of a place show it."""

    @property
    def time(self) -> datetime.datetime:
        """The instant, aware of its offset."""

    @property
    def zone(self) -> str | None:
        """IANA name of the zone; None for a fixed offset."""

    @property
    def utc_offset_h(self) -> float:
        """Local time minus UTC. [h]"""

    @property
    def abbreviation(self) -> str:
        """What the offset is called, such as "CEST", or "+03" where it has no name."""

    @property
    def daylight_saving(self) -> bool:
        """Whether clocks are set forward for the summer."""

    @property
    def occurrence(self) -> Literal["once", "repeated", "skipped"]:
        """How often clocks show the local time that was given: "once"; "repeated" (clocks are set back: the first is taken); "skipped" (clocks are set
        forward: the time as far after the gap is taken)."""

    @property
    def notice(self) -> str | None:
        """What had to be assumed, in a sentence: that clocks show the time never or twice and which instant is taken, that a date alone is its noon, that a
        second 60 is the one before; None for a time that says all."""

@final
class TimeFields:
    """What a text says of a time, for programs that keep date, time of day, offset and zone apart."""

    @property
    def year(self) -> int:
        """Gregorian year, 1000 to 3000."""

    @property
    def month(self) -> int:
        """Month, 1 to 12."""

    @property
    def day(self) -> int:
        """Day of the month, 1 to 31."""

    @property
    def hour(self) -> int:
        """Hour, 0 to 23, in the zone that the text names, at its offset, or local where it says neither; "now" is in UTC."""

    @property
    def minute(self) -> int:
        """Minute, 0 to 59."""

    @property
    def second(self) -> float:
        """Second with its fraction, 0 to below 60."""

    @property
    def utc_offset_h(self) -> float | None:
        """Local time minus UTC, where the text says offset or zone, else None. In an hour that clocks show twice it tells which is meant. [h]"""

    @property
    def zone(self) -> str | None:
        """IANA name of the zone that the text names, else None."""

    @property
    def notice(self) -> str | None:
        """What had to be assumed, in a sentence, as ``CivilTime.notice``; without a zone in the text it is not known whether its clocks show the time."""

def search_places(text: str, limit: int = 10) -> list[Place]:
    """Places whose name, or another name, matches `text`: the best first. Up to 3 ms, 5 ms for a single letter; the first time some 0.1 s.

    Case, accents and hyphens do not count, words may be begun only, and region or country may follow, after a comma or not: "lund", "goteborg",
    "los ang", "portland, maine", "lund se". Ordered by how exactly the name is met, then by inhabitants. An empty text finds nothing.

    Parameters
    ----------
    text
        What a person has typed so far.
    limit
        How many places at most.

    More than 200 bytes, 16 words or 6 commas find nothing.
    """

def suggest_places(text: str, limit: int = 5) -> list[Place]:
    """Places whose names are spelled nearly as `text`: what may have been meant where the search finds nothing. "Stockhlom" suggests Stockholm.

    Up to two letters may be missing, wrong, too many or swapped, one in words of four letters or fewer. The nearest come first, then the largest; up to 3 ms, the first time some 15 ms more.

    Parameters
    ----------
    text
        As for ``search``; more than 40 letters suggest nothing.
    limit
        How many places at most.
    """

def nearest_place(latitude: float, longitude: float) -> NearestPlace:
    """The town or observatory nearest to coordinates.

    Parameters
    ----------
    latitude
        Geodetic latitude, -90 to 90. [degrees]
    longitude
        Longitude, -180 to 180. [degrees]
    """

def locate_place(text: str) -> Location:
    """The place that `text` means: coordinates in any spelling, or the best match of a name, which the label of the result tells.

    Raises :class:`InputError` if it is neither; the message has the nearest spellings.

    Parameters
    ----------
    text
        Such as "Lund, Sweden", "55.71, 13.19" or a link to a map.
    """

def parse_coordinates(text: str) -> tuple[float, float]:
    """Latitude and longitude [degrees] that `text` says in any of the usual spellings.

    "55.71, 13.19", "55,71 13,19", "55 42 36 N 13 11 24 E", "55°42'36\"N 13°11'24\"E", "N55 42.6 E13 11.4", "lat: 55.71, lon: 13.19",
    "geo:55.71,13.19", links to Google Maps, OpenStreetMap and others. Raises :class:`InputError` for what cannot be read, or in two ways.

    Parameters
    ----------
    text
        The coordinates; latitude first unless letters say otherwise.
    """

def format_coordinates(latitude: float, longitude: float, style: _CoordinateStyle = "decimal") -> str:
    """Coordinates as text, which :func:`parse_coordinates` reads.

    Parameters
    ----------
    latitude
        Geodetic latitude, -90 to 90. [degrees]
    longitude
        Longitude, -180 to 180. [degrees]
    style
        "decimal" (55.71, 13.19), "minutes" (55°42.600'N 13°11.400'E) or "seconds" (55°42'36"N 13°11'24"E).
    """

def elevation_m(latitude: float, longitude: float) -> float:
    """Rough height of the land above the sea [m], 0 at sea: means over 18 km, which know neither valleys nor peaks.

    Parameters
    ----------
    latitude
        Geodetic latitude, -90 to 90. [degrees]
    longitude
        Longitude, -180 to 180. [degrees]
    """

def zone_of_place(latitude: float, longitude: float) -> str:
    """IANA name of the time zone that is kept today at coordinates; at sea the nautical one.

    Parameters
    ----------
    latitude
        Geodetic latitude, -90 to 90. [degrees]
    longitude
        Longitude, -180 to 180. [degrees]
    """

def civil_time(time: str, latitude: float, longitude: float, zone: str | None = None) -> CivilTime:
    """A time as the clocks of a place show it.

    Parameters
    ----------
    time
        Date and time, ISO 8601: without offset it is local time; a date alone is its noon; "now".
    latitude
        Geodetic latitude, -90 to 90. [degrees]
    longitude
        Longitude, -180 to 180. [degrees]
    zone
        IANA time zone instead of that of the place.
    """

def check_files(inputs: Sequence[str | os.PathLike[str]], outputs: Sequence[str | os.PathLike[str]]) -> None:
    """Check, before any work, that files can be written, and that none is written over what is read or written already.

    Parameters
    ----------
    inputs
        Files that will be read.
    outputs
        Files that will be written: each must be in a folder that is there, must not be read-only, and must be neither an input nor another output,
        however they are spelt (relative, through links, in another case where the system does not tell cases apart).
    """

def parse_time(text: str) -> TimeFields:
    """Date, time of day, offset and zone that a text says, without knowing the place.

    ISO 8601 and RFC 9557 as ``Sky`` reads them: "2005-06-21T13:00:00+02:00", "2005-06-21 13:00", "2005-06-21T13+02",
    "2005-06-21T13:00[Europe/Stockholm]", "2005-06-21T11:00Z[Europe/Stockholm]" (13:00 there), "2005-06-21" (its noon), "now". Raises
    :class:`InputError` for what cannot be read.

    Parameters
    ----------
    text
        The time, at most 100 bytes.
    """

def run_command_line(arguments: Sequence[str]) -> int:
    """Run the command line tool with `arguments`, the first being the program's name, and return its exit code."""

@final
class GlareReport:
    """What ``glare`` did to a picture."""

    @property
    def state(self) -> str:
        """State of the eye: photopic, mesopic or scotopic."""

    @property
    def mean_luminance(self) -> float:
        """Geometric mean of the luminance of all pixels that have any. [cd m-2]"""

    @property
    def threshold(self) -> float | None:
        """Luminance above which light glared; None if all light did. [cd m-2]"""

    @property
    def glaring_pixels(self) -> int:
        """How many pixels had light that glared."""

    @property
    def too_bright(self) -> int:
        """How many pixels were too bright to be light (above 1e12) and kept what they had."""

    @property
    def unscattered(self) -> tuple[float, float, float]:
        """Share of the glaring light of each channel that was not scattered."""

    @property
    def repairs(self) -> tuple[int, int, int]:
        """How many values were no light and were repaired: not a number, infinite, denormal."""

def glare(
    pixels: ArrayLike,
    *,
    projection: str = "perspective",
    field_of_view_deg: float | None = None,
    rows: str = "centre",
    scale: _Scale | None = None,
    white_luminance: float | None = None,
    color_space: str = "lin_rec709",
    state: str = "auto",
    threshold: float | None = None,
    whole_pixels: bool = False,
    all_light: bool = False,
    size: float = 2.0,
    seed: int = 0,
    streaks: float = 0.6,
    progress: Callable[[str, float], bool | None] | None = None,
) -> tuple[NDArray[numpy.float32], GlareReport]:
    """Add the glare of the eye to a picture (Spencer et al. 1995): returns the new picture and what was done.

    Parameters
    ----------
    pixels
        Linear values, shape (H, W, 3), row 0 at the top. Values that are no light (not a number, infinite) are repaired, not spread.
    projection
        "perspective", "latlong" (a probe: 2:1, or 4:1 for its upper half) or "fisheye".
    field_of_view_deg
        Of a perspective picture the angle between left and right border (39.6 by default, as Blender's first camera), of a fisheye that of its width (180). [degrees]
    rows
        Of a latlong picture: "centre" or "corner".
    scale
        What the numbers are, "blender", "mitsuba" or "luminance", as ``Probe.scale`` says it. Without it and ``white_luminance`` it is "blender", with a ``ScaleWarning``.
    white_luminance
        Instead of ``scale``: luminance of a pixel of value 1, 683 in the scale "blender", 72983 in "mitsuba". [cd m-2]
    color_space
        "lin_rec709", "acescg", "lin_rec2020" or "xyz".
    state
        "photopic", "mesopic", "scotopic", or "auto" by the mean luminance: photopic above 5 cd m-2, scotopic below 0.005.
    threshold
        Light above this luminance glares; by default 20 times the mean luminance. [cd m-2]
    whole_pixels
        With a threshold: all light of the brighter pixels glares, not only what exceeds it.
    all_light
        All light glares.
    size
        Width and height of the filter in widths and heights of the picture, 0.01 to 2. A latlong picture always has all of it.
    seed
        Draws the streaks.
    streaks
        Their contrast, 0 (none) to 1 (lines on black, as in the thesis).
    progress
        ``progress(stage, fraction)``; returning False raises ``Cancelled``.
    """

def point_spread_function(state: str, angles_deg: ArrayLike, wavelengths_nm: ArrayLike) -> NDArray[numpy.float64]:
    """Share of the light of a point per solid angle, shape (angles, wavelengths). [sr-1]

    Parameters
    ----------
    state
        "photopic", "mesopic" or "scotopic".
    angles_deg
        From the source, 0 to 180. [degrees]
    wavelengths_nm
        300 to 1000. Only the lenticular halo of the mesopic and the scotopic eye depends on them. [nm]
    """

@final
class Metering:
    """Luminances of a picture as a meter and an eye see them: of a probe the upper half, by solid angle. Averages leave out the brightest 2 % and what is nearly black."""

    @property
    def log_average(self) -> float:
        """Mean of the logarithm: the middle of the picture. [cd m-2]"""

    @property
    def bright(self) -> float:
        """95th percentile. [cd m-2]"""

    @property
    def lowest(self) -> float:
        """Smallest luminance of all pixels. [cd m-2]"""

    @property
    def highest(self) -> float:
        """Largest luminance of all pixels. [cd m-2]"""

    @property
    def adaptation(self) -> float:
        """Luminance that the eye of the operator "sky" adapts to: the geometric mean of ``log_average`` and ``bright``. [cd m-2]"""

    @property
    def ev100(self) -> float:
        """Exposure value at ISO 100 of automatic exposure, which makes ``log_average`` 0.18."""

    @property
    def meter_ev100(self) -> float:
        """Exposure value at ISO 100 that a reflected-light meter shows for ``log_average`` (ISO 2720, K = 12.5): 0.79 more than ``ev100``."""

@final
class ToneReport:
    """What ``tone_map`` did to a picture."""

    @property
    def metering(self) -> Metering:
        """Luminances of the picture."""

    @property
    def adaptation(self) -> float:
        """Luminance that the picture was exposed for. [cd m-2]"""

    @property
    def ev100(self) -> float:
        """Exposure value at ISO 100."""

    @property
    def repairs(self) -> tuple[int, int, int]:
        """How many values were no light and were repaired: not a number, infinite, denormal."""

@final
class Adaptation:
    """An eye that takes time, for sequences of pictures without flicker. It follows the logarithm of luminance through two equal stages.

    Parameters
    ----------
    light_s, dark_s
        Time constants of adaptation to light and to darkness, 0.001 to 1e5. [s]
    """

    def __new__(cls, light_s: float = 0.5, dark_s: float = 1.0) -> Adaptation: ...
    @staticmethod
    def eye() -> Adaptation:
        """Return a real eye's: 0.4 s towards light, 110 s towards darkness."""

    def step(self, luminance: float, seconds: float) -> float:
        """Go on by a time during which the picture has this metered luminance, and return what the eye is adapted to then. The first step takes the picture's own.

        Parameters
        ----------
        luminance
            Such as ``auto_exposure(pixels).adaptation``. [cd m-2]
        seconds
            0 to 1e9. [s]
        """

    @property
    def luminance(self) -> float | None:
        """What the eye is adapted to; None before the first step. [cd m-2]"""

    def reset(self) -> None:
        """Forget all, as at a cut."""

def tone_map(
    pixels: ArrayLike,
    operator: _Operator = "sky",
    *,
    exposure_stops: float = 0.0,
    ev100: float | None = None,
    aperture: float | None = None,
    shutter_s: float | None = None,
    iso: float = 100.0,
    adaptation: float | None = None,
    display: Literal["srgb", "display_p3", "rec709", "linear"] = "srgb",
    bits: Literal[8, 16] | None = ...,
    projection: str = "perspective",
    field_of_view_deg: float | None = None,
    rows: str = "centre",
    scale: _Scale | None = None,
    white_luminance: float | None = None,
    color_space: str = "lin_rec709",
    progress: _Progress | None = None,
    **numbers: float,
) -> tuple[NDArray[numpy.uint8] | NDArray[numpy.uint16] | NDArray[numpy.float32], ToneReport]:
    """Bring a picture to a screen: returns the new picture, shape (H, W, 3), and what was done.

    Parameters
    ----------
    pixels
        Linear values, shape (H, W, 3), row 0 at the top. Values that are no light (not a number, infinite) are repaired.
    operator
        "sky" (made for skies by day and night), "filmic" (in the manner of AgX), "aces" (fitted), "exposure" (1 - exp(-light)), "reinhard", "reinhard_local",
        "ashikhmin", "logarithmic" or "linear".
    exposure_stops
        Exposure relative to the automatic one, -20 to 20. [stops]
    ev100
        Exposure by hand: exposure value at ISO 100, -24 to 36; white is 1.2 * 2**ev100 cd m-2.
    aperture, shutter_s, iso
        Exposure as of a camera: f-number, 0.5 to 128; shutter time, 1e-6 to 1e5 [s]; sensitivity, 1 to 1e7.
    adaptation
        Luminance that the eye ("sky") or the meter is adapted to, 1e-8 to 1e9; that of the picture by default. [cd m-2]
    display
        What shows the picture.
    bits
        8 (uint8, dithered; the default), 16 (uint16), or None for the light of the screen, float32 from 0 to 1.
    projection, field_of_view_deg, rows, scale, white_luminance, color_space
        As for ``glare``.
    progress
        ``progress(stage, fraction)``; returning False raises ``Cancelled``.
    **numbers
        Numbers of the operator. sky: key, darkening, rods, blue_shift, acuity_loss, colour_contrast, shoulder; filmic: contrast, inset, power; reinhard: white; reinhard_local:
        sharpening, threshold, scales; ashikhmin: threshold, largest_scale, stretch; logarithmic: white, middle; linear: white.
    """

def auto_exposure(
    pixels: ArrayLike,
    *,
    projection: str = "perspective",
    field_of_view_deg: float | None = None,
    rows: str = "centre",
    scale: _Scale | None = None,
    white_luminance: float | None = None,
    color_space: str = "lin_rec709",
) -> Metering:
    """Meter a picture: its luminances, and the exposure that suits them. Parameters as for ``glare``."""
