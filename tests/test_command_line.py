"""The command line tool as its users meet it: whole files or one clear line."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PLACE = ["--latitude", "55.71", "--longitude", "13.19"]
TIME = ["--time", "2005-06-21T13:00:00+02:00"]
SMALL = ["--width", "64", "--quality", "draft"]
CONFIG = {
    "latitude": 55.71,
    "longitude": 13.19,
    "elevation_m": 20,
    "time": "2005-06-21T13:00:00+02:00",
    "atmosphere": {"preset": "clear", "turbidity": 3.0, "ground": "grass", "quality": "draft"},
    "probe": {"width": 64, "scale": "blender", "sun_disc": True},
}


@pytest.fixture(scope="session")
def binary():
    """The tool under test: SKYPROBE_BINARY, or what `cargo build --release` made."""
    path = Path(os.environ.get("SKYPROBE_BINARY", ROOT / "target" / "release" / "skyprobe"))
    if not path.exists():
        pytest.fail(f"{path} is missing: cargo build --release, or name the tool in SKYPROBE_BINARY")
    return path


@pytest.fixture
def run(binary, tmp_path):
    """Function that runs the tool in an empty folder."""

    def call(*arguments):
        command = [binary, *map(str, arguments)]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)

    return call


@pytest.fixture
def write_config(tmp_path_factory):
    """Function that writes a configuration outside the folder of the outputs and returns its path."""

    def write(content):
        path = tmp_path_factory.mktemp("config") / "sky.json"
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    return write


def everything_in(folder):
    return sorted(str(path.relative_to(folder)) for path in Path(folder).rglob("*"))


def check_refusal(answer, *named):
    """One line on the standard error that names what is wrong, exit code 2, nothing on the standard output."""
    assert answer.returncode == 2, answer.stderr
    assert answer.stderr.count("\n") == 1 and answer.stderr.endswith("\n"), answer.stderr
    assert answer.stdout == ""
    for text in named:
        assert text in answer.stderr, answer.stderr
    assert "panicked" not in answer.stderr


WRONG_VALUES = [
    (["--latitude", "91", "--longitude", "13.19", *TIME], ["latitude", "91", "-90", "90"]),
    (["--latitude", "-90.001", "--longitude", "13.19", *TIME], ["latitude", "-90.001"]),
    (["--latitude", "nan", "--longitude", "13.19", *TIME], ["latitude", "NaN"]),
    (["--latitude", "inf", "--longitude", "13.19", *TIME], ["latitude", "inf"]),
    (["--latitude", "north", "--longitude", "13.19", *TIME], ["latitude", "north"]),
    (["--latitude", "55.71", "--longitude", "nan", *TIME], ["longitude", "NaN"]),
    (["--latitude", "55.71", "--longitude", "400", *TIME], ["longitude", "400"]),
    ([*PLACE, "--time", "yesterday"], ["time", "yesterday"]),
    ([*PLACE, "--time", "2005-02-30T12:00:00Z"], ["time", "2005-02-30"]),
    ([*PLACE, "--time", "2005-06-21T25:00:00Z"], ["time"]),
    ([*PLACE, "--time", ""], ["time"]),
    ([*PLACE, *TIME, "--elevation", "nan"], ["elevation"]),
    ([*PLACE, *TIME, "--elevation", "1e9"], ["elevation"]),
    ([*PLACE, *TIME, "--width", "0"], ["width", "0", "64", "16384"]),
    ([*PLACE, *TIME, "--width", "-64"], ["width", "-64"]),
    ([*PLACE, *TIME, "--width", "16385"], ["width", "16385"]),
    ([*PLACE, *TIME, "--width", "99999999999999999999"], ["width"]),
    ([*PLACE, *TIME, "--turbidity", "-1"], ["turbidity", "-1"]),
    ([*PLACE, *TIME, "--turbidity", "nan"], ["turbidity", "NaN"]),
    ([*PLACE, *TIME, "--preset", "foggy"], ["preset", "foggy"]),
    ([*PLACE, *TIME, "--quality", "best"], ["quality", "best"]),
    ([*PLACE, *TIME, "--scale", "lumen"], ["scale", "lumen"]),
    ([*PLACE, *TIME, "--frobnicate"], ["--frobnicate"]),
    (PLACE, ["time"]),
    (["--longitude", "13.19", *TIME], ["latitude"]),
]


@pytest.mark.parametrize(("wrong", "named"), WRONG_VALUES, ids=[" ".join(wrong[-4:]) for wrong, _ in WRONG_VALUES])
def test_a_wrong_value_is_one_line_and_leaves_nothing(run, tmp_path, wrong, named):
    check_refusal(run("render", *wrong, "--output", "sky.exr"), *named)
    assert everything_in(tmp_path) == []


@pytest.mark.parametrize(("wrong", "named"), WRONG_VALUES[:3] + WRONG_VALUES[7:8], ids=lambda value: str(value[0]))
def test_info_refuses_the_same(run, wrong, named):
    check_refusal(run("info", *wrong), *named)


def test_a_wrong_value_leaves_an_older_file_as_it_was(run, tmp_path):
    (tmp_path / "sky.exr").write_bytes(b"older")
    check_refusal(run("render", *PLACE, *TIME, "--width", "0", "--output", "sky.exr"), "width")
    assert (tmp_path / "sky.exr").read_bytes() == b"older"
    assert everything_in(tmp_path) == ["sky.exr"]


@pytest.mark.parametrize(
    "output",
    ["folder.exr", "folder", "nowhere/sky.exr", "file/sky.exr", "/proc/sky.exr", "/proc/nowhere/sky.exr", "sky", "sky.jpg", ""],
)
def test_an_output_that_cannot_be_is_one_line_and_leaves_nothing(run, tmp_path, output):
    (tmp_path / "folder.exr").mkdir()
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("")
    before = everything_in(tmp_path)
    check_refusal(run("render", *PLACE, *TIME, *SMALL, "--output", output), "output")
    assert everything_in(tmp_path) == before


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere; /proc in the test above stands for it")
def test_a_folder_that_may_not_be_written_to(run, tmp_path):
    folder = tmp_path / "closed"
    folder.mkdir(mode=0o500)
    check_refusal(run("render", *PLACE, *TIME, *SMALL, "--output", "closed/sky.exr"), "output")


def test_no_output_at_all(run):
    check_refusal(run("render", *PLACE, *TIME, *SMALL), "output")


@pytest.mark.parametrize("arguments", [[], ["paint"], ["render"]])
def test_a_command_or_its_essentials_are_missing(run, tmp_path, arguments):
    check_refusal(run(*arguments))
    assert everything_in(tmp_path) == []


def changed(table, key, value):
    """CONFIG with one value changed or added; `table` is "" for the top."""
    config = json.loads(json.dumps(CONFIG))
    (config[table] if table else config)[key] = value
    return config


WRONG_CONFIGS = {
    "unknown key at the top": (changed("", "lattitude", 3), ["lattitude"]),
    "unknown key of the air": (changed("atmosphere", "turbidty", 3), ["turbidty"]),
    "unknown key of the probe": (changed("probe", "widht", 64), ["widht"]),
    "latitude out of range": (changed("", "latitude", 91), ["latitude", "91"]),
    "time that is none": (changed("", "time", "yesterday"), ["time", "yesterday"]),
    "turbidity below one": (changed("atmosphere", "turbidity", -1), ["turbidity", "-1"]),
    "two ways to say the haze": (changed("atmosphere", "aod550", 0.1), ["aod550", "turbidity"]),
    "width of nothing": (changed("probe", "width", 0), ["width", "0"]),
    "text for a number": (changed("probe", "width", "wide"), ["width"]),
    "number for a table": (changed("", "probe", 3), ["probe"]),
    "not a number": ('{"latitude": NaN, "longitude": 13.19}', ["config"]),
    "not JSON": ("latitude = 55", ["config"]),
    "a list": ("[1, 2]", []),
    "empty": ("", ["config"]),
}


@pytest.mark.parametrize("name", WRONG_CONFIGS)
def test_a_wrong_configuration_is_one_line_and_leaves_nothing(run, tmp_path, write_config, name):
    content, named = WRONG_CONFIGS[name]
    check_refusal(run("render", "--config", write_config(content), "--output", "sky.exr"), *named)
    assert everything_in(tmp_path) == []


@pytest.mark.parametrize("path", ["nowhere.json", "."])
def test_a_configuration_that_cannot_be_read(run, tmp_path, path):
    check_refusal(run("render", "--config", path, "--output", "sky.exr"), "config")
    assert everything_in(tmp_path) == []


def test_the_main_job_writes_what_was_asked_for_and_nothing_else(run, tmp_path):
    answer = run("render", "--lat", "55.71", "--lon", "13.19", *TIME, *SMALL, "-o", "sky.exr", "-o", "sky.hdr", "-o", "sky.png")
    assert answer.returncode == 0, answer.stderr
    assert everything_in(tmp_path) == ["sky.exr", "sky.hdr", "sky.png"]
    starts = {".exr": b"\x76\x2f\x31\x01", ".hdr": b"#?RADIANCE", ".png": b"\x89PNG"}
    for path in tmp_path.iterdir():
        assert path.read_bytes().startswith(starts[path.suffix]), path.name


def test_the_long_and_the_short_names_are_the_same(run):
    long = run("render", *PLACE, *TIME, "--output", "sky.exr", "--dump-config")
    short = run("render", "--lat", "55.71", "--lon", "13.19", *TIME, "-o", "sky.exr", "--dump-config")
    assert long.returncode == short.returncode == 0, long.stderr + short.stderr
    assert long.stdout == short.stdout


def test_a_dumped_configuration_reads_back_as_itself_and_renders(run, tmp_path, write_config):
    first = run("render", "--config", write_config(CONFIG), "--dump-config")
    assert first.returncode == 0, first.stderr
    dumped = json.loads(first.stdout)
    for name in ("latitude", "longitude", "elevation_m", "time"):
        assert dumped[name] == CONFIG[name]
    for table in ("atmosphere", "probe"):
        assert {name: dumped[table][name] for name in CONFIG[table]} == CONFIG[table]
    again = write_config(first.stdout)
    second = run("render", "--config", again, "--dump-config")
    assert json.loads(second.stdout) == dumped
    assert everything_in(tmp_path) == []
    answer = run("render", "--config", again, "-o", "sky.exr")
    assert answer.returncode == 0, answer.stderr
    assert everything_in(tmp_path) == ["sky.exr"]


def test_an_option_overrides_the_configuration(run, write_config):
    answer = run("render", "--config", write_config(CONFIG), "--latitude", "-10", "--width", "128", "--dump-config")
    assert answer.returncode == 0, answer.stderr
    dumped = json.loads(answer.stdout)
    assert (dumped["latitude"], dumped["probe"]["width"], dumped["longitude"]) == (-10, 128, CONFIG["longitude"])


def test_info_says_where_the_sun_is(run, tmp_path):
    answer = run("info", *PLACE, *TIME, "--quality", "draft")
    assert answer.returncode == 0, answer.stderr
    text = answer.stdout.lower()
    for word in ("sun", "sunrise", "sunset", "lx"):
        assert word in text
    assert everything_in(tmp_path) == []


@pytest.mark.parametrize("command", [[], ["render"], ["info"]])
def test_help_teaches(run, command):
    answer = run(*command, "--help")
    assert answer.returncode == 0 and answer.stderr == ""
    if command:
        assert "--latitude" in answer.stdout and "Examples" in answer.stdout
    else:
        assert "render" in answer.stdout and "info" in answer.stdout
