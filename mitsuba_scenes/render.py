"""From a place and a time to a picture: computes the light probe and renders the scene with it.

    python mitsuba_scenes/render.py --latitude 55.71 --longitude 13.19 --time 2005-06-21T17:00:00+02:00 --output lund.exr

writes lund.exr (linear), lund.png (to look at) and lund_probe.exr (the light). Needs the Python packages skyprobe and mitsuba.
The header of lund.exr says how bright its numbers are and how wide it looks, so that `skyprobe glare` and `skyprobe tonemap` know it.
"""

import argparse
import glob
import os
import shutil
import sys
import tempfile
from pathlib import Path

SCENE = Path(__file__).resolve().parent / "probe_scene.xml"


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as the command line tool does."""

    def error(self, message):
        self.exit(2, f"error: {message}\n")


def arguments(given=None):
    parser = Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    place = parser.add_argument_group("the light: a place and a time, a Sun that is put, a configuration, or a probe that is there")
    place.add_argument("--latitude", "--lat", type=float, metavar="DEG", help="north positive, -90 to 90 [degrees]")
    place.add_argument("--longitude", "--lon", type=float, metavar="DEG", help="east positive, -180 to 180 [degrees]")
    place.add_argument("--elevation", type=float, default=0.0, metavar="M", help="height above the sea [m]")
    place.add_argument("--time", metavar="TIME", help="ISO 8601, such as 2005-06-21T17:00:00+02:00; without offset it is local time")
    place.add_argument("--sun-altitude", type=float, metavar="DEG", help="instead of place and time [degrees]")
    place.add_argument("--sun-azimuth", type=float, metavar="DEG", help="from north through east [degrees]")
    place.add_argument("--config", type=Path, metavar="FILE", help="a configuration: JSON, or a picture of skyprobe whose header holds it")
    place.add_argument("--probe", type=Path, metavar="FILE", help="a probe rendered before, with its rows on the corners")
    air = parser.add_argument_group("the air")
    air.add_argument("--preset", default="clear", metavar="NAME", help="clear, hazy, polluted, urban, maritime, desert, ... (default: clear)")
    air.add_argument("--turbidity", type=float, metavar="T", help="haze: optical depth of the air over that of pure air")
    air.add_argument("--ground", metavar="NAME", help="grass, snow, sea, desert, city, ...")
    air.add_argument("--quality", default="standard", help="draft, standard, high or reference (default: standard)")
    picture = parser.add_argument_group("the picture")
    picture.add_argument("--scene", type=Path, default=SCENE, metavar="XML", help="scene with the parameters of probe_scene.xml")
    picture.add_argument("--output", "-o", type=Path, default=Path("picture.exr"), metavar="FILE", help="an .exr; the .png lies beside it")
    picture.add_argument("--probe-width", type=int, default=2048, metavar="PX", help="width of the probe (default: 2048)")
    picture.add_argument("--width", type=int, default=960, metavar="PX", help="width of the picture; 3 : 2 (default: 960)")
    picture.add_argument("--spp", type=int, default=256, metavar="N", help="samples per pixel (default: 256)")
    picture.add_argument("--exposure", type=float, default=0.0, metavar="EV", help="of the .png, over the automatic one [stops]")
    picture.add_argument("--variant", metavar="NAME", help="of Mitsuba (default: llvm_ad_rgb where LLVM is, else scalar_rgb)")
    options = parser.parse_args(given)

    by_place = [options.latitude, options.longitude, options.time]
    by_sun = [options.sun_altitude, options.sun_azimuth]
    ways = [any(value is not None for value in way) for way in (by_place, by_sun, [options.config], [options.probe])]
    if sum(ways) != 1:
        parser.error("give either --latitude, --longitude and --time, or --sun-altitude and --sun-azimuth, or --config, or --probe")
    if ways[0] and None in by_place:
        parser.error("a place and a time need all of --latitude, --longitude and --time")
    if ways[1] and None in by_sun:
        parser.error("a Sun that is put needs --sun-altitude and --sun-azimuth")
    for name, value, low in (("width", options.width, 3), ("spp", options.spp, 1)):
        if value < low:
            parser.error(f"{name} = {value}: must be at least {low}")
    if options.output.suffix.lower() != ".exr" or options.output.is_dir():
        parser.error(f"output = {options.output}: must be a file name that ends in .exr")
    if not os.access(options.output.absolute().parent, os.W_OK):
        parser.error(f"output = {options.output}: must be in a folder that can be written to")
    if options.config is not None and (options.preset, options.turbidity, options.ground, options.quality, options.elevation) != (
        "clear",
        None,
        None,
        "standard",
        0.0,
    ):
        parser.error("--config says the air and the elevation: leave --preset, --turbidity, --ground, --quality and --elevation out")
    for name, path in (("config", options.config), ("probe", options.probe), ("scene", options.scene)):
        if path is not None and not path.is_file():
            parser.error(f"{name} = {path}: must be a file")
    return options


def check_files(options, outputs):
    """Refuses, before any work, to write over what is read, over what is read-only, or twice to one file."""
    import skyprobe as sp

    sp.check_files([path for path in (options.config, options.probe, options.scene) if path is not None], outputs)


def make_probe(options, path):
    """Computes the probe that the options describe and writes it to `path`."""
    import skyprobe as sp

    air = {"preset": options.preset, "turbidity": options.turbidity, "ground": options.ground, "quality": options.quality}
    if options.config is not None:
        scene = sp.Scene.load(options.config)
    elif options.sun_altitude is not None:
        sun = {"altitude_deg": options.sun_altitude, "azimuth_deg": options.sun_azimuth}
        scene = sp.Scene(sun=sun, elevation_m=options.elevation, atmosphere=air)
    else:
        place = {"latitude": options.latitude, "longitude": options.longitude, "elevation_m": options.elevation}
        scene = sp.Scene(**place, time=options.time, atmosphere=air)
    # Mitsuba puts the first and the last row on the poles.
    picture = {"scale": "mitsuba", "rows": "corner", "projection": "latlong", "extent": "full", "turn_deg": 0.0}
    scene = scene.replace(probe={**picture, "width": options.probe_width}, file=None)
    sun = scene.sky().sun
    print(f"Sun at altitude {sun.altitude_deg:.2f}, azimuth {sun.azimuth_deg:.2f} degrees")
    scene.render_to_files([path])


def load_mitsuba(variant):
    """Mitsuba with `variant` set; without one the fastest that works here."""
    # Dr.Jit takes the first LLVM that it finds, and Debian's LLVM 15 fails on recent processors.
    libraries = [path for version in (20, 19, 18, 17) for path in glob.glob(f"/usr/lib/*/libLLVM.so.{version}*")]
    if libraries:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", libraries[0])
    import mitsuba as mi

    if variant is None:
        variant = "llvm_ad_rgb" if "DRJIT_LIBLLVM_PATH" in os.environ else "scalar_rgb"
    if variant not in mi.variants():
        raise ValueError(f"variant = {variant}: must be one of {', '.join(mi.variants())}")
    mi.set_variant(variant)
    return mi


def header_of(mi, path):
    """What the header of a probe says, by name."""
    if path.suffix.lower() != ".hdr":
        found = mi.Bitmap(str(path)).metadata()
        return {name: found[name] for name in found.keys()}
    # Mitsuba leaves the header of a Radiance file aside. Its lines end where an empty one is.
    with path.open("rb") as file:
        lines = iter(lambda: file.readline(1 << 16).rstrip(b"\r\n"), b"")
        pairs = (line.decode("utf-8", "replace").partition("=") for line in lines)
        return {name: value.strip() for name, _, value in pairs if name.startswith("skyprobe.")}


def warn_of_centred_rows(path, header):
    """Says so if the file's header says that it was not made for Mitsuba."""
    if float(header.get("skyprobe.turn_deg", 0.0)) != 0.0:
        raise ValueError(f"probe = {path}: must not be turned (its header says turn_deg = {header['skyprobe.turn_deg']})")
    if header.get("skyprobe.rows", "corner") != "corner":
        print(f"warning: {path} has its rows in the centre, the sky will stand up to half a row too high (README.md)", file=sys.stderr)


# Luminance of a pixel of value 1 in each scale [cd m-2]: 683 lm/W, and for Mitsuba times the integral of ybar, 106.857 nm.
WHITE_LUMINANCE = {"blender": 683.0, "mitsuba": 683.0 * 106.857, "luminance": 1.0}


def white_luminance(path, header):
    """The luminance of a pixel of value 1 that the probe's header says [cd m-2]; None, and a warning, if it says none."""
    scale = WHITE_LUMINANCE.get(header.get("skyprobe.scale"))
    for value in (header.get("skyprobe.white_luminance"), header.get("whiteLuminance"), scale):
        try:
            luminance = float(value)
        except (TypeError, ValueError):
            continue
        if 1e-9 <= luminance <= 1e9:
            return luminance
    print(f"warning: {path} does not say its scale, and so the picture will not", file=sys.stderr)
    return None


def load_scene(mi, scene_path, probe_path, width, spp):
    """The scene with the probe as its light, for a picture of 3 : 2."""
    height = width * 2 // 3
    return mi.load_file(str(scene_path), probe=str(probe_path), width=str(width), height=str(height), spp=str(spp))


def describe(mi, scene, luminance):
    """What the header of the picture says: the luminance of a pixel of value 1, and the camera's field of view."""
    import numpy as np

    told = {"skyprobe.color_space": "lin_rec709"}
    if luminance is not None:
        told["skyprobe.white_luminance"] = repr(luminance)
    camera = mi.traverse(scene.sensors()[0])
    if "x_fov" in camera:
        # A number, or in vectorised variants an array of one.
        angle = np.array(camera["x_fov"]).item()
        told |= {"skyprobe.projection": "perspective", "skyprobe.field_of_view_deg": f"{angle:.7g}"}
    return told


def render(mi, scene, spp):
    """The picture as an array, (H, W, 3), linear Rec.709, in the unit of the probe."""
    import numpy as np

    width, height = scene.sensors()[0].film().size()
    # The vectorised variants hold all samples of a pass in memory: at most some 16 million.
    passes = min(spp, -(-spp * width * height // 2**24))
    pictures = (np.array(mi.render(scene, spp=-(-spp // passes), seed=number)) for number in range(passes))
    return (sum(pictures) / passes).astype(np.float32)[:, :, :3]


def write_whole(path, write):
    """Calls `write` with a name beside `path`, and gives the file its own name when it is complete; what it replaces passes on its mode."""
    # Links stay links.
    target = path.resolve()
    with tempfile.TemporaryDirectory(dir=target.parent, prefix=f".{path.stem}.") as folder:
        part = Path(folder) / path.name
        write(part)
        if target.exists():
            shutil.copymode(target, part)
        part.replace(target)


def write_picture(mi, picture, told, path):
    """Writes the picture with what its header is `told`."""
    bitmap = mi.Bitmap(picture)
    header = bitmap.metadata()
    for name, value in told.items():
        header[name] = value
    bitmap.write(str(path))


def to_look_at(mi, picture, exposure_ev):
    """The picture as 8-bit sRGB. Exposed so that all but the brightest twentieth stays within the range."""
    import numpy as np

    luminance = picture @ np.array([0.2126, 0.7152, 0.0722], dtype=np.float32)
    bright = np.percentile(luminance, 95.0)
    gain = 2.0**exposure_ev * (0.8 / bright if bright > 0.0 else 1.0)
    bitmap = mi.Bitmap(np.ascontiguousarray(picture * np.float32(gain)))
    return bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True)


def main(given=None):
    options = arguments(given)
    try:
        image = options.output.with_suffix(".png")
        probe_path = options.probe or options.output.with_name(f"{options.output.stem}_probe.exr")
        check_files(options, [options.output, image] + ([] if options.probe else [probe_path]))
        if options.probe is None:
            make_probe(options, probe_path)
        mi = load_mitsuba(options.variant)
        header = header_of(mi, probe_path)
        warn_of_centred_rows(probe_path, header)
        luminance = white_luminance(probe_path, header)
        scene = load_scene(mi, options.scene, probe_path.absolute(), options.width, options.spp)
        told = describe(mi, scene, luminance)
        picture = render(mi, scene, options.spp)
        write_whole(options.output, lambda path: write_picture(mi, picture, told, path))
        write_whole(image, lambda path: to_look_at(mi, picture, options.exposure).write(str(path)))
    except (ValueError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    for path in (probe_path, options.output, image):
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
