"""What the tests do in a window of Blender. Each function is a generator of its own process (window.run, window_child.py)."""

import os
import time

import addon_utils
import bpy
import numpy as np
import screen

PACKAGE = "skyprobe_addon"


def enable():
    """Switch the add-on on, as the Preferences do."""
    if addon_utils.enable(PACKAGE, default_set=True) is None:
        raise RuntimeError(f"{PACKAGE} cannot be enabled")


def window():
    """Return the window."""
    return bpy.context.window_manager.windows[0]


def area(kind):
    """Return the largest area of `kind` ("VIEW_3D", "PROPERTIES", ...)."""
    return max((area for area in window().screen.areas if area.type == kind), key=lambda area: area.width * area.height)


def region(area, kind):
    """Return the region of `kind` ("WINDOW", "UI", ...) of `area`."""
    return next(region for region in area.regions if region.type == kind)


def context(area_kind, region_kind="WINDOW"):
    """Return what puts operators into an area of the window: with context("VIEW_3D"): bpy.ops..."""
    where = area(area_kind)
    return bpy.context.temp_override(window=window(), area=where, region=region(where, region_kind))


def show_panels():
    """Open the World properties large at the right, and the add-on's tab of the 3D view's sidebar. A generator."""
    with context("OUTLINER"):
        bpy.ops.screen.area_close()
    yield
    area("PROPERTIES").spaces.active.context = "WORLD"
    area("VIEW_3D").spaces.active.show_region_ui = True
    yield
    yield from turn_to_tab("Sky")


class WINDOW_PT_marker(bpy.types.Panel):
    """Knows whether its tab of the sidebar is the one that is shown, which Blender does not tell before 4.2."""

    bl_label = "Marker"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_options = {"HIDE_HEADER"}
    drawn = False

    def draw(self, context):
        WINDOW_PT_marker.drawn = True


def turn_to_tab(category):
    """Turn the sidebar of the 3D view to the tab `category`, by clicking on one tab after the other. A generator."""
    WINDOW_PT_marker.bl_category = category
    bpy.utils.register_class(WINDOW_PT_marker)
    sidebar = region(area("VIEW_3D"), "UI")
    x, top = sidebar.x + sidebar.width - 8, sidebar.y + sidebar.height
    for y in range(top - 20, sidebar.y, -20):
        yield from click(x, y)
        if WINDOW_PT_marker.drawn:
            break
    else:
        raise RuntimeError(f"the sidebar has no tab {category}")
    bpy.utils.unregister_class(WINDOW_PT_marker)
    yield


def click(x, y):
    """Click at the pixel (x, y) of the window, counted from its lower left corner. A generator."""
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x, y=y)
    yield 0.05


def screenshot(path):
    """Write the screen as it is drawn now to `path` (PNG); return it, uint8 RGB (H, W, 3), row 0 at the top."""
    picture = screen.read(os.environ["SKYPROBE_SCREEN"])
    screen.write_png(path, picture)
    return picture


def draw_panels(picture):
    """Enable the add-on, show both panels, take a picture."""
    enable()
    yield
    yield from show_panels()
    yield 0.5
    shown = screenshot(picture)
    return {
        "version": bpy.app.version_string,
        "settings": hasattr(bpy.context.scene, "skyprobe"),
        "colours": len(np.unique(shown.reshape(-1, 3), axis=0)),
    }


class WINDOW_PT_failing(bpy.types.Panel):
    bl_label = "Failing"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "world"

    def draw(self, context):
        raise ArithmeticError("this panel fails")


def draw_failing_panel():
    """Show a panel that cannot be drawn."""
    bpy.utils.register_class(WINDOW_PT_failing)
    area("PROPERTIES").spaces.active.context = "WORLD"
    yield
    yield 0.2


def fail():
    """Fail between two drawings."""
    yield
    raise ArithmeticError("this step fails")


def hang():
    """Never give the event loop its turn again."""
    yield
    while True:
        time.sleep(1.0)
