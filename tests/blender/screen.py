"""The picture on a virtual screen, as Xvfb keeps it in a file, and a PNG of it.

What Blender itself saves (screen.screenshot) is black where its OpenGL cannot read what it showed, as with the Mesa of Debian trixie.
"""

import struct
import zlib
from pathlib import Path

import numpy as np


def read(path):
    """Return the screen in the XWD file at `path` (XWDFile.h, version 7): uint8 RGB, (H, W, 3), row 0 at the top."""
    content = Path(path).read_bytes()
    header = struct.unpack(">25I", content[:100])
    header_size, height, bits_per_pixel, bytes_per_line, colours = header[0], header[5], header[11], header[12], header[19]
    if bits_per_pixel != 32 or header[7] != 0:
        raise ValueError(f"{path}: {bits_per_pixel} bits per pixel, byte order {header[7]}: must be 32 and 0")
    pixels = np.frombuffer(content, np.uint8, height * bytes_per_line, header_size + 12 * colours)
    return pixels.reshape(height, bytes_per_line // 4, 4)[:, : header[4], 2::-1].copy()


def write_png(path, picture):
    """Write uint8 RGB `picture`, (H, W, 3), to `path`."""
    height, width, _ = picture.shape

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = picture.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)), chunk(b"IEND", b"")
    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(parts))
