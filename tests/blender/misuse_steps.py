"""Lets users, scripts and disks do to the add-on what they should not, one case after the other in one Blender (hosts.run).

A case is a function of a Stage that does one thing wrong, described by its docstring. Its decorator says what the user must be told; it returns
what is told, or nothing if that is printed as a report. After each case the scene is as it was at the case's last `mark`, nobody has
seen a traceback, and an ordinary Render Probe and Remove Sky do what they do.
"""

import contextlib
import importlib
import os
import sys
import tempfile
import time
from pathlib import Path

import bpy
from steps import census, enable, error_of, grey_world, part, pixels_of

QUICK = {"quality": "draft", "width_choice": "OTHER", "width": 64, "preview_width": 64, "solar_flux": 130.0}


def case(told):
    """Make a function of a Stage a case in which the user must be told `told`."""

    def mark(function):
        function.told = told
        return function

    return mark


class Stage:
    """A new file with a grey world, and a folder of its own for a case."""

    def __init__(self, folder, disks):
        bpy.ops.wm.read_homefile(use_empty=True)
        self.folder, self.disks = Path(folder), disks
        self.scene.world = grey_world()
        quick(self.scene)
        self.mark()

    @property
    def scene(self):
        """The scene of the window, whichever that is now: references do not outlive an undo or a load."""
        return bpy.context.scene

    @property
    def settings(self):
        return self.scene.skyprobe

    def set(self, **settings):
        """Set properties of the settings."""
        for name, value in settings.items():
            setattr(self.settings, name, value)

    def mark(self):
        """From here on nothing may change."""
        self._marked = self._state()

    def unmark(self):
        """What the case does is allowed and changes the scene."""
        self._marked = None

    def is_untouched(self):
        return self._marked is None or self._marked == self._state()

    def _state(self):
        scene = self.scene
        names = ("probe_world", "image", "sun_lamp", "shown")
        made = [getattr(getattr(scene.skyprobe, name), "name", getattr(scene.skyprobe, name)) for name in names]
        return census(), scene.world.name if scene.world else None, made, sorted(thing.name for thing in scene.objects)

    def render(self, **settings):
        """Set properties and press Render Probe; return the error, or an empty text."""
        self.set(**settings)
        return error_of(bpy.ops.skyprobe.render)

    def add(self):
        """Press Add Sky, and take the scene as it then is for granted."""
        bpy.ops.skyprobe.add()
        self.mark()

    def message(self):
        """Return what panel and status bar say of the scene."""
        return part("live").readout(self.scene).message


def quick(scene):
    """Give a scene settings that are rendered in no time."""
    for name, value in QUICK.items():
        setattr(scene.skyprobe, name, value)


def environment(world):
    """Return the node that holds the picture of the sky."""
    return world.node_tree.nodes["Skyprobe Environment"]


@contextlib.contextmanager
def replaced(thing, name, value):
    """Let `thing` have another attribute `name` for a while."""
    before = getattr(thing, name)
    setattr(thing, name, value)
    try:
        yield
    finally:
        setattr(thing, name, before)


@contextlib.contextmanager
def printed():
    """Yield a list that gets all that Blender, libraries and scripts print, as one text."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(1), os.dup(2)]
    texts = []
    with tempfile.TemporaryFile() as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
        try:
            yield texts
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            for number, copy in zip((1, 2), kept):
                os.dup2(copy, number)
                os.close(copy)
            file.seek(0)
            texts.append(file.read().decode("utf-8", "replace"))


def run(theme, disks):
    """Run the cases of the module `theme`; `disks` has the paths of a tiny one and a read-only one, or None. Tell how each went."""
    enable()
    rows = []
    for name, function in vars(importlib.import_module(theme)).items():
        if hasattr(function, "told"):
            rows.append({"name": name, "what": function.__doc__, "expected": function.told, **_run(function, disks)})
    return rows


def _run(function, disks):
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        stage = Stage(folder, disks)
        wrong = []
        with printed() as texts:
            try:
                told = function(stage)
            except BaseException as error:
                told = ""
                wrong.append(f"raised {error!r} at line {error.__traceback__.tb_next.tb_lineno if error.__traceback__.tb_next else '?'}")
        if told == SKIPPED:
            return {"told": SKIPPED, "wrong": [], "seconds": 0.0}
        if "Traceback" in texts[0]:
            wrong.append("a traceback")
        if not told:
            told = " ".join(line for line in texts[0].splitlines() if "Skyprobe:" in line)
        if not stage.is_untouched():
            wrong.append("the scene has changed")
        if function.told not in told or "\n" in told or len(told) > 500:
            wrong.append("another message")
        with printed() as afterwards:
            try:
                wrong += _use(stage)
            except BaseException as error:
                wrong.append(f"afterwards {error!r}")
        output = texts[0] + afterwards[0]
    seconds = time.perf_counter() - start
    return {"told": told, "wrong": wrong, "seconds": seconds, **({"output": output[-3000:]} if wrong else {})}


# What a case returns that this machine cannot have.
SKIPPED = "(cannot be had here)"


def _use(stage):
    """Render a probe and remove all skies as if nothing had been; tell what is wrong then."""
    wrong = []
    bpy.ops.skyprobe.reset()
    quick(stage.scene)
    world = stage.scene.world if not part("scene_probe").is_lit(stage.scene) else stage.settings.previous_world
    if bpy.ops.skyprobe.render() != {"FINISHED"} or stage.settings.shown != "PROBE":
        wrong.append("no probe is rendered any more")
    elif not pixels_of(environment(stage.scene.world).image).mean() > 0.0:
        wrong.append("a black probe")
    if len([thing for thing in stage.scene.objects if thing.type == "LIGHT"]) != 1:
        wrong.append("not one Sun")
    if stage.message():
        wrong.append(f"still told: {stage.message()}")
    here = stage.scene
    for scene in bpy.data.scenes:
        if scene.library is None and part("scene_probe").has_anything(scene):
            bpy.context.window.scene = scene
            bpy.ops.skyprobe.remove()
    bpy.context.window.scene = here
    if stage.scene.world != world:
        wrong.append(f"the world is {stage.scene.world}, not {world}")
    for kind in ("worlds", "images", "lights", "objects"):
        left = [thing.name for thing in getattr(bpy.data, kind) if thing.name.startswith(("Skyprobe", "sky_")) and not thing.library]
        if left:
            wrong.append(f"left: {left}")
    if part("beside").current is not None:
        wrong.append("a work that does not end")
    return wrong
