"""The measured skies of Kider et al. (2014) and an air of a few numbers to compare with them.

81 directions x 31 bands of 11.75 nm, Ithaca NY, 27 May 2013. The air is that of Bruneton's comparison of clear-sky models (IEEE TVCG 23, 2016): molecules with
a scale height of 8 km, Angstrom's aerosol, no gas absorption, grass.
"""

from dataclasses import dataclass

import numpy as np
import skyprobe as sp
from common import column, directions, own_table, read_table, reference
from pvlib.spectrum import get_reference_spectra
from scipy.optimize import minimize_scalar

SCANS = ["0930", "1000", "1030", "1100", "1130", "1200", "1230", "1330"]
EDGES_NM = 360.0 + 11.75 * np.arange(32)
CENTRES_NM = (EDGES_NM[1:] + EDGES_NM[:-1]) / 2
PLACE = {"latitude": 42.44345, "longitude": -76.48196}
# A lawn: the project's own preset "grass" (src/atmosphere/ground.rs), its end value kept below 380 nm.
GRASS_NM = [380, 410, 440, 480, 550, 580, 620, 670, 690, 710, 740, 800]
GRASS = [0.030, 0.035, 0.042, 0.065, 0.100, 0.080, 0.058, 0.042, 0.060, 0.150, 0.350, 0.450]


@dataclass(frozen=True)
class Haze:
    """Optical depth `beta` (wavelength / 1 um)^-`alpha`, asymmetry, single scattering albedo and scale height [km]."""

    alpha: float = 0.8
    beta: float = 0.04
    g: float = 0.7
    albedo: float = 0.8
    height_km: float = 1.2

    def tau(self) -> np.ndarray:
        return self.beta * (CENTRES_NM / 1000) ** -self.alpha


def sunlight() -> np.ndarray:
    """Band means of the extraterrestrial spectrum of ASTM G173 [W m-2 nm-1]."""
    spectrum = get_reference_spectra()["extraterrestrial"]
    fine = np.arange(360.0, 725.0, 0.05)
    values = np.interp(fine, spectrum.index, spectrum.to_numpy())
    return np.array([values[(fine >= low) & (fine < high)].mean() for low, high in zip(EDGES_NM[:-1], EDGES_NM[1:], strict=True)])


def air(haze: Haze, phase: sp.Phase | None = None, ozone_du: float = 0.0, **options) -> sp.Atmosphere:
    """The air with this haze; its phase function is Cornette and Shanks's unless given."""
    z = np.concatenate([np.arange(0, 10, 0.25), np.arange(10, 30, 1.0), np.arange(30, 101, 5.0)])
    none = np.zeros((len(z), len(CENTRES_NM)))
    extinction = column(z, haze.tau(), np.exp(-z / haze.height_km))
    # Molecules as in that comparison: 1.24062e-6 / m at 1 um, in proportion to wavelength^-4.
    molecules = column(z, 1.24062e-3 * 8.0 * (CENTRES_NM / 1000) ** -4.0, np.exp(-z / 8.0))
    table = own_table("ozone.csv")
    gas = ozone_du * 2.6867e16 * np.interp(CENTRES_NM, table["wavelength_nm"], table["cross_section_cm2"])
    components = [
        sp.Component(scattering=molecules, absorption=none, phase=sp.Phase.rayleigh(depolarisation=0.0)),
        sp.Component(
            scattering=haze.albedo * extinction,
            absorption=(1 - haze.albedo) * extinction,
            phase=phase or sp.Phase.cornette_shanks(haze.g),
        ),
        sp.Component(scattering=none, absorption=column(z, gas, np.maximum(0.0, 1 - np.abs(z - 25) / 15)), phase=None),
    ]
    options = {"quality": "high", "polarisation": True, "planet_radius_km": 6360.0} | options
    return sp.Atmosphere.from_profile(z, CENTRES_NM, components, solar_irradiance=sunlight(), ground_albedo=np.interp(CENTRES_NM, GRASS_NM, GRASS), **options)


class Scan:
    """One measured sky: directions and radiance [mW m-2 sr-1 nm-1]."""

    def __init__(self, name: str) -> None:
        table = read_table(reference(f"kider2014/scan_{name}.csv"))
        self.name = name
        self.time = f"2013-05-27T{name[:2]}:{name[2:]}:00-04:00"
        self.azimuth_deg, self.altitude_deg = table["azimuth_deg"], table["elevation_deg"]
        self.radiance = 1000 * np.stack([values for key, values in table.items() if key.startswith("L_")], axis=1)

    def sky(self, atmosphere: sp.Atmosphere) -> sp.Sky:
        return sp.Sky(**PLACE, time=self.time, atmosphere=atmosphere)

    def look(self, offset_deg: float) -> np.ndarray:
        """Directions in which the instrument looked: its azimuth minus `offset_deg`."""
        return directions(self.altitude_deg, self.azimuth_deg - offset_deg)

    def fit_azimuth(self, radiance_towards) -> tuple[float, np.ndarray]:
        """The offset between -20 and -8 degrees that leaves least, and model minus measurement, shape (81, 31)."""

        def left(offset: float) -> np.ndarray:
            return radiance_towards(self.look(offset)) - self.radiance

        offset = minimize_scalar(lambda o: np.mean(left(o) ** 2), bounds=(-20, -8), method="bounded", options={"xatol": 0.05}).x
        return float(offset), left(offset)

    def compare(self, atmosphere: sp.Atmosphere) -> tuple[float, np.ndarray]:
        """The same for the sky under this air."""
        sky = self.sky(atmosphere)
        return self.fit_azimuth(lambda look: 1000 * sky.spectral_radiance(look, CENTRES_NM))
