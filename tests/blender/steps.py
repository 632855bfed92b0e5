"""What the tests let Blender do with the installed extension. Each function runs in a process of its own (hosts.run)."""

import importlib
import sys
import tempfile
from pathlib import Path

import addon_utils
import analysis
import bpy
import numpy as np
import scene_builder
from render_scene import picture_of
from scene_geometry import load_scene

PACKAGE = "bl_ext.user_default.skyprobe"


def install(archive):
    """Install the zip as a user would."""
    addon_utils.enable("bl_pkg")
    answer = bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
    return {
        "version": bpy.app.version_string,
        "answer": sorted(answer),
        "enabled": hasattr(bpy.types.Scene, "skyprobe"),
        "module": sys.modules["skyprobe"].__file__,
    }


def enable():
    """Switch the installed extension on, after the file is loaded."""
    addon_utils.enable("bl_pkg")
    if addon_utils.enable(PACKAGE) is None:
        raise RuntimeError(f"{PACKAGE} cannot be enabled")


def part(name):
    """Return a module of the extension."""
    return importlib.import_module(f"{PACKAGE}.{name}")


def set_up(parts=None, camera="camera", **settings):
    """Build the test scene with a small quick probe's settings; return the scene."""
    scene = scene_builder.build(load_scene(), parts, camera)
    enable()
    defaults = {"quality": "draft", "width_choice": "OTHER", "width": 256, "preview_width": 128}
    for name, value in {**defaults, **settings}.items():
        setattr(scene.skyprobe, name, value)
    return scene


def grey_world():
    """Return a world as a user may have it: a strong grey behind a node of theirs, with mist."""
    world = bpy.data.worlds.new("Mine")
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True
    world.mist_settings.start = 7.0
    nodes = world.node_tree.nodes
    nodes.clear()
    background, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    background.inputs["Strength"].default_value = 3.0
    world.node_tree.links.new(background.outputs["Background"], output.inputs["Surface"])
    return world


def census():
    """Return how much of each kind is in the file."""
    counts = {kind: len(getattr(bpy.data, kind)) for kind in ("worlds", "lights", "objects", "node_groups")}
    # Rendering makes an image of its own.
    counts["images"] = sum(image.type != "RENDER_RESULT" for image in bpy.data.images)
    return counts


def light_up(sun_mode, picture_path):
    """Press Render Probe in a scene with a world, render a picture, save, reopen without the extension, render, and remove."""
    scene = set_up(sun_mode=sun_mode)
    scene.world = mine = grey_world()
    before = census()
    answer = bpy.ops.skyprobe.render()
    lit = picture_of(scene, 4)
    np.save(picture_path, lit)
    state = state_of(scene)
    # The same again takes the place of what was there.
    bpy.ops.skyprobe.render()
    after_second = census()

    with tempfile.TemporaryDirectory() as folder:
        file = str(Path(folder) / "scene.blend")
        bpy.ops.wm.save_as_mainfile(filepath=file, copy=True)
        bpy.ops.skyprobe.remove()
        restored = {
            "world": scene.world == mine,
            "census": census() == before,
            "strength": mine.node_tree.nodes["Background"].inputs["Strength"].default_value,
            "nodes": len(mine.node_tree.nodes),
        }
        addon_utils.disable(PACKAGE)
        bpy.ops.wm.open_mainfile(filepath=file)
        alone = picture_of(bpy.context.scene, 4)
        alone_has_addon = hasattr(bpy.types.Scene, "skyprobe")
    return {
        "answer": sorted(answer),
        "state": state,
        "before": before,
        "after_second": after_second,
        "restored": restored,
        "alone_has_addon": alone_has_addon,
        "alone_relative_difference": float(np.abs(alone - lit).mean() / lit.mean()),
        "mean": lit.mean(axis=(0, 1)).tolist(),
    }


def state_of(scene):
    """Return what a user would find in the scene after a probe was rendered."""
    world = scene.world
    environment = world.node_tree.nodes["Skyprobe Environment"]
    suns = [thing for thing in scene.objects if thing.type == "LIGHT"]
    return {
        "world": world.name,
        "mist_start": world.mist_settings.start,
        "image_size": list(environment.image.size),
        "image_float": environment.image.is_float,
        "image_packed": environment.image.packed_file is not None,
        "color_space": environment.image.colorspace_settings.name,
        "importance": [world.cycles.sampling_method, world.cycles.sample_map_resolution],
        "sun_threshold": world.sun_threshold,
        "brightest": float(np.max(pixels_of(environment.image))),
        "lamps": [[lamp.data.energy, *lamp.data.color, lamp.data.angle] for lamp in suns],
    }


def pixels_of(image):
    """Return the pixels of `image`, (H, W, 3), row 0 at the top."""
    width, height = image.size
    flat = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(flat)
    return flat.reshape(height, width, -1)[::-1, :, :3]


def keep_as_file(folder):
    """Render probes that are kept as files, before and after the .blend has a place: of one minute with two airs, and the first again."""
    scene = set_up(storage="FILE", directory="//")
    message = error_of(bpy.ops.skyprobe.render)
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(folder) / "scene.blend"))
    rendered = []
    for preset in ("clear", "desert", "clear"):
        scene.skyprobe.preset = preset
        bpy.ops.skyprobe.render()
        image = scene.skyprobe.image
        mean = float(pixels_of(image).mean(dtype=np.float64))
        rendered.append({"filepath": image.filepath_raw, "packed": image.packed_file is not None, "size": list(image.size), "mean": mean})
    return {"unsaved": message, "rendered": rendered}


def error_of(operator):
    """Return the message with which `operator` fails, or an empty one."""
    try:
        operator()
    except RuntimeError as error:
        return str(error).strip()
    return ""


def mistakes(unwritable):
    """Try settings that cannot be used; tell the messages and whether anything changed."""
    cases = {
        "zone": {"zone_mode": "NAME", "zone_name": "Nowhere/Atlantis"},
        "day": {"month": 2, "day": 30},
        "folder": {"storage": "FILE", "directory": unwritable},
    }
    answers = {}
    for name, settings in cases.items():
        scene = set_up(**settings)
        scene.world = mine = grey_world()
        before = census()
        message = error_of(bpy.ops.skyprobe.render)
        answers[name] = {"message": message, "untouched": scene.world == mine and census() == before and not scene.skyprobe.sun_lamp}
    return answers


def choices():
    """Ask the library for every air that the panel offers; tell which it refuses."""
    enable()
    import skyprobe

    offered, values = part("choices"), part("values")
    refused = {}
    for keyword, items in (("preset", offered.PRESETS), ("aerosol", offered.AEROSOLS), ("ground", offered.GROUNDS)):
        for name, _, _ in items:
            if name == offered.OF_PRESET:
                continue
            try:
                skyprobe.Atmosphere(**{"preset": "clear", keyword: name})
            except ValueError as error:
                refused[f"{keyword} {name}"] = str(error)
    scene = set_up(filter_mode="HELD", filter_angle=np.radians(30.0), filter_azimuth=np.radians(90.0))
    for switch, name in values.OPTIONAL_AIR:
        setattr(scene.skyprobe, switch, True)
    for make, keywords in (
        (skyprobe.Atmosphere, values.air(scene.skyprobe)),
        (skyprobe.PolarisingFilter, values.polarising_filter(scene.skyprobe)),
    ):
        try:
            make(**keywords)
        except (TypeError, ValueError) as error:
            refused[make.__name__] = str(error)
    for when in ("auto", "always", "never"):
        for town, _, _ in offered.TOWNS:
            scene.skyprobe.night_when, scene.skyprobe.light_pollution = when, town
            try:
                skyprobe.Night(**values.night(scene.skyprobe))
            except (TypeError, ValueError) as error:
                refused[f"night {when} {town}"] = str(error)
    for name, _, _ in offered.LAYERS:
        setattr(scene.skyprobe, f"layer_{name}", 0.5)
    if sorted(values.layers(scene.skyprobe)) != sorted(name for name, _, _ in offered.LAYERS):
        refused["layers"] = str(values.layers(scene.skyprobe))
    return refused


def filtered():
    """Render a probe without and with a filter; tell how its mean changes, and what the filter was."""
    scene = set_up(sun_mode="LAMP")
    answer = {}
    for mode in ("NONE", "VIEW", "HELD"):
        scene.skyprobe.filter_mode = mode
        bpy.ops.skyprobe.render()
        upper = pixels_of(scene.skyprobe.image)[:128]
        answer[mode] = {"mean": float(upper.mean()), "keywords": part("values").polarising_filter(scene.skyprobe)}
    return answer


def nights():
    """Render a probe under the full Moon with each choice of the panel; tell the mean of its upper half, and the keywords as they come."""
    scene = set_up(year=2005, month=1, day=25, hour=0.5, sun_mode="MAP")
    answer = {"defaults": part("values").night(scene.skyprobe)}
    for name, settings in {
        "full_moon": {},
        "town": {"light_pollution": "8", "solar_flux": 200.0, "star_limit": 6.5},
        "never": {"night_when": "never"},
    }.items():
        for key, value in settings.items():
            setattr(scene.skyprobe, key, value)
        bpy.ops.skyprobe.render()
        answer[name] = float(pixels_of(scene.skyprobe.image)[:128].mean())
        answer[f"{name}_keywords"] = part("values").night(scene.skyprobe)
    return answer


def time_texts():
    """Return the time that the settings mean, in each way to give the zone."""
    scene = set_up(year=2025, month=6, day=21, hour=13.5, zone_name="Europe/Stockholm", utc_offset=-3.5)
    texts = {}
    for mode in ("PLACE", "NAME", "OFFSET"):
        scene.skyprobe.zone_mode = mode
        texts[mode] = part("values").time(scene.skyprobe)
    return texts


def threads(folder):
    """Run one job on its thread to the end and cancel another; tell how each ended and which files there are."""
    scene = set_up(storage="FILE", directory=folder)
    jobs, values = part("jobs"), part("values")

    def job():
        return jobs.ProbeJob(values.final_request(scene), values.probe_path(scene.skyprobe))

    first = job()
    first.start()
    first.join()
    scene.skyprobe.width = 2048
    second = job()
    second.cancel()
    second.start()
    second.join()
    return {
        "first": [type(first.error).__name__, first.result is not None],
        "second": [type(second.error).__name__, second.result is not None],
        "files": [path.name for path in Path(folder).iterdir()],
        "written": Path(first.path).name,
    }


def light_with_sun(scene, altitude_deg, azimuth_deg, width, sun_in_map):
    """Light `scene` by a Sun in a given direction, by the extension's own code; return its skyprobe.Sky."""
    import skyprobe

    jobs = part("jobs")
    air = load_scene()["air"]
    sky = skyprobe.Sky.with_sun(
        altitude_deg=altitude_deg, azimuth_deg=azimuth_deg, elevation_m=0, atmosphere=jobs.atmosphere(air)
    )
    path = str(Path(bpy.app.tempdir) / "probe.exr")
    request = jobs.SkyRequest(
        air=air, place={}, time="", width=width, sun_in_map=sun_in_map, lamp_color_space="lin_rec709"
    )
    probe, result = jobs.render(sky, request)
    probe.save(path)
    part("scene_probe").show_probe(scene, result, path, pack=True)
    return sky


def shadows(sun_in_map):
    """Return [Sun azimuth, azimuth of the pole's shadow] for each azimuth of scene.json."""
    data = load_scene()
    scene = set_up(["plane", "pole"], "top_camera")
    measured = []
    for azimuth in data["sun"]["shadow_azimuths_deg"]:
        light_with_sun(scene, data["sun"]["altitude_deg"], azimuth, data["probe_width"], sun_in_map)
        measured.append([azimuth, analysis.shadow_azimuth_deg(picture_of(scene, 16), data["top_camera"])])
    return measured


def turned_shadow(north_deg):
    """Return the shadow's azimuth after north is turned under a finished probe, as lamp and in the map."""
    data = load_scene()
    answer = {}
    for sun_in_map in (False, True):
        scene = set_up(["plane", "pole"], "top_camera")
        light_with_sun(scene, data["sun"]["altitude_deg"], 110.0, data["probe_width"], sun_in_map)
        scene.skyprobe.north = np.radians(north_deg)
        answer["map" if sun_in_map else "lamp"] = analysis.shadow_azimuth_deg(picture_of(scene, 16), data["top_camera"])
    return answer


def white_plane(altitude_deg, width, sun_in_map, samples):
    """Return the mean radiance of the white plane and the irradiance of the same sky's probe with the Sun's disc in it."""
    data = load_scene()
    scene = set_up(["plane"], "top_camera")
    scene.render.resolution_x = scene.render.resolution_y = 48
    sky = light_with_sun(scene, altitude_deg, 200.0, width, sun_in_map)
    picture = picture_of(scene, samples)
    probe = sky.render(width=width, scale="blender", color_space="lin_rec709", sun_disc=True)
    return {
        "radiance": picture.mean(axis=(0, 1), dtype=np.float64).tolist(),
        "irradiance": analysis.horizontal_irradiance(np.asarray(probe.pixels), "centre").tolist(),
        "reflectance": data["materials"]["white"]["reflectance"],
    }


def lamp_or_disc(width, samples):
    """Light a white sphere on a white plane by the Sun as a lamp and in a map of `width`; tell what each sees.

    Radiance of the plane, and of the sphere in bands of the angle between normal and Sun, whose edges are BANDS [degrees].
    """
    data = load_scene()
    answer = {}
    for sun_in_map in (False, True):
        scene = set_up(["plane"], "top_camera")
        view, radius = data["top_camera"], 0.3 * data["top_camera"]["width"]
        bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=radius, location=(0.0, 0.0, radius))
        bpy.ops.object.shade_smooth()
        bpy.context.object.data.materials.append(bpy.data.materials["white"])
        scene.render.resolution_x = scene.render.resolution_y = 160
        sky = light_with_sun(scene, 40.0, 200.0, width, sun_in_map)
        picture = picture_of(scene, samples).mean(axis=2, dtype=np.float64)
        # The camera looks straight down, its columns to the east, its rows to the south.
        across = (np.arange(160) + 0.5 - 80.0) * view["width"] / 160.0
        x, y = np.meshgrid(across, -across)
        square = x**2 + y**2
        normal = np.stack([x, y, np.sqrt(np.maximum(radius**2 - square, 0.0))], axis=2) / radius
        cosine = normal @ np.array(sky.sun.apparent_direction)
        angle = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
        ball = square < (0.98 * radius) ** 2
        bands = [float(picture[ball & (angle >= low) & (angle < high)].mean()) for low, high in zip(BANDS, BANDS[1:])]
        # Towards the Sun the plane is lit by the Sun and most of the sky.
        sunny = (square > (1.4 * radius) ** 2) & (x * sky.sun.apparent_direction[0] + y * sky.sun.apparent_direction[1] > 0.0)
        answer["map" if sun_in_map else "lamp"] = {"plane": float(picture[sunny].mean()), "bands": bands}
    return answer


BANDS = (0.0, 20.0, 40.0, 60.0, 75.0, 82.0, 86.0, 88.0, 90.0, 92.0, 94.0, 98.0, 105.0, 120.0)
