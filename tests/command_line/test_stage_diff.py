"""stage-diff: the same, different, or impossible to compare."""

import json
import os
import shlex
import shutil
import struct
import subprocess
import unittest

import programs

BOX = programs.SCENES / "cornell_box_ceiling_diffuse.toml"


class Pictures(programs.InFolder):
    def render(self, name, *options, scene=BOX, stage="stage1"):
        path = self.folder / name
        result = programs.run(
            stage,
            *(scene, "-o", path, "--size", "32x32", "--spp", "256"),
            *("--max-bounces", "3", "--quiet", *options),
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        return path

    def changed(self, old, new):
        """The box with one piece of its text replaced."""
        text = BOX.read_text()
        self.assertEqual(text.count(old), 1, old)
        path = self.folder / "changed.toml"
        path.write_text(text.replace(old, new))
        return path

    def diff(self, a, b, *options):
        return programs.run("stage-diff", a, b, *options)

    def check_different(self, a, b, *expected):
        result = self.diff(a, b)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        for words in expected:
            self.assertIn(words, result.stdout)
        return result

    def check_cannot(self, a, b, *expected):
        result = self.diff(a, b)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("stage-diff: "))
        for words in expected:
            self.assertIn(words, result.stderr)


class StageDiff(Pictures):
    def test_another_seed_is_the_same(self):
        reference = self.render("b.pfm")
        for seed in (2, 3, 4):
            a = self.render("a.pfm", "--seed", str(seed))
            result = self.diff(a, reference)
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertRegex(
                result.stdout, r"^the same: a tile that is \d+ % off would have been seen \(8 x 8 pixels\)\n"
            )
            self.assertEqual(result.stderr, "")

    def test_a_lamp_found_by_chance_is_the_same_as_one_that_is_sampled(self):
        """As chapter 2 says, and in both orders: in some tiles no path finds the lamp."""
        scene = programs.SCENES / "cornell_box_sphere_lamp_diffuse.toml"
        options = ("--size", "128x128", "--spp", "64", "--max-bounces", "8")
        for seed in (1, 3):
            found = self.render("a.pfm", *options, "--seed", str(seed), scene=scene)
            other = ("--seed", str(seed + 1))
            sampled = self.render("b.pfm", *options, *other, scene=scene, stage="stage2")
            for a, b in ((found, sampled), (sampled, found)):
                result = self.diff(a, b, "--other-seeds")
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_a_lamp_that_is_3_percent_darker(self):
        a = self.render("a.pfm", "--seed", "2", scene=self.changed("ke = 1", "ke = 0.97"))
        result = self.check_different(a, self.render("b.pfm"), "% too dark over the")
        self.assertIn("different scene files", result.stderr)

    def test_a_ball_moved_by_a_pixel(self):
        # A pixel at the ball's distance is 0.07 wide.
        moved = self.changed("center = [0.5, -0.7", "center = [0.43, -0.7")
        a = self.render("a.pfm", "--seed", "2", scene=moved)
        self.check_different(a, self.render("b.pfm"), "lower right")

    def test_a_missing_caustic(self):
        # With a bound of 2 bounces paths through the glass are too long.
        scene = programs.SCENES / "cornell_box_ceiling.toml"
        stage = "stage3" if "stage3" in programs.built_stages() else None
        if stage is None:
            self.skipTest("stage 3 is not in the tree")
        a = self.render("a.pfm", "--max-bounces", "2", scene=scene, stage=stage)
        b = self.render("b.pfm", "--max-bounces", "5", scene=scene, stage=stage)
        result = self.check_different(a, b, "lower right")
        self.assertIn("different bounds, 2 and 5", result.stderr)

    def test_an_image_without_variance_borrows_the_others(self):
        """The first picture of a .pfm alone, as other programs write it."""
        b = self.render("b.pfm")
        a = self.render("a.pfm", "--seed", "2")
        a.write_bytes(a.read_bytes()[: len(b"PF\n32 32\n-1.0\n") + 12 * 32 * 32])
        result = self.diff(a, b)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("a.pfm has no variance", result.stderr)
        named = shutil.copy(a, self.folder / "a\x1b]0;\n.pfm")
        self.assertIn("a ]0; .pfm has no variance", self.diff(named, b).stderr)
        self.check_cannot(a, a, "cannot compare: ", "a.pfm: it has no variance")
        magic, size, scale, data = a.read_bytes().split(b"\n", 3)
        a.write_bytes(b"\r\n".join((magic, size, scale, data)))
        self.assertEqual(self.diff(a, b).stdout, result.stdout)

    def test_one_sample_per_pixel_has_no_variance(self):
        a = self.render("a.pfm", "--spp", "1")
        b = self.render("b.pfm", "--spp", "1", "--seed", "2")
        words = "one sample per pixel has no variance"
        self.check_cannot(a, b, "cannot compare: ", f"a.pfm: {words}", f"b.pfm: {words}")
        ppm = self.render("c.ppm", "--spp", "1")
        self.check_cannot(a, ppm, f"a.pfm: {words}", "c.ppm: it has no variance")

    def test_one_sample_beside_many_borrows_their_variance(self):
        many = self.render("many.pfm", "--spp", "1024")
        few = self.render("few.pfm", "--spp", "1", "--seed", "2")
        for a, b in ((few, many), (many, few)):
            result = self.diff(a, b)
            self.assertIn("few.pfm has no variance: ", result.stderr)
            self.assertEqual(result.returncode, 0, result.stdout)

    def test_an_exr_says_the_same_as_a_pfm(self):
        if not programs.HAS_EXR:
            self.skipTest("OpenImageIO is not in this build")
        said = []
        for ending in ("pfm", "exr"):
            a, b = self.render(f"a.{ending}", "--seed", "2"), self.render(f"b.{ending}")
            said.append(self.diff(a, b).stdout)
        self.assertEqual(*said)

    def test_the_courses_ppm(self):
        b = self.render("b.pfm")
        ppm = self.render("a.ppm", "--seed", "2")
        result = self.diff(ppm, b)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("a.ppm has no variance", result.stderr)
        ppm.write_text(ppm.read_text().replace("#MAX=", "# max = "))
        self.assertEqual(self.diff(ppm, b).returncode, 0)
        lines = ppm.read_text().split("\n")
        ppm.write_text("\n".join(lines[:1] + lines[2:]))
        self.assertIn("a.ppm: has no comment #MAX=", self.diff(ppm, b).stderr)

    def test_no_figure_is_without_a_value(self):
        """Black has no ratio, and without noise no difference has a z."""
        black = self.render("a.pfm", "--max-bounces", "0", scene=self.changed("ke = 1", "kd = 1"))
        lamp = self.render("b.pfm", "--max-bounces", "0")
        for a, b in ((black, black), (black, lamp), (lamp, black), (lamp, lamp)):
            for options in ((), ("--json",)):
                result = self.diff(a, b, *options)
                self.assertEqual(result.returncode, 0 if a == b else 1)
                self.assertNotRegex(result.stdout + result.stderr, r"(?i)\b(nan|inf)")

    def test_json(self):
        a, b = self.render("a.pfm", "--seed", "2"), self.render("b.pfm")
        values = json.loads(self.diff(a, b, "--json").stdout)
        self.assertIs(values["same"], True)
        self.assertAlmostEqual(values["mean_ratio"][0], 1, delta=0.02)
        self.assertLess(values["worst"]["z"], values["z_critical"])

    def test_json_of_black_images_is_json(self):
        a = self.render("a.pfm", "--max-bounces", "0", scene=self.changed("ke = 1", "kd = 1"))
        values = json.loads(self.diff(a, a, "--json").stdout)
        self.assertIs(values["same"], True)

    def test_one_picture_of_all(self):
        a, b = self.render("a.pfm", "--seed", "2"), self.render("b.pfm")
        picture = self.folder / "diff.png"
        self.assertEqual(self.diff(a, b, "-o", picture).returncode, 0)
        width, height = struct.unpack(">II", picture.read_bytes()[16:24])
        self.assertEqual((width, height), (4 * 256 + 3 * 4, 256))
        result = self.diff(a, b, "-o", self.folder / "none" / "diff.png")
        self.assertEqual(result.returncode, 2)

    def test_other_sizes(self):
        a = self.render("a.pfm", "--size", "16x32")
        self.check_cannot(a, self.render("b.pfm"), "16 x 32", "32 x 32")

    def test_not_finite(self):
        a = self.render("a.pfm")
        data = bytearray(a.read_bytes())
        data[-4:] = struct.pack("<f", float("nan"))
        a.write_bytes(data)
        self.check_cannot(a, self.render("b.pfm"), "column 31, row 0 is not finite")

    def test_files_that_are_no_images(self):
        good = self.render("b.pfm")
        whole = good.read_bytes()
        for name, data in {
            "empty.pfm": b"",
            "cut.pfm": b"PF\n32 32\n-1.0\n" + b"\0" * 99,
            "cut_variance.pfm": whole[:-1],
            "text.pfm": b"no image at all\n" * 99,
            "huge.pfm": b"PF\n60000 60000\n-1.0\n" + b"\0" * 99,
            "negative.pfm": b"PF\n-3 2\n-1.0\n" + b"\0" * 99,
        }.items():
            with self.subTest(name):
                path = self.folder / name
                path.write_bytes(data)
                self.check_cannot(path, good, f"{name}: ")

    def test_other_files(self):
        good = self.render("b.pfm")
        self.check_cannot(self.folder / "missing.pfm", good, "no such file")
        self.check_cannot(self.folder, good, "it is not a file")
        png = self.render("a.png")
        self.check_cannot(png, good, "its name ends in none of .exr, .pfm, .ppm, .hdr, .tif, .tiff")

    def test_wrong_usage(self):
        for words, said in [
            ("", "two images are required, as in 'build/stage-diff a.pfm b.pfm -o diff.png'"),
            ("a.pfm", "two images are required, as in 'build/stage-diff a.pfm b.pfm -o diff.png'"),
            ("a.pfm b.pfm c.pfm", "argument 'c.pfm' was not expected after 'b.pfm'"),
            ("--jsno a.pfm b.pfm", "unknown option '--jsno', did you mean '--json'?"),
            ("a.pfm b.pfm -o x.jpg", "--output: 'x.jpg' does not end in .png"),
            ("a.pfm b.pfm -o -", "--output: '-' is no name: images are written by name, like box.png"),
        ]:
            with self.subTest(words):
                result = programs.run("stage-diff", *words.split())
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertEqual(result.stderr, f"stage-diff: {said} (stage-diff --help lists the options)\n")
        for option in ["--version", "-V"]:
            result = programs.run("stage-diff", option)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertRegex(result.stdout, r"^stage-diff \(Lightwalk\) \d+\.\d+\.\d+\n$")

    def test_the_same_bits_are_called_so(self):
        a, b = self.render("a.pfm"), self.render("b.pfm")
        self.assertIn("the same bits, is this one render twice?", self.diff(a, b).stdout)
        result = self.diff(a, b, "--other-seeds")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("does the seed change nothing?", result.stderr)
        b = self.render("b.pfm", "--seed", "2")
        result = self.diff(a, b, "--other-seeds")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("same bits", result.stdout)

    def test_noise_is_told(self):
        a, b = self.render("a.pfm", "--sampling", "uniform", "--seed", "2"), self.render("b.pfm")
        self.assertRegex(self.diff(a, b).stdout, r"seen .*; [12]\.\d\d times the variance .*: noisier")
        self.assertRegex(self.diff(b, a).stdout, r"seen .*; 0\.\d+ times the variance .*: quieter")


class WhatTilesDoNotShow(Pictures):
    """Pictures of 128 x 128 pixels and 64 samples, as `make diff` renders them; one of them is edited."""

    SIZE = 128
    pictures = []  # of two seeds, rendered once

    def edited(self, edit):
        """The picture with another seed, after `edit(rows)`, in which a pixel is 12 bytes."""
        if not self.pictures:
            for seed in ("1", "2"):
                path = self.render("x.pfm", "--size=128x128", "--spp=64", "--seed", seed)
                self.pictures.append(path.read_bytes())
        a, b = self.folder / "a.pfm", self.folder / "b.pfm"
        for path, data in zip((b, a), self.pictures):
            path.write_bytes(data)
        self.assertEqual(self.diff(a, b).returncode, 0)
        start, row = len(b"PF\n128 128\n-1.0\n"), 12 * self.SIZE
        rows = [
            [data[at + x : at + x + 12] for x in range(0, row, 12)]
            for at in range(start, start + self.SIZE * row, row)
        ]
        edit(rows)
        pixels = b"".join(pixel for pixels in rows for pixel in pixels)
        a.write_bytes(data[:start] + pixels + data[start + len(pixels) :])
        return a, b

    def test_a_row_and_a_column_that_are_black(self):
        def black_row(rows):  # stored from the bottom up
            rows[self.SIZE - 1 - 50] = [bytes(12)] * self.SIZE

        def black_column(rows):
            for row in rows[:90]:  # not the ceiling, which has no noise
                row[50] = bytes(12)

        self.check_different(*self.edited(black_row), "columns 0 to 127, rows 50 to 50")
        self.check_different(*self.edited(black_column), "columns 50 to 50, rows 0 to 127")

    def test_pairs_of_rows_or_columns_that_are_exchanged(self):
        def exchange_columns(rows):
            for row in rows:
                row[::2], row[1::2] = row[1::2], row[::2]

        def exchange_rows(rows):
            rows[::2], rows[1::2] = rows[1::2], rows[::2]

        words = "its pixels are further off than their noise"
        self.check_different(*self.edited(exchange_columns), words)
        self.check_different(*self.edited(exchange_rows), words)

    def test_a_tile_that_is_20_percent_darker(self):
        for left, top in ((32, 64), (36, 68)):

            def darken(rows):
                for row in rows[top : top + 8]:
                    for x in range(left, left + 8):
                        row[x] = struct.pack("<3f", *(0.8 * v for v in struct.unpack("<3f", row[x])))

            self.check_different(*self.edited(darken))


class Diff(programs.InFolder):
    """`make diff`, with shell scripts as its programs."""

    def setUp(self):
        super().setUp()
        self.build = self.folder / "build"
        self.build.mkdir()
        (self.build / "stage-diff").symlink_to(programs.BUILD / "stage-diff")
        for stage in programs.built_stages():
            (self.build / stage).symlink_to(programs.BUILD / stage)

    def program(self, name, *lines):
        path = self.folder / name
        path.write_text("\n".join(("#!/bin/sh", *lines, "")))
        path.chmod(0o755)
        return path

    def start(self, a, b, **variables):
        given = {"A": a, "B": b, "SCENE": BOX, "OPTIONS": "--spp 4 --quiet", **variables}
        return subprocess.Popen(
            [programs.ROOT / "compare" / "diff.sh"],
            env={**os.environ, "BUILD": str(self.build), **{k: str(v) for k, v in given.items()}},
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def diff(self, a, b, **variables):
        process = self.start(a, b, **variables)
        output, errors = programs.communicate(process)
        return process.returncode, output, errors

    def check_cannot(self, words, *arguments, **variables):
        code, output, errors = self.diff(*arguments, **variables)
        self.assertEqual((code, output), (2, ""), errors)
        self.assertIn(words, errors)

    def test_no_picture_of_an_earlier_run_is_believed(self):
        code, output, errors = self.diff("stage1", "stage1")
        self.assertEqual(code, 0, output + errors)
        picture = self.build / "diff" / "diff.png"
        self.assertIn(str(picture), output)
        self.assertTrue(picture.exists())
        nothing = self.program("nothing", "exit 0")
        self.check_cannot(f"A: '{nothing}' wrote no image", nothing, "stage1")
        self.check_cannot(f"B: '{nothing}' wrote no image", "stage1", nothing)
        failing = self.program("failing", "exit 3")
        self.check_cannot("ended with exit code 3", failing, "stage1")

    def test_a_program_that_never_ends_is_stopped(self):
        endless = self.program("endless", "while :; do :; done")
        self.check_cannot("it may run for LIMIT=1 seconds", endless, "stage1", LIMIT=1)

    def test_one_picture_twice_is_refused(self):
        same = self.program("same", f'exec {shlex.quote(str(self.build))}/stage1 "$@" --seed 1')
        self.check_cannot("the same bits from two seeds", same, same)

    def test_two_at_once(self):
        black = self.program("black", f'exec {shlex.quote(str(self.build))}/stage1 "$@" --max-bounces 0')
        pairs = [("stage1", "stage1", 0), (black, "stage1", 1)]
        running = [(self.start(a, b), code) for a, b, code in pairs]
        for process, code in running:
            output, errors = programs.communicate(process)
            self.assertEqual(process.returncode, code, output + errors)

    def test_old_runs_go(self):
        for i in range(30):
            (self.build / "diff" / f"run.{i:06}").mkdir(parents=True)
        (self.build / "diff" / "run.000000" / "running").write_text(str(os.getpid()))
        os.utime(self.build / "diff" / "run.000000", (0, 0))
        self.diff("stage1", "stage1")
        left = [path.name for path in (self.build / "diff").glob("run.*")]
        self.assertLessEqual(len(left), 22)
        self.assertIn("run.000000", left)

    def test_names_are_no_programs(self):
        """Also with make, which expands its variables."""
        image = self.folder / "x.pfm"
        programs.run("stage1", BOX, "-o", image, "--size", "8x8", "--spp", "4", "--quiet")
        for name in (
            "a`touch ran`.pfm",
            "$(touch ran).pfm",
            "$(shell touch ran).pfm",
            "$(info ran)$x.pfm",
            "a'; touch ran; '.pfm",
            'a"; touch ran; ".pfm',
            "a b *.pfm",
            "-o.pfm",
            "a\\tb.pfm",
        ):
            with self.subTest(name):
                shutil.copy(image, self.folder / name)
                made = subprocess.run(
                    [
                        *("make", "-s", "--no-print-directory", "-f", "Makefile"),
                        *("names", f"A={name}", f"B={name}", f"SCENE={name}", f"OPTIONS={name}"),
                        *("--eval", 'names: ; @printf "%s|" "$$A" "$$B" "$$SCENE" "$$OPTIONS"'),
                    ],
                    cwd=programs.ROOT,
                    capture_output=True,
                    text=True,
                )
                self.assertFalse((programs.ROOT / "ran").exists())
                self.assertEqual(made.stdout, 4 * f"{name}|", made.stderr)
                code, output, errors = self.diff(name, name)
                self.assertEqual(code, 0, output + errors)
                self.assertIn("the same bits", output)
                self.assertFalse((self.folder / "ran").exists())

    def test_a_build_folder_of_odd_letters_is_refused(self):
        for name in ("a b", "a;touch ran", "$(shell touch ran)", "a`touch ran`", "a'b", 'a"b', "a\\b", "a(b"):
            with self.subTest(name):
                made = programs.run_command(["make", "-s", "help", f"BUILD={name}"], cwd=programs.ROOT)
                self.assertEqual(made.returncode, 2)
                self.assertIn(f"BUILD='{name}': a folder name without", made.stderr)
                self.assertFalse((programs.ROOT / "ran").exists())


if __name__ == "__main__":
    unittest.main()
