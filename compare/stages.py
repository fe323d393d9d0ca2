"""Where the tree and its programs are, how they are run, what they leave.

All of the tree's Python stands on this. LIGHTWALK_BUILD names the build
folder, if it is not build/.
"""

import functools
import json
import os
import re
import struct
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = Path(os.environ.get("LIGHTWALK_BUILD", ROOT / "build")).absolute()
SCENES = ROOT / "scenes"


class Failure(Exception):
    """Something that the user has to put right."""


def stage_headers():
    """The chapters, in order."""
    return sorted(ROOT.glob("stages/[1-9]_*/path_tracer.hpp"))


def core_headers():
    """The core's headers in the order in which common/README.md lists them.

    All that have a title are in it, once, and all that it lists are there.
    """
    text = (ROOT / "common/README.md").read_text()
    names = re.findall(r"^- \[.*?\]\((\S+?\.hpp)\)", text, re.MULTILINE)
    titled = {
        path.relative_to(ROOT / "common").as_posix()
        for path in ROOT.glob("common/**/*.hpp")
        if re.search(r"^// # ", path.read_text(), re.MULTILINE)
    }
    wrong = [(name, "is not there") for name in names if not (ROOT / "common" / name).is_file()]
    wrong += [(name, "stands there twice") for name in names if names.count(name) > 1]
    wrong += [(name, "has a title and is missing") for name in sorted(titled - set(names))]
    if wrong:
        raise Failure("common/README.md: {} {}".format(*wrong[0]))
    return [ROOT / "common" / name for name in names]


def built_stages():
    """The names of the programs that there are, the newest last."""
    return sorted(path.name for path in BUILD.glob("stage[1-9]"))


def run(program, *arguments, folder=None, **options):
    """Runs a program to its end; what it prints is text."""
    return subprocess.run(
        [BUILD / program, *map(str, arguments)],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        encoding="utf-8",
        errors="backslashreplace",
        **options,
    )


def render(program, scene, image, *options):
    """Renders the scene to the image, and returns what --report says of it."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        asked = ["--report", report] if has_report(program) else []
        done = run(program, scene, "-o", image, *options, *asked)
        if done.returncode:
            raise Failure(f"{program}: {done.stderr.strip()}")
        return json.loads(report.read_text()) if asked else report_of(done.stdout)


# These two go once every program has --report.
@functools.cache
def has_report(program):
    return "--report" in run(program, "--help").stdout


def report_of(text):
    seconds, rate, prefix, rays = re.search(
        r"([\d.]+) s, ([\d.e+]+) ?([kMG]?)samples/s, ([\d.e+]+) rays per sample", text
    ).groups()
    return {
        "seconds": float(seconds),
        "samples_per_second": float(rate) * {"": 1, "k": 1e3, "M": 1e6, "G": 1e9}[prefix],
        "rays_per_sample": float(rays),
    }


def read_pfm(path):
    """Width, height and the pixels' (r, g, b), row by row from the top."""
    magic, size, scale, data = Path(path).read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    if (magic, scale, len(data)) != (b"PF", b"-1.0", 12 * width * height):
        raise ValueError(f"{path} is not the .pfm that the stages write")
    pixels = list(struct.iter_unpack("<3f", data))
    rows = [pixels[i : i + width] for i in range(0, len(pixels), width)]
    return width, height, [pixel for row in reversed(rows) for pixel in row]
