"""The test scene of scene.json in plain geometry: through which ray a pixel looks, and what it sees.

Both renderers' tests use it, so neither judges itself. Pictures are (H, W, 3) arrays, row 0 at the top. Needs numpy only.
"""

import json
import math
from pathlib import Path

import numpy as np

SCENE_FILE = Path(__file__).resolve().parent / "scene.json"
SKY = ""


def load_scene():
    """Return the content of scene.json."""
    return json.loads(SCENE_FILE.read_text(encoding="utf-8"))


def pixel_rays(camera):
    """Return (origins, directions), each (H, W, 3), of the rays through the pixel centres of `camera`."""
    width, height = camera["resolution"]
    origin, target, up = (np.array(camera[name], dtype=float) for name in ("origin", "target", "up"))
    forward = (target - origin) / np.linalg.norm(target - origin)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    above = np.cross(right, forward)
    x = ((np.arange(width) + 0.5) / width - 0.5)[None, :, None]
    y = (0.5 - (np.arange(height) + 0.5) / height)[:, None, None] * height / width
    if camera["type"] == "orthographic":
        origins = origin + camera["width"] * (x * right + y * above)
        return origins, np.broadcast_to(forward, origins.shape)
    breadth = 2.0 * math.tan(math.radians(camera["horizontal_fov_deg"]) / 2.0)
    directions = forward + breadth * (x * right + y * above)
    return np.broadcast_to(origin, directions.shape), directions / np.linalg.norm(directions, axis=2, keepdims=True)


def first_hit(scene, origins, directions):
    """Return (H, W) names of the objects that the rays meet first; SKY for none."""
    distances = {
        "plane": _plane_distance(scene["plane"], origins, directions),
        "pole": _cylinder_distance(scene["pole"], origins, directions),
        "box": _box_distance(scene["box"], origins, directions),
        "metal_sphere": _sphere_distance(scene["metal_sphere"], origins, directions),
        "glass_sphere": _sphere_distance(scene["glass_sphere"], origins, directions),
    }
    names = np.array([*distances, SKY])
    nearest = np.stack([*distances.values(), np.full(directions.shape[:2], 1e9)])
    return names[np.argmin(nearest, axis=0)]


def diffuse_mask(scene):
    """Return (H, W) bool: the pixels of the camera that see a single diffuse object, without the edges."""
    seen = first_hit(scene, *pixel_rays(scene["camera"]))
    inside = np.zeros(seen.shape, dtype=bool)
    core = seen[1:-1, 1:-1]
    inside[1:-1, 1:-1] = np.logical_and.reduce(
        [core == seen[1 + i : seen.shape[0] - 1 + i, 1 + j : seen.shape[1] - 1 + j] for i in (-1, 0, 1) for j in (-1, 0, 1)]
    )
    diffuse = [
        name for name, part in scene.items()
        if isinstance(part, dict) and "material" in part and scene["materials"][part["material"]]["type"] == "diffuse"
    ]
    return inside & np.isin(seen, diffuse)


def angle_between_azimuths_deg(first, second):
    """Return the smaller angle between two azimuths, 0 to 180 degrees."""
    return abs((first - second + 180.0) % 360.0 - 180.0)


def _plane_distance(plane, origins, directions):
    centre, half = plane["centre"], plane["size"] / 2.0
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (centre[2] - origins[..., 2]) / directions[..., 2]
    point = origins + np.where(np.isfinite(t), t, 0.0)[..., None] * directions
    on = (np.abs(point[..., 0] - centre[0]) <= half) & (np.abs(point[..., 1] - centre[1]) <= half)
    return np.where(on & (t > 0.0) & np.isfinite(t), t, np.inf)


def _sphere_distance(sphere, origins, directions):
    offset = origins - np.array(sphere["centre"])
    half = (offset * directions).sum(axis=2)
    root = half**2 - (offset**2).sum(axis=2) + sphere["radius"] ** 2
    t = -half - np.sqrt(np.maximum(root, 0.0))
    return np.where((root > 0.0) & (t > 0.0), t, np.inf)


def _slab(lower, upper, origins, directions, axis):
    with np.errstate(divide="ignore", invalid="ignore"):
        one = (lower - origins[..., axis]) / directions[..., axis]
        two = (upper - origins[..., axis]) / directions[..., axis]
    return np.fmin(one, two), np.fmax(one, two)


def _box_distance(box, origins, directions):
    enter, leave = 0.0, np.inf
    for axis in range(3):
        middle, half = box["centre"][axis], box["size"][axis] / 2.0
        near, far = _slab(middle - half, middle + half, origins, directions, axis)
        enter, leave = np.fmax(enter, near), np.fmin(leave, far)
    return np.where(enter < leave, enter, np.inf)


def _cylinder_distance(pole, origins, directions):
    x, y = origins[..., 0] - pole["base"][0], origins[..., 1] - pole["base"][1]
    dx, dy = directions[..., 0], directions[..., 1]
    a, b, c = dx**2 + dy**2, x * dx + y * dy, x**2 + y**2 - pole["radius"] ** 2
    root = np.sqrt(np.maximum(b**2 - a * c, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        enter = np.where(a > 0.0, (-b - root) / a, np.where(c < 0.0, -np.inf, np.inf))
        leave = np.where(a > 0.0, (-b + root) / a, np.where(c < 0.0, np.inf, -np.inf))
    near, far = _slab(pole["base"][2], pole["base"][2] + pole["height"], origins, directions, 2)
    enter, leave = np.maximum(np.maximum(enter, near), 0.0), np.minimum(leave, far)
    return np.where((b**2 - a * c >= 0.0) & (enter < leave), enter, np.inf)
