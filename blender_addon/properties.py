# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user sets, kept with the scene, and its translation into the plain values of jobs.ProbeRequest."""

import math

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import scene_probe

# An item of an enumeration that leaves a value to the preset.
OF_PRESET = "preset"

PRESETS = (
    ("clear", "Clear", "A clear day in the country, over grass"),
    ("pure", "Pure", "Molecules and ozone only, over grass"),
    ("hazy", "Hazy", "A hazy summer day in the country"),
    ("polluted", "Polluted", "A polluted day over land"),
    ("urban", "Urban", "A large town"),
    ("maritime", "Maritime", "The open sea"),
    ("desert", "Desert", "Dusty air over sand"),
    ("antarctic", "Antarctic", "The clearest air there is, over snow"),
    ("fog", "Fog", "A layer of fog over land"),
    ("volcanic", "Volcanic", "A clear day after a great eruption: purple twilights"),
    ("thesis", "Thesis", "Simple haze without ozone, as in the thesis that this work began with"),
)
AEROSOLS = (
    (OF_PRESET, "As the Preset", "The particles of the chosen preset"),
    ("none", "None", "No particles at all"),
    ("continental_clean", "Continental, Clean", "Remote land, no soot"),
    ("continental_average", "Continental, Average", "Settled land with some soot"),
    ("continental_polluted", "Continental, Polluted", "Land near towns and industry"),
    ("urban", "Urban", "A large town: much soot"),
    ("maritime_clean", "Maritime, Clean", "Open sea: salt"),
    ("maritime_polluted", "Maritime, Polluted", "Sea near inhabited coasts: salt and soot"),
    ("maritime_tropical", "Maritime, Tropical", "Tropical sea: salt, little else"),
    ("desert", "Desert", "Mineral dust"),
    ("arctic", "Arctic", "Far north in spring: haze from the continents"),
    ("antarctic", "Antarctic", "Droplets of sulphate"),
    ("fog", "Fog", "Droplets of water in a layer with a top"),
    ("thesis", "Thesis", "Simple haze that only scatters"),
)
GROUNDS = (
    (OF_PRESET, "As the Preset", "The ground of the chosen preset"),
    ("grass", "Grass", "A meadow"),
    ("forest", "Forest", "A wood from above"),
    ("soil", "Soil", "Bare dry earth"),
    ("desert", "Desert", "Pale sand"),
    ("snow", "Snow", "Clean fresh snow"),
    ("sea", "Sea", "The open sea"),
    ("city", "City", "Roofs, streets, some trees"),
    ("asphalt", "Asphalt", "Worn asphalt"),
)
# Bortle's classes by their number.
NO_TOWNS = "none"
TOWNS = (
    (NO_TOWNS, "None", "A natural sky without artificial light"),
    ("1", "1: Excellent Dark Site", "As dark as it gets: the Milky Way casts shadows"),
    ("2", "2: Truly Dark Site", "Clouds are black holes in the sky"),
    ("3", "3: Rural", "A glow at the horizon"),
    ("4", "4: Rural, Near Suburbs", "Domes of light over towns; the Milky Way still has structure"),
    ("5", "5: Suburban", "Only hints of the Milky Way at the horizon"),
    ("6", "6: Bright Suburban", "The Milky Way shows at the zenith only"),
    ("7", "7: Suburbs and City", "The whole sky is grey; hardly a trace of the Milky Way"),
    ("8", "8: City", "The sky glows; one can read headlines by it"),
    ("9", "9: Inner City", "Only Moon, planets and the brightest stars are left"),
)
# Values of the air that a switch takes from the preset.
OPTIONAL_AIR = (
    ("use_humidity", "relative_humidity"),
    ("use_ozone", "ozone_du"),
    ("use_stratosphere", "stratospheric_aod550"),
)


def _north_changed(settings, context):
    scene_probe.turn_north(settings.id_data)


class SkyprobeSettings(bpy.types.PropertyGroup):
    """Settings of the scene's sky, and what was made from them."""

    latitude: FloatProperty(
        name="Latitude",
        description="Geographic latitude, north positive",
        subtype="ANGLE",
        min=-math.pi / 2.0,
        max=math.pi / 2.0,
        default=math.radians(55.71),
        precision=4,
        step=100,
    )
    longitude: FloatProperty(
        name="Longitude",
        description="Geographic longitude, east positive",
        subtype="ANGLE",
        min=-math.pi,
        max=math.pi,
        default=math.radians(13.19),
        precision=4,
        step=100,
    )
    elevation_m: FloatProperty(
        name="Elevation (m)",
        description="Height of the observer above sea level, in metres whatever the unit of the scene",
        min=-500.0,
        max=60000.0,
        soft_max=9000.0,
        default=0.0,
        precision=0,
        step=1000,
    )
    year: IntProperty(name="Year", description="Year of the civil date", min=1000, max=3000, soft_min=1900, soft_max=2100, default=2025)
    month: IntProperty(name="Month", description="Month of the civil date", min=1, max=12, default=6)
    day: IntProperty(name="Day", description="Day of the month", min=1, max=31, default=21)
    hour: FloatProperty(
        name="Time",
        description="Civil time of day in hours as a clock at the place shows it, daylight saving included: 13.5 is half past one",
        min=0.0,
        max=23.9997,
        default=13.0,
        precision=3,
        step=10,
    )
    zone_mode: EnumProperty(
        name="Time Zone",
        description="How the clock at the place relates to universal time",
        items=(
            ("PLACE", "Of the Place", "Found from latitude and longitude, with the daylight saving of the date"),
            ("NAME", "By Name", "A zone of the IANA database, with the daylight saving of the date"),
            ("OFFSET", "By Offset", "A fixed difference from universal time; daylight saving is yours to add"),
        ),
        default="PLACE",
    )
    zone_name: StringProperty(
        name="Zone", description="IANA name of the time zone, such as Europe/Stockholm", default="Europe/Stockholm"
    )
    utc_offset: FloatProperty(
        name="UTC Offset (h)",
        description="Hours that the clock is ahead of universal time, east positive: 5.5 in India",
        min=-14.0,
        max=14.0,
        default=0.0,
        precision=2,
        step=25,
    )

    preset: EnumProperty(name="Air", description="State of the air", items=PRESETS, default="clear")
    aerosol: EnumProperty(
        name="Aerosol", description="Kind of the particles in the air", items=AEROSOLS, default=OF_PRESET
    )
    haze: EnumProperty(
        name="Haze",
        description="How the amount of particles is given",
        items=(
            (OF_PRESET, "As the Preset", "The amount of the chosen preset"),
            ("aod550", "Optical Depth", "Vertical optical depth of the particles at 550 nm"),
            ("turbidity", "Turbidity", "Vertical optical depth of particles and molecules relative to molecules alone"),
            ("visibility_km", "Visibility", "Distance at which a dark object fades into the horizon"),
        ),
        default=OF_PRESET,
    )
    aod550: FloatProperty(
        name="Optical Depth",
        description="Vertical optical depth of the particles at 550 nm: 0.05 very clear, 0.1 clear, 0.4 hazy, 2 and more fog",
        min=0.0,
        max=50.0,
        soft_max=1.0,
        default=0.1,
        precision=3,
        step=1,
    )
    turbidity: FloatProperty(
        name="Turbidity",
        description="Optical depth of particles and molecules relative to molecules alone: 1 pure air, 2 clear, 6 hazy",
        min=1.0,
        max=64.0,
        soft_max=10.0,
        default=2.5,
        precision=2,
    )
    visibility_km: FloatProperty(
        name="Visibility (km)",
        description="Distance at which a dark object fades into the horizon, in kilometres",
        min=0.05,
        max=300.0,
        soft_min=1.0,
        default=40.0,
        precision=1,
        step=100,
    )
    use_ozone: BoolProperty(
        name="Set Ozone", description="Give the ozone column instead of leaving it to the preset", default=False
    )
    ozone_du: FloatProperty(
        name="Ozone (DU)",
        description="Column of ozone in Dobson units: 300 on average; it makes twilight blue",
        min=0.0,
        max=1000.0,
        soft_min=100.0,
        soft_max=500.0,
        default=300.0,
        precision=0,
        step=1000,
    )
    use_humidity: BoolProperty(
        name="Set Humidity", description="Give the humidity with which the particles grow instead of the usual 80 %", default=False
    )
    relative_humidity: FloatProperty(
        name="Humidity (%)",
        description="Relative humidity: damp air makes the particles larger and the haze whiter",
        min=0.0,
        max=99.0,
        default=80.0,
        precision=0,
        step=100,
    )
    use_stratosphere: BoolProperty(
        name="Set Volcanic Haze",
        description="Give the amount of volcanic haze in the stratosphere instead of leaving it to the preset",
        default=False,
    )
    stratospheric_aod550: FloatProperty(
        name="Volcanic Haze",
        description="Vertical optical depth at 550 nm of volcanic haze in the stratosphere: 0.15 after the greatest eruptions",
        min=0.0,
        max=1.0,
        soft_max=0.3,
        default=0.15,
        precision=3,
        step=1,
    )
    ground: EnumProperty(
        name="Ground", description="What the land around reflects", items=GROUNDS, default=OF_PRESET
    )

    night_when: EnumProperty(
        name="Show",
        description="When Moon, planets, stars and the other lights of the night are in the sky",
        items=(
            ("auto", "As It Gets Dark", "Moon and planets always; moonlight, stars and diffuse light while the Sun is below the horizon"),
            ("always", "Always", "All of them by day too, where they are less than a thousandth of the light"),
            ("never", "Never", "The light of the Sun only"),
        ),
        default="auto",
    )
    star_limit: FloatProperty(
        name="Star Limit",
        description="Stars to this magnitude are drawn one by one, fainter ones as part of the Milky Way. A larger number is fainter: 6.5 is what the eye can see",
        min=-2.0,
        max=8.5,
        default=8.5,
        precision=1,
        step=50,
    )
    light_pollution: EnumProperty(
        name="Town Light",
        description="How much artificial light the air scatters, on Bortle's scale of dark skies",
        items=TOWNS,
        default=NO_TOWNS,
    )
    solar_flux: FloatProperty(
        name="Airglow (sfu)",
        description="How strongly the upper air glows, by the Sun's radio flux at 10.7 cm in solar flux units: "
        "70 at the minimum of its activity, 130 on average, 200 at the maximum",
        min=60.0,
        max=300.0,
        soft_max=200.0,
        default=130.0,
        precision=0,
        step=1000,
    )

    width: IntProperty(
        name="Width",
        description="Width of the probe; its height is half of that",
        subtype="PIXEL",
        min=64,
        max=16384,
        soft_min=512,
        soft_max=8192,
        default=2048,
        step=512,
    )
    quality: EnumProperty(
        name="Quality",
        description="How finely the light in the air is computed",
        items=(
            ("draft", "Draft", "To find time and place"),
            ("standard", "Standard", "For pictures"),
            ("high", "High", "For pictures that are measured"),
            ("reference", "Reference", "To check the others; slow"),
        ),
        default="standard",
    )
    north: FloatProperty(
        name="North",
        description="Direction of true north in the scene: angle from the +Y axis, clockwise seen from above",
        subtype="ANGLE",
        soft_min=-math.pi,
        soft_max=math.pi,
        default=0.0,
        step=100,
        update=_north_changed,
    )
    sun_mode: EnumProperty(
        name="Sun",
        description="Where the light of the Sun's disc comes from",
        items=(
            ("LAMP", "As a Lamp", "A Sun lamp of the right size, colour and strength: free of noise"),
            ("MAP", "In the Map", "The disc is drawn into the probe and seen in reflections. For Cycles: EEVEE cannot hold its brightness"),
        ),
        default="LAMP",
    )
    filter_mode: EnumProperty(
        name="Filter",
        description="Whether the sky is seen through a polarising filter",
        items=(
            ("NONE", "None", "No filter"),
            ("VIEW", "Turns with the View", "In every direction the axis stands at the same angle from the vertical"),
            ("HELD", "Held", "One piece of glass that is held towards a direction, as before a camera"),
        ),
        default="NONE",
    )
    filter_strength: FloatProperty(
        name="Strength", description="0 no filter, 1 an ideal one", subtype="FACTOR", min=0.0, max=1.0, default=1.0
    )
    filter_angle: FloatProperty(
        name="Angle",
        description="Angle of the filter's axis from the vertical, clockwise as one sees it",
        subtype="ANGLE",
        min=-math.pi,
        max=math.pi,
        default=0.0,
        step=100,
    )
    filter_altitude: FloatProperty(
        name="Altitude",
        description="Altitude above the horizon towards which the filter is held",
        subtype="ANGLE",
        min=-math.pi / 2.0,
        max=math.pi / 2.0,
        default=math.radians(20.0),
        step=100,
    )
    filter_azimuth: FloatProperty(
        name="Azimuth",
        description="Azimuth from true north through east towards which the filter is held",
        subtype="ANGLE",
        min=-2.0 * math.pi,
        max=2.0 * math.pi,
        default=0.0,
        step=100,
    )
    storage: EnumProperty(
        name="Keep Probe",
        description="Where the picture of the sky is kept",
        items=(
            ("PACKED", "In the .blend", "Packed: the file can go anywhere alone"),
            ("FILE", "As a File", "OpenEXR in a folder"),
        ),
        default="PACKED",
    )
    directory: StringProperty(
        name="Folder",
        description="Folder for the OpenEXR file; // is where the .blend is",
        subtype="DIR_PATH",
        default="//",
    )

    # What the last render made; never shown as settings.
    previous_world: PointerProperty(type=bpy.types.World)
    probe_world: PointerProperty(type=bpy.types.World)
    image: PointerProperty(type=bpy.types.Image)
    lamp: PointerProperty(type=bpy.types.Object)
    sun_altitude_deg: FloatProperty()
    sun_azimuth_deg: FloatProperty()


def air(settings):
    """Return the keywords of skyprobe.Atmosphere; what is left to the preset is absent."""
    keywords = {"preset": settings.preset, "quality": settings.quality}
    for name in ("aerosol", "ground"):
        if getattr(settings, name) != OF_PRESET:
            keywords[name] = getattr(settings, name)
    if settings.haze != OF_PRESET:
        keywords[settings.haze] = _as_typed(getattr(settings, settings.haze))
    for switch, name in OPTIONAL_AIR:
        if getattr(settings, switch):
            keywords[name] = _as_typed(getattr(settings, name))
    return keywords


def polarising_filter(settings):
    """Return the keywords of skyprobe.PolarisingFilter, or None without a filter."""
    if settings.filter_mode == "NONE":
        return None
    keywords = {"strength": _as_typed(settings.filter_strength), "angle_deg": _degrees(settings.filter_angle)}
    if settings.filter_mode == "HELD":
        keywords["held_towards_deg"] = (_degrees(settings.filter_altitude), _degrees(settings.filter_azimuth))
    return keywords


def night(settings):
    """Return the keywords of skyprobe.Night."""
    keywords = {
        "when": settings.night_when,
        "star_limit": _as_typed(settings.star_limit),
        "solar_flux_sfu": _as_typed(settings.solar_flux),
    }
    if settings.light_pollution != NO_TOWNS:
        keywords["bortle"] = int(settings.light_pollution)
    return keywords


def place(settings):
    """Return latitude, longitude [degrees] and elevation_m as keywords of skyprobe.Sky."""
    return {
        "latitude": _degrees(settings.latitude),
        "longitude": _degrees(settings.longitude),
        "elevation_m": _as_typed(settings.elevation_m),
    }


def _as_typed(value):
    """Return the number that the user typed: Blender keeps single precision, in which 0.1 is another and the poles lie beyond 90."""
    return round(value, 5)


def _degrees(angle):
    """Return an angle [radians] as the degrees that the user typed."""
    return _as_typed(math.degrees(angle))


def clock(settings):
    """Return (hour, minute, second) of the time of day."""
    seconds = min(round(settings.hour * 3600.0), 86399)
    return seconds // 3600, seconds // 60 % 60, seconds % 60


def time(settings):
    """Return the time as ISO 8601 with its zone in brackets, its offset, or neither where the place decides."""
    hour, minute, second = clock(settings)
    text = f"{settings.year:04d}-{settings.month:02d}-{settings.day:02d}T{hour:02d}:{minute:02d}:{second:02d}"
    if settings.zone_mode == "NAME":
        return f"{text}[{settings.zone_name.strip()}]"
    if settings.zone_mode == "OFFSET":
        minutes = round(settings.utc_offset * 60.0)
        return f"{text}{'-' if minutes < 0 else '+'}{abs(minutes) // 60:02d}:{abs(minutes) % 60:02d}"
    return text


def register():
    bpy.utils.register_class(SkyprobeSettings)
    bpy.types.Scene.skyprobe = PointerProperty(type=SkyprobeSettings)


def unregister():
    del bpy.types.Scene.skyprobe
    bpy.utils.unregister_class(SkyprobeSettings)
