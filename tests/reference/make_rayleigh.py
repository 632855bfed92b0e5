"""Computes rayleigh_polarised.csv: the exact polarised sky of a flat, homogeneous Rayleigh layer over a Lambertian ground, by doubling.

Stokes parameters (I, Q, U) in the meridian frame e_theta, e_phi of the direction in which light travels. A dipole sends the field P E into w,
with P = 1 - w w^T, so that the phase matrix follows from the four products e_i(w) . e_j(w') and has the azimuthal orders m = 0, 1, 2 alone. The
orders do not mix. Reflection and transmission of a layer of optical depth tau / 2^DOUBLINGS, which scatters once, are doubled DOUBLINGS times
(van de Hulst 1963; Hansen 1971); the ground is added in closed form. Angles of the Sun and of the view are nodes of weight zero, so nothing is interpolated.

Independent of the library in method and code. Validated against Natraj, Li & Yung (2009): `python make_rayleigh.py <folder of their tables>`.
"""

import csv
import sys
from pathlib import Path

import numpy as np

NODES = 40
DOUBLINGS = 30
# Azimuths at which the phase matrix is sampled: more than twice the highest order.
SAMPLES = 8

OPTICAL_DEPTHS = [0.02, 0.05, 0.15, 0.25, 1.0]
ALBEDOS = [0.0, 0.25, 0.8]
SUN_COSINES = [0.1, 0.2, 0.4, 0.6, 0.8, 1.0]
VIEW_COSINES = [0.1, 0.16, 0.32, 0.64, 0.92, 1.0]
AZIMUTHS_DEG = [0.0, 60.0, 150.0]


def phase_matrices(out, into):
    """The orders 0, 1, 2 of the phase matrix from travel directions with zenith cosines `into` to `out`; shape (3, 3 out, 3 into), Stokes parameters innermost."""
    sine = lambda mu: np.sqrt(np.maximum(0.0, 1.0 - mu * mu))
    a, b = out[:, None, None], into[None, :, None]
    sa, sb = sine(a), sine(b)
    p = 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES
    c, s = np.cos(p), np.sin(p)
    # e_i(out, azimuth p) . e_j(into, azimuth 0)
    tt, tp, pt, pp = a * b * c + sa * sb, a * s, -b * s, c
    tt, tp, pt, pp = np.broadcast_arrays(tt, tp + 0 * b, pt + 0 * a, pp + 0 * a + 0 * b)
    matrix = 0.75 * np.array(
        [
            [tt**2 + tp**2 + pt**2 + pp**2, tt**2 - tp**2 + pt**2 - pp**2, 2 * (tt * tp + pt * pp)],
            [tt**2 + tp**2 - pt**2 - pp**2, tt**2 - tp**2 - pt**2 + pp**2, 2 * (tt * tp - pt * pp)],
            [2 * (tt * pt + tp * pp), 2 * (tt * pt - tp * pp), 2 * (tt * pp + tp * pt)],
        ]
    )
    orders = []
    for m in range(3):
        order = np.mean(matrix * np.exp(-1j * m * p), axis=-1)
        orders.append(order.transpose(2, 0, 3, 1).reshape(3 * len(out), 3 * len(into)))
    return orders


class Layer:
    """Kernels of a layer for one azimuthal order: what comes from below and above is kept apart. A kernel times the weights is an operator."""

    def __init__(self, matrices, mu, weights, tau):
        (down_down, up_down, down_up, up_up), self.weights, n = matrices, np.repeat(weights, 3), len(mu)
        a, b = mu[:, None], mu[None, :]
        back = b / (a + b) * -np.expm1(-tau * (1 / a + 1 / b))
        # b (exp(-tau / b) - exp(-tau / a)) / (b - a), and its limit, without cancellation.
        x = tau * (1 / a - 1 / b)
        ratio = np.where(np.abs(x) < 1e-12, 1.0, -np.expm1(-x) / np.where(x == 0, 1.0, x))
        ahead = tau / a * np.exp(-tau / b) * ratio
        spread = lambda kernel: np.kron(kernel, np.ones((3, 3)))
        self.direct = np.repeat(np.exp(-tau / mu), 3)
        self.reflect, self.reflect_up = 0.5 * spread(back) * down_up, 0.5 * spread(back) * up_down
        self.transmit, self.transmit_up = 0.5 * spread(ahead) * down_down, 0.5 * spread(ahead) * up_up
        assert self.reflect.shape == (3 * n, 3 * n)

    def double(self):
        """Two of the layer, one on the other."""
        w, e = self.weights, self.direct
        halves = []
        for r, t, back, t_back in (
            (self.reflect, self.transmit, self.reflect_up, self.transmit_up),
            (self.reflect_up, self.transmit_up, self.reflect, self.transmit),
        ):
            loop = (back * w) @ r
            between = np.linalg.solve(np.eye(len(w)) - loop * w, t + loop * e)
            returned = r * e + (r * w) @ between
            halves.append((r + e[:, None] * returned + (t_back * w) @ returned, e[:, None] * between + t * e + (t * w) @ between))
        (self.reflect, self.transmit), (self.reflect_up, self.transmit_up) = halves
        self.direct = e * e


def sky(tau, sun_cosines, view_cosines, nodes=NODES):
    """I, Q, U of the sky seen from the ground for a solar irradiance of pi: a function of (albedo, Sun, view, azimuth [rad]; 0 looks towards the Sun), with the library's signs."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    # Nodes at t^2, since a thin layer changes fast towards the horizon.
    t = 0.5 * (x + 1.0)
    mu = np.concatenate([t * t, sun_cosines, view_cosines])
    weights = np.concatenate([w * t, np.zeros(len(sun_cosines) + len(view_cosines))])
    directions = [phase_matrices(out * mu, into * mu) for out, into in ((-1, -1), (-1, 1), (1, -1), (1, 1))]
    layers = []
    for m in range(3):
        layer = Layer([d[m] for d in directions], mu, weights, tau / 2**DOUBLINGS)
        for _ in range(DOUBLINGS):
            layer.double()
        layers.append(layer)
    flux = 2.0 * np.pi * mu * weights
    natural = np.zeros(3 * len(mu))
    natural[::3] = weights
    uniform = (layers[0].reflect_up @ natural).real
    back = flux @ uniform[::3]

    def stokes(albedo, sun, view, azimuth):
        i, j = nodes + sun, nodes + len(sun_cosines) + view
        beam = np.zeros(3)
        for m, layer in enumerate(layers):
            # An unpolarised beam of irradiance pi; m and -m are conjugates. U counts from the direction of sight, which turns e_phi around.
            beam += 0.5 * (1 if m == 0 else 2) * np.real(layer.transmit[3 * j : 3 * j + 3, 3 * i] * np.exp(1j * m * azimuth)) * [1, 1, -1]
        diffuse = 0.5 * flux @ layers[0].transmit[::3, 3 * i].real
        direct = np.pi * mu[i] * np.exp(-tau / mu[i])
        ground = albedo / np.pi * (diffuse + direct) / (1.0 - albedo / np.pi * back)
        return beam + ground * uniform[3 * j : 3 * j + 3]

    return stokes


def validate(folder):
    """Prints the differences from the published tables of optical depths 0.1 and 0.5 for several numbers of nodes."""
    for tau in (0.1, 0.5):
        with open(folder / f"downwelling_tau_{tau}.csv") as file:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(line for line in file if line[0] != "#")]
        values = {name: sorted({row[name] for row in rows}) for name in ("albedo", "mu0", "mu")}
        for nodes in (16, 24, NODES):
            stokes = sky(tau, np.array(values["mu0"]), np.array(values["mu"]), nodes)
            place = lambda row: (values["mu0"].index(row["mu0"]), values["mu"].index(row["mu"]))
            found = np.array([stokes(row["albedo"], *place(row), np.radians(row["phi_deg"])) for row in rows])
            given = np.array([[r["I"], -r["Q"], -r["U"]] for r in rows])
            relative, others = found[:, 0] / given[:, 0] - 1, np.abs(found - given) / given[:, :1]
            print(
                f"tau {tau}, {nodes} nodes, {len(rows)} rows: I rms {np.sqrt(np.mean(relative**2)):.1e}, largest {np.abs(relative).max():.1e}; "
                f"Q / I {others[:, 1].max():.1e}, U / I {others[:, 2].max():.1e}"
            )


def main():
    with open(Path(__file__).with_name("rayleigh_polarised.csv"), "w") as file:
        file.write("tau,albedo,mu0,mu,phi_deg,I,Q,U\n")
        for tau in OPTICAL_DEPTHS:
            stokes = sky(tau, np.array(SUN_COSINES), np.array(VIEW_COSINES))
            for albedo in ALBEDOS:
                for i, mu0 in enumerate(SUN_COSINES):
                    for j, mu in enumerate(VIEW_COSINES):
                        for phi in AZIMUTHS_DEG:
                            numbers = stokes(albedo, i, j, np.radians(phi)) + 0.0
                            file.write(f"{tau:g},{albedo:g},{mu0:g},{mu:g},{phi:g}," + ",".join(f"{v:.7f}" for v in numbers) + "\n")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        validate(Path(sys.argv[1]))
    else:
        main()
