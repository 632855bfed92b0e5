"""The add-on as people meet it: in a window of Blender, whose event loop runs."""

import pytest

from blender import window


def test_both_panels_are_drawn_without_complaint(windowed, pictures):
    answer = windowed.run("window_steps.draw_panels", picture=str(pictures / "panels.png"))
    assert answer["settings"]
    assert answer["colours"] > 500, "an empty screen"


def test_what_a_panel_fails_with_is_noticed(windowed):
    with pytest.raises(RuntimeError, match="this panel fails"):
        windowed.run("window_steps.draw_failing_panel")


def test_a_step_that_fails_says_so(windowed):
    with pytest.raises(RuntimeError, match="this step fails"):
        windowed.run("window_steps.fail")


def test_a_step_that_hangs_is_ended(windowed):
    with pytest.raises(RuntimeError, match="did not end within 8 s"):
        window.run(windowed.blender, "window_steps.hang", windowed.wheel, timeout_s=8)
