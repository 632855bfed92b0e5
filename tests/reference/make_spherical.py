"""Computes spherical_single_scattering.csv and spherical_multiple_scattering.csv with sasktran2: scalar, planet of 6371 km, straight rays, the Sun a point.

Single scattering (by the air alone) is integrated on a fine altitude grid, and on one half as fine to estimate its error. Multiple scattering (all the rest, light from the
ground included) is by successive orders, and with fewer directions to estimate its error of discretisation in angle. The errors that the method has
besides are in README.md.
"""

import sys
from pathlib import Path

import numpy as np
import sasktran2 as sk

from air import AIRS, ALTITUDES_KM, reference_air

RADIUS_KM = 6371.0
MOMENTS = 100
SUN_ZENITHS_DEG = [20.0, 60.0, 80.0, 88.0]
# With the Sun lower, successive orders are wrong by tens of per cent where the ground is bright.
LOWEST_SUN_FOR_MULTIPLE_DEG = 80.0
VIEWS = [
    (0.0, [(0.0, 0.0)] + [(zenith, azimuth) for zenith in (30.0, 60.0, 80.0, 88.0) for azimuth in (0.0, 45.0, 90.0, 135.0, 180.0)]),
    (10.0, [(zenith, azimuth) for zenith in (45.0, 85.0, 92.0, 120.0) for azimuth in (0.0, 90.0, 180.0)]),
    (40.0, [(zenith, azimuth) for zenith in (45.0, 90.0, 95.0, 150.0) for azimuth in (0.0, 90.0, 180.0)]),
]
# Where successive orders keep their source [km].
SOURCE_ALTITUDES_KM = np.array([0.02, 0.1, 0.2, 0.4, 0.7, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 18, 20, 22, 25, 28, 31, 35, 40, 45, 50, 60, 70, 80, 95])


def altitude_grid_km(fineness):
    """The 0.5 km grid of the air and points between, which change nothing but the accuracy: the package takes the source as linear in a layer."""
    pieces = [np.arange(0, 4, 0.1 / fineness), np.arange(4, 15, 0.25 / fineness), np.arange(15, 100.01, 0.5 / fineness)]
    return np.unique(np.round(np.concatenate(pieces), 6))


def radiance(air, sun_zenith_deg, rays, fineness, method, ground_albedo):
    """Radiance along rays (observer altitude km, view zenith deg, relative azimuth deg) for a solar irradiance of 1."""
    z = altitude_grid_km(fineness)
    config = sk.Config()
    config.num_stokes = 1
    config.num_threads = 2
    config.num_singlescatter_moments = MOMENTS
    if method.startswith("successive orders"):
        config.multiple_scatter_source = sk.MultipleScatterSource.SuccessiveOrders
        config.successive_orders_reduced_horizon_quadrature = False
        config.num_successive_orders_incoming = 110 if "coarse" in method else 302
        config.num_successive_orders_outgoing = 110
        config.num_successive_orders_iterations = 50
        config.successive_orders_relative_tolerance = 1e-4
        config.successive_orders_altitude_grid_m = SOURCE_ALTITUDES_KM * 1000.0
        config.num_sza = 3
    geometry = sk.Geometry1D(
        np.cos(np.radians(sun_zenith_deg)), 0.0, RADIUS_KM * 1000.0, z * 1000.0,
        sk.InterpolationMethod.LinearInterpolation, sk.GeometryType.Spherical,
    )
    viewing = sk.ViewingGeometry()
    for altitude, zenith, azimuth in rays:
        viewing.add_ray(
            sk.SolarAnglesObserverLocation(
                np.cos(np.radians(sun_zenith_deg)), np.radians(azimuth), np.cos(np.radians(zenith)), altitude * 1000.0
            )
        )
    atmosphere = sk.Atmosphere(geometry, config, numwavel=1, calculate_derivatives=False)
    extinction, rayleigh, aerosol = (np.interp(z, ALTITUDES_KM, c) for c in (air.extinction, air.rayleigh, air.aerosol_scattering))
    atmosphere.storage.total_extinction[:, 0] = extinction / 1000.0
    atmosphere.storage.ssa[:, 0] = np.minimum((rayleigh + aerosol) / extinction, 1.0)
    moments = air.legendre_moments(rayleigh, aerosol, MOMENTS) * (2 * np.arange(MOMENTS) + 1)
    count = atmosphere.leg_coeff.a1.shape[0]
    atmosphere.leg_coeff.a1[:, :, 0] = moments.T[:count]
    atmosphere.surface.albedo[:] = ground_albedo
    return np.squeeze(sk.Engine(config, geometry, viewing).calculate_radiance(atmosphere).radiance.values)


def write(name, columns, rows):
    with open(Path(__file__).with_name(name), "w") as file:
        case = "tau_rayleigh,tau_aerosol,tau_ozone,ground_albedo,observer_altitude_km,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg"
        file.write(f"{case},{columns}\n")
        for numbers, value, error in rows:
            file.write(",".join(f"{number:g}" for number in numbers) + f",{value:.6e},{error:.1e}\n")


def main():
    rays = [(altitude, *view) for altitude, views in VIEWS for view in views]
    singles, multiples = [], []
    for case in AIRS[:3]:
        air = reference_air(*case)
        for sun in SUN_ZENITHS_DEG:
            numbers = [(*case, altitude, sun, *view) for altitude, *view in rays]
            single, single_check = (radiance(air, sun, rays, fineness, "single", 0.0) for fineness in (8, 4))
            singles += zip(numbers, single, np.abs(single - single_check))
            if sun > LOWEST_SUN_FOR_MULTIPLE_DEG:
                continue
            # Without a multiple scattering source the package gives the sunlit ground too, seen through the air.
            ground = radiance(air, sun, rays, 4, "single", air.ground_albedo) - single_check
            single_coarse = radiance(air, sun, rays, 1, "single", air.ground_albedo)
            orders, orders_check = (
                radiance(air, sun, rays, 1, method, air.ground_albedo) - single_coarse + ground
                for method in ("successive orders", "successive orders, coarse")
            )
            multiples += zip(numbers, orders, np.abs(orders - orders_check))
            print(case, sun, f"largest difference {np.max(np.abs(orders_check / orders - 1.0)):.3f}", file=sys.stderr, flush=True)
    write("spherical_single_scattering.csv", "single_scattering,error", singles)
    write("spherical_multiple_scattering.csv", "multiple_scattering,error", multiples)


if __name__ == "__main__":
    main()
