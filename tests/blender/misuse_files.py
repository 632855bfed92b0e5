"""Folders, disks, pictures and presets that are not as they should be: cases of misuse_steps."""

import json
import shutil
from pathlib import Path

import bpy
import numpy as np
from misuse_steps import SKIPPED, case, replaced
from steps import error_of, part

RENDERED = "probe of 64 x 32 pixels"
# A picture that no compression makes small.
NOISY = {"width": 512}


def _keep(stage, directory, **settings):
    """Render a probe into a folder."""
    return stage.render(storage="FILE", directory=str(directory), **settings)


@case("must be one that you may write to; choose another")
def read_only_folder(stage):
    """A folder on a disk that cannot be written to."""
    return _keep(stage, stage.disks["read_only"]) if stage.disks else SKIPPED


@case("must be a folder that exists; choose another, or make it")
def folder_that_is_a_file(stage):
    """A file where the folder should be."""
    (stage.folder / "file").write_text("")
    return _keep(stage, stage.folder / "file")


@case("folder = //: must be absolute until the .blend is saved")
def unsaved_blend(stage):
    """A folder beside a .blend that has no place yet."""
    return _keep(stage, "//")


@case("folder = sky/probes: must be absolute, or begin with // for where the .blend is")
def relative_folder(stage):
    """A folder that depends on where Blender was started."""
    return _keep(stage, "sky/probes")


@case("folder = (empty): must be the name of a folder")
def no_folder(stage):
    """No folder at all."""
    return _keep(stage, " ")


@case(RENDERED)
def unicode_folder(stage):
    """Letters of many alphabets, blanks and an emoji."""
    stage.unmark()
    folder = stage.folder / "Himmel über Ängelholm \N{SUN BEHIND CLOUD} 天空 'a' \"b\" %d"
    folder.mkdir()
    error = _keep(stage, folder)
    assert len(list(folder.glob("*.exr"))) == 1 and stage.settings.image.size[0] == 64
    return error


@case("and Blender takes 1023")
def endless_folder(stage):
    """A path that the system takes and Blender cuts."""
    folder = stage.folder
    while len(str(folder)) < 1000:
        folder /= "x" * 80
    folder.mkdir(parents=True)
    error = _keep(stage, folder)
    assert not list(folder.iterdir())
    return error


@case("No space left on device (os error 28); make room there, or choose another folder")
def full_disk(stage):
    """A disk that is full before the picture is whole."""
    if not stage.disks:
        return SKIPPED
    tiny = Path(stage.disks["tiny"])
    error = _keep(stage, tiny, **NOISY)
    assert not list(tiny.iterdir()), list(tiny.iterdir())
    return error


def _meddled(stage, meddle):
    """Render a probe, with `meddle` let loose upon the file as soon as it is written."""
    jobs = part("jobs")
    write = jobs.write

    def written(request, path, progress=None):
        result = write(request, path, progress)
        meddle(Path(path))
        return result

    stage.add()
    with replaced(jobs, "write", written):
        return stage.render()


@case("must be there until Blender has read it; render it again")
def file_deleted_before_it_is_read(stage):
    """Someone deletes the picture between its writing and its reading."""
    return _meddled(stage, Path.unlink)


@case("must be a picture that Blender can read; render it again")
def file_damaged_before_it_is_read(stage):
    """Someone overwrites the picture between its writing and its reading."""
    return _meddled(stage, lambda path: path.write_bytes(b"no picture" * 100))


@case(RENDERED)
def file_on_another_drive(stage):
    """No relative path leads from the .blend to the picture, as between drives of Windows."""
    stage.unmark()
    bpy.ops.wm.save_as_mainfile(filepath=str(stage.folder / "scene.blend"))

    def fail(path, start=None):
        raise ValueError("path is on mount 'D:', start on mount 'C:'")

    with replaced(bpy.path, "relpath", fail):
        error = _keep(stage, stage.folder)
    assert Path(stage.settings.image.filepath_raw).is_absolute()
    return error


@case("lit")
def rendered_file_deleted_later(stage):
    """The file of the probe that the scene shows is deleted; other settings and back again find no picture and make one."""
    stage.unmark()
    _keep(stage, stage.folder)
    for path in stage.folder.glob("*.exr"):
        path.unlink()
    stage.settings.image.reload()
    stage.set(hour=10.0)
    part("live").update_now(stage.scene, final=False)
    stage.set(hour=13.0)
    part("live").update_now(stage.scene, final=False)
    assert stage.settings.shown == "PREVIEW"
    return "lit"


# Presets and configurations.


def _import(stage, content):
    """Import a configuration: bytes, text, or what JSON makes of anything else."""
    before = {name: getattr(stage.settings, name) for name in ("latitude", "zone_name", "zone_mode", "preset", "month", "width", "star_limit")}
    path = stage.folder / "preset.json"
    if not isinstance(content, (str, bytes)):
        content = json.dumps(content)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    error = error_of(lambda: bpy.ops.skyprobe.apply_preset(filepath=str(path)))
    assert before == {name: getattr(stage.settings, name) for name in before}, "half of it was applied"
    return error


@case("must be JSON (EOF while parsing an object")
def preset_cut_off(stage):
    """Half a preset."""
    return _import(stage, '{"atmosphere": {')


@case("must be JSON text in UTF-8")
def preset_of_noise(stage):
    """A picture with the name of a preset."""
    return _import(stage, np.random.default_rng(1).bytes(1000))


@case("must be JSON (recursion limit exceeded")
def bottomless_preset(stage):
    """A hundred thousand brackets."""
    return _import(stage, "[" * 100_000)


@case("configuration = [1,2,3]: must be a table of keys and values")
def preset_of_numbers(stage):
    """JSON, but a list."""
    return _import(stage, [1, 2, 3])


@case("unknown key month = 3: must be left out, or one of latitude")
def preset_with_an_unknown_key(stage):
    """Keys that nobody knows, after one that is right."""
    return _import(stage, {"latitude": 10.0, "month": 3})


@case("latitude = [10]: must be a number")
def preset_with_wrong_types(stage):
    """A list for a number."""
    return _import(stage, {"time": "2020-01-01T00:00", "latitude": [10]})


@case("must be JSON (number out of range")
def preset_with_an_endless_number(stage):
    """A latitude of four hundred digits."""
    return _import(stage, {"latitude": 10**400})


@case("must be JSON (expected value")
def preset_with_no_number(stage):
    """A star limit of NaN, which JSON has not and Python writes."""
    return _import(stage, '{"latitude": 1.0, "night": {"star_limit": NaN}}')


@case("must be JSON (unexpected end of hex escape")
def preset_with_half_a_letter(stage):
    """A zone of half a surrogate pair, which Blender cannot keep, after settings that it can."""
    return _import(stage, '{"latitude": 1.0, "time": "2020-01-01T00:00", "zone": "Europe/\\ud800"}')


@case("probe.width = 65: must be even")
def preset_with_an_odd_width(stage):
    """A width that the renderer would refuse later."""
    return _import(stage, {"latitude": 1.0, "probe": {"width": 65}})


@case("must be a readable file of JSON text, or a picture of skyprobe (No such file or directory")
def preset_that_is_gone(stage):
    """A preset deleted since the menu was drawn."""
    return error_of(lambda: bpy.ops.skyprobe.apply_preset(filepath=str(stage.folder / "gone.json")))


def _save_preset(title="Mine"):
    return error_of(lambda: bpy.ops.skyprobe.save_preset(title=title))


@case("must be a short name in a folder that you may write to (File name too long)")
def endless_preset_name(stage):
    """A preset with a name of 10 000 letters."""
    error = _save_preset("x" * 10_000)
    return error.split("file = ")[0] + error[error.index("must be") :] if "must be" in error else error


@case("must be a short name in a folder that you may write to")
def preset_folder_that_is_a_file(stage):
    """A file where the folder of presets should be; the menu is drawn all the same."""
    presets = part("presets")
    folder = presets.own_folder()
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    folder.write_text("")
    try:
        assert presets.all_of(folder) == []
        return _save_preset()
    finally:
        folder.unlink()


@case("must be a short name in a folder that you may write to (Read-only file system)")
def read_only_preset_folder(stage):
    """A folder of presets that cannot be written to."""
    if not stage.disks:
        return SKIPPED
    with replaced(part("presets"), "own_folder", lambda: Path(stage.disks["read_only"])):
        return _save_preset()


@case("must be one of your presets, and there are none")
def preset_deleted_twice(stage):
    """A preset is deleted that is not there."""
    return error_of(lambda: bpy.ops.skyprobe.delete_preset(title="Mine"))


# Sequences.


def _sequence(stage, folder=None, **settings):
    """Render a sequence into a folder; return the error."""
    stage.set(sequence_directory=str(folder or stage.folder), **settings)
    return error_of(bpy.ops.skyprobe.render_sequence)


@case("2 frames rendered, 0 were there")
def frames_before_the_first(stage):
    """A negative first frame: Blender stops at 0."""
    stage.unmark()
    stage.scene.frame_start, stage.scene.frame_end = -5, 1
    error = _sequence(stage)
    assert sorted(path.name for path in stage.folder.glob("*.exr")) == ["sky_0000.exr", "sky_0001.exr"]
    return error


@case("1 frames rendered, 0 were there")
def end_before_start(stage):
    """A last frame before the first: Blender moves the first."""
    stage.unmark()
    stage.scene.frame_start, stage.scene.frame_end = 10, 5
    assert stage.scene.frame_start == 5
    return _sequence(stage)


@case("must be one that can be made and written to (Read-only file system); choose another")
def read_only_sequence_folder(stage):
    """A folder for the sequence where none can be made."""
    return _sequence(stage, Path(stage.disks["read_only"]) / "sky") if stage.disks else SKIPPED


@case("must be one that can be made and written to (Not a directory); choose another")
def sequence_folder_in_a_file(stage):
    """A folder for the sequence inside a file."""
    (stage.folder / "file").write_text("")
    return _sequence(stage, stage.folder / "file" / "sky")


@case("must have")
def sequence_larger_than_the_disk(stage):
    """A million frames of the largest size."""
    stage.scene.frame_end = 1048574
    return _sequence(stage, width_choice="16384")


@case("No space left on device (os error 28); make room there, or choose another folder")
def disk_that_fills_up(stage):
    """The disk fills up in the middle; the finished frames are kept, and nothing half."""
    if not stage.disks:
        return SKIPPED
    stage.scene.frame_end = 50
    tiny = Path(stage.disks["tiny"]) / "sky"
    with replaced(part("sequence_files"), "COMPRESSED", 0.0):
        error = _sequence(stage, tiny, width=128)
    pictures, records = list(tiny.glob("*.exr")), list((tiny / "records").glob("*.json"))
    assert 0 < len(pictures) < 50 and 0 <= len(pictures) - len(records) <= 1
    assert not [path for path in tiny.rglob("*") if ".part" in path.name]
    assert stage.scene.frame_current == 1
    shutil.rmtree(tiny)
    return error


@case("3 frames rendered, 1 were there")
def records_and_pictures_damaged(stage):
    """One record is no JSON, one has texts for numbers, one picture is cut off: these frames are rendered anew."""
    stage.unmark()
    stage.scene.frame_end = 4
    _sequence(stage)
    records = stage.folder / "records"
    (records / "sky_0001.json").write_text("{")
    content = json.loads((records / "sky_0002.json").read_text())
    content["result"]["sun"]["irradiance"] = ["much", None, {}]
    (records / "sky_0002.json").write_text(json.dumps(content))
    picture = stage.folder / "sky_0003.exr"
    picture.write_bytes(picture.read_bytes()[:-10])
    message = _sequence(stage)
    return message


@case("2 frames rendered, 3 were there")
def frame_range_changed(stage):
    """Frames are added at both ends: those that are there are kept."""
    stage.unmark()
    stage.scene.frame_start, stage.scene.frame_end = 2, 4
    _sequence(stage)
    stage.scene.frame_start, stage.scene.frame_end = 1, 5
    return _sequence(stage)


@case("must be there until Blender has read it")
def sequence_deleted_before_it_plays(stage):
    """Someone deletes the first picture before the last one is finished."""
    stage.scene.frame_end = 2
    files = part("sequence_files").SequenceFiles
    finish = files.finish

    def meddled(self, frame, result):
        finish(self, frame, result)
        if frame == 2:
            Path(self.picture(1)).unlink()

    with replaced(files, "finish", meddled):
        return _sequence(stage)


@case("kept")
def save_with_a_picture_that_cannot_be_packed(stage):
    """The preview cannot be put into the .blend when that is saved: it is saved all the same, and the panel tells."""
    stage.add()

    def fail(image):
        raise RuntimeError("cannot pack")

    with replaced(part("world_nodes"), "pack_pixels", fail):
        bpy.ops.wm.save_as_mainfile(filepath=str(stage.folder / "scene.blend"))
    assert "cannot pack" in stage.message() and (stage.folder / "scene.blend").exists()
    return "kept"
