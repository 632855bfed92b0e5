# SPDX-License-Identifier: GPL-3.0-or-later
"""Where and when."""

import datetime
import math

from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty
from skyprobe import places

from .. import failures, jobs, live, scene_probe, values, viewport_drawing
from ..limits import angle_limits, limits

# How many names a search offers.
SUGGESTIONS = 20
# Letters of the longest text that a search runs for while one types, and of the longest that can be typed: a link to a map.
LONGEST_NAME, LONGEST_PLACE = 80, 500


def _search_places(settings, context, text):
    """Offer the places whose names begin like `text`."""
    try:
        name = text.strip()
        return [place.label for place in places.search(name, limit=SUGGESTIONS)] if 0 < len(name) <= LONGEST_NAME else []
    except jobs.USER_ERRORS:
        return []


def _place_chosen(settings, context):
    """Go to the place that was typed: a name, or coordinates in any spelling."""
    text = settings.place.strip()
    if not text:
        return
    scene = settings.id_data
    try:
        found = places.locate(text)
    except Exception as error:
        live.complain(scene, failures.line(error))
        return
    with live.held(scene):
        settings.latitude, settings.longitude = math.radians(found.latitude), math.radians(found.longitude)
        settings.elevation_m = found.elevation_m


def _day_of_year(settings):
    try:
        return datetime.date(settings.year, settings.month, settings.day).timetuple().tm_yday
    except ValueError:
        # A day too many for its month: the last one of it.
        return _last_day(settings.year, settings.month).timetuple().tm_yday


def _last_day(year, month):
    after = datetime.date(year + month // 12, month % 12 + 1, 1)
    return after - datetime.timedelta(days=1)


def _set_day_of_year(settings, number):
    date = datetime.date(settings.year, 1, 1) + datetime.timedelta(days=number - 1)
    if date.year != settings.year:
        date = datetime.date(settings.year, 12, 31)
    settings.month, settings.day = date.month, date.day


def _north_changed(settings, context):
    try:
        values.check_finite(settings, "north")
        scene_probe.turn_north(settings.id_data)
    except Exception as error:
        live.complain(settings.id_data, failures.line(error))
    viewport_drawing.follow(settings)


class PlaceAndTime:
    """Properties of place, north and time."""

    place: StringProperty(
        name="Place",
        description="Name of a town (Lund, or Lund, Sweden) or coordinates in any spelling (55.71, 13.19 or 55 42 36 N 13 11 24 E)",
        maxlen=LONGEST_PLACE,
        search=_search_places,
        search_options={"SUGGESTION"},
        update=_place_chosen,
    )
    latitude: FloatProperty(
        name="Latitude",
        description="Geographic latitude, north positive",
        subtype="ANGLE",
        **angle_limits("latitude"),
        default=math.radians(55.71),
        precision=4,
        step=100,
        update=live.changed,
    )
    longitude: FloatProperty(
        name="Longitude",
        description="Geographic longitude, east positive",
        subtype="ANGLE",
        **angle_limits("longitude"),
        default=math.radians(13.19),
        precision=4,
        step=100,
        update=live.changed,
    )
    elevation_m: FloatProperty(
        name="Elevation (m)",
        description="Height of the observer above sea level, in metres whatever the unit of the scene",
        **limits("elevation_m"),
        soft_max=9000.0,
        default=0.0,
        precision=0,
        step=1000,
        update=live.changed,
    )
    year: IntProperty(
        name="Year",
        description="Year of the civil date",
        min=values.FIRST_YEAR,
        max=values.LAST_YEAR,
        soft_min=1900,
        soft_max=2100,
        default=2025,
        update=live.changed,
    )
    month: IntProperty(name="Month", description="Month of the civil date", min=1, max=12, default=6, update=live.changed)
    day: IntProperty(name="Day", description="Day of the month", min=1, max=31, default=21, update=live.changed)
    day_of_year: IntProperty(
        name="Day of Year",
        description="Day of the year, 1 to 366: slide through the seasons",
        min=1,
        max=366,
        get=_day_of_year,
        set=_set_day_of_year,
    )
    hour: FloatProperty(
        name="Time",
        description="Civil time of day in hours as a clock at the place shows it, daylight saving included: 13.5 is half past one",
        min=0.0,
        max=23.9997,
        default=13.0,
        precision=3,
        step=10,
        update=live.changed,
    )
    time_offset_h: FloatProperty(
        name="Time Offset (h)",
        description="Hours that have passed since date and time: animate this to run through nights and years",
        soft_min=-24.0,
        soft_max=24.0,
        min=-1e6,
        max=1e6,
        default=0.0,
        precision=2,
        step=25,
        update=live.changed,
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
        update=live.changed,
    )
    zone_name: StringProperty(
        name="Zone",
        description="IANA name of the time zone, such as Europe/Stockholm",
        default="Europe/Stockholm",
        update=live.changed,
    )
    utc_offset: FloatProperty(
        name="UTC Offset (h)",
        description="Hours that the clock is ahead of universal time, east positive: 5.5 in India",
        min=-14.0,
        max=14.0,
        default=0.0,
        precision=2,
        step=25,
        update=live.changed,
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
