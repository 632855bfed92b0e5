"""Computes plane_parallel_disort.csv with PythonicDISORT.

The view directions are quadrature nodes of the 32-stream solution, where discrete ordinates need no interpolation in angle. The same
directions from 48 streams, in half as many layers, estimate the error; they are interpolated in the view zenith angle, by a cubic spline of the logarithm of
radiance over 1 - exp(-tau / mu), because the package's polynomial in mu is poor near the zenith and above thin air.
"""

import sys
import warnings
from pathlib import Path

import numpy as np
from PythonicDISORT import pydisort
from scipy.interpolate import CubicSpline

from air import AIRS, ALTITUDES_KM, reference_air

STREAMS = 32
SUN_ZENITHS_DEG = [20.0, 60.0, 80.0]
UP_FROM_GROUND = ([8.0, 25.0, 45.0, 65.0, 77.0, 85.0], [0.0, 45.0, 90.0, 135.0, 180.0])
FROM_10_KM = ([25.0, 65.0, 85.0, 95.0, 115.0, 155.0], [0.0, 90.0, 180.0])


def layers(air, per_scale):
    """Homogeneous layers from the top down: (optical depth of each, single scattering albedo, Rayleigh and aerosol scattering depth)."""
    fine = np.linspace(0.0, 100.0, 20001)
    z = np.concatenate([np.arange(0, 10, 1.0 / per_scale), np.arange(10, 40, 3.0 / per_scale), np.arange(40, 100.1, 20.0 / per_scale)])

    def depths(coefficient):
        values = np.interp(fine, ALTITUDES_KM, coefficient)
        below = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(fine))])
        return np.diff(np.interp(z, fine, below))[::-1]

    return z, depths(air.extinction), depths(air.rayleigh), depths(air.aerosol_scattering)


def solve(air, sun_zenith_deg, streams, per_scale):
    """A function of view zenith, altitude and azimuth that is the radiance."""
    z, extinction, rayleigh, aerosol = layers(air, per_scale)
    moments = air.legendre_moments(rayleigh, aerosol, 257)
    albedo = np.minimum((rayleigh + aerosol) / extinction, 1.0 - 1e-9)
    depth = np.cumsum(extinction)
    # The depth at which delta-M truncates is zero for pure Rayleigh air.
    truncated = np.any(moments[:, streams] > 0.0)
    nodes, _, _, _, u = pydisort(
        depth, albedo, streams, moments, np.cos(np.radians(sun_zenith_deg)), 1.0, 0.0,
        NLeg=streams, NFourier=streams,
        f_arr=moments[:, streams] if truncated else 0, NT_cor=bool(truncated),
        BDRF_Fourier_modes=[air.ground_albedo] if air.ground_albedo > 0 else [],
    )
    above = lambda altitude: depth[-1] if altitude == 0 else np.interp(altitude, z, np.concatenate([depth[::-1], [0.0]]))
    mu_nodes = nodes[: streams // 2]
    assert np.all(mu_nodes > 0) and np.allclose(mu_nodes, -nodes[streams // 2 :])

    def radiance(zenith_deg, altitude, azimuth_deg):
        up = zenith_deg > 90.0
        values = u(above(altitude), np.radians(azimuth_deg))[: streams // 2] if up else u(above(altitude), np.radians(azimuth_deg))[streams // 2 :]
        path = 1.0 if up else -np.expm1(-above(altitude) / mu_nodes)
        smooth = np.log(np.squeeze(values) / path)
        theta = np.degrees(np.arccos(mu_nodes))
        order = np.argsort(theta)
        nadir_angle = 180.0 - zenith_deg if up else zenith_deg
        here = np.exp(CubicSpline(theta[order], smooth[order])(nadir_angle))
        return float(here if up else here * -np.expm1(-above(altitude) / np.cos(np.radians(nadir_angle))))

    return radiance


def main():
    warnings.simplefilter("ignore")
    nodes_deg = np.degrees(np.arccos(0.5 * (np.polynomial.legendre.leggauss(STREAMS // 2)[0] + 1.0)))
    nearest = lambda angle: nodes_deg[np.argmin(np.abs(nodes_deg - angle))] if angle < 90 else 180.0 - nearest(180.0 - angle)
    rows = []
    for case in AIRS:
        air = reference_air(*case)
        for sun in SUN_ZENITHS_DEG:
            first = len(rows)
            best, check_solution = solve(air, sun, STREAMS, 8), solve(air, sun, 48, 4)
            for altitude, (zeniths, azimuths) in [(0.0, UP_FROM_GROUND), (10.0, FROM_10_KM)]:
                for zenith in map(nearest, zeniths):
                    for azimuth in azimuths:
                        value, check = best(zenith, altitude, azimuth), check_solution(zenith, altitude, azimuth)
                        rows.append((*case, altitude, sun, zenith, azimuth, value, abs(check / value - 1.0)))
            print(case, sun, "largest difference", max(row[-1] for row in rows[first:]), file=sys.stderr, flush=True)
    with open(Path(__file__).with_name("plane_parallel_disort.csv"), "w") as file:
        file.write("tau_rayleigh,tau_aerosol,tau_ozone,ground_albedo,observer_altitude_km,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,radiance,relative_error\n")
        for row in rows:
            file.write(",".join(f"{value:g}" for value in row[:6]) + f",{row[6]:.6f},{row[7]:g},{row[8]:.7e},{row[9]:.1e}\n")


if __name__ == "__main__":
    main()
