"""How far the quality levels are from `reference`: the zenith of an air of molecules and ozone in twilight."""

import numpy as np
import skyprobe as sp
from common import column, markdown

SUNS_DEG = np.arange(0, -17, -1)


def zenith(quality: str) -> np.ndarray:
    z = np.concatenate([np.arange(0, 10, 0.5), np.arange(10, 50, 1.0), np.arange(50, 141, 3.0)])
    wavelengths = np.array([440.0, 550.0])
    none = np.zeros((len(z), 2))
    components = [
        sp.Component(scattering=column(z, np.array([0.24, 0.097]), np.exp(-z / 8)), absorption=none, phase=sp.Phase.rayleigh()),
        sp.Component(scattering=none, absorption=column(z, np.array([0.001, 0.03]), np.maximum(0, 1 - np.abs(z - 25) / 15)), phase=None),
    ]
    air = sp.Atmosphere.from_profile(z, wavelengths, components, solar_irradiance=1.0, ground_albedo=0.2, quality=quality, polarisation=True)
    skies = [sp.Sky.with_sun(altitude_deg=float(sun), azimuth_deg=0.0, atmosphere=air) for sun in SUNS_DEG]
    return np.array([sky.spectral_radiance([[0.0, 0.0, 1.0]], wavelengths)[0] for sky in skies])


def report() -> str:
    best = zenith("reference")
    rows = []
    for quality in ("draft", "standard", "high"):
        error = 100 * np.abs(zenith(quality) / best - 1)
        rows.append([quality, *(f"{error[(SUNS_DEG <= high) & (SUNS_DEG > low)].max():.2f} %" for high, low in ((0, -5), (-5, -10), (-10, -17)))])
    return markdown(["quality", "Sun 0 to -4", "-5 to -9", "-10 to -16"], rows)
