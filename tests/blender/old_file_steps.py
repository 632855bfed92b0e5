"""What tests/blender/test_old_files.py lets Blender do. Each function runs in a process of its own (hosts.run)."""

import addon_utils
import bpy
from steps import census, enable, grey_world, set_up


def save(path):
    """Save a scene of which everything of ours is in use: a probe in the file, a preview, both lamps, the old world."""
    scene = set_up(year=2005, month=1, day=25, hour=0.5, moon_mode="LAMP")
    scene.world = grey_world()
    before = census()
    bpy.ops.skyprobe.render()
    scene.skyprobe.hour = 1.0
    bpy.ops.skyprobe.add() if bpy.ops.skyprobe.add.poll() else None
    scene.skyprobe.hour = 0.5
    bpy.ops.wm.save_as_mainfile(filepath=path)
    return {"before": before, "lit": census()}


def remove(path, late):
    """Open the file, remove the sky, save, and open it again; tell what is left. If `late` the extension is switched on after the file is open."""
    addon_utils.enable("bl_pkg")
    if not late:
        enable()
    bpy.ops.wm.open_mainfile(filepath=path)
    enable()
    scene = bpy.context.scene
    kept = {name: getattr(scene.skyprobe, name) for name in ("year", "hour", "moon_mode", "shown")}
    lit = census()
    bpy.ops.skyprobe.remove()
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=path)
    return {"kept": kept, "lit": lit, "left": census(), "world": bpy.context.scene.world.name, "custom": "skyprobe" in bpy.context.scene.keys()}
