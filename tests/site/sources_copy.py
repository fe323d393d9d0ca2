"""The book and the slides are not built with a mistake in them: each test puts one
into a copy of the sources, and the build must report it in one line."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from tools.tree import BUILD, ROOT, built_stages

SOURCES = [
    "cmake",
    "common",
    "compare",
    "scenes",
    "slides",
    "stages",
    "tests/every_stage",
    "tests/mistakes",
    "tests/runner",
    "tools",
]
SOURCES += [f"tests/{name.replace('_tests', '')}" for name in built_stages()]
STAGE1 = "stages/1_diffuse/path_tracer.hpp"
STAGE3 = "stages/3_specular_refraction/path_tracer.hpp"


class Copy(unittest.TestCase):
    """A test with its own copy of the sources, and the programs and figures of
    the real build."""

    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="lightwalk-site-"))
        self.addCleanup(shutil.rmtree, self.root)
        for folder in SOURCES:
            # With Python's compiled files: otherwise each test would compile all tools.
            shutil.copytree(ROOT / folder, self.root / folder)
        shutil.copy(ROOT / "tests/split_header.py", self.root / "tests")
        shutil.copy(ROOT / "WORDS.md", self.root)
        self.build = self.root / "build"
        self.build.mkdir()
        for made in (
            "figures",
            "node",
            "stage-diff",
            "compile_commands.json",
            "CMakeCache.txt",
            *built_stages(),
        ):
            (self.build / made).symlink_to((BUILD / made).resolve())

    def change(self, path, old, new):
        """Replaces a text that must occur exactly once."""
        text = (self.root / path).read_text()
        self.assertEqual(text.count(old), 1, f"'{old}' in {path}")
        (self.root / path).write_text(text.replace(old, new))

    def run_tool(self, tool, *arguments, **environment):
        return subprocess.run(
            [sys.executable, "-m", f"tools.{tool}", *arguments],
            cwd=self.root,
            env=os.environ | {"LIGHTWALK_BUILD": str(self.build)} | environment,
            capture_output=True,
            text=True,
        )

    def assert_refused(self, tool, *parts, arguments=("--check",)):
        run = self.run_tool(f"{tool}.build", *arguments)
        self.assert_one_line(run, tool, parts)

    def assert_one_line(self, run, program, parts):
        self.assertEqual(run.returncode, 1, run.stderr or run.stdout)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertTrue(run.stderr.startswith(f"{program}: "), run.stderr)
        for part in parts:
            self.assertIn(part, run.stderr)
