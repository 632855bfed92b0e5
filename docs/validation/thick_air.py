"""The irradiance under thick air, by adding and doubling, against what the solver finds and the error that it expects of itself.

    cargo run --release --example thick_air -- --json draft fog,clear 2,5,8 | python docs/validation/thick_air.py

Plane-parallel, scalar, mean over azimuth, 16 directions a hemisphere, delta-M (Wiscombe 1977). Doubling: Hansen & Travis 1974, Space Sci. Rev. 16, 527.
"""

import json
import sys

import numpy as np

DIRECTIONS = 16
ORDERS = 2 * DIRECTIONS
THINNEST = 1e-5  # optical depth from which layers are doubled


def ground_irradiance(air: dict) -> np.ndarray:
    """Irradiance of the ground per unit solar irradiance, for the Sun in each of the directions."""
    nodes, weights = np.polynomial.legendre.leggauss(DIRECTIONS)
    mu, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    one = np.eye(DIRECTIONS)
    legendre = np.polynomial.legendre.legvander(mu, ORDERS - 1).T
    parity = (-1.0) ** np.arange(ORDERS)

    def layer(depth: float, albedo: float, moments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        terms = (2 * np.arange(ORDERS) + 1) * moments
        forward = legendre.T @ (terms[:, None] * legendre)
        backward = legendre.T @ ((terms * parity)[:, None] * legendre)
        lost = (one - 0.5 * albedo * forward * weights) / mu[:, None]
        turned = 0.5 * albedo * backward * weights / mu[:, None]
        doublings = max(0, int(np.ceil(np.log2(depth / THINNEST))))
        step = depth / 2**doublings
        through = one - step * lost + 0.5 * step**2 * (lost @ lost + turned @ turned)
        back = step * turned - 0.5 * step**2 * (lost @ turned + turned @ lost)
        for _ in range(doublings):
            between = np.linalg.inv(one - back @ back)
            through, back = through @ between @ through, back + through @ between @ back @ through
        return back, through

    down, from_below = one, np.zeros_like(one)
    altitudes = np.array(air["altitudes_km"])
    for i in reversed(range(len(altitudes) - 1)):
        scattering, absorption, moments, peak = 0.0, 0.0, np.zeros(ORDERS), 0.0
        for component in air["components"]:
            step = altitudes[i + 1] - altitudes[i]
            part = 0.5 * sum(component["scattering_per_km"][i : i + 2]) * step
            absorption += 0.5 * sum(component["absorption_per_km"][i : i + 2]) * step
            scattering += part
            if component["moments"]:
                moments += part * np.array(component["moments"][:ORDERS])
                peak += part * component["moments"][ORDERS]
        share = peak / max(scattering, 1e-30)
        rest = (1.0 - share) * scattering
        if rest + absorption > 0.0:
            moments = (moments / max(scattering, 1e-30) - share) / (1.0 - share)
            back, through = layer(rest + absorption, rest / (rest + absorption), moments)
            down = through @ np.linalg.inv(one - from_below @ back) @ down
            from_below = back + through @ from_below @ np.linalg.inv(one - back @ from_below) @ through
    ground = 2.0 * air["ground_albedo"] * np.outer(np.ones(DIRECTIONS), mu * weights)
    arriving = np.linalg.inv(one - from_below @ ground) @ down
    return (mu * weights) @ arriving / weights


def main() -> None:
    print("| air | optical depth | error at Sun cosine 0.27 | 0.55 | 0.81 | 0.97 | expected, worst wavelength |\n|---|---|---|---|---|---|---|")
    for line in sys.stdin:
        air = json.loads(line)
        if "error" in air:
            print(f"| {air['kind']} | {air['aod550']} | {air['error']} |")
            continue
        error = 100.0 * (np.array(air["solved"]) / ground_irradiance(air) - 1.0)
        cells = " | ".join(f"{error[k]:+.1f}" for k in (5, 8, 11, 14))
        print(f"| {air['kind']} | {air['aod550']} | {cells} | {100.0 * air['worst']:+.1f} |")


if __name__ == "__main__":
    main()
