"""Rebuilds data/terrain.png: height of the land, means over 10 arcminutes.

The source has 5 arcminutes in 255 steps of 28 m from -450 m on, and no value at sea. Here pixel 0 is the sea, and pixel p stands for
28 (p - 1) - 450 metres. A cell is land if at least half of it is, and has the mean of its land. The source ends at 85 degrees south; its
last row stands for what lies beyond.
"""

import h5py
import numpy as np
from packages import DATA, unpack_from_pypi
from PIL import Image

NO_DATA, STEP_M, LOWEST_M = 255, 28.0, -450.0


def means():
    """Heights [m] and whether there is land, rows from 90 to -90, columns from -180 degrees."""
    with h5py.File(unpack_from_pypi("pvlib==0.16.1") / "pvlib/data/Altitude.h5") as file:
        codes = file["Altitude"][:]
    height, width = codes.shape[0] // 2, codes.shape[1] // 2
    blocks = codes.reshape(height, 2, width, 2).astype(float)
    is_land = blocks != NO_DATA
    count = is_land.sum(axis=(1, 3))
    total = np.where(is_land, blocks * STEP_M + LOWEST_M, 0.0).sum(axis=(1, 3))
    heights, land = total / np.maximum(count, 1), count >= 2
    last = np.flatnonzero(land.any(axis=1))[-1]
    heights[last + 1 :], land[last + 1 :] = heights[last], land[last]
    return heights, land


def main():
    heights, land = means()
    pixels = np.where(land, np.round((heights - LOWEST_M) / STEP_M) + 1.0, 0.0).astype(np.uint8)
    Image.fromarray(pixels).save(DATA / "terrain.png", optimize=True)
    print(f"data/terrain.png: {pixels.shape[1]} x {pixels.shape[0]}, {100.0 * land.mean():.1f} % land, up to {heights.max():.0f} m")


if __name__ == "__main__":
    main()
