"""Checks data/aerosol_particles.bin against Mie theory by PyPI miepython (needs numpy, miepython; some minutes).

The file is made by `cargo run --release --example tabulate_mie data/aerosol_particles.bin` from the numbers in src/atmosphere/particles.rs. Here they
stand again for some of the particles, as published: Hess, Koepke & Schult, Bull. Am. Meteorol. Soc. 79, 831 (1998), tables 1 and 2; d'Almeida, Koepke &
Shettle, Atmospheric Aerosols (1991), refractive indices; Hale & Querry (1973) for water. The layout of the file: src/atmosphere/particle_tables.rs.
"""

import math
import struct
import sys
from pathlib import Path

import numpy as np
from miepython import S1_S2, efficiencies_mx

FILE = Path(__file__).resolve().parent.parent / "aerosol_particles.bin"

WATER_550 = 1.333

# Number of the table in the file, refractive index at 550 nm, dry and wet mode radius [um], geometric standard deviation, largest radius [um].
MODES = {
    "insoluble": (0, 1.53 + 0.008j, 0.471, 0.471, 2.51, 7.5),
    "water soluble, 70 %": (3, 1.53 + 0.006j, 0.0212, 0.0285, 2.24, 20.0),
    "soot": (9, 1.75 + 0.44j, 0.0118, 0.0118, 2.00, 20.0),
    "sea salt accumulation, 80 %": (13, 1.5 + 1e-8j, 0.209, 0.416, 2.03, 20.0),
    "mineral nucleation": (26, 1.53 + 0.0055j, 0.07, 0.07, 1.95, 20.0),
    "mineral accumulation": (27, 1.53 + 0.0055j, 0.39, 0.39, 2.00, 20.0),
    "sulphate, 99 %": (37, 1.43 + 1e-8j, 0.0695, 0.231, 2.03, 20.0),
    "volcanic sulphate": (38, 1.454 + 1e-8j, 0.331, 0.331, 1.5, 20.0),
    "fog": (39, 1.333 + 0j, 8.06, 8.06, None, 50.0),
}


def read():
    """Angles [degrees] and all tables: extinction, scattering, asymmetry (by wavelength), phase function (by wavelength and angle)."""
    data = FILE.read_bytes()
    assert data[:8] == b"SKYMIE1\0"
    tables, wavelengths, angles = struct.unpack("<3I", data[8:20])
    numbers = np.frombuffer(data[20:], "<f4").astype(float)
    nodes, rest = numbers[:wavelengths], numbers[wavelengths:]
    degrees, rest = rest[:angles], rest[angles:].reshape(tables, wavelengths * (3 + angles))
    at = list(nodes).index(550.0)
    cross_sections = rest[:, : 3 * wavelengths].reshape(tables, 3, wavelengths)[:, :, at]
    phase = np.exp(rest[:, 3 * wavelengths :].reshape(tables, wavelengths, angles)[:, at])
    return degrees, cross_sections, phase


def integrate(index, mode_radius, sigma, largest, cosines):
    """Extinction, scattering [um2], asymmetry and phase function at 550 nm of a size distribution, in steps that differ from the file's."""
    wavelength = 0.55
    # Even in ln r for small, in r for large particles.
    small = np.exp(np.arange(math.log(0.005), math.log(1.0), 0.008))
    radius = np.concatenate([small, np.arange(1.0, largest, 0.003)])
    if sigma is None:
        number = radius**4 * np.exp(-0.0562 * radius**1.77)
    else:
        number = np.exp(-0.5 * (np.log(radius / mode_radius) / math.log(sigma)) ** 2) / (math.sqrt(2 * math.pi) * math.log(sigma) * radius)
    number = number * np.gradient(radius)
    if sigma is None:
        number /= number.sum()
    share = number * radius**4
    keep = share > 1e-8 * share.max()
    radius, number = radius[keep], number[keep]
    x = 2 * math.pi * radius / wavelength
    q_ext, q_sca, _, g = efficiencies_mx(index.conjugate(), x)
    area = number * math.pi * radius**2
    extinction, scattering = (area * q_ext).sum(), (area * q_sca).sum()
    intensity = np.zeros(len(cosines))
    for count, size in zip(number, x, strict=True):
        s1, s2 = S1_S2(index.conjugate(), size, cosines, norm="wiscombe")
        intensity += count * 0.5 * (abs(s1) ** 2 + abs(s2) ** 2)
    return extinction, scattering, (area * q_sca * g).sum() / scattering, intensity * wavelength**2 / (math.pi * scattering)


def main():
    degrees, cross_sections, phase = read()
    chosen = [0, 20, 60, 90, 120, 150, 180, 200, 210, 220, 230, 240, 250, len(degrees) - 1]
    cosines = np.cos(np.radians(degrees[chosen]))
    worst = 0.0
    for name, (table, dry_index, dry, wet, sigma, largest) in MODES.items():
        fraction = (dry / wet) ** 3
        index = dry_index * fraction + WATER_550 * (1 - fraction)
        extinction, scattering, asymmetry, values = integrate(index, wet, sigma, largest, cosines)
        albedo = cross_sections[table, 1] / cross_sections[table, 0]
        deviations = abs(phase[table, chosen] / values - 1)
        print(
            f"{name:28} extinction {cross_sections[table, 0] / extinction - 1:+.1e} albedo {albedo - scattering / extinction:+.1e}"
            f" asymmetry {cross_sections[table, 2] - asymmetry:+.1e}"
            f" phase function rms {math.sqrt((deviations**2).mean()):.1e} worst {deviations.max():.1e} at {degrees[chosen][deviations.argmax()]:.2f} degrees"
        )
        worst = max(worst, deviations.max())
    return 0 if worst < 0.004 else 1


if __name__ == "__main__":
    sys.exit(main())
