"""What tests/blender/test_leftovers.py lets Blender do. Each function runs in a process of its own (hosts.run)."""

import gc
import sys
import threading

import addon_utils
import bpy
from steps import PACKAGE, census, enable, set_up


def off_and_on(times):
    """Switch the extension on, use it the first and the last time, and off, `times` times; tell what there is of it before, while it is on, and after."""
    addon_utils.enable("bl_pkg")
    addon_utils.disable(PACKAGE)
    clean = traces()
    on, off, rendered = [], [], 0
    for number in range(times):
        scene = set_up()
        on.append(traces())
        scene.skyprobe.show_north = True
        # Light is solved anew each time, as nothing of it stays either: twice will do.
        if number in (0, times - 1):
            rendered += bpy.ops.skyprobe.render() == {"FINISHED"}
            bpy.ops.skyprobe.remove()
        addon_utils.disable(PACKAGE)
        off.append(traces())
    return {"clean": clean, "used": on[0], "on": on, "off": off, "rendered": rendered}


def traces():
    """Return all of the extension that Blender and Python know of, and how much is in the file beside the test's scene."""
    gc.collect()
    # Not there before it is enabled for the first time.
    live, drawing = (sys.modules.get(f"{PACKAGE}.{name}") for name in ("live", "viewport_drawing"))
    return {
        "handlers": sorted(
            f"{name} {function.__name__}"
            for name in dir(bpy.app.handlers)
            if isinstance(handlers := getattr(bpy.app.handlers, name), list)
            for function in handlers
            if is_ours(getattr(function, "__module__", ""))
        ),
        "classes": sorted(name for name in dir(bpy.types) if "skyprobe" in name.lower()),
        "scene_properties": sorted(name for name in dir(bpy.types.Scene) if "skyprobe" in name.lower()),
        "other_properties": sorted(
            f"{kind} {name}"
            for kind in ("WindowManager", "World", "Object", "Image", "Light")
            for name in dir(getattr(bpy.types, kind))
            if "skyprobe" in name.lower()
        ),
        "menu_entries": sorted(
            f"{kind} {function.__name__}"
            for kind in dir(bpy.types)
            for function in getattr(getattr(getattr(bpy.types, kind, None), "draw", None), "_draw_funcs", ())
            if is_ours(getattr(function, "__module__", ""))
        ),
        "operators": sorted(dir(bpy.ops.skyprobe)),
        "threads": sorted(thread.name for thread in threading.enumerate() if "skyprobe" in thread.name.lower()),
        "timers": [live is not None and bpy.app.timers.is_registered(live._poll)],
        "draw_handlers": len(drawing._handles) if drawing else 0,
        "worlds": [world.name for world in bpy.data.worlds if "skyprobe" in world.name.lower()],
        "images": [image.name for image in bpy.data.images if "skyprobe" in image.name.lower() or "sky_" in image.name],
        "lamps": [lamp.name for lamp in bpy.data.objects if "skyprobe" in lamp.name.lower()],
    }


def is_ours(module):
    """Whether a module belongs to the extension."""
    return module.startswith(PACKAGE)


def off_while_lit():
    """Switch the extension off while it lights the scene, and on again; then remove the sky."""
    scene = set_up()
    before_all = census()
    bpy.ops.skyprobe.render()
    before = census(), scene.world.name
    addon_utils.disable(PACKAGE)
    after = census(), scene.world.name
    enable()
    bpy.ops.skyprobe.remove()
    return {"before": before, "after": after, "removed_after_return": census() == before_all}
