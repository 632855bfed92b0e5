"""Animated skies: keyframes for a time-lapse, sequences of probes, and what follows the frame without them."""

import pytest


def test_a_time_lapse_runs_from_its_begin_to_its_end(host):
    answer = host.run("animation_steps.time_lapses")
    # Lund at the equinox, in its standard time: sunrise 6:10, sunset 18:19, and half an hour of civil twilight before and after.
    for span, hour, hours in (("DAY", 5.6, 13.4), ("SUNRISE", 5.2, 2.0), ("SUNSET", 17.3, 2.0), ("NIGHT", 18.3, 11.8), ("WHOLE", 0.0, 24.0)):
        first, last, found_hour, found_hours = answer[span]
        assert [first, last] == [1, 25]
        assert found_hour == pytest.approx(hour, abs=0.15), span
        assert found_hours == pytest.approx(hours, abs=0.15), span
    assert answer["YEAR"][3] == pytest.approx(365.0 * 24.0)
    assert "the Sun does not rise or set" in answer["polar"]


def test_a_sequence_plays_without_the_addon_and_goes_without_a_trace(host, tmp_path):
    answer = host.run("animation_steps.play", folder=str(tmp_path))
    assert answer["state"]["files"] == [f"sky_{frame:04d}.exr" for frame in range(10, 16)]
    assert answer["state"]["shown"] == "SEQUENCE"
    assert answer["state"]["source"] == "SEQUENCE"
    assert answer["state"]["frames"] == [10, 6, True]
    assert answer["state"]["frame"] == 15
    assert answer["restored"]
    # An hour before sunset and an hour after it, nearly dark.
    assert answer["means"][0] > 100.0 * answer["means"][1] > 0.0
    assert max(answer["alone"]) < 1e-4


def test_the_frame_handler_lights_as_the_sequence_does(host, tmp_path):
    answer = host.run("animation_steps.handler_against_sequence", folder=str(tmp_path))
    assert answer["width"] == 128, "pictures are rendered with the probe that is asked for, not with the preview"
    assert max(answer["sequence"]) < 1e-3
    assert max(answer["back"]) < 1e-3


def test_keys_of_the_exposure_go_with_the_sequence_and_others_stay(host, tmp_path):
    assert host.run("animation_steps.exposure_keys", folder=str(tmp_path)) == {
        "playing": [10.0, 11.0, 12.0],
        "left": [],
        "shorter": [10.0, 11.0],
        "copy left, original": [10.0, 11.0],
        "no longer wanted": [],
        "removed": [],
        "own": [3.0],
        "own, removed": [3.0],
        "keyed by hand afterwards": [11.0],
    }


def test_persistent_data_do_not_keep_an_old_sky(host, tmp_path):
    answer = host.run("animation_steps.rendered_in_turn", folder=str(tmp_path))
    assert len(answer["means"]) == 4
    assert answer["means"] == pytest.approx(answer["alone"], rel=1e-3)
    assert answer["means"][0] > 3.0 * answer["means"][1] > 9.0 * answer["means"][2]


def test_a_sequence_that_was_killed_goes_on_with_every_frame_whole(host, tmp_path):
    with pytest.raises(RuntimeError, match="ended with -9"):
        host.run("animation_steps.sequence_until_killed", folder=str(tmp_path), frames=6, kill_at=13)
    assert sorted(path.name for path in tmp_path.glob("*.exr")) == [f"sky_{frame:04d}.exr" for frame in (10, 11, 12)]
    answer = host.run("animation_steps.sequence_again", folder=str(tmp_path), frames=6)
    assert answer["answer"] == ["FINISHED"] and answer["shown"] == "SEQUENCE"
    assert answer["rendered"] == [f"sky_{frame:04d}.exr" for frame in (13, 14, 15)]
    means = list(answer["means"].values())
    assert len(means) == 6 and means == sorted(means, reverse=True) and means[-1] > 0.0
    # Whole again after a file was cut, and only that one.
    answer = host.run("animation_steps.sequence_again", folder=str(tmp_path), frames=6, damaged=11)
    assert answer["rendered"] == ["sky_0011.exr"]
    assert list(answer["means"].values()) == pytest.approx(means)
