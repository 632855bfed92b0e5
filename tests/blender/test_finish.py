"""Glare on a real Cycles render, in each Blender."""

import math

import numpy as np
import pytest


@pytest.mark.parametrize("state", ["auto", "scotopic"])
def test_the_operator_adds_the_librarys_glare_to_the_render(host, state, tmp_path):
    path = tmp_path / "pictures.npy"
    answer = host.run("finish_steps.glare", state=state, seed=3, out_path=str(path))
    assert answer["answer"] == answer["again"] == ["FINISHED"]
    assert answer["images"] == 1, "the second time takes the place of the first"
    assert answer["scenes"] == 1
    assert answer["is_float"] and answer["size"] == [192, 128]
    assert answer["view"] == {"projection": "perspective", "field_of_view_deg": pytest.approx(40.0, abs=1e-3)}
    assert answer["state"] == ("photopic" if state == "auto" else state)
    assert 0 < answer["glaring_pixels"] < 60
    assert answer["read_back"] == 0.0, "what the operator finishes is what was rendered"
    assert answer["largest_difference"] < 1e-6
    assert answer["brightening"] > 1e-4
    rendered, glared = np.load(path)
    # The lamp stands near the upper border, over which a little of its glare leaves the picture: 2 % by night.
    assert 0.97 < glared.sum() / rendered.sum() < 1.0


def test_every_tone_operator_of_the_menu_is_the_librarys(host):
    answer = host.run("finish_steps.tone_mapped")
    assert len(answer["differences"]) == 9
    assert max(answer["differences"].values()) < 0.01, answer
    assert not answer["is_float"] and answer["color_space"] == "sRGB"


def test_what_cannot_be_finished_is_told(host):
    answer = host.run("finish_steps.refused")
    assert answer["no_render"] is False
    assert "orthographic: set the field of view by hand" in answer["orthographic"]
    assert answer["own_view"] == ["FINISHED"]


def test_cameras_say_where_pixels_look(host):
    answer = host.run("finish_steps.views")
    angle = math.degrees(2.0 * math.atan(18.0 / 50.0))
    assert answer["plain"] == {"projection": "perspective", "field_of_view_deg": pytest.approx(angle, abs=1e-3)}
    assert answer["shifted"] == answer["plain"] | {"field_of_view_deg": pytest.approx(angle, abs=1e-3)}
    assert answer["EQUIRECTANGULAR"] == {"projection": "latlong"}
    assert answer["FISHEYE_EQUIDISTANT"]["projection"] == "fisheye"


def test_settings_of_the_scene_stay(host):
    assert host.run("finish_steps.black_and_white") == {"size": [48, 32], "settings_kept": True}
