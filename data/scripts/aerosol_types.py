"""Rebuilds data/aerosol_types.csv: Mie theory (PyPI miepython) over the log-normal modes of OPAC (needs numpy, miepython).

Modes, humidity growth, mixtures and refractive indices as published: Hess, Koepke & Schult, Bull. Am. Meteorol. Soc. 79, 831 (1998),
tables 1 and 3; d'Almeida, Koepke & Shettle, Atmospheric Aerosols (1991), refractive indices; Hale & Querry (1973) for water.
Particles are spheres; number size distributions are cut at 0.005 and 20 micrometres (7.5 for dry insoluble particles).
"""

import numpy as np
from miepython import efficiencies_mx

from packages import write_table

WAVELENGTHS = np.array([350, 400, 450, 500, 550, 600, 650, 700, 750, 800.0])

WATER = [1.343, 1.339, 1.337, 1.335, 1.333, 1.332, 1.331, 1.331, 1.330, 1.329]

# Real part; imaginary part by wavelength.
INDICES = {
    "inso": (1.53, [0.008] * 10),
    "waso": (1.53, [0.005, 0.005, 0.005, 0.005, 0.006, 0.006, 0.007, 0.007, 0.0085, 0.01]),
    "soot": (1.75, [0.465, 0.46, 0.455, 0.45, 0.44, 0.435, 0.435, 0.43, 0.43, 0.43]),
    "salt": (1.50, [3e-8, 3e-8, 2e-8, 1e-8, 1e-8, 1e-8, 1e-8, 1e-8, 1e-8, 1e-8]),
    "mineral": (1.53, [0.017, 0.013, 0.0085, 0.0078, 0.0055, 0.0045, 0.0045, 0.004, 0.004, 0.004]),
    "sulphate": (1.43, [1e-8] * 10),
}

# Component: substance, dry mode radius [um], mode radius at 80 % humidity [um], geometric standard deviation, largest radius [um].
COMPONENTS = {
    "inso": ("inso", 0.471, 0.471, 2.51, 7.5),
    "waso": ("waso", 0.0212, 0.0306, 2.24, 20.0),
    "soot": ("soot", 0.0118, 0.0118, 2.00, 20.0),
    "ssam": ("salt", 0.209, 0.416, 2.03, 20.0),
    "sscm": ("salt", 1.75, 3.49, 2.03, 60.0),
    "minm": ("mineral", 0.07, 0.07, 1.95, 20.0),
    "miam": ("mineral", 0.39, 0.39, 2.00, 20.0),
    "micm": ("mineral", 1.90, 1.90, 2.15, 60.0),
    "mitr": ("mineral", 0.50, 0.50, 2.20, 5.0),
    "suso": ("sulphate", 0.0695, 0.118, 2.03, 20.0),
}

# Particles per cm3 (table 4).
TYPES = {
    "continental_clean": {"waso": 2600, "inso": 0.15},
    "continental_average": {"waso": 7000, "inso": 0.4, "soot": 8300},
    "continental_polluted": {"waso": 15700, "inso": 0.6, "soot": 34300},
    "urban": {"waso": 28000, "inso": 1.5, "soot": 130000},
    "maritime_clean": {"waso": 1500, "ssam": 20, "sscm": 3.2e-3},
    "desert": {"waso": 2000, "minm": 269.5, "miam": 30.5, "micm": 0.142},
    "antarctic": {"suso": 42.9, "ssam": 0.047, "mitr": 0.0053},
}


def mode_optics(component: str) -> np.ndarray:
    """Extinction, scattering and g-weighted scattering per particle [um2] by wavelength."""
    substance, dry, radius, sigma, largest = COMPONENTS[component]
    real, imaginary = INDICES[substance]
    dry_fraction = (dry / radius) ** 3
    log_radius = np.linspace(np.log(0.005), np.log(largest), 500)
    r = np.exp(log_radius)
    number = np.exp(-0.5 * ((log_radius - np.log(radius)) / np.log(sigma)) ** 2) / (np.sqrt(2 * np.pi) * np.log(sigma))
    area = number * np.pi * r**2 * (log_radius[1] - log_radius[0])
    result = np.zeros((3, len(WAVELENGTHS)))
    for k, wavelength in enumerate(WAVELENGTHS):
        index = complex(real, -imaginary[k]) * dry_fraction + complex(WATER[k], 0.0) * (1 - dry_fraction)
        q_ext, q_sca, _, g = efficiencies_mx(index, 2 * np.pi * r * 1000 / wavelength)
        result[:, k] = (area * q_ext).sum(), (area * q_sca).sum(), (area * q_sca * g).sum()
    return result


def main():
    optics = {component: mode_optics(component) for component in COMPONENTS}
    rows = []
    for number, (name, mixture) in enumerate(TYPES.items()):
        # um2 x cm-3 = 1e-3 km-1.
        extinction, scattering, forward = sum(count * optics[c] for c, count in mixture.items()) * 1e-3
        at = list(WAVELENGTHS).index(550.0)
        slope = -np.log(extinction[-1] / extinction[3]) / np.log(800 / 500)
        blue = -np.log(extinction[3] / extinction[0]) / np.log(500 / 350)
        print(
            f"{name:22} ext {extinction[at]:.4f}/km ssa {scattering[at] / extinction[at]:.4f} g {forward[at] / scattering[at]:.4f}"
            f" angstrom {blue:.2f} {slope:.2f}"
        )
        for k, wavelength in enumerate(WAVELENGTHS):
            ratio = extinction[k] / extinction[at]
            rows.append((number, int(wavelength), ratio, scattering[k] / extinction[k], forward[k] / scattering[k]))
    write_table(
        "aerosol_types.csv",
        [
            "Aerosol types of OPAC (Hess, Koepke & Schult 1998) at 80 % relative humidity, computed with PyPI miepython (MIT).",
            "Types: " + ", ".join(f"{i} {name}" for i, name in enumerate(TYPES)) + ".",
            "Extinction relative to 550 nm, single scattering albedo, asymmetry parameter.",
        ],
        "type,wavelength_nm,relative_extinction,single_scattering_albedo,asymmetry",
        rows,
        ["{:d}", "{:d}", "{:.4f}", "{:.4f}", "{:.4f}"],
    )


if __name__ == "__main__":
    main()
