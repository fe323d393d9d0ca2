"""Runs the programs of the build folder as their users do."""

import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("LIGHTWALK_BUILD", ROOT / "build"))
SCENES = ROOT / "scenes"

# No test expects anything to take so long: a hang shall end in a failure.
HANG = 120


def built_stages():
    """The names of the programs that there are, the newest last."""
    return sorted(path.name for path in BUILD.glob("stage[1-9]"))


def sanitized():
    """Whether the programs are sanitizer builds, which reserve terabytes."""
    cache = (BUILD / "CMakeCache.txt").read_text()
    return "LIGHTWALK_SANITIZE:STRING=address" in cache


def run(program, *arguments, folder=None, **options):
    """Runs a program to its end; what it prints is text."""
    return subprocess.run(
        [BUILD / program, *map(str, arguments)],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="backslashreplace",
        timeout=HANG,
        **options,
    )


def read_pfm(path):
    """Width, height and the pixels' (r, g, b), row by row from the top."""
    magic, size, scale, data = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    if (magic, scale, len(data)) != (b"PF", b"-1.0", 12 * width * height):
        raise ValueError(f"{path} is not the .pfm that the stages write")
    pixels = list(struct.iter_unpack("<3f", data))
    rows = [pixels[i : i + width] for i in range(0, len(pixels), width)]
    return width, height, [pixel for row in reversed(rows) for pixel in row]


class InFolder(unittest.TestCase):
    """A test that has an empty folder for itself."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lightwalk-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_one_line(self, result, message):
        """Exit code 1 and this line on stderr; "..." leaves its end open."""
        self.assertEqual(result.stdout, "")
        self.assertTrue(
            result.stderr.endswith("\n") and result.stderr.count("\n") == 1,
            f"not one line on stderr: {result.stderr[:2000]!r}",
        )
        line = result.stderr[:-1]
        unprintable = [c for c in line if ord(c) < 32 or 127 <= ord(c) < 160]
        self.assertEqual(unprintable, [], line)
        if message.endswith("..."):
            self.assertEqual(line[: len(message) - 3], message[:-3])
        else:
            self.assertEqual(line, message)
        self.assertEqual(result.returncode, 1)
