# SPDX-License-Identifier: GPL-3.0-or-later
"""The tiles that Cycles makes of pictures (Blender 5.2 and later, where auto-generating is on), in a folder beside each: they go with the picture.

A cache that the preferences put elsewhere is the user's own and stays.
"""

import contextlib
import os
import re
from pathlib import Path

import bpy

from . import compat


def forget(image):
    """Delete the tiles of the probe, or the sequence of probes, that `image` loads from files."""
    folder = compat.texture_cache_folder()
    if folder is None or image.packed_file is not None or image.source not in {"FILE", "SEQUENCE"} or image.library is not None:
        return
    picture = Path(bpy.path.abspath(image.filepath_raw))
    if not picture.is_absolute() or not picture.name:
        return
    name = re.escape(picture.name)
    if image.source == "SEQUENCE":
        # Any frame of it.
        stem, suffix = re.fullmatch(r"(.*?)\d*(\.\w+)?", picture.name).groups()
        name = rf"{re.escape(stem)}\d+{re.escape(suffix or '')}"
    tiles = picture.parent / folder
    # Whoever else uses the folder may be there at the same time; what stays is made anew or never used.
    with contextlib.suppress(OSError):
        for path in tiles.iterdir():
            if re.fullmatch(rf"{name}\.[^/\\]*\.tx", path.name):
                path.unlink(missing_ok=True)
        os.rmdir(tiles)
