"""A student's picture beside the reference's, for the page."""

import base64
import math
import struct

from tools.exercises.picture import color, difference, exposure_of, png, rows_of
from tools.tree import read_pfm, read_variance

# Differences of this many standard deviations have the full color.
FULL = 6


def z_color(mine, expected, variance):
    """Red where mine is brighter by more than its noise, blue where it is darker."""
    # The colors of a pixel rise and fall together: so their deviations add up.
    z = (sum(mine) - sum(expected)) / (sum(map(math.sqrt, variance)) + 1e-6)
    level = min(1.0, abs(z) / FULL) ** 2.2 if math.isfinite(z) else 1.0
    return color((level, 0, 0) if z > 0 else (0, 0, level))


def values(pixels):
    """For the page: halves, since a number beside a pixel has three digits."""
    flat = [max(-60000.0, min(60000.0, x)) if x == x else x for pixel in pixels for x in pixel]
    return base64.b64encode(struct.pack(f"<{len(flat)}e", *flat)).decode()


def picture_files(mine, reference, samples, folder):
    """Writes PNGs into a folder; returns what the page needs beside them."""
    width, height, ours = read_pfm(mine)
    _, _, expected = read_pfm(reference)
    *_, variance = read_variance(mine)
    variance = [tuple(x / samples for x in pixel) for pixel in variance]
    exposure = exposure_of(rows_of((width, height, expected)))
    parts = {
        "student": [color(pixel, exposure) for pixel in ours],
        "reference": [color(pixel, exposure) for pixel in expected],
        "difference": list(map(difference, ours, expected)),
        "z": list(map(z_color, ours, expected, variance)),
    }
    folder.mkdir(exist_ok=True)
    for name, pixels in parts.items():
        rows = rows_of((width, height, pixels))
        (folder / f"{name}.png").write_bytes(png([b"".join(row) for row in rows]))
    return {"size": [width, height], "student": values(ours), "reference": values(expected)}
