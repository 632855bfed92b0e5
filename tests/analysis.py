"""What the tests measure in probes and pictures.

Everything here is plain numpy and knows neither renderer; what the scene itself looks like is in scene_geometry.py. Frame: x east, y north, z up. Probes are latitude-longitude images of
shape (H, W, 3), row 0 at the zenith, column u = 1/4 + azimuth / 360; pictures have shape (H, W, 3), row 0 at the top. `rows` says where
the rows of a probe lie: "centre" means theta_j = pi (j + 1/2) / H (Blender), "corner" means theta_j = pi j / (H - 1) (Mitsuba).
"""

import numpy as np
from scene_geometry import angle_between_azimuths_deg, pixel_rays


def row_angles(height, rows):
    """Angle from the zenith of each row's own direction [rad], shape (height,)."""
    row = np.arange(height)
    if rows == "centre":
        return np.pi * (row + 0.5) / height
    if rows == "corner":
        return np.pi * row / (height - 1)
    raise ValueError(f'rows = {rows!r}: must be "centre" or "corner"')


def row_edges(height, rows):
    """Angles from the zenith between which each row's pixels lie [rad], shape (height + 1,), from 0 to pi.

    On the corners the first and the last row are half as high as the others.
    """
    if rows == "corner":
        return np.clip(np.pi * (np.arange(height + 1) - 0.5) / (height - 1), 0.0, np.pi)
    return np.concatenate([[0.0], row_angles(height, rows)[:-1] + 0.5 * np.pi / height, [np.pi]])


def pixel_directions(height, width, rows):
    """Unit vectors towards the pixels, shape (height, width, 3)."""
    theta = row_angles(height, rows)[:, None]
    azimuth = 2.0 * np.pi * ((np.arange(width) + 0.5) / width - 0.25)[None, :]
    up = np.cos(theta) + 0.0 * azimuth
    return np.stack([np.sin(theta) * np.sin(azimuth), np.sin(theta) * np.cos(azimuth), up], axis=-1)


def pixel_solid_angles(height, width, rows):
    """Solid angle of one pixel of each row [sr], shape (height,); all pixels together make 4 pi."""
    return (2.0 * np.pi / width) * -np.diff(np.cos(row_edges(height, rows)))


def horizontal_irradiance(pixels, rows):
    """Irradiance of a horizontal surface that looks up, shape (3,): pi times the unit of `pixels`.

    The integral of cos(theta) over a pixel is exact, (2 pi / W) (sin^2 theta_2 - sin^2 theta_1) / 2, so that a row which the horizon cuts
    counts with its upper part only.
    """
    height, width, _ = pixels.shape
    sine = np.sin(np.minimum(row_edges(height, rows), 0.5 * np.pi))
    weight = (np.pi / width) * np.diff(sine**2)
    return np.einsum("hwc,h->c", pixels.astype(np.float64), weight)


def luminance(picture):
    """Luminance of linear Rec.709 values, in their unit."""
    return np.asarray(picture, dtype=np.float64) @ np.array([0.2126, 0.7152, 0.0722])


def mean_of_neighbours(image):
    """Mean over 3 x 3 pixels of an (H, W) image; the edge is repeated outwards."""
    height, width = image.shape
    wide = np.pad(image, 1, mode="edge")
    return sum(wide[row : row + height, column : column + width] for row in range(3) for column in range(3)) / 9.0


def halved(picture, mask):
    """Picture and mask at half the resolution: the mean of 2 x 2 pixels, masked where all four are.

    The picture that the same paths would have made in larger pixels, with half the noise.
    """
    height, width = mask.shape
    blocks = np.asarray(picture, dtype=np.float64).reshape(height // 2, 2, width // 2, 2, -1)
    return blocks.mean(axis=(1, 3)), mask.reshape(height // 2, 2, width // 2, 2).all(axis=(1, 3))


class NoShadow(AssertionError):
    """The picture has no single straight shadow that starts at the pole."""


def shadow_azimuth_deg(picture, camera, inner_m=0.25, outer_m=2.2):
    """Azimuth towards which the shadow of a thin pole at the origin points [deg], seen by the top camera of tests/scene.json.

    The light lost to the shadow in the ring from `inner_m` to `outer_m` around the pole is summed as vectors from the base. The picture is
    averaged over 3 x 3 pixels first, so that noise does not look like shadow; then only pixels that lose more than 15 % of the lit plane's
    light count. Without Sun there are none.

    Raises NoShadow if they are missing or not in one direction.
    """
    light = mean_of_neighbours(luminance(picture))
    origins, _ = pixel_rays(camera)
    east, north = origins[..., 0], origins[..., 1]
    distance = np.hypot(east, north)
    ring = (distance > inner_m) & (distance < outer_m)
    loss = 1.0 - light / np.median(light[ring])
    loss = np.where(ring & (loss > 0.15), loss, 0.0)
    if np.count_nonzero(loss) < 20:
        raise NoShadow(f"only {np.count_nonzero(loss)} dark pixels around the pole")
    # Each pixel votes for its direction; the far ones know it better.
    vote_east, vote_north = np.sum(loss * east), np.sum(loss * north)
    agreement = np.hypot(vote_east, vote_north) / np.sum(loss * distance)
    if agreement < 0.995:
        raise NoShadow(f"the dark pixels agree on a direction only to {agreement:.3f}")
    return np.degrees(np.arctan2(vote_east, vote_north)) % 360.0


def check_shadow(picture, camera, sun_azimuth_deg, tolerance_deg=0.5):
    """Asserts that the pole's shadow points away from the Sun; returns the error [deg]."""
    azimuth = shadow_azimuth_deg(picture, camera)
    error = angle_between_azimuths_deg(azimuth, sun_azimuth_deg + 180.0)
    assert error <= tolerance_deg, (
        f"shadow towards azimuth {azimuth:.2f} deg, Sun at {sun_azimuth_deg:.2f} deg: {error:.2f} deg off, allowed {tolerance_deg}"
    )
    return error


def relative_rms(first, second, mask):
    """Root mean square over the masked pixels of (first - second), in units of the mean of both there. Per channel, shape (3,)."""
    first, second = np.asarray(first, dtype=np.float64)[mask], np.asarray(second, dtype=np.float64)[mask]
    return np.sqrt(np.mean((first - second) ** 2, axis=0)) / (0.5 * np.mean(first + second, axis=0))
