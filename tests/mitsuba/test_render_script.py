"""mitsuba_scenes/render.py: from a Sun or a probe to the files of a picture, and nothing by halves."""

import subprocess
import sys

import mitsuba as mi
import numpy as np
import pytest
import render_scene
import skyprobe as sp

SCRIPT = render_scene.ROOT / "mitsuba_scenes" / "render.py"
SMALL = ["--width", "96", "--spp", "4", "--probe-width", "128", "--quality", "draft"]


def run(*given):
    return subprocess.run([sys.executable, SCRIPT, *map(str, given)], capture_output=True, text=True, timeout=300)


def skyprobe(*given):
    """The command line tool."""
    return subprocess.run([sys.executable, "-m", "skyprobe", *map(str, given)], capture_output=True, text=True, timeout=300)


def read(path):
    mi.set_variant("scalar_rgb")
    return np.array(mi.Bitmap(str(path)))


def test_probe_and_picture_in_one_go(tmp_path, variant):
    answer = run("--latitude", 55.71, "--longitude", 13.19, "--time", "2005-06-21T13:00:00+02:00", "--variant", variant,
                 "--output", tmp_path / "lund.exr", *SMALL)  # fmt: skip
    assert answer.returncode == 0, answer.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"lund.exr", "lund.png", "lund_probe.exr"}
    picture, image, probe = (read(tmp_path / name) for name in ("lund.exr", "lund.png", "lund_probe.exr"))
    assert picture.shape == (64, 96, 3) and picture.dtype == np.float32
    assert image.shape == (64, 96, 3) and image.dtype == np.uint8
    assert probe.shape[:2] == (64, 128)
    assert np.isfinite(picture).all() and picture.mean() > 0.0
    # Neither black nor burnt out.
    assert 60 < image.mean() < 240


def test_a_probe_that_is_there_is_used_as_it_is(probe, tmp_path):
    path = tmp_path / "sky.exr"
    probe(width=128, rows="corner").save(path)
    before = path.read_bytes()
    answer = run("--probe", path, "--output", tmp_path / "picture.exr", "--variant", "scalar_rgb", *SMALL)
    assert answer.returncode == 0, answer.stderr
    assert answer.stderr == ""
    assert path.read_bytes() == before
    assert (tmp_path / "picture.exr").exists()


def test_nothing_is_written_over_what_is_read_or_read_only(probe, tmp_path):
    path = tmp_path / "sky.exr"
    probe(width=128, rows="corner").save(path)
    path.chmod(0o444)
    (tmp_path / "soft.exr").symlink_to("sky.exr")
    (tmp_path / "hard.exr").hardlink_to(path)
    (tmp_path / "inner").mkdir()
    (tmp_path / "view.png").hardlink_to(path)
    (tmp_path / "scene.exr").write_bytes(render_scene.ROOT.joinpath("mitsuba_scenes", "probe_scene.xml").read_bytes())
    for name in ("kept.exr", "other.png"):
        (tmp_path / name).write_bytes(b"old")
        (tmp_path / name).chmod(0o444)
    before = {file.name: file.read_bytes() for file in tmp_path.iterdir() if file.is_file()}
    given = ("--probe", path, "--variant", "scalar_rgb", *SMALL)
    for output, more in [
        ("sky.exr", ()),
        ("inner/../sky.exr", ()),
        ("soft.exr", ()),
        ("hard.exr", ()),
        ("view.exr", ()),
        ("scene.exr", ("--scene", tmp_path / "scene.exr")),
        ("kept.exr", ()),
        ("other.exr", ()),
    ]:
        answer = run(*given, *more, "--output", tmp_path / output)
        assert answer.returncode == 2, output
        assert answer.stderr.count("\n") == 1 and ("another file than" in answer.stderr or "read-only" in answer.stderr), answer.stderr
        assert {file.name: file.read_bytes() for file in tmp_path.iterdir() if file.is_file()} == before
        assert path.stat().st_mode & 0o777 == 0o444


def test_what_is_replaced_keeps_its_mode_and_links_stay_links(probe, tmp_path):
    path = tmp_path / "sky.exr"
    probe(width=128, rows="corner").save(path)
    for name in ("real.exr", "picture.png"):
        (tmp_path / name).write_bytes(b"old")
        (tmp_path / name).chmod(0o600)
    (tmp_path / "picture.exr").symlink_to("real.exr")
    answer = run("--probe", path, "--output", tmp_path / "picture.exr", "--variant", "scalar_rgb", *SMALL)
    assert answer.returncode == 0, answer.stderr
    assert (tmp_path / "picture.exr").is_symlink()
    assert read(tmp_path / "real.exr").shape == (64, 96, 3)
    assert [(tmp_path / name).stat().st_mode & 0o777 for name in ("real.exr", "picture.png")] == [0o600, 0o600]


def test_centred_rows_are_pointed_out(probe, tmp_path):
    path = tmp_path / "sky.exr"
    probe(width=128, rows="centre").save(path)
    answer = run("--probe", path, "--output", tmp_path / "picture.exr", "--variant", "scalar_rgb", *SMALL)
    assert answer.returncode == 0
    assert "rows in the centre" in answer.stderr


def test_glare_knows_how_bright_the_picture_is_and_how_wide_it_looks(tmp_path):
    sky = sp.Sky.with_sun(altitude_deg=40.0, azimuth_deg=215.0, atmosphere=sp.Atmosphere(quality="draft"))
    means = {}
    for name, scale in (("a.exr", "mitsuba"), ("b.hdr", "mitsuba"), ("c.exr", "blender"), ("d.hdr", "luminance")):
        sky.render(width=128, rows="corner", scale=scale).save(tmp_path / name)
        answer = run("--probe", tmp_path / name, "--output", tmp_path / "picture.exr", "--variant", "scalar_rgb", *SMALL)
        assert (answer.returncode, answer.stderr) == (0, "")
        told = skyprobe("glare", tmp_path / "picture.exr", tmp_path / "glared.exr")
        assert (told.returncode, told.stderr) == (0, "")
        assert "perspective, 40 degrees" in told.stdout
        means[name] = float(told.stdout.partition("mean luminance ")[2].split()[0])
        told = skyprobe("tonemap", tmp_path / "glared.exr", tmp_path / "shown.png")
        assert (told.returncode, told.stderr) == (0, "")
        if name == "a.exr":
            luminance = 72983.331 * (read(tmp_path / "picture.exr") @ np.array([0.2126, 0.7152, 0.0722]))
            assert means[name] == pytest.approx(np.exp(np.log(luminance[luminance > 0.0]).mean()), rel=2e-3)
    # Daylight, the same in every scale; half a step of 256 in the HDR.
    assert 1e3 < means["a.exr"] < 1e5
    assert list(means.values()) == pytest.approx([means["a.exr"]] * 4, rel=0.01)


def test_a_probe_without_scale_gives_a_picture_without(write_pixels, tmp_path):
    write_pixels(tmp_path / "sky.exr", np.ones((16, 32, 3)))
    answer = run("--probe", tmp_path / "sky.exr", "--output", tmp_path / "picture.exr", "--variant", "scalar_rgb", *SMALL)
    assert answer.returncode == 0
    assert "does not say its scale" in answer.stderr
    told = skyprobe("glare", tmp_path / "picture.exr", tmp_path / "glared.exr")
    assert "683 cd/m2 assumed" in told.stderr


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ([], "--latitude"),
        (["--latitude", "55"], "--longitude"),
        (["--sun-altitude", "30"], "--sun-azimuth"),
        (["--sun-altitude", "30", "--sun-azimuth", "180", "--probe", "sky.exr"], "--probe"),
        (["--latitude", "91", "--longitude", "13", "--time", "2005-06-21T13:00:00+02:00"], "latitude"),
        (["--latitude", "55", "--longitude", "13", "--time", "yesterday"], "time"),
        (["--sun-altitude", "nan", "--sun-azimuth", "180"], "altitude"),
        (["--sun-altitude", "30", "--sun-azimuth", "180", "--turbidity", "-1"], "turbidity"),
        (["--sun-altitude", "30", "--sun-azimuth", "180", "--width", "0"], "width"),
        (["--probe", "nowhere.exr"], "probe"),
    ],
)
def test_wrong_input_is_one_line_and_leaves_nothing(tmp_path, wrong, named):
    answer = run("--output", tmp_path / "picture.exr", *SMALL, *wrong)
    assert answer.returncode == 2
    assert answer.stderr.count("\n") == 1 and named in answer.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("output", ["picture.jpg", "nowhere/picture.exr", "folder.exr"])
def test_an_output_that_cannot_be_is_refused_before_any_work(tmp_path, output):
    (tmp_path / "folder.exr").mkdir()
    answer = run("--sun-altitude", 30, "--sun-azimuth", 180, "--output", tmp_path / output, *SMALL)
    assert answer.returncode == 2
    assert answer.stderr.count("\n") == 1 and "output" in answer.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["folder.exr"]
