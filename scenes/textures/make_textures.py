"""Makes the textures of the scenes: globe.png and marble.png.

Needs only Python's standard library. Writes the same bytes each time, so that
git sees no change: run `python3 make_textures.py` in this folder.
"""

import math
import struct
import zlib
from pathlib import Path


def write_png(path, width, height, pixel):
    """Writes the 8-bit sRGB picture whose color at (column, row) is pixel."""
    rows = bytearray()
    for row in range(height):
        rows.append(0)  # no filter
        for column in range(width):
            rows += bytes(max(0, min(255, round(255 * c))) for c in pixel(column, row))

    def chunk(kind, data):
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
        + chunk(b"IEND", b"")
    )


def lattice(x, y, z):
    """A number in [0, 1) for a point of the integer lattice."""
    n = (x * 73856093) ^ (y * 19349663) ^ (z * 83492791)
    n = (n ^ (n >> 13)) * 1274126177 & 0xFFFFFFFF
    return ((n ^ (n >> 16)) & 0xFFFFFF) / 0x1000000


def noise(x, y, z):
    """Smooth noise in [0, 1]: the lattice's numbers, interpolated."""
    corner = [math.floor(v) for v in (x, y, z)]
    part = [v - c for v, c in zip((x, y, z), corner)]
    ease = [t * t * (3 - 2 * t) for t in part]
    total = 0
    for i in range(8):
        step = (i & 1, i >> 1 & 1, i >> 2)
        weight = math.prod(e if s else 1 - e for s, e in zip(step, ease))
        total += weight * lattice(*(c + s for c, s in zip(corner, step)))
    return total


def fractal(x, y, z):
    """Five octaves of noise, about 0 to 1."""
    return sum(noise(x * 2**i, y * 2**i, z * 2**i) / 2 ** (i + 1) for i in range(5))


def mix(a, b, t):
    return [p + (q - p) * t for p, q in zip(a, b)]


def globe(column, row, width=512, height=256):
    """An invented planet: sea, land, ice, and a net of 30 degrees."""
    longitude = (column + 0.5) / width * 2 * math.pi
    latitude = (0.5 - (row + 0.5) / height) * math.pi
    x = math.cos(latitude) * math.sin(longitude)
    y = math.sin(latitude)
    z = math.cos(latitude) * math.cos(longitude)
    land = fractal(1.7 * x + 11, 1.7 * y + 7, 1.7 * z + 5)
    if land > 0.5:
        color = mix([0.35, 0.55, 0.25], [0.7, 0.6, 0.4], min(1, (land - 0.5) * 7))
    else:
        color = mix([0.15, 0.35, 0.65], [0.05, 0.15, 0.4], min(1, (0.5 - land) * 5))
    if abs(y) + 0.25 * (land - 0.5) > 0.93:
        color = [0.92, 0.94, 0.96]
    degrees = (column + 0.5) / width * 360, (row + 0.5) / height * 180
    if any(abs((d + 15) % 30 - 15) < 0.4 for d in degrees):
        color = mix(color, [0.9, 0.9, 0.85], 0.6)
    return color


def marble(column, row, size=256):
    """Veins in a light stone; it repeats without a seam."""
    u, v = (2 * math.pi * (i + 0.5) / size for i in (column, row))
    # A torus in four dimensions has no edge; two of them at a time will do.
    cloud = 0.5 * fractal(1.3 * math.cos(u) + 9, 1.3 * math.sin(u) + 9, 3)
    cloud += 0.5 * fractal(1.3 * math.cos(v) + 5, 1.3 * math.sin(v) + 5, 1.3 * math.cos(u) + 5)
    vein = abs(math.sin(u + 2 * v + 14 * cloud)) ** 0.35
    return mix([0.35, 0.33, 0.36], [0.93, 0.91, 0.88], vein)


if __name__ == "__main__":
    here = Path(__file__).parent
    write_png(here / "globe.png", 512, 256, globe)
    write_png(here / "marble.png", 256, 256, marble)
