"""What the parts of the validation share: where tables are, directions, columns, colours, and markdown tables."""

import csv
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
LUMINOUS_EFFICACY = 683.0
FLAT_RADIUS_KM = 6.371e6


class Skipped(Exception):
    """A part that lacks a file or a package; the message says which."""


def reference(name: str) -> Path:
    """A file or folder of the reference tables: in the folder that SKYPROBE_REFERENCE names, or beside the checkout."""
    folder = Path(os.environ.get("SKYPROBE_REFERENCE", ROOT.parent / "shared" / "reference"))
    path = folder / name
    if not path.exists():
        raise Skipped(f"no {name} beside the checkout (../shared/reference) or in SKYPROBE_REFERENCE")
    return path


def read_table(path: Path) -> dict[str, np.ndarray]:
    """A table with a line of column names, by column; lines that begin with # are comments."""
    with path.open() as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    return {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def own_table(name: str) -> dict[str, np.ndarray]:
    """A table of the project's `data` folder."""
    return read_table(ROOT / "data" / name)


def directions(altitude_deg: np.ndarray, azimuth_deg: np.ndarray) -> np.ndarray:
    """Unit vectors (east, north, up), shape (N, 3)."""
    altitude, azimuth = np.broadcast_arrays(np.radians(altitude_deg), np.radians(azimuth_deg))
    vectors = [np.cos(altitude) * np.sin(azimuth), np.cos(altitude) * np.cos(azimuth), np.sin(altitude)]
    return np.stack(vectors, axis=-1).reshape(-1, 3)


def around(axis: np.ndarray, edges_deg: Sequence[float], rings: int, azimuths: int) -> tuple[np.ndarray, np.ndarray]:
    """Directions in rings around `axis` and their solid angles [sr]: Gauss in the angle within each interval of `edges_deg`."""
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    axis = axis / np.linalg.norm(axis)
    side = np.cross(axis, [0.0, 0.0, 1.0] if abs(axis[2]) < 0.9 else [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    third = np.cross(axis, side)
    phi = 2 * np.pi * (np.arange(azimuths) + 0.5) / azimuths
    vectors, angles = [], []
    for low, high in zip(np.radians(edges_deg[:-1]), np.radians(edges_deg[1:]), strict=True):
        for theta, weight in zip(low + (high - low) * (nodes + 1) / 2, weights * (high - low) / 2, strict=True):
            ring = np.cos(phi)[:, None] * side + np.sin(phi)[:, None] * third
            vectors.append(np.cos(theta) * axis + np.sin(theta) * ring)
            angles.append(np.full(azimuths, np.sin(theta) * weight * 2 * np.pi / azimuths))
    return np.concatenate(vectors), np.concatenate(angles)


def column(altitudes_km: np.ndarray, tau: np.ndarray, shape: np.ndarray) -> np.ndarray:
    """Coefficients [1/km], shape (Z, W), of `shape` over altitude whose columns by the trapezoid rule are `tau`."""
    return np.outer(shape / np.trapezoid(shape, altitudes_km), np.atleast_1d(tau))


def to_xyz(radiance: np.ndarray, wavelengths_nm: np.ndarray) -> np.ndarray:
    """CIE 1931 XYZ of spectra, shape (..., W): Y times 683 lm/W is the luminance."""
    observer = own_table("cie1931.csv")
    matching = [np.interp(wavelengths_nm, observer["wavelength_nm"], observer[name]) for name in ("xbar", "ybar", "zbar")]
    return np.stack([np.trapezoid(radiance * curve, wavelengths_nm, axis=-1) for curve in matching], axis=-1)


def rms(values: Iterable[float]) -> float:
    return float(np.sqrt(np.mean(np.square(np.asarray(values)))))


def markdown(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A markdown table."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"
