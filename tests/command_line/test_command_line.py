"""The programs as users use them: options, files and exit codes."""

import os
import pathlib
import pty
import re
import resource
import shutil
import signal
import socket
import struct
import subprocess
import threading
import time
import unittest

from broken_scenes import GOOD, with_instead
from programs import (
    BUILD,
    ENDINGS,
    SCENES,
    InFolder,
    built_stages,
    communicate,
    read_pfm,
    run,
    run_command,
    wait_until,
)

from tests.runner import watch

# The box under a bright ceiling: no pixel of it is black.
BOX = SCENES / "cornell_box_ceiling_diffuse.toml"

# Takes days: a program that ends at once has not rendered it.
FOR_EVER = ["--spp", "1000000000", "--size", "512x512"]


def catches_interrupts(process):
    """Whether a program has reached the point where it handles Ctrl-C."""
    try:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    except OSError:  # not Linux: assume so after a while
        time.sleep(2)
        return True
    caught = int(re.search(r"SigCgt:\s*(\w+)", status)[1], 16)
    return bool(caught >> (signal.SIGINT - 1) & 1)


def interrupt(process, after=0.3):
    """Presses Ctrl-C after some wall-clock time and some processor time: on a busy
    machine, wall-clock time alone says nothing."""
    wait_until(process, lambda: catches_interrupts(process))
    time.sleep(after)
    wait_until(process, lambda: watch.usage(process.pid)[0] >= after)
    process.send_signal(signal.SIGINT)


class Programs(InFolder):
    def run_here(self, *arguments, program="stage1", **options):
        return run(program, *arguments, folder=self.folder, **options)

    def render(self, *arguments, scene=BOX, program="stage1"):
        result = self.run_here(scene, *arguments, program=program)
        self.assertEqual(result.stderr, "")
        self.assertEqual(result.returncode, 0)
        return result.stdout

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def start(self, *arguments, **options):
        process = subprocess.Popen(
            [BUILD / "stage1", *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL, **options
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process


class Options(Programs):
    def wrong(self, *arguments, about):
        """The program refuses this as wrong usage, in one line that contains `about`."""
        result = self.run_here(*arguments)
        for name in self.files():
            (self.folder / name).unlink()
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("stage1: "), result.stderr)
        self.assertIn(about, result.stderr)
        self.assertIn("stage1 --help lists the options", result.stderr)
        self.assertEqual(result.returncode, 2)

    def test_version(self):
        for program in built_stages():
            for option in ["--version", "-V"]:
                result = self.run_here(option, program=program)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertRegex(result.stdout, rf"^{program} \(Lightwalk\) \d+\.\d+\.\d+(, .+)?\n$")

    def test_a_scene_and_an_output_are_needed(self):
        example = "as in 'build/stage1 scenes/cornell_box_ceiling_diffuse.toml -o box.png'"
        self.wrong(about=f"stage1: a scene is required, {example} (")
        self.wrong("-o", "out.pfm", about=f"stage1: a scene is required, {example} (")
        self.wrong("help", about=f"stage1: --output is required, {example} (")
        self.wrong(BOX, about=f"stage1: --output is required, {example} (")
        self.wrong(BOX, "-o", about="stage1: --output needs a value (")
        self.wrong("a.toml", "b.toml", "-o", "out.pfm", about="'b.toml' was not expected after 'a.toml' (")

    def test_an_unknown_option_is_named_first(self):
        for words, said in [
            ("BOX -o out.pfm --seeds 4", "'--seeds', did you mean '--seed'?"),
            ("--seeds 4 BOX -o out.pfm", "'--seeds', did you mean '--seed'?"),
            ("--seeds=4 BOX -o out.pfm", "'--seeds', did you mean '--seed'?"),
            ("-seed 4 BOX -o out.pfm", "'-seed', did you mean '--seed'?"),
            ("--ssp 4", "'--ssp', did you mean '--spp'?"),
            ("--sede 1 --ssp 4", "'--sede', did you mean '--seed'?"),
            ("--pixle 1,1 --sample 2 BOX", "'--pixle', did you mean '--pixel'?"),
            ("--sed 1 BOX -o", "'--sed', did you mean '--seed'?"),
            ("--bounces 4 BOX -o out.pfm", "'--bounces', did you mean '--max-bounces'?"),
            ("--samples 4 BOX -o out.pfm", "'--samples', did you mean '--spp'?"),
            ("--width 4 BOX -o out.pfm", "'--width', did you mean '--size'?"),
            ("BOX -o out.pfm -x", "'-x'"),
            ("BOX -o out.pfm --wavelengths", "'--wavelengths'"),
            ("BOX -o out.pfm --\n", "'-- '"),
        ]:
            with self.subTest(words):
                arguments = [BOX if word == "BOX" else word for word in words.split(" ")]
                self.wrong(*arguments, about=f"stage1: unknown option {said} (stage1 --help")
        # After -- there are no options.
        self.wrong(
            "-o", "out.pfm", "--", "a", "-b", about="stage1: argument '-b' was not expected after 'a' ("
        )

    def test_values_that_do_not_fit(self):
        for option, *values in [
            ("--size", "", "8", "8x", "x8", "8x8x8", "0x8", "8x0", "-8x8"),
            ("--size", "65537x1", "1x65537", "8.5x8", " 8x8", "8X8", "8 x 8"),
            ("--size", "99999999999999999999x1", "a\nb"),
            ("--spp", "", "0", "-1", "1.5", "many", "1000000001"),
            ("--spp", "1" + 30 * "0", "0x10", "1_0", "1'0", "1e1", " 8", "+8"),
            ("--max-bounces", "-1", "4097", "1.5", "none", "0x1", "0b1", "1_0"),
            ("--threads", "-1", "1025", "all", "0.5", "0x1"),
            ("--seed", "-1", "1.5", "x", "18446744073709551616", "0x1"),
            ("--pixel=1,1 --sample", "-1", "1000000000", "0.5", "0x1"),
            ("--pixel", "1", "1,", "-1,1", "0x1,1", "1;1"),
            ("--sampling", "", "cos", "Uniform", "stratified"),
            ("--tone-map", "", "bright", "clamp,bright", "Clamp"),
            ("--gamma", "0", "-1", "11", "nan", "inf", "x", "0x2", "1_0"),
            ("--exposure", "41", "-41", "nan", "inf", "x", "0x2", "1_0"),
        ]:
            for value in values:
                with self.subTest(f"{option} {value}"):
                    *others, last = f"{option}={value}".split(" ", option.count(" "))
                    self.wrong(BOX, "-o", "out.pfm", *others, last, about=option.split(" ")[-1])

    def test_what_was_typed_is_quoted(self):
        for option, value, why in [
            ("--output", "a.gif", "'a.gif' ends in none of .exr, .pfm, .ppm, .png"),
            ("--output", "-", "'-' is no name: images are written by name, like box.png"),
            ("--report", "-", "'-' is no name: reports are written by name, like box.json"),
            ("--report", "a.txt", "'a.txt' does not end in .json"),
            ("--spp", "0", "'0' is not a whole number from 1 to 1000000000"),
            ("--size", "64", "'64' is not a size like 128x128, each from 1 to 65536"),
            ("--pixel", "1", "'1' is not a pixel like 120,80, from 0,0 on"),
            ("--sampling", "cos", "'cos' is none of cosine, uniform"),
            ("--tone-map", "gamma,x", "'x' is none of clamp, equalize, gamma, reinhard"),
            ("--gamma", "11", "'11' is not a number from 0.1 to 10"),
            ("--exposure", "nan", "'nan' is not a number from -40 to 40"),
        ]:
            with self.subTest(f"{option} {value}"):
                self.wrong(BOX, "-o", "out.pfm", option, value, about=f"stage1: {option}: {why} (")
        self.wrong(BOX, "--sample", "1", about="stage1: --sample requires --pixel (")
        self.wrong(BOX, "--quiet=x", about="stage1: --quiet takes no value (")

    def test_whole_numbers_are_decimal(self):
        said = self.render(
            *["-o", "a.pfm", "--size=08x011", "--spp=010", "--max-bounces=010"],
            *["--seed=010", "--threads=01"],
        )
        self.assertIn("a.pfm: 8 x 11, 10 samples per pixel\n", said)
        self.render("-o", "b.pfm", "--size=8x11", "--spp=10", "--max-bounces=10", "--seed=10")
        self.assertEqual(self.bytes_of("a.pfm"), self.bytes_of("b.pfm"))
        told = self.render("--pixel=010,07", "--sample=010")
        self.assertIn("pixel 10,7, sample 10,", told)

    def test_the_ends_of_the_ranges_are_taken(self):
        for option, *values in [
            ("--size", "1x1", "65536x1", "1x65536"),
            ("--max-bounces", "0", "4096"),
            ("--threads", "0", "1024"),
            ("--seed", "0", "18446744073709551615"),
            ("--gamma", "0.1", "10"),
            ("--exposure", "-40", "40"),
        ]:
            for value in values:
                with self.subTest(f"{option} {value}"):
                    small = [] if option == "--size" else ["--size", "2x2"]
                    self.render(*["-o", "out.pfm", "--spp", "1", option, value, *small])

    def test_the_ending_says_the_format(self):
        for name in ["out", "out.jpg", "out.pfm.gz", "pfm", ".pfm", "out."]:
            with self.subTest(name):
                self.wrong(BOX, "-o", name, about=f"'{name}' ends in none of")
        self.render("-o", "out.PFM", "--size", "2x2", "--spp", "1")
        self.assertEqual(self.files(), ["out.PFM"])

    def test_wrong_usage_is_found_before_a_wrong_scene(self):
        self.wrong("no.toml", "-o", "out.jpg", about="ends in none of")


class Renders(Programs):
    small = ["--size", "17x13", "--spp", "4"]  # tiles that are cut off, too

    def test_no_number_of_threads_changes_a_bit(self):
        for threads in [1, 2, 7]:
            pfm = f"{threads}.pfm"
            self.render("-o", pfm, "--threads", threads, *self.small)
            why = f"{threads} threads give another picture than one"
            self.assertEqual(self.bytes_of(pfm), self.bytes_of("1.pfm"), why)

    def test_two_renders_are_equal_files_in_every_format(self):
        for name in ["a", "b"]:
            outputs = []
            for ending in ENDINGS:
                outputs += ["-o", f"{name}.{ending}"]
            self.render(*outputs, *self.small)
            if name == "a":
                time.sleep(1.1)  # a file that contains the time would differ
        for ending in ENDINGS:
            a, b = self.bytes_of(f"a.{ending}"), self.bytes_of(f"b.{ending}")
            self.assertEqual(a, b, ending)

    def test_another_seed_gives_another_picture(self):
        self.render("-o", "default.pfm", *self.small)
        for seed in [0, 1, 2, 2**64 - 1]:
            self.render("-o", f"{seed}.pfm", "--seed", seed, *self.small)
        pictures = {self.bytes_of(name) for name in self.files()}
        self.assertEqual(self.bytes_of("default.pfm"), self.bytes_of("1.pfm"))
        self.assertEqual(len(pictures), 4)

    def test_size_wins_over_the_scene(self):
        self.render("-o", "out.pfm", "--size", "5x3", "--spp", "1")
        self.assertEqual(read_pfm(self.folder / "out.pfm")[:2], (5, 3))

    def test_the_scene_says_size_samples_and_bounces(self):
        scene = GOOD.replace("[4, 4]", "[30, 20]")
        scene = with_instead("pixel = 1\n", "pixel = 3\n", scene)
        (self.folder / "scene.toml").write_text(scene)
        said = self.render("-o", "out.pfm", scene="scene.toml")
        self.assertIn("out.pfm: 30 x 20, 3 samples per pixel\n", said)
        explicit = ["--size", "30x20", "--spp", "3", "--max-bounces"]
        for bounces in [0, 2]:
            out = f"{bounces}.pfm"
            self.render("-o", out, *explicit, bounces, scene="scene.toml")
        self.assertEqual(self.bytes_of("out.pfm"), self.bytes_of("2.pfm"))
        self.assertNotEqual(self.bytes_of("out.pfm"), self.bytes_of("0.pfm"))

    def test_samples_and_bounces_win_over_the_scene(self):
        said = self.render(*["-o", "out.pfm", "--size=8x8", "--spp=2", "--max-bounces=0"])
        self.assertIn("out.pfm: 8 x 8, 2 samples per pixel\n", said)

    def test_no_bounces_show_only_what_emits(self):
        for bounces in [0, 1]:
            self.render(
                *["-o", f"{bounces}.pfm", "--max-bounces", bounces], *["--size", "8x8", "--spp", "32"]
            )
        floor = slice(56, 64)
        *_, pixels = read_pfm(self.folder / "0.pfm")
        self.assertEqual(set(pixels[floor]), {(0, 0, 0)})
        self.assertEqual(set(pixels[3:5]), {(1, 1, 1)}, "the ceiling's ke is 1")
        *_, pixels = read_pfm(self.folder / "1.pfm")
        self.assertGreater(min(max(pixel) for pixel in pixels[floor]), 0)

    def test_uniform_and_cosine_sampling_differ_in_noise_alone(self):
        sums = {}
        for sampling in ["cosine", "uniform"]:
            self.render(
                *["-o", f"{sampling}.pfm", "--sampling", sampling], *["--size", "8x8", "--spp", "256"]
            )
            *_, pixels = read_pfm(self.folder / f"{sampling}.pfm")
            sums[sampling] = sum(map(sum, pixels))
        self.assertNotEqual(self.bytes_of("cosine.pfm"), self.bytes_of("uniform.pfm"))
        self.assertAlmostEqual(sums["uniform"] / sums["cosine"], 1, delta=0.05)

    def test_quiet_says_nothing(self):
        said = self.render("-o", "out.pfm", "--quiet", *self.small)
        self.assertEqual(said, "")
        self.assertEqual(self.files(), ["out.pfm"])

    def test_what_was_rendered_is_said(self):
        said = self.render("-o", "a.pfm", "-o", "b.ppm", *self.small)
        self.assertRegex(
            said,
            r"^a\.pfm: 17 x 13, 4 samples per pixel\n"
            r"b\.ppm: 17 x 13, 4 samples per pixel\n"
            r"[\d.]+ s, [\d.e+]+ [kMG]?samples/s, [\d.]+ rays per sample\n$",
        )

    def test_any_folder_will_do(self):
        (self.folder / "deep" / "er").mkdir(parents=True)
        shutil.copy(BOX, self.folder / "deep" / "box.toml")
        result = run(
            "stage1",
            *["box.toml", "-o", "../up.pfm", "-o", "er/down.ppm"],
            *["-o", self.folder / "absolute.png", *self.small],
            folder=self.folder / "deep",
        )
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.files(), ["absolute.png", "deep", "up.pfm"])
        self.assertTrue((self.folder / "deep/er/down.ppm").is_file())


class Formats(Programs):
    def test_ppm_says_what_its_largest_number_stands_for(self):
        self.render("-o", "a.ppm", "-o", "a.pfm", "--size=8x4", "--spp=4")
        text = self.bytes_of("a.ppm").decode("ascii")
        magic, comment, size, resolution, rest = text.split("\n", 4)
        self.assertEqual((magic, size, resolution), ("P3", "8 4", "65535"))
        self.assertTrue(comment.startswith("#MAX="), comment)
        most = float(comment.removeprefix("#MAX="))
        *_, pixels = read_pfm(self.folder / "a.pfm")
        linear = [channel for pixel in pixels for channel in pixel]
        self.assertAlmostEqual(most, max(linear), places=6)
        numbers = [int(word) * most / 65535 for word in rest.split()]
        self.assertEqual(len(numbers), len(linear))
        for stored, exact in zip(numbers, linear):
            self.assertAlmostEqual(stored, exact, delta=most / 65535)

    def test_png_is_tone_mapped_as_asked(self):
        ways = [
            [],
            ["--tone-map", "equalize,gamma", "--gamma", "2.2"],
            ["--gamma", "1"],
            ["--tone-map", "clamp"],
            ["--tone-map", "reinhard,gamma"],
            ["--tone-map", "reinhard", "--tone-map", "gamma"],
            ["--tone-map", "clamp", "--exposure", "-2"],
        ]
        for i, way in enumerate(ways):
            self.render("-o", f"{i}.png", "--size=8x4", "--spp=4", *way)
        pictures = [self.bytes_of(f"{i}.png") for i in range(len(ways))]
        for picture in pictures:
            self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">II", picture[16:24]), (8, 4))
        self.assertEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[4], pictures[5])
        self.assertEqual(len(set(pictures)), len(ways) - 2)


class WhatCannotBeWritten(Programs):
    """The messages come before a render that takes days begins."""

    def refused(self, path, message, *others, shown=None):
        before = self.files()
        result = self.run_here(BOX, *others, "-o", path, *FOR_EVER)
        self.assert_one_line(result, f"stage1: {shown or path} cannot be written: {message}")
        self.assertEqual(self.files(), before)

    def test_into_a_folder_that_is_not_there(self):
        self.refused("no/where/out.pfm", "there is no folder 'no/where'")

    def test_into_a_file(self):
        (self.folder / "file").touch()
        self.refused("file/out.pfm", "there is no folder 'file'")

    def test_onto_a_folder(self):
        (self.folder / "out.pfm").mkdir()
        self.refused("out.pfm", "it is a folder")

    def test_onto_a_socket(self):
        with socket.socket(socket.AF_UNIX) as one:
            one.bind(str(self.folder / "out.pfm"))
            self.refused("out.pfm", "it is a socket")

    @unittest.skipUnless(os.path.isdir("/proc/self"), "needs Linux")
    def test_into_a_place_where_nobody_can_write(self):
        self.refused("/proc/out.pfm", "no file can be made in '/proc'")

    def test_under_a_name_that_is_too_long(self):
        self.refused(300 * "x" + ".pfm", "...", shown=300 * "x" + "...")

    def test_the_second_of_two(self):
        self.refused("no/out.pfm", "there is no folder 'no'", "-o", "first.pfm")

    def test_without_the_image_library(self):
        shutil.copy(BUILD / "stage1", self.folder)
        environment = dict(os.environ)
        environment.pop("LD_LIBRARY_PATH", None)
        result = run_command(["./stage1", BOX, "-o", "out.exr", *FOR_EVER], cwd=self.folder, env=environment)
        self.assert_one_line(result, "stage1: out.exr cannot be written: .exr needs OpenImageIO, ...")
        self.assertEqual(self.files(), ["stage1"])

    def test_more_pixels_than_any_memory_holds(self):
        result = self.run_here(BOX, "-o", "out.pfm", "--size", "65536x65536")
        self.assert_one_line(
            result,
            "stage1: an image of 65536 x 65536 pixels needs 481 GB of memory, and this machine has ...",
        )
        self.assertEqual(self.files(), [])

    def test_a_disk_that_fills_up_leaves_the_old_file(self):
        def let_no_file_grow():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

        for ending in ENDINGS:
            with self.subTest(ending):
                out = self.folder / f"out.{ending}"
                out.write_text("the old file")
                result = self.run_here(
                    *[BOX, "-o", out.name, "--size", "64x64", "--spp", "1"], preexec_fn=let_no_file_grow
                )
                self.assert_one_line(result, f"stage1: {out.name} cannot be written: ...")
                self.assertEqual(out.read_text(), "the old file")
                self.assertEqual(self.files(), [out.name])
                out.unlink()

    def test_an_old_file_is_replaced(self):
        (self.folder / "out.pfm").write_text("the old file")
        self.render("-o", "out.pfm", "--size", "2x2", "--spp", "1")
        self.assertEqual(read_pfm(self.folder / "out.pfm")[:2], (2, 2))
        self.assertEqual(self.files(), ["out.pfm"])


class CtrlC(Programs):
    def test_writes_what_there_is_and_says_how_much_that_is(self):
        process = self.start(
            *[BOX, "-o", "out.pfm", "-o", "out.png"],
            *["--spp", "1000000000", "--size", "16x16"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        interrupt(process)
        stdout, stderr = communicate(process)
        self.assertEqual(process.returncode, 130, stderr)
        # No progress if stderr is not a terminal: this line is all.
        said = re.fullmatch(r"stage1: interrupted after (\d+) of 1000000000 samples per pixel\n", stderr)
        self.assertIsNotNone(said, stderr)
        samples = int(said[1])
        self.assertGreater(samples, 0)
        for name in ["out.pfm", "out.png"]:
            self.assertIn(f"{name}: 16 x 16, {samples} samples per pixel", stdout)
        self.assertEqual(self.files(), ["out.pfm", "out.png"])
        self.assertIn(b"\n# samples_per_pixel %d\n" % samples, self.bytes_of("out.pfm"))

        # The picture is complete: each pixel is that of a render with this many
        # samples, or with those of one pass more.
        *_, pixels = read_pfm(self.folder / "out.pfm")
        self.render("-o", "b.pfm", "--spp", samples, "--size", "16x16")
        *_, planned = read_pfm(self.folder / "b.pfm")
        self.assertGreater(sum(a == b for a, b in zip(pixels, planned)), 0)
        for pixel, other in zip(pixels, planned):
            self.assertGreater(min(pixel), 0)
            for a, b in zip(pixel, other):
                self.assertLess(abs(a - b), 0.5 * b)

    def test_leaves_no_file_behind_where_it_cannot_write(self):
        (self.folder / "sub").mkdir()
        process = self.start(
            BOX,
            *["-o", "sub/out.pfm", *FOR_EVER],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        wait_until(process, lambda: catches_interrupts(process))
        (self.folder / "sub").rmdir()
        interrupt(process)
        *_, stderr = communicate(process)
        self.assertRegex(stderr, r"^stage1: sub/out\.pfm cannot be written: ")
        self.assertEqual(process.returncode, 1)
        self.assertEqual(self.files(), [])


class Progress(Programs):
    def on_a_terminal(self, *arguments):
        """The output of a render of about a second to a terminal."""
        ours, theirs = pty.openpty()
        written = []

        def read():
            try:
                while data := os.read(ours, 65536):
                    written.append(data)
            except OSError:
                pass  # how Linux reports that the other side is closed

        process = self.start(
            *[BOX, "-o", "out.pfm", "--spp", "1000000000", "--size", "8x8"],
            *arguments,
            stdout=subprocess.DEVNULL,
            stderr=theirs,
        )
        os.close(theirs)
        reader = threading.Thread(target=read)
        reader.start()
        interrupt(process, after=0.8)
        wait_until(process, lambda: False)
        reader.join()
        os.close(ours)
        return b"".join(written).decode()

    def test_is_shown_on_a_terminal_and_wiped_off_at_the_end(self):
        text = self.on_a_terminal()
        self.assertRegex(text, r" *\d+ %  \d+ (s|hours|days) left  [\d.e+]+ [kMG]?samples/s")
        *progress, end = text.split("\r\x1b[K")
        self.assertRegex(end, r"^stage1: interrupted after \d+ of \d+ samples")
        for line in progress:
            self.assertNotIn("\n", line)
        # In a terminal of 30 columns longer lines are cut, not wrapped.
        for line in progress[1:]:
            self.assertIn("samples/s\x1b[?7h", line)
        self.assertTrue(text.startswith("\x1b[?7l\r\x1b[K"), text)

    def test_is_not_shown_where_quiet_was_asked_for(self):
        text = self.on_a_terminal("--quiet")
        self.assertRegex(text, r"^stage1: interrupted after .*\r\n$")


if __name__ == "__main__":
    unittest.main()
