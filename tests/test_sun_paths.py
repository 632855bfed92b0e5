"""The curves that the Blender add-on draws, without Blender: against the library's own events, and where they must lie."""

import datetime
import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

import skyprobe

SOURCE = Path(__file__).resolve().parent.parent / "blender_addon" / "sun_paths.py"
LUND, TROMSO, QUITO, SYDNEY = (55.705, 13.19, 50.0), (69.65, 18.96, 0.0), (-0.18, -78.47, 2850.0), (-33.87, 151.21, 0.0)
SUMMER, WINTER = datetime.date(2025, 6, 21), datetime.date(2025, 12, 21)


@pytest.fixture(scope="module")
def sun_paths():
    spec = importlib.util.spec_from_file_location("sun_paths", SOURCE)
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(("place", "offset_h"), [(LUND, 2), (QUITO, -5), (SYDNEY, 10)])
def test_sunrise_and_sunset_are_those_of_the_library(sun_paths, place, offset_h):
    day = sun_paths.day(place, SUMMER, offset_h * 3600)
    air = skyprobe.Atmosphere(preset="clear", quality="draft")
    time = f"2025-06-21T12:00:00{offset_h:+03d}:00"
    events = skyprobe.Sky(latitude=place[0], longitude=place[1], elevation_m=place[2], time=time, atmosphere=air).sun_events()
    for mark, event in ((day.rise, events.sunrise), (day.set, events.sunset)):
        shown = datetime.datetime.strptime(mark.text, "%H:%M")
        seconds = (shown.hour - event.hour) * 3600 + (shown.minute - event.minute) * 60 - event.second
        assert abs(seconds) <= 31, (mark.text, event)
        assert mark.direction[2] == pytest.approx(0.0, abs=1e-12) and np.linalg.norm(mark.direction) == pytest.approx(1.0)
    # At the equinoxes it would be due east and west; it rises north of east in June everywhere.
    assert day.rise.direction[0] > 0.0 > day.set.direction[0]
    assert day.rise.direction[1] > 0.0 and day.set.direction[1] > 0.0


def test_where_the_sun_does_not_rise_or_set_there_is_no_mark(sun_paths):
    up, down = sun_paths.day(TROMSO, SUMMER, 7200), sun_paths.day(TROMSO, WINTER, 3600)
    assert up.rise is None and up.set is None and up.path[:, 2].min() > 0.0
    assert down.rise is None and down.set is None and down.path[:, 2].max() < 0.0
    assert len(sun_paths.above_horizon(down.path)) == 0
    assert len(sun_paths.dashes_below_horizon(up.path)) == 0


def test_the_marks_of_hours_lie_on_the_path_where_the_sun_stands_then(sun_paths):
    day = sun_paths.day(SYDNEY, SUMMER, 36000)
    assert [mark.text for mark in day.hours] == [str(hour) for hour in range(24)]
    moment = datetime.datetime(2025, 6, 21, 15, tzinfo=datetime.timezone(datetime.timedelta(hours=10)))
    sun, moon = sun_paths.sun_and_moon(SYDNEY, moment)
    assert np.allclose(day.hours[15].direction, sun, atol=1e-9)
    sky = skyprobe.Sky(
        latitude=SYDNEY[0], longitude=SYDNEY[1], time=moment, atmosphere=skyprobe.Atmosphere(preset="clear", quality="draft")
    )
    # The thesis's Sun is within 0.02 degrees of the precise one, the Moon is the precise one.
    assert np.degrees(np.arccos(sun @ np.array(sky.sun.apparent_direction))) < 0.02
    assert np.degrees(np.arccos(min(1.0, moon @ np.array(sky.moon.apparent_direction)))) < 1e-4


def test_an_analemma_is_a_closed_figure_of_the_year(sun_paths):
    noon = sun_paths.analemmas(LUND, 2025, 3600)[12]
    assert np.array_equal(noon[0], noon[-1])
    assert np.allclose(np.linalg.norm(noon, axis=1), 1.0)
    altitude = np.degrees(np.arcsin(noon[:, 2]))
    # From 90 - latitude - 23.44 to 90 - latitude + 23.44 degrees, a little less as noon by the clock is not noon by the Sun, refraction a little more.
    assert altitude.max() == pytest.approx(90.0 - LUND[0] + 23.44, abs=0.2)
    assert altitude.min() == pytest.approx(90.0 - LUND[0] - 23.44, abs=0.2)
    # A neighbour on the curve is never far: no date is missing and no clock jumps.
    steps = np.degrees(np.arccos(np.clip((noon[1:] * noon[:-1]).sum(axis=1), -1.0, 1.0)))
    assert steps.max() < 3.0


def test_the_path_of_the_date_goes_through_the_analemmas(sun_paths):
    start = datetime.date(2025, 1, 1)
    for week in (0, 20, 40):
        date = start + datetime.timedelta(days=5 * week)
        day = sun_paths.day(LUND, date, 3600)
        for hour in (0, 7, 18):
            curve = sun_paths.analemmas(LUND, 2025, 3600)[hour]
            assert np.degrees(np.arccos(min(1.0, (curve @ day.hours[hour].direction).max()))) < 1e-3


def test_lines_end_on_the_horizon(sun_paths):
    day = sun_paths.day(LUND, SUMMER, 7200)
    ends = sun_paths.above_horizon(day.path)
    assert ends[:, 2].min() == pytest.approx(0.0, abs=1e-12)
    assert (np.abs(ends[:, 2]) < 1e-9).sum() == 2
    both = sun_paths.above_horizon(np.stack([day.path, -day.path]))
    assert len(both) == len(ends) + len(sun_paths.above_horizon(-day.path))
    dashes = sun_paths.dashes_below_horizon(day.path)
    assert dashes[:, 2].max() < 0.0 and len(dashes) > 20
