"""Diffuse irradiance of the plane of ASTM G173 over that of the horizontal, by discrete ordinates: a judge of `standard_spectrum.py` that shares no code with skyprobe.

    pip install PythonicDISORT==1.8 scipy
    python docs/validation/tilted_plane.py

Scalar, flat, black ground, 32 streams with the correction of Nakajima & Tanaka; aerosol of Henyey & Greenstein in the lowest fifth of the air, its optical depth and asymmetry those of
Shettle & Fenn's rural aerosol in SMARTS.
"""

import warnings

import numpy as np
from PythonicDISORT import pydisort
from scipy.interpolate import CubicSpline

STREAMS = 32
ZENITH_DEG, TILT_DEG = 48.19, 37.0
ALBEDO = 0.945
# Wavelength [nm], optical depth of molecules and of aerosol, asymmetry.
CASES = [(400, 0.3605, 0.1045, 0.666), (500, 0.1435, 0.0840, 0.648), (550, 0.0972, 0.0764, 0.641), (680, 0.0409, 0.0584, 0.627)]


def irradiances(molecules: float, aerosol: float, asymmetry: float) -> tuple[float, float]:
    """Diffuse irradiance of the horizontal and, by the sky alone, of the tilted plane, for a solar irradiance of 1."""
    order = np.arange(257)
    rayleigh, haze = np.where(order == 0, 1.0, np.where(order == 2, 0.1, 0.0)), asymmetry**order
    scattering = np.array([[0.8 * molecules, 0.0], [0.2 * molecules, ALBEDO * aerosol]])
    extinction = np.array([0.8 * molecules, 0.2 * molecules + aerosol])
    total = scattering.sum(axis=1)
    moments = (scattering[:, :1] * rayleigh + scattering[:, 1:] * haze) / total[:, None]
    depth, albedo = np.cumsum(extinction), np.minimum(total / extinction, 1 - 1e-9)
    nodes, _, _, _, radiance = pydisort(
        depth, albedo, STREAMS, moments, np.cos(np.radians(ZENITH_DEG)), 1.0, 0.0, NLeg=STREAMS, NFourier=STREAMS, f_arr=moments[:, STREAMS], NT_cor=True
    )
    azimuth = np.radians(np.arange(360) + 0.5)
    at_nodes = np.array([np.squeeze(radiance(depth[-1], angle))[STREAMS // 2 :] for angle in azimuth])
    down = np.argsort(nodes[: STREAMS // 2])
    x, weight = np.polynomial.legendre.leggauss(120)
    mu = 0.5 * (x + 1)
    sky = CubicSpline(nodes[: STREAMS // 2][down], at_nodes[:, down], axis=1)(mu) * 0.5 * weight * (2 * np.pi / len(azimuth))
    tilt = np.radians(TILT_DEG)
    incidence = np.maximum(0.0, mu * np.cos(tilt) + np.sqrt(1 - mu * mu) * np.sin(tilt) * np.cos(azimuth)[:, None])
    return float((sky * mu).sum()), float((sky * incidence).sum())


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    for wavelength, *air in CASES:
        horizontal, tilted = irradiances(*air)
        print(f"{wavelength} nm: horizontal {horizontal:.4f}, tilted {tilted:.4f}, ratio {tilted / horizontal:.3f}")
