"""What tests/blender/test_faces.py lets Blender do. Each function runs in a process of its own (hosts.run)."""

import json
import math
import subprocess
from pathlib import Path

import bpy
import numpy as np
import random_scenes
import skyprobe
from agreement_steps import pixels_at
from skyprobe import places
from steps import part, set_up

SEED = 20050621
# Day, twilight and night, with what each has: scenes that every face can say.
SCENES = (
    {"latitude": 55.71, "longitude": 13.19, "time": "2005-06-21T13:00", "atmosphere": {"aerosol": "urban", "turbidity": 4.5}},
    {"place": "Santorini", "time": "2024-03-01T18:20+02:00", "layers": {"sky": 0.5}, "polarising_filter": {"angle_deg": 30.0}},
    {"latitude": -24.6272, "longitude": -70.4042, "elevation_m": 2635, "time": "2005-07-06T00:00", "zone": "America/Santiago"}
    | {"night": {"bortle": 6, "star_limit": 4.5}, "layers": {"stars": 3.0}, "atmosphere": {"ground": "desert"}},
)


def said_in_settings(count):
    """Import `count` random scenes into a panel that was reset; tell what went wrong, what was varied, and what cannot be said."""
    scene = set_up()
    settings, configuration = scene.skyprobe, part("configuration")
    default = random_scenes.by_way(skyprobe.Scene().to_dict())
    wrong, varied, refused, told = [], set(), set(), set()
    for document in random_scenes.scenes(SEED, count):
        bpy.ops.skyprobe.reset()
        content = skyprobe.Scene(**document).to_dict()
        while True:
            before = {name: getattr(settings, name) for name in ("latitude", "preset", "width", "star_limit", "hour")}
            try:
                notes = configuration.to_settings(content, settings)
                break
            except ValueError as error:
                way = random_scenes.way_of(error)
                # What the library refuses has lost what it goes with.
                if not isinstance(error, skyprobe.InputError):
                    refused.add(way)
                if before != {name: getattr(settings, name) for name in before}:
                    wrong.append(f"half of it was applied: {error}")
                if not random_scenes.remove(content, way):
                    wrong.append(f"not there: {error}")
                    notes = []
                    break
        wanted = random_scenes.by_way(skyprobe.Scene(**content).to_dict())
        found = random_scenes.by_way(skyprobe.Scene(**json.loads(json.dumps(configuration.from_settings(settings)))).to_dict())
        of_files = {way for way in wanted if wanted[way] != default.get(way) and any(note.startswith(f"{way} = ") for note in notes)} - {"time"}
        told |= of_files
        if "time" in wanted:
            instants = {_instant(values) for values in (wanted, found)}
            if len(instants) != 1:
                wrong.append(f"time: {content}")
        for way in wanted.keys() - of_files - {"time", "zone"}:
            if not _is_same(found.get(way), wanted[way]):
                wrong.append(f"{way}: {wanted[way]} came back as {found.get(way)}")
        varied |= {way for way in wanted.keys() - of_files if wanted[way] != default.get(way)}
    return {"wrong": wrong, "varied": sorted(varied), "refused": sorted(refused), "told": sorted(told)}


def _is_same(found, wanted):
    """Tell whether two values are the same, numbers as far as single precision tells them apart."""
    if isinstance(wanted, list) and isinstance(found, list):
        return all(_is_same(*pair) for pair in zip(found, wanted, strict=True))
    if isinstance(wanted, float) and isinstance(found, float):
        return math.isclose(found, wanted, rel_tol=1e-7, abs_tol=1e-5)
    return found == wanted


def _instant(values):
    zone = {"zone": values["zone"]} if "zone" in values else {}
    return places.civil_time(values["time"], values["latitude"], values["longitude"], **zone).time


def pictures(folder, binary):
    """Render each of SCENES by the panel, by the module and by the tool at `binary`; tell how far they are apart relative to the mean."""
    scene = set_up()
    settings, configuration, jobs, values = scene.skyprobe, part("configuration"), part("jobs"), part("values")
    answer = []
    for number, keys in enumerate(SCENES):
        bpy.ops.skyprobe.reset()
        drafted = {**keys, "atmosphere": {**keys.get("atmosphere", {}), "quality": "draft"}, "probe": {"width": 96, "sun_disc": True}}
        notes = configuration.to_settings(drafted, settings)
        stem = Path(folder) / f"{number}"
        sky = skyprobe.Scene(**drafted)
        sky.save(f"{stem}.json")
        sky.render_to_files([f"{stem}_module.exr"])
        jobs.write(values.final_request(scene), f"{stem}_panel.exr")
        command = [binary, "render", "--config", f"{stem}.json", "-o", f"{stem}_tool.exr"]
        subprocess.run(command, check=True, capture_output=True, text=True)
        panel, module, tool = (pixels_at(f"{stem}_{who}.exr") for who in ("panel", "module", "tool"))
        answer.append({
            "notes": notes,
            "panel": float(np.abs(panel - tool).max() / tool.mean()),
            "module": float(np.abs(module - tool).max() / tool.mean()),
        })
    return answer
