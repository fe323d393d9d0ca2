"""Where the tree and its programs are, how to run them, how to read their files.

All of the tree's Python uses this. LIGHTWALK_BUILD names the build folder, if it
is not build/.
"""

import hashlib
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
# What a handout says of itself: its stage, and the sums of its files.
HANDOUT_NOTE = "handout.json"


class Failure(Exception):
    """An error that the user has to fix."""


def text_of(path):
    """What people have written, in whatever encoding: only its ASCII is looked at."""
    return path.read_text(encoding="utf-8-sig", errors="replace")


def sum_of(data):
    """Of a file's bytes; line ends do not matter: git or an editor may change them."""
    return hashlib.sha256(data.replace(b"\r\n", b"\n")).hexdigest()


def stage_headers():
    """The chapters, in order."""
    return sorted(ROOT.glob("stages/[1-9]_*/path_tracer.hpp"))


def core_headers():
    """The core's headers in the order of its map, common/README.md."""
    return listed_headers(ROOT / "common")


def listed_headers(folder):
    """The headers of a folder's rooms, in the order in which its README lists them."""
    there = set(folder.glob("*/**/*.hpp"))
    text = (folder / "README.md").read_text(encoding="utf-8") if there else ""
    listed = [folder / name for name in re.findall(r"\]\((\w+/\w+\.hpp)\)", text)]
    odd = there ^ set(listed)
    odd = odd or {path for path in listed if listed.count(path) > 1}
    if odd:
        names = ", ".join(sorted(path.relative_to(ROOT).as_posix() for path in odd))
        where = (folder / "README.md").relative_to(ROOT).as_posix()
        raise Failure(f"{where}: missing, listed twice or not there: {names}")
    return listed


def exact_tests_filter(names):
    """The value of doctest's -tc for the tests of these names: a comma would
    separate two, a quote would end the shell's word, and `?` is any letter."""
    return ",".join(re.sub(r"[,'\"*\\]", "?", name) for name in names)


def tests_filter(beginnings):
    """The same for the tests with these beginnings."""
    return ",".join(exact_tests_filter([begin]) + "*" for begin in beginnings)


def test_names(suite):
    """The names of the test cases of "core" or "stage3", file by file; a stage's
    include the tests for every stage from stage 1 up to it."""
    sources = sorted((ROOT / "tests" / suite).glob("*.cpp"))
    if suite.startswith("stage"):
        sources += sorted((ROOT / "tests/every_stage").glob(f"from_stage[1-{suite[5:]}].cpp"))
    literal = r'"(?:[^"\\]|\\.)*"'
    names = []
    for path in sources:
        for case in re.findall(rf"TEST_CASE\(\s*((?:{literal}\s*)+)\)", path.read_text(encoding="utf-8")):
            names.append("".join(one[1:-1] for one in re.findall(literal, case)))
    return names


def left_out(where):
    """The parts that the build lacks there, a line each: cmake/Optional.cmake."""
    path = BUILD / "left_out.txt"
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return [line.removeprefix(f"{where}: ") for line in lines if line.startswith(f"{where}: ")]


def built_stages():
    """The names of the built stages, the newest last."""
    return sorted(path.name for path in BUILD.glob("stage[1-9]"))


def program_path(name):
    """Where the build puts a program."""
    return BUILD / (f"{name}.exe" if os.name == "nt" else name)


def run(program, *arguments, folder=None, **options):
    """Runs a program to its end, and captures its output as text."""
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
    """Renders the scene to the image, and returns the program's report of it."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        done = run(program, scene, "-o", image, "--report", report, *options)
        if done.returncode:
            raise Failure(f"{program}: {done.stderr.strip()}")
        return json.loads(report.read_text(encoding="utf-8"))


def read_pfm(path):
    """Width, height and the pixels' (r, g, b), row by row from the top."""
    width, height, pixels, _ = taken_pfm(path, Path(path).read_bytes())
    return width, height, pixels


def read_variance(path):
    """The same of the variance, the second picture of a render's file."""
    *_, rest = taken_pfm(path, Path(path).read_bytes())
    width, height, pixels, _ = taken_pfm(path, rest)
    return width, height, pixels


def taken_pfm(path, data):
    """The first picture in a file's bytes, and what follows it."""
    head = re.match(rb"PF\n(?:#[^\n]*\n)*(\d+) (\d+)\n-1\.0\n", data)
    if not head:
        raise ValueError(f"{path} is not the .pfm that the stages write")
    width, height = map(int, head.groups())
    end = head.end() + 12 * width * height
    pixels = list(struct.iter_unpack("<3f", data[head.end() : end]))
    rows = [pixels[i : i + width] for i in range(0, len(pixels), width)]
    return width, height, [pixel for row in reversed(rows) for pixel in row], data[end:]


def write_whole(path, text):
    """The file is the old one or the new one, whole, whenever this is broken off."""
    new = path.with_name(f".new-{os.getpid()}-{path.name}")
    new.write_text(text, encoding="utf-8", errors="replace")
    new.replace(path)
