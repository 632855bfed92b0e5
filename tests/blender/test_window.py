"""The add-on as people meet it: in a window of Blender, whose event loop runs."""

import pytest

from blender import window


def test_both_panels_are_drawn_without_complaint(windowed, pictures):
    answer = windowed.run("window_steps.draw_panels", picture=str(pictures / "panels.png"))
    assert answer["settings"]
    assert answer["colours"] > 500, "an empty screen"


def test_the_sky_follows_the_time_slider(windowed, pictures):
    answer = windowed.run("window_steps.drag_time", screen=(720, 480), picture=str(pictures / "live.png"))
    print(
        f"Blender {answer['version']}: pixels {answer['median_ms']:.1f} ms after a change of time (median of 100), {answer['air_ms']:.0f} ms after "
        f"one of the air; main thread held {answer['held_median_ms']:.2f} ms in the median, {answer['held_ms']:.1f} ms at most"
    )
    assert answer["message"] == ""
    assert answer["images"] == 2, "Cycles keeps the pixels of an image that changes in place"
    assert answer["last"] == "2025-06-21T16:30:00", "the latest change wins"
    hours, turns, means = zip(*answer["suns"])
    assert len(set(means)) == 100, "every change has its own picture"
    # The Sun goes clockwise, seen from above, all day.
    assert all(later < earlier for earlier, later in zip(turns, turns[1:]))
    # Brightest near solar noon, 13:09.
    brightest = hours[means.index(max(means))]
    assert abs(brightest - 13.15) < 1.5


def test_undo_and_redo_bring_settings_and_sky_back(windowed, pictures):
    answer = windowed.run("window_steps.undo_and_redo", picture=str(pictures / "undone.png"))
    stops = answer["stops"]
    assert [stop[:2] for stop in stops] == [
        ["added", 13.0], ["at 8.0", 8.0], ["at 20.0", 20.0], ["undo", 8.0], ["undo", 13.0], ["redo", 8.0], ["redo", 20.0],
    ]
    assert {stop[2] for stop in stops} == {"PREVIEW"}
    by_hour = {hour: mean for _, hour, _, _, mean in stops[:3]}
    for what, hour, _, _, mean in stops[3:]:
        assert mean == pytest.approx(by_hour[hour], rel=1e-4), f"{what} to {hour}"
    assert answer["world"] == "World"


def test_a_probe_is_rendered_beside_the_work(windowed, pictures, tmp_path):
    answer = windowed.run("window_steps.render_beside", picture=str(pictures / "rendering.png"), path=str(tmp_path))
    assert answer["turns"] > 3 and answer["fractions"] > 2, "the interface stood still"
    assert answer["first"] == ["PROBE", [2048, 1024], True]
    assert answer["begun"] and answer["key_is_old"], "Esc leaves the scene as it was"
    assert answer["images"] == 1
    print(f"Esc ended the render after {1e3 * answer['esc_s']:.0f} ms")


def test_what_a_panel_fails_with_is_noticed(windowed):
    with pytest.raises(RuntimeError, match="this panel fails"):
        windowed.run("window_steps.draw_failing_panel")


def test_a_step_that_fails_says_so(windowed):
    with pytest.raises(RuntimeError, match="this step fails"):
        windowed.run("window_steps.fail")


def test_a_step_that_hangs_is_ended(windowed):
    with pytest.raises(RuntimeError, match="did not end within 8 s"):
        window.run(windowed.blender, "window_steps.hang", windowed.wheel, timeout_s=8)


def test_the_ways_of_the_sun_are_seen_when_they_are_switched_on(windowed, pictures):
    answer = windowed.run("window_steps.switch_helpers", pictures=str(pictures))
    pixels = answer["pixels"]
    assert answer["failure"] is None
    for name in ("nothing", "no_overlays", "off"):
        assert pixels[name] == [0, 0], name
    assert pixels["path"][0] > 500 and pixels["path"][1] == 0
    assert pixels["north"][0] == 0 and pixels["north"][1] > 100
    assert pixels["everything"][0] > 500 and pixels["everything"][1] > 100


def test_a_drawing_that_fails_is_told_once_and_comes_back_with_the_next_change(windowed):
    answer, printed = windowed.run("window_steps.break_helpers", complaints_allowed=True)
    assert answer == {"calls": 1, "broken": answer["still"], "still": answer["broken"], "mended": None}
    assert "ArithmeticError this drawing fails" in answer["broken"]
    assert printed.count("this drawing fails") == 1 and "Traceback" not in printed


def test_the_sun_is_drawn_where_its_lamp_shines_from(windowed, pictures):
    settings = {"show_diurnal_path": True, "show_north": True, "helper_size": 8.0, "hour": 16.5, "north": 0.6, "elevation_m": 500.0}
    answer = windowed.run("window_steps.draw_helpers_on_sky", picture=str(pictures / "on_sky.png"), settings=settings)
    assert answer["failure"] is None
    # The thesis's Sun, which the curves follow, is within 0.02 degrees of the lamp's.
    assert answer["angle_deg"] < 0.03, answer
