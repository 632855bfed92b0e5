"""What the tests let Blender do with animated skies. Each function runs in a process of its own (hosts.run)."""

import os
import signal
from pathlib import Path

import addon_utils
import bpy
import numpy as np
from render_scene import picture_of
from steps import PACKAGE, census, error_of, grey_world, part, pixels_of, set_up


def sunset_scene(folder, frames=6):
    """Return the test scene with a sunset of some frames to be rendered into `folder`, and the Sun as a lamp."""
    scene = set_up(["plane", "pole"], "top_camera", width=128, sequence_directory=str(folder), year=2025, month=3, day=20)
    scene.render.resolution_x = scene.render.resolution_y = 24
    scene.frame_start = 10
    bpy.ops.skyprobe.time_lapse(span="SUNSET", frames=frames)
    return scene


def time_lapses():
    """Make a time-lapse of each span; tell its frames, the clock at its first frame, and its hours."""
    scene = set_up(year=2025, month=3, day=20)
    answer = {}
    for span in ("DAY", "SUNRISE", "SUNSET", "NIGHT", "WHOLE", "YEAR"):
        bpy.ops.skyprobe.time_lapse(span=span, frames=25)
        scene.frame_set(scene.frame_end)
        hours = scene.skyprobe.time_offset_h
        scene.frame_set(scene.frame_start)
        answer[span] = [scene.frame_start, scene.frame_end, scene.skyprobe.hour, hours]
    scene.skyprobe.latitude = np.radians(78.0)
    scene.skyprobe.month = 6
    answer["polar"] = error_of(lambda: bpy.ops.skyprobe.time_lapse(span="DAY", frames=25))
    return answer


def play(folder):
    """Render a sequence, save, and render pictures of it with and without the add-on; tell what is in the scene."""
    scene = sunset_scene(folder)
    scene.world = mine = grey_world()
    before = census()
    bpy.ops.skyprobe.render_sequence()
    pictures = [_at(scene, frame) for frame in (10, 15)]
    world = scene.world.node_tree.nodes["Skyprobe Environment"]
    state = {
        "shown": scene.skyprobe.shown,
        "source": world.image.source,
        "frames": [world.image_user.frame_start, world.image_user.frame_duration, world.image_user.use_auto_refresh],
        "files": sorted(path.name for path in Path(folder).glob("*.exr")),
        "frame": scene.frame_current,
    }
    file = str(Path(folder) / "scene.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file, copy=True)
    bpy.ops.skyprobe.remove()
    restored = scene.world == mine and census() == before
    addon_utils.disable(PACKAGE)
    bpy.ops.wm.open_mainfile(filepath=file)
    alone = [_at(bpy.context.scene, frame) for frame in (10, 15)]
    return {
        "state": state,
        "restored": restored,
        "means": [float(picture.mean()) for picture in pictures],
        "alone": [float(np.abs(a - b).mean() / b.mean()) for a, b in zip(alone, pictures)],
    }


def _at(scene, frame):
    scene.frame_set(frame)
    return picture_of(scene, 4)


def handler_against_sequence(folder):
    """Render two frames by the frame handler in background mode, and by the sequence; tell how far apart they are."""
    scene = sunset_scene(folder)
    bpy.ops.skyprobe.add()
    by_handler = [_at(scene, frame) for frame in (10, 15)]
    width = scene.world.node_tree.nodes["Skyprobe Environment"].image.size[0]
    bpy.ops.skyprobe.render_sequence()
    by_sequence = [_at(scene, frame) for frame in (10, 15)]
    bpy.ops.skyprobe.leave_sequence()
    back = [_at(scene, frame) for frame in (10, 15)]
    return {
        "width": width,
        "sequence": [float(np.abs(a - b).mean() / b.mean()) for a, b in zip(by_handler, by_sequence)],
        "back": [float(np.abs(a - b).mean() / b.mean()) for a, b in zip(by_handler, back)],
    }


def exposure_keys(folder):
    """Let sequences keyframe the exposure in scenes of several histories; tell the frames of its keys at each stop."""
    compat = part("compat")

    def begin(frames=3):
        scene = sunset_scene(folder, frames)
        scene.skyprobe.auto_exposure = True
        return scene

    def keys(scene):
        return sorted(compat.key_frames(scene, "view_settings.exposure"))

    answer = {}
    scene = begin()
    bpy.ops.skyprobe.render_sequence()
    answer["playing"] = keys(scene)
    bpy.ops.skyprobe.leave_sequence()
    answer["left"] = keys(scene)
    bpy.ops.skyprobe.render_sequence()
    scene.frame_end = 11
    bpy.ops.skyprobe.render_sequence()
    answer["shorter"] = keys(scene)
    copied = scene.copy()
    with bpy.context.temp_override(scene=copied):
        bpy.ops.skyprobe.leave_sequence()
    answer["copy left, original"] = keys(copied) + keys(scene)
    scene.skyprobe.auto_exposure = False
    bpy.ops.skyprobe.render_sequence()
    answer["no longer wanted"] = keys(scene)
    scene.skyprobe.auto_exposure = True
    bpy.ops.skyprobe.render_sequence()
    bpy.ops.skyprobe.remove()
    answer["removed"] = keys(scene)

    scene = begin()
    scene.keyframe_insert("view_settings.exposure", frame=3)
    bpy.ops.skyprobe.render_sequence()
    answer["own"] = keys(scene)
    bpy.ops.skyprobe.remove()
    answer["own, removed"] = keys(scene)

    scene = begin()
    bpy.ops.skyprobe.render_sequence()
    compat.remove_curve(scene, "view_settings.exposure")
    scene.keyframe_insert("view_settings.exposure", frame=11)
    bpy.ops.skyprobe.remove()
    answer["keyed by hand afterwards"] = keys(scene)
    return answer


def rendered_in_turn(folder):
    """Render an animation with persistent data: Cycles must not keep the sky of the frame before. Tell the mean of each picture."""
    scene = sunset_scene(folder, frames=4)
    bpy.ops.skyprobe.add()
    scene.render.use_persistent_data = True
    scene.cycles.samples = 4
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(Path(folder) / "picture_")
    bpy.ops.render.render(animation=True, scene=scene.name)
    means = []
    for path in sorted(Path(folder).glob("picture_*.exr")):
        image = bpy.data.images.load(str(path))
        means.append(float(pixels_of(image).mean()))
    return {"means": means, "alone": [float(_at(scene, frame).mean()) for frame in range(10, 14)]}


def sequence_until_killed(folder, frames, kill_at):
    """Render a sequence in a process that kills itself, as the power does, while it writes the frame `kill_at`."""
    scene = sunset_scene(folder, frames)
    scene.skyprobe.width = 1024
    skyprobe_probe = part("jobs")
    write = skyprobe_probe.write

    def deadly(request, path, progress=None):
        if path.endswith(f"{kill_at:04d}.exr"):
            # A file half written, under the name that the library gives one.
            Path(path).with_name(".skyprobe-abc.part").write_bytes(b"half of a picture")
            os.kill(os.getpid(), signal.SIGKILL)
        return write(request, path, progress)

    skyprobe_probe.write = deadly
    bpy.ops.skyprobe.render_sequence()


def sequence_again(folder, frames, damaged=None):
    """Start the same sequence again; tell how many frames were rendered anew and what each file holds."""
    scene = sunset_scene(folder, frames)
    scene.skyprobe.width = 1024
    if damaged is not None:
        path = Path(folder) / f"sky_{damaged:04d}.exr"
        path.write_bytes(path.read_bytes()[:-100])
    rendered = []
    jobs = part("jobs")
    write = jobs.write

    def counted(request, path, progress=None):
        rendered.append(Path(path).name)
        return write(request, path, progress)

    jobs.write = counted
    answer = bpy.ops.skyprobe.render_sequence()
    means = {}
    for path in sorted(Path(folder).glob("*.exr")):
        image = bpy.data.images.load(str(path))
        means[path.name] = float(pixels_of(image).mean())
        bpy.data.images.remove(image)
    return {"answer": sorted(answer), "rendered": rendered, "means": means, "shown": scene.skyprobe.shown}
