"""Renders what a stage renders so far, beside what is expected, and where they
differ: three pictures in one file.

    python3 -m tools.exercises.picture STAGE
"""

import signal
import struct
import subprocess
import sys
import tomllib
import zlib

from tests.runner import watch
from tools.exercises.compiler import build
from tools.tree import BUILD, ROOT, program_path, read_pfm

WIDTH = 200  # of each picture at least, in pixels
GAP = 4
SECONDS = 60  # of processor time


def byte(value):
    return round(255 * min(1.0, max(0.0, value)) ** (1 / 2.2)) if value == value else 255


def color(pixel, exposure=1.0):
    return bytes(byte(exposure * value) for value in pixel)


def exposure_of(rows):
    """What makes all but the brightest twentieth of a picture fit a screen."""
    values = sorted(max(pixel) for row in rows for pixel in row)
    return 1 / max(1e-6, values[len(values) * 19 // 20])


def difference(mine, expected):
    """Black where they agree; red where mine is brighter, blue where it is darker."""
    change = sum(mine) - sum(expected)
    level = min(1.0, abs(change) / (0.1 + sum(expected)))
    return color((level, 0, 0) if change > 0 else (0, 0, level))


def png(rows):
    """Rows of RGB bytes as a file."""

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    size = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def rows_of(picture):
    width, height, pixels = picture
    return [pixels[row * width : (row + 1) * width] for row in range(height)]


def side_by_side(mine, expected):
    """The two pictures and their difference, enlarged."""
    width = expected[0]
    mine, expected = rows_of(mine), rows_of(expected)
    scale, exposure = max(1, -(-WIDTH // width)), exposure_of(expected)
    gap = bytes([255] * 3 * GAP)
    rows = []
    for left, middle in zip(mine, expected):
        parts = [[color(p, exposure) for p in one] for one in (left, middle)]
        parts.append(list(map(difference, left, middle)))
        row = gap.join(b"".join(one * scale for one in part) for part in parts)
        rows += [row] * scale
    return png(rows)


def main(stage):
    goldens = tomllib.loads((ROOT / "tests/golden/goldens.toml").read_text(encoding="utf-8"))["golden"]
    golden = next((one for one in goldens if one["stage"] == stage), None)
    if not golden:
        return
    program = program_path(f"stage{stage}")
    if not program.exists():
        print("\nThe program is compiled for the first time, for your picture.", flush=True)
    if not build(f"stage{stage}")[1]:
        return
    scene = golden["scene"]
    expected = read_pfm(ROOT / f"tests/golden/stage{stage}/{scene}.pfm")
    folder = BUILD / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    mine, target = folder / "mine.pfm", folder / f"stage{stage}_compared.png"
    command = [program, ROOT / f"scenes/{scene}.toml", "-o", mine, "--quiet"]
    command += ["--size", f"{expected[0]}x{expected[1]}", "--spp", "64"]
    command += ["--max-bounces", str(golden["max_bounces"])] if "max_bounces" in golden else []
    quiet = {name: subprocess.DEVNULL for name in ("stdin", "stdout", "stderr")}
    process = subprocess.Popen(command, **quiet)
    try:
        watch.communicate(process, seconds=SECONDS)
    except watch.Endless:
        print("\nThere is no picture: rendering does not come to an end.")
        return
    finally:
        process.kill()
        process.wait()
    if process.returncode == 0:
        target.write_bytes(side_by_side(read_pfm(mine), expected))
        print(f"\n{scene}: yours, expected, and their difference:\n{target}")


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    main(int(sys.argv[1]))
