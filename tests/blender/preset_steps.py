"""What the tests let Blender do with presets and configurations. Each function runs in a process of its own (hosts.run)."""

import json
from pathlib import Path

import bpy
import numpy as np
from steps import error_of, part, set_up

# A setting of each kind, other than its default.
CHANGED = {
    "latitude": np.radians(-24.6272),
    "longitude": np.radians(-70.4042),
    "elevation_m": 2635.0,
    "year": 2031,
    "month": 2,
    "day": 28,
    "hour": 21.75,
    "zone_mode": "NAME",
    "zone_name": "America/Santiago",
    "preset": "maritime",
    "aerosol": "desert",
    "haze": "visibility_km",
    "visibility_km": 12.5,
    "use_ozone": True,
    "ozone_du": 250.0,
    "use_humidity": True,
    "relative_humidity": 70.0,
    "use_stratosphere": True,
    "stratospheric_aod550": 0.02,
    "ground": "snow",
    "quality": "high",
    "night_when": "always",
    "star_limit": 6.5,
    "solar_flux": 180.0,
    "light_pollution": "4",
    "led_share": 0.25,
    "layer_stars": 2.0,
    "layer_airglow": 0.0,
    "filter_mode": "HELD",
    "filter_strength": 0.75,
    "filter_angle": np.radians(30.0),
    "filter_altitude": np.radians(10.0),
    "filter_azimuth": np.radians(200.0),
    "width_choice": "OTHER",
    "width": 300,
    "sun_mode": "MAP",
}


# Times in each spelling that the command line takes, with the key `zone` after " in ".
TIMES = (
    "2024-02-29T06:30",
    "2024-02-29 06:30",
    "2024-02-29T06",
    "2024-02-29T06:30:15-03:30",
    "2024-02-29T06:30+02",
    "2024-02-29T06:30Z",
    "2024-02-29T06:30[Asia/Tokyo]",
    "2005-06-21T13:00Z[Europe/Stockholm]",
    "2005-06-21T13:00Z in Europe/Stockholm",
    "2005-06-21T13:00 in Asia/Tokyo",
    # The first and the second of an hour that comes twice.
    "2005-10-30T02:30+02:00[Europe/Stockholm]",
    "2005-10-30T02:30+01:00[Europe/Stockholm]",
    # Offsets that the panel cannot hold.
    "1850-06-21T12:00:00+01:12:12",
    "2005-06-21T12:00+18:00",
)


def round_trip(path):
    """Export all settings, reset them, import them again; tell what the configuration says and which settings differ."""
    scene = set_up(**CHANGED)
    settings = scene.skyprobe
    before = {name: getattr(settings, name) for name in CHANGED}
    bpy.ops.skyprobe.export_configuration(filepath=path)
    bpy.ops.skyprobe.reset()
    reset = [name for name in CHANGED if settings.is_property_set(name)]
    bpy.ops.skyprobe.import_configuration(filepath=path)
    after = {name: getattr(settings, name) for name in CHANGED}
    different = {
        name: [before[name], after[name]]
        for name in CHANGED
        if (before[name] != after[name] if isinstance(before[name], (str, bool)) else abs(before[name] - after[name]) > 1e-4)
    }
    return {"different": different, "reset": reset}


def offset_times():
    """Import times in each spelling; tell how the settings then stand."""
    scene = set_up()
    settings = scene.skyprobe
    configuration = part("configuration")
    answer = {}
    for text in TIMES:
        time, _, zone = text.partition(" in ")
        configuration.to_settings({"time": time, **({"zone": zone} if zone else {})}, settings)
        answer[text] = [settings.zone_mode, settings.zone_name, round(settings.utc_offset, 3), part("values").time(settings)]
    return answer


def shipped():
    """Apply each preset that comes with the add-on and show it; tell the light on the ground, and the text of each."""
    scene = set_up()
    presets, live = part("presets"), part("live")
    answer = {}
    for title, path in presets.all_of(presets.OURS):
        bpy.ops.skyprobe.reset()
        scene.skyprobe.preview_width = 128
        presets.apply(scene, path)
        live.update_now(scene, final=False)
        answer[title] = {"lx": live.readout(scene).result.horizontal_lx, "text": Path(path).read_text(encoding="utf-8")}
    return answer


def own():
    """Save, apply and delete a preset of the user's that holds the air alone."""
    scene = set_up(preset="desert", month=1)
    presets = part("presets")
    title = "Ögonblick \N{SUN BEHIND CLOUD}"
    bpy.ops.skyprobe.save_preset(title=title, sections={"air"})
    path = dict(presets.all_of(presets.own_folder()))[title]
    content = json.loads(Path(path).read_text(encoding="utf-8"))
    scene.skyprobe.preset, scene.skyprobe.month = "clear", 7
    bpy.ops.skyprobe.apply_preset(filepath=path)
    applied = [scene.skyprobe.preset, scene.skyprobe.month]
    bpy.ops.skyprobe.delete_preset(title=title)
    return {
        "content": content,
        "applied": applied,
        "left": [name for name, _ in presets.all_of(presets.own_folder())],
        "bad_name": error_of(lambda: bpy.ops.skyprobe.save_preset(title="a/b")),
    }


def told():
    """Import a configuration with all that Blender does without; return what is told of it."""
    scene = set_up()
    content = {
        "place": "Lund, Sweden",
        "time": "2005-03-27T02:30",
        "tolerance": 0.01,
        "probe": {"width": 512, "rows": "corner", "turn_deg": 90.0, "scale": "mitsuba", "color_space": "acescg", "gamut": "keep"},
        "file": {"half": "scale", "exposure_stops": 1.0, "operator": "aces", "layers": True},
        "output": ["sky.exr", "sky.png"],
    }
    notes = part("configuration").to_settings(content, scene.skyprobe)
    return {"notes": notes, "width": scene.skyprobe.width, "latitude": float(np.degrees(scene.skyprobe.latitude)), "hour": scene.skyprobe.hour}


def dumped(path):
    """Import what --dump-config wrote into a scene with other layers and a filter; tell the settings that then count, and what was told."""
    scene = set_up(**CHANGED)
    with open(path, encoding="utf-8") as file:
        notes = part("configuration").to_settings(json.load(file), scene.skyprobe)
    values = part("values")
    return {
        "notes": notes,
        "layers": values.layers(scene.skyprobe),
        "filter": values.polarising_filter(scene.skyprobe),
        "air": values.air(scene.skyprobe),
        "place": values.place(scene.skyprobe),
        "time": values.time(scene.skyprobe),
    }


def refused(folder):
    """Import files that make no sense; tell the messages and whether a setting changed."""
    scene = set_up(month=5, preset="hazy")
    answer = {}
    for name, text in {
        "not JSON": "{",
        "a list": "[1]",
        "an unknown key": '{"month": 3}',
        "an unknown preset": '{"time": "2025-01-01T00:00", "atmosphere": {"preset": "stormy"}}',
        "a text for a number": '{"time": "2025-01-01T00:00", "latitude": "north"}',
        "a latitude too far": '{"time": "2025-01-01T00:00", "latitude": 95}',
        "no such date": '{"time": "2025-02-30T00:00"}',
        "two amounts of haze, one negative": '{"time": "2025-01-01T00:00", "atmosphere": {"aod550": -1}}',
        "another model": '{"model": "preetham"}',
        "another theory of the Sun": '{"sun_model": "thesis"}',
        "a Sun that is put": '{"sun": {"altitude_deg": 30, "azimuth_deg": 180}}',
        "another projection": '{"probe": {"projection": "fisheye"}}',
        "the upper half": '{"probe": {"extent": "upper"}}',
        "a mirrored ground": '{"probe": {"ground": "mirrored"}}',
        "light without polarisation": '{"atmosphere": {"polarisation": false}}',
        "chosen wavelengths": '{"atmosphere": {"wavelengths_nm": [500, 600]}}',
        "a ground by its albedo": '{"atmosphere": {"ground": 0.3}}',
        "a layer as bright as no property": '{"layers": {"stars": 1e8}}',
        "towns by their brightness": '{"night": {"zenith_brightness": 20}}',
        "a scattering function": '{"atmosphere": {"asymmetry": 0.5}}',
        "a night that is never shown": '{"night": {"when": "never", "bortle": 4}}',
        "a place twice": '{"place": "Lund, Sweden", "latitude": 10}',
        "two amounts of haze": '{"atmosphere": {"aod550": 0.1, "turbidity": 3}}',
        "a key that is there twice": '{"atmosphere": {"preset": "fog", "preset": "clear"}}',
        "no such zone": '{"time": "2025-06-21T13:00[Nowhere/Atlantis]"}',
        "not UTF-8": "\udcff",
    }.items():
        path = Path(folder) / "bad.json"
        path.write_bytes(text.encode("utf-8", "surrogateescape"))
        message = error_of(lambda: bpy.ops.skyprobe.import_configuration(filepath=str(path)))
        answer[name] = {"message": message, "unchanged": [scene.skyprobe.month, scene.skyprobe.preset] == [5, "hazy"]}
    return answer
