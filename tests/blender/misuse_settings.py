"""Settings that nobody should have: cases of misuse_steps."""

import math

import bpy
from misuse_steps import case
from steps import part


@case("date = 2025-02-30: must be a day of the calendar; that month is shorter")
def thirtieth_of_february(stage):
    """A day that the month does not have."""
    return stage.render(month=2, day=30)


@case("probe of 64 x 32 pixels")
def both_poles(stage):
    """The poles, which single precision puts beyond 90 degrees."""
    stage.unmark()
    return stage.render(latitude=-math.pi / 2.0) or stage.render(latitude=math.pi / 2.0)


@case("probe of 64 x 32 pixels")
def date_line(stage):
    """The meridian of 180 degrees, from both sides."""
    stage.unmark()
    return stage.render(longitude=-math.pi) or stage.render(longitude=math.pi)


@case("probe of 64 x 32 pixels")
def first_and_last_year(stage):
    """The ends of the calendar."""
    stage.unmark()
    return stage.render(year=1) or stage.render(year=1000, time_offset_h=48.0) or stage.render(year=3000, month=12, day=31, time_offset_h=0.0)


@case("probe of 64 x 32 pixels")
def latitude_driven_beyond_the_pole(stage):
    """A driver that says 5 radians: Blender stops it at the pole."""
    stage.unmark()
    driver = stage.scene.driver_add("skyprobe.latitude").driver
    driver.type, driver.expression = "SCRIPTED", "5.0"
    stage.scene.frame_set(2)
    error = stage.render()
    stage.scene.driver_remove("skyprobe.latitude")
    return error


@case("hour = nan: must be a number; look for the script or the driver that sets it")
def hour_that_is_no_number(stage):
    """A script sets the time to NaN."""
    stage.set(hour=math.nan)
    assert part("readout").time(stage.settings) == "\N{EN DASH}" and not part("readout").zone(stage.settings)
    return stage.render()


@case("latitude = NaN: must be a number from -90 to 90 degrees")
def latitude_that_is_no_number(stage):
    """A script sets the latitude to NaN."""
    stage.set(latitude=math.nan)
    assert part("readout").place(stage.settings) == ""
    return stage.render()


@case("north = nan: must be a number")
def north_that_is_no_number(stage):
    """A script sets north to NaN under a finished sky."""
    stage.add()
    stage.set(north=math.nan)
    assert tuple(stage.scene.world.node_tree.nodes["Skyprobe North"].inputs["Rotation"].default_value) == (0.0, 0.0, 0.0)
    message = stage.message()
    assert message in stage.render()
    return message


@case("time_offset_h = 1e+06: must lead to a year from 1000 to 3000")
def offset_beyond_the_calendar(stage):
    """A million hours after the last year."""
    return stage.render(year=3000, time_offset_h=1e6)


@case("width = 65: must be even")
def odd_width(stage):
    """A probe whose height would be a half."""
    return stage.render(width=65)


@case("Nowhere/Atlantis")
def unknown_zone(stage):
    """A time zone that is not there."""
    return stage.render(zone_mode="NAME", zone_name="Nowhere/Atlantis")


@case("zone = (empty): must be a name of the IANA database, such as Europe/Stockholm")
def empty_zone(stage):
    """No time zone at all."""
    message = stage.render(zone_mode="NAME", zone_name="  ")
    assert message[7:] == stage.message() or not stage.message()
    return message


@case(" ... ")
def endless_zone(stage):
    """The name of a zone of 10 000 letters: a line is all there is room for."""
    return stage.render(zone_mode="NAME", zone_name="x" * 10_000)


@case("probe of 64 x 32 pixels")
def hour_that_clocks_skip(stage):
    """Half past two in the night in which clocks go from two to three: half past three is meant."""
    stage.unmark()
    message = stage.render(year=2025, month=3, day=30, hour=2.5, zone_mode="NAME", zone_name="Europe/Stockholm")
    assert part("values").civil_time(stage.settings).time.isoformat() == "2025-03-30T03:30:00+02:00"
    return message


@case("probe of 64 x 32 pixels")
def hour_that_clocks_repeat(stage):
    """Half past two in the night in which clocks go from three to two: the first one is meant."""
    stage.unmark()
    message = stage.render(year=2025, month=10, day=26, hour=2.5, zone_mode="NAME", zone_name="Europe/Stockholm")
    assert part("values").civil_time(stage.settings).time.isoformat() == "2025-10-26T02:30:00+02:00"
    return message


def _place(stage, text):
    before = stage.settings.latitude, stage.settings.longitude
    stage.settings.place = text
    assert (stage.settings.latitude, stage.settings.longitude) == before
    return stage.message()


@case("Qwertzuiopolis")
def place_that_is_not_there(stage):
    """A town that no map has."""
    return _place(stage, "Qwertzuiopolis")


@case("\N{ROCKET}")
def place_of_pictures(stage):
    """A place of emoji."""
    return _place(stage, "\N{ROCKET}\N{FULL MOON SYMBOL}")


@case("at most 200 bytes")
def endless_place(stage):
    """A place of 10 000 letters."""
    return _place(stage, "Lund" * 2_500)


@case("nothing")
def empty_place(stage):
    """Blanks for a place: nothing happens."""
    return _place(stage, "   ") or "nothing"


@case("95")
def coordinates_too_far_north(stage):
    """A latitude of 95 degrees."""
    return _place(stage, "95, 13")


@case("visibility_km = 0.05: must be 0.156 km or more in haze with a scale height of 2 km")
def visibility_of_a_wall(stage):
    """Fog's visibility in an air that is no fog."""
    return stage.render(haze="visibility_km", visibility_km=0.05)


@case('aerosol = "none": must be one of continental_clean')
def haze_of_nothing(stage):
    """An amount of particles, and no particles."""
    return stage.render(preset="pure", haze="aod550", aod550=0.3)


@case("probe of 64 x 32 pixels")
def densest_fog(stage):
    """Fog of the largest turbidity there is."""
    stage.unmark()
    return stage.render(preset="fog", haze="turbidity", turbidity=64.0)


@case("span = SUNRISE: must be another; on that date the Sun does not rise or set there")
def sunrise_in_the_polar_night(stage):
    """A time-lapse of a sunrise where there is none."""
    return _time_lapse(stage, latitude=math.radians(80.0), month=12)


@case("driver = skyprobe.time_offset_h: must not be there, as it overrules keyframes; delete it")
def time_lapse_over_a_driver(stage):
    """Keyframes where a driver is."""
    stage.scene.driver_add("skyprobe.time_offset_h").driver.expression = "0.0"
    message = _time_lapse(stage)
    stage.scene.driver_remove("skyprobe.time_offset_h")
    return message


@case("frames = 240: must end at frame 1048574 or before; begin earlier than at 1048570")
def time_lapse_at_the_end_of_time(stage):
    """More frames than Blender can count."""
    stage.scene.frame_end = 1048574
    stage.scene.frame_start = 1048570
    return _time_lapse(stage)


def _time_lapse(stage, **settings):
    stage.set(**settings)
    before = stage.settings.hour, stage.settings.day, stage.scene.frame_start, stage.scene.frame_end
    try:
        bpy.ops.skyprobe.time_lapse(span="SUNRISE")
    except RuntimeError as error:
        assert before == (stage.settings.hour, stage.settings.day, stage.scene.frame_start, stage.scene.frame_end)
        return str(error).strip()
    return "it is animated"
