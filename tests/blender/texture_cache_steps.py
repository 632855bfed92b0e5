"""What tests/blender/test_texture_cache.py lets Blender do. Each function runs in a process of its own (hosts.run)."""

from pathlib import Path

import bpy
from render_scene import picture_of
from steps import set_up


def use_and_remove(folder):
    """Let Cycles keep tiles of a probe and of a sequence beside them, then remove the sky; tell the files at each stop."""
    scene = set_up(storage="FILE", directory=folder, sequence_directory=f"{folder}/frames")
    scene.render.use_auto_generate_texture_cache = True
    bpy.ops.skyprobe.render()
    picture_of(scene, 1)
    answer = {"probe": _names(folder)}
    scene.frame_start, scene.frame_end = 1, 2
    bpy.ops.skyprobe.render_sequence()
    answer["probe replaced"] = _names(folder)
    for frame in (1, 2):
        scene.frame_set(frame)
        picture_of(scene, 1)
    # Another picture's tiles are not ours.
    (Path(folder) / "frames" / "blender_tx" / "wood.exr.0-AB.tx").touch()
    answer["sequence"] = _names(folder)
    bpy.ops.skyprobe.remove()
    answer["removed"] = _names(folder)
    return answer


def _names(folder):
    return sorted(path.relative_to(folder).as_posix() for path in Path(folder).rglob("*") if path.suffix == ".tx" or path.name == "blender_tx")
