"""Programs for Windows, built with mingw-w64 and run under wine: `make test-windows`.

Each stage renders its box in every format, and the test compares the picture
with that of the native program; then each stage's suite runs. Takes minutes.
"""

import array
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from tests.command_line.programs import run_command
from tests.windows.tools import wine_program
from tools.tree import BUILD, ROOT, stage_headers

WINDOWS = BUILD / "windows"
STAGES = [int(header.parent.name[0]) for header in stage_headers()]
SUITES = ["core", *(f"stage{stage}" for stage in STAGES)]
# The box that each stage can render.
SCENES = {1: "cornell_box_ceiling_diffuse", 2: "cornell_box_point_diffuse"}


def pixels(path):
    """The numbers of a PFM file of this machine's byte order."""
    kind, size, scale, rest = path.read_bytes().split(b"\n", 3)
    assert (kind, float(scale)) == (b"PF", -1.0), (kind, scale)
    width, height = map(int, size.split())
    return array.array("f", rest[: 12 * width * height])  # the variance follows the mean


class Windows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        environment = os.environ | {"WINEDEBUG": "-all", "WINEPREFIX": str(WINDOWS / "wine")}
        cls.place = {"cwd": cls.folder, "env": environment}
        cls.native = run_command([BUILD / "stage6", "--version"]).stdout
        cls.rows = "paths at once" in cls.native
        # The first program has to wait until wine has set itself up.
        subprocess.run([wine_program(), WINDOWS / "stage1.exe", "--version"], check=True, **cls.place)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_windows(self, program, *arguments):
        """Runs a program under wine; returns what subprocess.run returns."""
        command = [wine_program(), WINDOWS / f"{program}.exe", *map(str, arguments)]
        return run_command(command, seconds=1200, **self.place)

    def paint(self, stage, *arguments):
        done = self.run_windows(f"stage{stage}", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_each_stage_paints_what_the_native_program_paints(self):
        for stage in STAGES:
            with self.subTest(stage=stage):
                scene = ROOT / f"scenes/{SCENES.get(stage, 'cornell_box_point')}.toml"
                options = [scene, "--size", "64x64", "--spp", "4"]
                names = [f"{stage}.{ending}" for ending in ("pfm", "ppm", "png")]
                outputs = [word for name in names for word in ("-o", name)]
                done = self.paint(stage, *options, *outputs)
                self.assertNotIn("\r", done.stdout)
                for name in names:
                    self.assertTrue((self.folder / name).stat().st_size > 0, name)
                native = self.folder / f"native{stage}.pfm"
                program = BUILD / f"stage{stage}"
                subprocess.run([program, *options, "-q", "-o", native], check=True)
                self.compare(stage, pixels(native), pixels(self.folder / f"{stage}.pfm"))

    def compare(self, stage, expected, seen):
        """The math libraries differ in the last bit of some functions, and a path may
        take another turn there: then a pixel differs by the path's whole radiance."""
        self.assertEqual(len(expected), len(seen))
        differ = sum(a != b for a, b in zip(expected, seen))
        apart = sum(abs(a - b) > 1e-5 * (1 + abs(a)) for a, b in zip(expected, seen))
        print(f"stage{stage}: of {len(seen)} numbers {differ} differ, {apart} by more than rounding")
        self.assertLess(apart, len(seen) / 100, f"stage{stage} is another picture on Windows")

    def test_what_the_build_lacks_is_listed_with_the_command_that_gets_it(self):
        lines = (WINDOWS / "left_out.txt").read_text().splitlines()
        self.assertGreater(len(lines), 0)  # there is no Google Benchmark for Windows
        for line in lines:
            self.assertRegex(line, r"^[a-z-]+: .+ \(.+; tools/setup\.sh[ a-z]*\)$")

    def test_stage_6_follows_as_many_paths_as_the_native_program(self):
        if not self.rows:
            self.skipTest(self.native)
        self.assertEqual(self.run_windows("stage6", "--version").stdout, self.native)

    def test_names_of_files_are_utf_8(self):
        place = self.folder / "ñandú Ω"
        place.mkdir()
        scene = place / "escena ü.toml"
        shutil.copy(ROOT / "scenes/cornell_box_ceiling_diffuse.toml", scene)
        name = "ñandú Ω/imagen é.png"
        done = self.paint(1, scene, "--size", "8x8", "--spp", "1", "-o", name)
        self.assertTrue((self.folder / name).is_file())
        self.assertIn(name, done.stdout)

    def test_a_picture_replaces_an_old_one_and_nothing_else_is_left(self):
        place = self.folder / "replaced"
        place.mkdir()
        (place / "a.pfm").write_bytes(b"old")
        scene = ROOT / "scenes/cornell_box_ceiling_diffuse.toml"
        self.paint(1, scene, "--size", "8x8", "--spp", "1", "-o", "replaced/a.pfm")
        self.assertEqual([path.name for path in place.iterdir()], ["a.pfm"])
        self.assertEqual(len(pixels(place / "a.pfm")), 8 * 8 * 3)

    def test_what_cannot_be_written_is_said_in_one_line(self):
        scene = ROOT / "scenes/cornell_box_ceiling_diffuse.toml"
        done = self.run_windows("stage1", scene, "-o", "nowhere/a.png")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(
            done.stderr, "stage1: nowhere/a.png cannot be written: there is no folder 'nowhere'\n"
        )

    def test_a_report_has_the_processor_time(self):
        """Four threads of two programs share a processor. So wall-clock time passes faster than
        processor time, and a report of the clock would exceed what the system has counted."""
        scene = ROOT / "scenes/cornell_box_ceiling_diffuse.toml"
        options = [scene, "--size", "64x64", "--spp", "512", "--threads", "2", "--quiet"]
        processors = os.sched_getaffinity(0)
        self.addCleanup(os.sched_setaffinity, 0, processors)
        os.sched_setaffinity(0, {min(processors)})
        names = ["a.json", "b.json"]
        command = [wine_program(), WINDOWS / "stage1.exe", *options, "--report"]
        processes = [
            subprocess.Popen([*command, name], stderr=subprocess.PIPE, **self.place) for name in names
        ]
        for name, process in zip(names, processes):
            with process.stderr:
                _, status, used = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                self.assertEqual(process.returncode, 0, process.stderr.read())
            report = json.loads((self.folder / name).read_text())
            counted = used.ru_utime + used.ru_stime
            print(
                f"cpu_seconds {report['cpu_seconds']:.2f}, by the system {counted:.2f}, in all of "
                f"{report['seconds']:.2f} s"
            )
            # The system counts times in hundredths of a second; half a second is for the start.
            self.assertLess(report["cpu_seconds"], counted + 0.1)
            self.assertGreater(report["cpu_seconds"], counted / 2)
            self.assertLess(report["cpu_seconds"], report["threads"] * report["seconds"] + 0.1)

    def test_the_suites_pass(self):
        for suite in SUITES:
            with self.subTest(suite=suite):
                done = self.run_windows(f"{suite}_tests")
                print(f"{suite}: {done.stdout.strip().splitlines()[-3:]}")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                # Tests of rows are skipped if the program follows one path at a time.
                skipped = "0" if self.rows else r"\d+"
                summary = rf"test cases: *([1-9]\d*) \| *\1 passed \| 0 failed \| {skipped} skipped"
                self.assertRegex(done.stdout, summary)


if __name__ == "__main__":
    unittest.main(verbosity=2)
