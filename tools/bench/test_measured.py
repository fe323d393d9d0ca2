"""Tests that stored measurements name the machine, the compiler and the commit."""

import datetime
import json
import os
import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

from tools.bench import machine, measured

CPU = "processor\t: 0\ncpu family\t: 25\nmodel\t\t: 17\nmodel name\t: Some EPYC\n\n"
COMPILER = 'set(CMAKE_CXX_COMPILER_ID "GNU")\nset(CMAKE_CXX_COMPILER_VERSION "12.2.0")\n'


class Measured(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)
        self.build, self.folder = self.root / "build", self.root / "measured"
        compiler = self.build / "CMakeFiles/3.25/CMakeCXXCompiler.cmake"
        compiler.parent.mkdir(parents=True)
        compiler.write_text(COMPILER)
        for name in ("efficiency.md", "peers.md"):
            (self.build / name).write_text("| a |\n|---|\n| 1 |\n")
        (self.build / "bench.json").write_text(json.dumps({"benchmarks": []}))
        (self.build / "convergence.svg").write_text("<svg/>")
        (self.root / "cpuinfo").write_text(CPU)
        self.environment = {key: text for key, text in os.environ.items() if not key.startswith("GIT_")}
        for target, change in (
            (measured, {"ROOT": self.root, "BUILD": self.build, "FOLDER": self.folder}),
            (machine, {"BUILD": self.build, "CPU_INFO": self.root / "cpuinfo"}),
        ):
            for name, value in change.items():
                patch = mock.patch.object(target, name, value)
                patch.start()
                self.addCleanup(patch.stop)
        patch = mock.patch.dict(os.environ, self.environment, clear=True)
        patch.start()
        self.addCleanup(patch.stop)

    def commit(self, date):
        """Makes a commit on this day, and returns its name."""
        who = {f"GIT_{role}_{what}": "x" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
        days = {f"GIT_{role}_DATE": f"{date} 12:00:00" for role in ("AUTHOR", "COMMITTER")}
        git = ["git", "-C", self.root]
        subprocess.run(
            [*git, "commit", "-q", "--allow-empty", "-m", date], check=True, env=self.environment | who | days
        )
        return subprocess.check_output([*git, "rev-parse", "--short", "HEAD"], text=True).strip()

    def heads(self):
        with mock.patch("builtins.print"):
            measured.main()
        return {path.name: path.read_text().split("\n")[0] for path in self.folder.glob("*.md")}

    def test_the_head_names_processor_compiler_and_commit(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        commit = self.commit("2026-03-01")
        here = f"Some EPYC (family 25, model 17), {os.cpu_count()} processors, GCC 12.2.0, commit {commit}."
        heads = self.heads()
        self.assertEqual(set(heads), {"efficiency.md", "benchmarks.md", "peers.md"})
        for name, head in heads.items():
            command = "make bench-peers" if name == "peers.md" else "make bench"
            self.assertRegex(head, rf"^Measured by `{command}` on \d{{4}}-\d\d-\d\d: ")
            self.assertTrue(head.endswith(here), f"{name}: {head!r} does not end with {here!r}")

    def test_date_and_commit_are_those_of_the_measurement(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        then, now = self.commit("2026-03-01"), self.commit("2026-05-01")
        day = datetime.datetime(2026, 4, 1, 12).timestamp()
        os.utime(self.build / "bench.json", (day, day))
        heads = self.heads()
        self.assertIn("on 2026-04-01: ", heads["benchmarks.md"])
        self.assertIn(f"commit {then}.", heads["benchmarks.md"])
        self.assertIn(f"commit {now}.", heads["peers.md"])

    def test_without_git(self):
        with mock.patch.dict(os.environ, {"GIT_CEILING_DIRECTORIES": str(self.root.parent)}):
            for name, head in self.heads().items():
                self.assertTrue(head.endswith(", no commit."), f"{name}: {head}")


if __name__ == "__main__":
    unittest.main()
