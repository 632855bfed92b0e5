"""What tests/blender/test_agreement.py lets Blender do. Each function runs in a process of its own (hosts.run)."""

import os
import subprocess
from pathlib import Path

import bpy
import numpy as np
from steps import part, pixels_of, set_up

# The night of the full Moon in which the settings of the night are tried.
NIGHT = {"year": 2005, "month": 1, "day": 25, "hour": 0.5}
TOKYO = {"zone_mode": "NAME", "zone_name": "Asia/Tokyo"}
# What is changed in each case. Together they change every setting that the light depends on.
CASES = {
    "as it is": {},
    "latitude": {"latitude": np.radians(-24.6272)},
    "longitude": {"longitude": np.radians(-70.4042)},
    "elevation": {"elevation_m": 2635.0},
    "year, month and day": {"year": 2031, "month": 2, "day": 28},
    "hour": {"hour": 18.2517},
    "time offset": {"time_offset_h": 9.0},
    "time offset to the second of two hours": {"month": 10, "day": 26, "hour": 1.5, "time_offset_h": 2.0, **NIGHT, "year": 2025, "night_when": "always"},
    "zone by name": TOKYO,
    "zone by name and time offset": {**TOKYO, "time_offset_h": -3.25},
    "zone by offset": {"zone_mode": "OFFSET", "utc_offset": -3.5},
    "zone by offset and time offset": {"zone_mode": "OFFSET", "utc_offset": 5.75, "time_offset_h": 3.0},
    "preset": {"preset": "desert"},
    "aerosol": {"aerosol": "urban"},
    "optical depth": {"haze": "aod550", "aod550": 0.3},
    "turbidity": {"haze": "turbidity", "turbidity": 4.5},
    "visibility": {"haze": "visibility_km", "visibility_km": 12.5},
    "ozone": {"use_ozone": True, "ozone_du": 500.0},
    "humidity": {"use_humidity": True, "relative_humidity": 95.0},
    "volcanic haze": {"use_stratosphere": True, "stratospheric_aod550": 0.1},
    "ground": {"ground": "snow"},
    "quality": {"quality": "standard"},
    "filter": {"filter_mode": "VIEW", "filter_strength": 0.75, "filter_angle": np.radians(30.0)},
    "held filter": {"filter_mode": "HELD", "filter_altitude": np.radians(10.0), "filter_azimuth": np.radians(200.0)},
    "width": {"width": 96},
    "width by name": {"width_choice": "1024"},
    "Sun in the map": {"sun_mode": "MAP"},
    "layer sky": {"layer_sky": 0.5},
    "layer sun": {"layer_sun": 2.0, "sun_mode": "MAP"},
    "night": NIGHT,
    "when": {**NIGHT, "night_when": "never"},
    "star limit": {**NIGHT, "star_limit": 4.5},
    "airglow": {**NIGHT, "solar_flux": 200.0},
    "town light": {**NIGHT, "light_pollution": "6"},
    "lamps of the town": {**NIGHT, "light_pollution": "6", "led_share": 1.0},
    "Moon as a lamp": {**NIGHT, "moon_mode": "LAMP", "layer_moon": 3.0},
    "layer Moon": {**NIGHT, "layer_moon": 3.0},
    "layer stars": {**NIGHT, "layer_stars": 20.0},
    "layer planets": {**NIGHT, "layer_planets": 20.0},
    "layer Milky Way": {**NIGHT, "layer_milky_way": 20.0},
    "layer zodiacal light": {**NIGHT, "layer_zodiacal": 20.0},
    "layer airglow": {**NIGHT, "layer_airglow": 1e-6},
    "layer town light": {**NIGHT, "light_pollution": "6", "layer_light_pollution": 3.0},
}
# What the light of the map does not depend on.
OTHER = {
    "rna_type", "name", "place", "day_of_year", "north", "storage", "directory", "sequence_directory", "live", "preview_width", "auto_exposure",
    "exposure_offset", "show_diurnal_path", "show_analemma", "show_north", "helper_size",
}


def compare(folder, binary):
    """Render each case by the add-on and, from its exported configuration, by the command line tool at `binary`, and import that again.

    Tell of each: the mean, the greatest difference relative to the mean, and the settings that came back other than they went.
    """
    scene = set_up()
    settings, jobs, values = scene.skyprobe, part("jobs"), part("values")
    answer = {"untried": sorted(set(settings.bl_rna.properties.keys()) - OTHER - part("settings").MADE - {name for case in CASES.values() for name in case})}
    for number, (name, changes) in enumerate(CASES.items()):
        bpy.ops.skyprobe.reset()
        for key, value in {"quality": "draft", "width_choice": "OTHER", "width": 64, **changes}.items():
            setattr(settings, key, value)
        stem = Path(folder) / f"{number}"
        bpy.ops.skyprobe.export_configuration(filepath=f"{stem}.json")
        request = values.final_request(scene)
        jobs.write(request, f"{stem}_addon.exr")
        command = [binary, "render", "--config", f"{stem}.json", "-o", f"{stem}_tool.exr"]
        run = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "SKYPROBE_CACHE": "off"})
        if run.returncode != 0:
            answer[name] = run.stderr
            continue
        ours, theirs = (pixels_at(f"{stem}_{who}.exr") for who in ("addon", "tool"))
        bpy.ops.skyprobe.reset()
        bpy.ops.skyprobe.import_configuration(filepath=f"{stem}.json")
        again = values.final_request(scene)
        answer[name] = {
            "mean": float(ours.mean(dtype=np.float64)),
            "difference": float(np.abs(ours - theirs).max() / max(ours.mean(), 1e-12)) if ours.shape == theirs.shape else f"{ours.shape} is not {theirs.shape}",
            "lost": [key for key in vars(request) if getattr(request, key) != getattr(again, key) and key != "time"],
            "time": abs((_instant(request) - _instant(again)).total_seconds()),
        }
    return answer


def _instant(request):
    from skyprobe import places

    return places.civil_time(request.time, request.place["latitude"], request.place["longitude"]).time


def pixels_at(path):
    """Return the numbers of the picture at `path` as Blender reads them."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Linear Rec.709"
    pixels = pixels_of(image).copy()
    bpy.data.images.remove(image)
    return pixels
