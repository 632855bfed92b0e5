"""What the tests do in a window of Blender. Each function is a generator of its own process (window.run, window_child.py)."""

import importlib
import math
import os
import statistics
import sys
import time

import addon_utils
import bpy
import mathutils
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


def drag_time(picture):
    """Add a sky, turn the viewport to it, and move the time 100 times as a slider does; tell how the pixels followed.

    Every change waits for its picture, and then ten follow without waiting.
    """
    enable()
    yield
    yield from show_panels()
    live = sys.modules[f"{PACKAGE}.live"]
    scene = bpy.context.scene
    settings = scene.skyprobe
    with context("VIEW_3D"):
        bpy.ops.skyprobe.add()
    settings.auto_exposure = True
    yield 1.0
    # The worker's own view of the main thread: how long it is held by what we do there.
    held = []
    poll = live._poll

    def timed_poll():
        start = time.perf_counter()
        try:
            return poll()
        finally:
            held.append(time.perf_counter() - start)

    waits, images, suns = [], set(), []
    live._poll = timed_poll
    for step in range(100):
        settings.hour = 6.0 + 0.12 * step
        wanted = settings.hour
        start = time.perf_counter()
        yield lambda: _has_arrived(live, scene)
        waits.append(time.perf_counter() - start)
        environment = scene.world.node_tree.nodes["Skyprobe Environment"]
        images.add(environment.image.name)
        suns.append([wanted, settings.sun_lamp.rotation_euler.z, mean_of(environment.image)])
    # Many changes at once: the last one is what the world shows in the end.
    for step in range(10):
        settings.hour = 12.0 + 0.5 * step
    yield lambda: _has_arrived(live, scene)
    last = live.readout(scene).result.request.time
    # Without a graphics card a rendered view takes seconds to draw: only for the picture.
    area("VIEW_3D").spaces.active.shading.type = "RENDERED"
    yield 2.0
    screenshot(picture)
    area("VIEW_3D").spaces.active.shading.type = "SOLID"
    yield 0.2
    live._poll = poll
    settings.preset = "hazy"
    start = time.perf_counter()
    yield lambda: _has_arrived(live, scene)
    return {
        "version": bpy.app.version_string,
        "median_ms": 1e3 * statistics.median(waits),
        "air_ms": 1e3 * (time.perf_counter() - start),
        "held_ms": 1e3 * max(held, default=0.0),
        "held_median_ms": 1e3 * statistics.median(held or [0.0]),
        "images": len(images),
        "suns": suns,
        "last": last,
        "message": live.readout(scene).message,
    }


def _has_arrived(live, scene):
    """Whether the world shows what the settings ask for."""
    values = sys.modules[f"{PACKAGE}.values"]
    result = live.readout(scene).result
    return result is not None and result.request.key == values.preview_request(scene).key


def mean_of(image):
    """Return the mean of the pixels of `image`."""
    flat = np.empty(4 * image.size[0] * image.size[1], dtype=np.float32)
    image.pixels.foreach_get(flat)
    return float(flat.reshape(-1, 4)[:, :3].mean())


def undo_and_redo(picture):
    """Change the time with undo steps between, go back and forth; tell the settings and what the world shows at each stop."""
    enable()
    yield
    live = sys.modules[f"{PACKAGE}.live"]
    answer = []

    def stop(what):
        scene = bpy.context.scene
        while not _has_arrived(live, scene):
            yield 0.02
        yield 0.1
        shown = scene.world.node_tree.nodes["Skyprobe Environment"].image
        answer.append([what, round(scene.skyprobe.hour, 3), scene.skyprobe.shown, scene.world.name, mean_of(shown)])

    with context("VIEW_3D"):
        bpy.ops.skyprobe.add()
        bpy.ops.ed.undo_push(message="sky")
    yield from stop("added")
    for hour in (8.0, 20.0):
        bpy.context.scene.skyprobe.hour = hour
        with context("VIEW_3D"):
            bpy.ops.ed.undo_push(message=str(hour))
        yield from stop(f"at {hour}")
    for what in ("undo", "undo", "redo", "redo"):
        with context("VIEW_3D"):
            getattr(bpy.ops.ed, what)()
        yield from stop(what)
    with context("VIEW_3D"):
        bpy.ops.skyprobe.remove()
    world = bpy.context.scene.world.name
    screenshot(picture)
    return {"stops": answer, "world": world}


def render_beside(picture, path):
    """Press Render Probe in the window: tell that the interface goes on meanwhile, how the scene is lit then, and that Esc stops another."""
    # It is the solve that lasts; light that another Blender of the same test run left would be there at once.
    os.environ["SKYPROBE_CACHE"] = "off"
    enable()
    yield
    yield from show_panels()
    beside, operators = (sys.modules[f"{PACKAGE}.{name}"] for name in ("beside", "operators"))
    settings = bpy.context.scene.skyprobe
    with context("VIEW_3D"):
        bpy.ops.skyprobe.add()
    settings.width_choice, settings.quality = "2048", "high"
    with context("VIEW_3D"):
        bpy.ops.skyprobe.render("INVOKE_DEFAULT")
    turns, fractions = 0, set()
    pictured = False
    while beside.current is not None:
        turns += 1
        fractions.add(beside.current.progress()[0])
        if not pictured and turns > 2:
            screenshot(picture)
            pictured = True
        yield 0.02
    yield 0.2
    first = [settings.shown, list(settings.image.size), settings.image.packed_file is not None]
    # Another air, and Esc while it is solved.
    settings.preset = "hazy"
    with context("VIEW_3D"):
        bpy.ops.skyprobe.render("INVOKE_DEFAULT")
    yield 0.2
    begun = beside.current is not None
    view = area("VIEW_3D")
    x, y = view.x + view.width // 3, view.y + view.height // 2
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    window().event_simulate(type="ESC", value="PRESS", x=x, y=y)
    window().event_simulate(type="ESC", value="RELEASE", x=x, y=y)
    start = time.perf_counter()
    while beside.current is not None:
        yield 0.02
    return {
        "turns": turns,
        "fractions": len(fractions),
        "first": first,
        "begun": begun,
        "esc_s": time.perf_counter() - start,
        "key_is_old": not operators.is_current(bpy.context.scene),
        "images": len([image for image in bpy.data.images if image.name.startswith("sky_")]),
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


def set_view(distance, altitude_deg, azimuth_deg, target=(0.0, 0.0, 0.0)):
    """Look at `target` from `distance` [m], from a direction of the scene."""
    view = area("VIEW_3D").spaces.active.region_3d
    view.view_perspective = "PERSP"
    view.view_location = target
    view.view_distance = distance
    view.view_rotation = mathutils.Euler((math.radians(90.0 - altitude_deg), 0.0, math.radians(180.0 - azimuth_deg))).to_quaternion()


def draw_helpers(picture, settings, distance=32.0, altitude_deg=28.0, azimuth_deg=205.0, shading="SOLID"):
    """Draw in the viewport what `settings` switch on, take a picture, and tell what failed."""
    enable()
    yield
    apply(settings)
    view = area("VIEW_3D")
    view.spaces.active.shading.type = shading
    set_view(distance, altitude_deg, azimuth_deg, (0.0, 0.0, 3.0))
    yield
    yield 0.3
    shown = screenshot(picture)
    return {"failure": part("viewport_drawing").failure(), "colours": len(np.unique(shown.reshape(-1, 3), axis=0))}


# The colours of the Sun's path and of the north arrow, as they are on the screen, within a few of 255.
PATH_COLOR, NORTH_COLOR = (246, 189, 75), (236, 105, 91)


def count_pixels(picture, color, tolerance=14):
    """Return how many pixels of `picture` have the `color`."""
    difference = np.abs(picture[:, :1100].astype(int) - color).max(axis=2)
    return int((difference <= tolerance).sum())


def switch_helpers(pictures):
    """Switch on what is drawn in the viewport one by one and off again, and off by the overlays; tell how much of it is seen, and how long it takes."""
    enable()
    yield
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    set_view(24.0, 30.0, 20.0, (0.0, 0.0, 3.0))
    drawing = part("viewport_drawing")
    found = {}

    def look(name):
        shown = screenshot(f"{pictures}/{name}.png")
        found[name] = [count_pixels(shown, PATH_COLOR), count_pixels(shown, NORTH_COLOR)]

    everything = {"show_diurnal_path": True, "show_analemma": True, "show_north": True, "helper_size": 8.0, "hour": 16.5}
    overlay = area("VIEW_3D").spaces.active.overlay
    for name, settings, overlays in (
        ("nothing", {}, True),
        ("path", {"show_diurnal_path": True, "helper_size": 8.0, "hour": 16.5}, True),
        ("north", {"show_diurnal_path": False, "show_north": True}, True),
        ("everything", everything, True),
        ("no_overlays", {}, False),
        ("off", dict.fromkeys(("show_diurnal_path", "show_analemma", "show_north"), False), True),
    ):
        apply(settings)
        overlay.show_overlays = overlays
        yield
        yield 0.2
        look(name)
    apply(everything)
    times = []
    for minute in range(60):
        bpy.context.scene.skyprobe.hour = 10.0 + minute / 60.0
        start = time.perf_counter()
        drawing._scenery.of(bpy.context.scene.skyprobe)
        times.append(time.perf_counter() - start)
        yield
    return {"pixels": found, "failure": drawing.failure(), "median_ms": 1e3 * float(np.median(times))}


def break_helpers():
    """Let the drawing fail, several times over; mend it, and change a setting."""
    enable()
    drawing = part("viewport_drawing")
    make, calls = drawing._scenery.of, []

    def fail(settings):
        calls.append(1)
        raise ArithmeticError("this drawing fails")

    drawing._scenery.of = fail
    apply({"show_north": True})
    for _ in range(8):
        yield 0.1
    broken = drawing.failure()
    drawing._scenery.of = make
    yield 0.1
    still = drawing.failure()
    apply({"helper_size": 5.0})
    yield 0.2
    return {"calls": len(calls), "broken": broken, "still": still, "mended": drawing.failure()}


def apply(settings):
    """Set properties of the scene's settings."""
    for name, value in settings.items():
        setattr(bpy.context.scene.skyprobe, name, value)


def part(name):
    """Return a module of the add-on."""
    return importlib.import_module(f"{PACKAGE}.{name}")


def draw_helpers_on_sky(picture, settings):
    """Light the scene by its sky, look at it rendered with what `settings` switch on, take a picture, and tell where the Sun is drawn and shines from."""
    enable()
    yield
    apply({**settings, "auto_exposure": True})
    with context("VIEW_3D"):
        bpy.ops.skyprobe.add()
    scene = bpy.context.scene
    while not _has_arrived(sys.modules[f"{PACKAGE}.live"], scene):
        yield 0.05
    view = area("VIEW_3D")
    view.spaces.active.shading.type = "RENDERED"
    set_view(24.0, 6.0, 20.0, (0.0, 0.0, 4.0))
    yield 3.0
    screenshot(picture)
    drawing = part("viewport_drawing")
    (sun,) = (marker for marker in drawing._scenery.of(scene.skyprobe).markers if marker.light_from is None)
    lamp = scene.skyprobe.sun_lamp.matrix_world.to_3x3() @ mathutils.Vector((0.0, 0.0, 1.0))
    return {"failure": drawing.failure(), "angle_deg": math.degrees(lamp.angle(mathutils.Vector(sun.point)))}
