"""Programs whose renders end early, and say why."""

import os
import resource
import signal
import subprocess
import sys
import unittest

from programs import BUILD, HAS_EXR, SCENES, InFolder, built_stages, communicate, run, sanitized

BOX = SCENES / "cornell_box_ceiling_diffuse.toml"


class Throwing(InFolder):
    def test_what_a_thread_throws_is_one_line(self):
        told = {
            1: "error: the path tracer threw an exception: a pixel is wrong",
            2: "there is not enough memory",
            3: "error: the path tracer threw something that is not a std::exception",
        }
        for seed, message in told.items():
            for threads in (1, 8):
                with self.subTest(message, threads=threads):
                    result = run(
                        "throwing",
                        *[BOX, "-o", "out.pfm", "--seed", seed, "--threads", threads],
                        folder=self.folder,
                    )
                    self.assert_one_line(result, f"throwing: {message}")
                    self.assertEqual(self.files(), [])

    def test_what_a_told_path_throws_is_one_line(self):
        for sample in range(500):
            result = run("throwing", BOX, "--pixel=0,0", "--seed=3", f"--sample={sample}", folder=self.folder)
            if result.returncode:
                break
        self.assert_one_line(
            result, "throwing: error: the path tracer threw something that is not a std::exception"
        )


class TooFewThreads(InFolder):
    @unittest.skipUnless(HAS_EXR, "OpenImageIO is not in this build")
    @unittest.skipIf(sanitized(), "the sanitizer needs the memory")
    def test_an_exr_that_cannot_be_written_is_an_error_before_the_render(self):
        """OpenImageIO takes about 450 MB of addresses; with less, it ends the program that loads it."""

        def leave_little_room(bytes):
            resource.setrlimit(resource.RLIMIT_AS, (bytes, bytes))

        for megabytes in (300, 400, 420):
            with self.subTest(megabytes):
                result = run(
                    "stage1",
                    # For ever, if the render begins.
                    *[BOX, "-o", "out.exr", "--spp=1000000000", "--threads=1"],
                    folder=self.folder,
                    preexec_fn=lambda: leave_little_room(megabytes * 1_000_000),
                )
                self.assert_one_line(result, "stage1: out.exr cannot be written: .exr needs OpenImageIO, ...")
                self.assertEqual(self.files(), [])

    @unittest.skipUnless(HAS_EXR and sys.platform == "linux", "a child process tries OpenImageIO on Linux")
    def test_a_library_that_waits_for_ever_is_an_error(self):
        result = run(
            "stage1",
            *[BOX, "-o", "out.exr", "--spp=1"],
            folder=self.folder,
            env=os.environ | {"LD_LIBRARY_PATH": str(BUILD / "tests/waiting")},
        )
        self.assert_one_line(result, "stage1: out.exr cannot be written: .exr needs OpenImageIO, ...")
        self.assertEqual(self.files(), [])

    @unittest.skipIf(sanitized(), "the sanitizer needs the memory")
    def test_a_render_takes_the_threads_that_it_gets(self):
        def leave_little_room():
            resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30))

        result = run(
            "stage1",
            *[BOX, "-o", "out.pfm", "--size=512x512", "--spp=1", "--max-bounces=0", "--threads=1024"],
            folder=self.folder,
            preexec_fn=leave_little_room,
        )
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.files(), ["out.pfm"])


@unittest.skipUnless("stage3" in built_stages(), "needs stage 3")
class TreesOfPaths(InFolder):
    """In this scene a sample with 64 bounces follows 2^64 rays."""

    endless = [SCENES / "plastic.toml", "--max-bounces", "64"]

    def test_is_told_what_it_takes_and_can_be_interrupted(self):
        process = subprocess.Popen(
            [BUILD / "stage3", *self.endless, "-o", "out.pfm"],
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        self.assertRegex(
            process.stderr.readline(),
            r"^stage3: each sample follows more than [\d.]+ [kMG] rays; the picture would "
            r"take more than [\d.e+]+ (days|years); fewer --max-bounces take less\n$",
        )
        process.send_signal(signal.SIGINT)
        communicate(process)
        self.assertEqual(process.returncode, 130)

    def test_is_too_long_to_be_told(self):
        result = run("stage3", *self.endless, "--pixel=128,128", folder=self.folder)
        self.assert_one_line(
            result,
            "stage3: the sample follows more than 100,000 rays, too many to print: try fewer --max-bounces",
        )


if __name__ == "__main__":
    unittest.main()
