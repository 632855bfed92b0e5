"""The air of the reference tables: the same as `reference_air` in tests/common/mod.rs.

Vertical profiles on a 0.5 km grid from 0 to 100 km, linear between the points, each normalised by the trapezoid rule so that its vertical
optical depth is its column: molecules exp(-z / 8 km), Rayleigh without depolarisation; aerosol exp(-z / 1.5 km), Henyey-Greenstein g = 0.7,
single scattering albedo 0.95; ozone a triangle 10-25-40 km that only absorbs.
"""

from dataclasses import dataclass

import numpy as np

ALTITUDES_KM = np.arange(201) * 0.5
ASYMMETRY = 0.7
AEROSOL_ALBEDO = 0.95

# Cases on purpose other than those of any published table: (tau_rayleigh, tau_aerosol, tau_ozone, ground_albedo).
AIRS = [
    (0.1, 0.0, 0.0, 0.0),
    (0.3, 0.0, 0.03, 0.3),
    (0.1, 0.2, 0.0, 0.3),
    (0.1, 0.5, 0.03, 0.8),
    (0.3, 0.2, 0.03, 0.0),
    (0.3, 0.5, 0.0, 0.8),
    (0.1, 1.0, 0.0, 0.0),
    (0.1, 1.0, 0.03, 0.3),
    (0.3, 1.0, 0.0, 0.8),
]


@dataclass
class Air:
    """Coefficients in km-1 at ALTITUDES_KM."""

    rayleigh: np.ndarray
    aerosol_scattering: np.ndarray
    extinction: np.ndarray
    ground_albedo: float

    @property
    def scattering(self):
        return self.rayleigh + self.aerosol_scattering

    def legendre_moments(self, rayleigh, aerosol, count):
        """Moments chi_l (chi_0 = 1) of the mixture of these scattering coefficients; shape (coefficients, count)."""
        order = np.arange(count)
        of_rayleigh = np.where(order == 0, 1.0, np.where(order == 2, 0.1, 0.0))
        of_aerosol = ASYMMETRY**order
        total = np.maximum(rayleigh + aerosol, 1e-300)
        return (np.outer(rayleigh, of_rayleigh) + np.outer(aerosol, of_aerosol)) / total[:, None]


def reference_air(tau_rayleigh, tau_aerosol, tau_ozone, ground_albedo):
    z = ALTITUDES_KM

    def column(tau, shape):
        return shape * tau / np.trapezoid(shape, z)

    rayleigh = column(tau_rayleigh, np.exp(-z / 8.0))
    aerosol = column(tau_aerosol, np.exp(-z / 1.5))
    ozone = column(tau_ozone, np.maximum(0.0, 1.0 - np.abs(z - 25.0) / 15.0))
    return Air(rayleigh, AEROSOL_ALBEDO * aerosol, rayleigh + aerosol + ozone, ground_albedo)
