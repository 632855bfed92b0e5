"""Mitsuba 3's `sunsky` and Blender's Sky Texture beside skyprobe."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import skyprobe as sp
from common import LUMINOUS_EFFICACY, ROOT, Skipped, directions, markdown, rms, to_xyz
from figures import plt, save
from kider import CENTRES_NM, SCANS, Scan
from scipy.optimize import minimize_scalar

SUNS_DEG = [60, 20, 5, 0, -4, -9]
WAVELENGTHS_NM = np.arange(380.0, 721.0, 10.0)
# Altitudes along the meridian: from the horizon under the Sun over the zenith to the opposite one, in the middle of Blender's rows.
ARC_DEG = np.arange(180) + 0.5


def arc() -> np.ndarray:
    """Directions along the meridian, the Sun in the north."""
    return directions(np.where(ARC_DEG < 90, ARC_DEG, 180 - ARC_DEG), np.where(ARC_DEG < 90, 0.0, 180.0))


def mitsuba_radiance(look: np.ndarray, wavelengths_nm: np.ndarray, sun: np.ndarray, turbidity: float, albedo: float) -> np.ndarray:
    """Spectral radiance of `sunsky` (Hosek & Wilkie 2012) without the disc, shape (N, W) [W m-2 sr-1 nm-1]."""
    import mitsuba as mi

    mi.set_variant("scalar_spectral")
    emitter = mi.load_dict({"type": "sunsky", "sun_direction": [float(v) for v in sun], "turbidity": float(turbidity), "albedo": albedo, "sun_scale": 0.0})
    hit = mi.SurfaceInteraction3f()
    padded = np.append(wavelengths_nm, np.full(-len(wavelengths_nm) % 4, wavelengths_nm[-1])).reshape(-1, 4)
    result = np.empty((len(look), padded.size))
    for i, direction in enumerate(look):
        hit.wi = mi.Vector3f(*(-float(v) for v in direction))
        for j, four in enumerate(padded):
            hit.wavelengths = [float(w) for w in four]
            result[i, 4 * j : 4 * j + 4] = emitter.eval(hit)
    return result[:, : len(wavelengths_nm)]


def blender() -> dict[str, object] | None:
    """What `blender_sky.py` prints under a Python with bpy: this one, that of SKYPROBE_BPY_PYTHON, or one that tests/setup_hosts.sh has made."""
    candidates = [os.environ.get("SKYPROBE_BPY_PYTHON", ""), *(str(ROOT / f".venv-bpy{v}/bin/python") for v in (50, 45, 42)), sys.executable]
    for python in candidates:
        if not python or not Path(python).exists():
            continue
        script = Path(__file__).with_name("blender_sky.py")
        done = subprocess.run([python, str(script), *map(str, SUNS_DEG)], capture_output=True, text=True, check=False, timeout=300)
        found = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
        if found:
            return json.loads(found[0].removeprefix("RESULT "))
        print(f"other_models: no sky from {Path(python).name}: {done.stderr.strip().splitlines()[-1:]}")
    return None


def measured() -> str:
    """Mitsuba's `sunsky` against the measured skies, turbidity fitted to each scan."""
    rows, best = [], []
    for scan in (Scan(name) for name in SCANS):
        direction = np.array(scan.sky(sp.Atmosphere(quality="draft")).sun.direction)
        offset, turbidity = -13.0, 2.0
        for _ in range(2):
            look = scan.look(offset)

            def left(t: float, look=look) -> float:
                return rms(1000 * mitsuba_radiance(look, CENTRES_NM, direction, t, 0.06) - scan.radiance)

            turbidity = minimize_scalar(left, bounds=(1, 10), method="bounded", options={"xatol": 0.05}).x
            offset, difference = scan.fit_azimuth(lambda look: 1000 * mitsuba_radiance(look, CENTRES_NM, direction, turbidity, 0.06))
        rows.append([scan.name, f"{turbidity:.1f}", f"{offset:.1f}", f"{rms(difference):.1f}"])
        best.append(rms(difference))
    return markdown(["scan", "turbidity", "azimuth offset [deg]", "RMSE"], [*rows, ["**all**", "", "", f"**{rms(best):.1f}**"]])


def report() -> str:
    import mitsuba as mi

    thin = sp.Atmosphere(preset="clear", aod550=0.018, quality="high", polarisation=True)
    hazy = sp.Atmosphere(preset="clear", turbidity=3.0, quality="high", polarisation=True)
    render = blender()
    figure, axes = plt.subplots(2, 3, figsize=(10, 5.6), layout="constrained")
    rows = []
    for sun, panel in zip(SUNS_DEG, axes.flat, strict=True):
        ours = {}
        for name, air in (("aerosol optical depth 0.018", thin), ("turbidity 3", hazy)):
            sky = sp.Sky.with_sun(altitude_deg=sun, azimuth_deg=0.0, atmosphere=air)
            ours[name] = LUMINOUS_EFFICACY * to_xyz(sky.spectral_radiance(arc(), WAVELENGTHS_NM), WAVELENGTHS_NM)[:, 1]
        # `sunsky` is black under a Sun at 0 degrees and lower; a hair higher it is not.
        height = np.radians(max(sun, 0.05))
        direction = np.array([0.0, np.cos(height), np.sin(height)])
        theirs = LUMINOUS_EFFICACY * to_xyz(mitsuba_radiance(arc(), WAVELENGTHS_NM, direction, 3.0, 0.1), WAVELENGTHS_NM)[:, 1] if sun >= 0 else None
        other = np.array(render[f"{sun:g}"]) if render else None
        for color, (name, values) in zip(("C0", "C1"), ours.items(), strict=True):
            panel.semilogy(ARC_DEG, values, color=color, label=f"skyprobe, {name}")
        if theirs is not None:
            panel.semilogy(ARC_DEG, theirs, "C1--", label="Mitsuba sunsky, turbidity 3")
        if other is not None:
            panel.semilogy(ARC_DEG, np.maximum(other, 1e-9), "C0--", label=f"Blender {render['version'][:3]}, default")
        panel.set(title=f"Sun {sun} deg", xticks=[0, 90, 180], xticklabels=["Sun's side", "zenith", "opposite"])

        def compare(values: np.ndarray | None, mine: np.ndarray) -> list[str]:
            if values is None:
                return ["black" if sun < 0 else "-", "-", "-"]
            ratio = values / mine
            # The aureole and the last degrees above the horizon are left out of the profile.
            kept = (np.abs(ARC_DEG - sun) > 5) & (np.minimum(ARC_DEG, 180 - ARC_DEG) > 3)
            return [f"{values[89:91].mean():.3g}", f"{ratio[89:91].mean():.2f}", f"{ratio[kept].min():.2f}-{ratio[kept].max():.2f}"]

        thin_arc, hazy_arc = ours.values()
        rows.append(
            [
                sun,
                f"{hazy_arc[89:91].mean():.3g}",
                *compare(theirs, hazy_arc),
                f"{thin_arc[89:91].mean():.3g}",
                *(compare(other, thin_arc) if render else ["-"] * 3),
            ]
        )
    axes[0, 0].set_ylabel("luminance [cd m-2]")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    header = [
        "Sun [deg]",
        "skyprobe, turbidity 3: zenith [cd m-2]",
        "`sunsky`",
        "ratio",
        "ratio along the meridian",
        "skyprobe, optical depth 0.018: zenith",
        "Blender",
        "ratio",
        "ratio along the meridian",
    ]
    versions = f"Mitsuba {mi.__version__}" + (f", Blender {render['version']} (`{render['sky_type']}`)" if render else ", Blender absent")
    text = f"{versions}.\n\n" + markdown(header, rows) + "\n" + save(figure, "other_models.png") + "\n"
    try:
        return text + "`sunsky` against the measured skies of section 2, turbidity fitted to each [mW m-2 sr-1 nm-1]:\n\n" + measured()
    except Skipped as lack:
        print(f"SKIPPED measured skies by sunsky: {lack}")
        return text
