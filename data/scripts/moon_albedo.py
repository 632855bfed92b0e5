"""Rebuilds data/moon_albedo.png from the Moon map in npm globe.gl (needs npm, numpy, pillow).

The map is `lroc_color_poles` of the CGI Moon Kit (NASA's Scientific Visualization Studio, 2019, image 4720): mosaic of the Lunar Reconnaissance
Orbiter's wide angle camera, normalised to one geometry of light with Hapke's function, poleward of 70 degrees filled from LRO's laser altimeter.
Its makers say how reflectance became a number of 8 bits: power 1 / 2.8, times 0.935, 1.005, 1.04 (red 643 nm, green 532 nm, blue 472 nm), and
0.16 to 0.4 mapped to 0 to 255. Here that is undone.
"""

import subprocess
import tarfile
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

from packages import DATA

PACKAGE = "globe.gl@2.46.2"
MEMBER = "package/example/moon-landing-sites/lunar_surface.jpg"
WIDTH, HEIGHT = 1024, 512
GAINS = (0.935, 1.005, 1.04)
# Weights of the three bands in what the eye sees as brightness (chosen; the maps differ little).
WEIGHTS = (0.3, 0.6, 0.1)


def reflectance(pixels: np.ndarray) -> np.ndarray:
    """Linear reflectance, up to a factor, of pixels of 8 bits."""
    shown = 0.16 + pixels.astype(np.float32) / 255 * (0.4 - 0.16)
    bands = [weight * (shown[..., i] / gain) ** 2.8 for i, (weight, gain) in enumerate(zip(WEIGHTS, GAINS))]
    return sum(bands)


def box_mean(values: np.ndarray, size: int, axis: int) -> np.ndarray:
    """Means over `size` equal intervals of an axis, whose ends may lie within pixels."""
    count = values.shape[axis]
    integral = np.concatenate([np.zeros_like(np.take(values, [0], axis)), np.cumsum(values, axis, dtype=np.float64)], axis)
    edges = np.arange(size + 1) * count / size
    low = np.minimum(edges.astype(int), count - 1)
    shape = [1, 1]
    shape[axis] = -1
    part = (edges - low).reshape(shape)
    at_edges = np.take(integral, low, axis) * (1 - part) + np.take(integral, low + 1, axis) * part
    return np.diff(at_edges, axis=axis) * size / count


def main():
    folder = Path(tempfile.mkdtemp(prefix="skyprobe-data-"))
    subprocess.run(["npm", "pack", "--silent", PACKAGE], cwd=folder, check=True)
    with tarfile.open(next(folder.glob("*.tgz"))) as archive:
        picture = Image.open(archive.extractfile(MEMBER)).convert("RGB")
    rows = np.array_split(np.asarray(picture), 16)
    linear = np.concatenate([box_mean(reflectance(part), WIDTH, 1) for part in rows])
    linear = box_mean(linear, HEIGHT, 0)
    print("reflectance, up to a factor: least, mean, greatest", linear.min(), linear.mean(), linear.max())
    pixels = np.round(255 * np.sqrt(linear / linear.max())).astype(np.uint8)
    Image.fromarray(pixels, "L").save(DATA / "moon_albedo.png", optimize=True)
    for name, longitude, latitude in [("Mare Crisium", 59, 17), ("Tycho", -11.2, -43.3), ("Oceanus Procellarum", -55, 15), ("Descartes", 15.5, -9)]:
        column, row = int((longitude / 360 + 0.5) * WIDTH), int((0.5 - latitude / 180) * HEIGHT)
        print(f"{name}: {linear[row - 1 : row + 2, column - 1 : column + 2].mean() / linear.mean():.3f} of the mean")


if __name__ == "__main__":
    main()
