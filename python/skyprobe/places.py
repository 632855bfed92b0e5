"""Names of places, coordinates as people write them, the height of the land, time zones. All of it is offline.

>>> from skyprobe import places
>>> places.search("goteborg", limit=1)[0].label
'Gothenburg, Västra Götaland, Sweden'
>>> places.parse_coordinates("55 42 36 N 13 11 24 E")
(55.71, 13.19)
>>> places.nearest(55.9, 13.19).label
'4 km NE of Marieholm, Skåne, Sweden'
>>> places.time_zone(55.71, 13.19)
'Europe/Stockholm'
>>> places.civil_time("2005-06-21T13:00", 55.71, 13.19).abbreviation
'CEST'

:func:`locate` takes whatever a person may write for a place, a name or coordinates.

Names, coordinates and elevations are those of GeoNames (geonames.org, CC BY 4.0), boundaries of time zones those of OpenStreetMap (ODbL 1.0), the map of
heights is that of Mapzen: see data/README.md for the credits that are due.
"""

from ._core import (
    CivilTime,
    Location,
    NearestPlace,
    Place,
    TimeFields,
    civil_time,
    elevation_m,
    format_coordinates,
    parse_coordinates,
    parse_time,
)
from ._core import locate_place as locate
from ._core import nearest_place as nearest
from ._core import search_places as search
from ._core import zone_of_place as time_zone

__all__ = [
    "CivilTime",
    "Location",
    "NearestPlace",
    "Place",
    "TimeFields",
    "civil_time",
    "elevation_m",
    "format_coordinates",
    "locate",
    "nearest",
    "parse_coordinates",
    "parse_time",
    "search",
    "time_zone",
]
