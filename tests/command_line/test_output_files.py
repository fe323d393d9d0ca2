"""Where a picture goes: links, modes, pipes, long names; and when it cannot."""

import json
import os
import pathlib
import pty
import re
import resource
import shutil
import signal
import stat
import subprocess
import tempfile
import threading
import tty
import unittest

from programs import (
    BUILD,
    SCENES,
    InFolder,
    communicate,
    read_pfm,
    run,
    run_command,
    wait_until,
    with_signals,
)

BOX = SCENES / "cornell_box_ceiling_diffuse.toml"
SMALL = ["--size", "8x8", "--spp", "1"]
OLD = "the old file"


class Outputs(InFolder):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out.pfm"

    def render(self, *arguments, **options):
        return run("stage1", BOX, *SMALL, *arguments, folder=self.folder, **options)

    def assert_done(self, result):
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def assert_whole(self, path):
        self.assertEqual(read_pfm(path)[:2], (8, 8))

    def render_unprivileged(self, *arguments, scene=BOX, **options):
        """Like `render`, for a program that may change only the contents of the folder."""
        if os.geteuid() != 0:
            return run("stage1", scene, *SMALL, *arguments, folder=self.folder, **options)
        # Other users may not enter root's home, where the tree may be.
        place = pathlib.Path(tempfile.mkdtemp(prefix="lightwalk-"))
        self.addCleanup(shutil.rmtree, place)
        program, box = (pathlib.Path(shutil.copy(file, place)) for file in (BUILD / "stage1", BOX))
        for file in (place, program, box):
            file.chmod(0o755)
        scene = box if scene == BOX else scene
        self.folder.chmod(0o777)
        nobody = {"user": 65534, "group": 65534, "extra_groups": []}
        return run_command([program, scene, *SMALL, *arguments], cwd=self.folder, **nobody, **options)

    def mode(self, path):
        return stat.S_IMODE(path.stat().st_mode)


class WhatIsThere(Outputs):
    def test_a_scene_in_a_folder_that_may_not_be_searched(self):
        (self.folder / "closed").mkdir(mode=0o600)
        result = self.render_unprivileged("-o", "out.pfm", scene="closed/scene.toml")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, "stage1: closed/scene.toml: Permission denied\n")

    def test_a_link_stays_and_the_file_it_leads_to_is_replaced(self):
        (self.folder / "deep").mkdir()
        for target in ["deep/a.pfm", self.folder / "b.pfm", "none_yet.pfm"]:
            file = self.folder / target
            if file.name != "none_yet.pfm":
                file.write_text(OLD)
            self.out.symlink_to("link")
            (self.folder / "link").symlink_to(target)
            self.assert_done(self.render("-o", "out.pfm"))
            self.assertTrue(self.out.is_symlink() and (self.folder / "link").is_symlink())
            self.assertFalse(file.is_symlink())
            self.assert_whole(file)
            self.out.unlink()
            (self.folder / "link").unlink()
        self.assertEqual(self.files(), ["b.pfm", "deep", "none_yet.pfm"])

    def test_a_link_is_read_where_it_is(self):
        (self.folder / "deep/er").mkdir(parents=True)
        (self.folder / "deep/a.pfm").symlink_to("er/b.pfm")
        (self.folder / "deep/er/b.pfm").symlink_to("../../c.pfm")
        self.assert_done(self.render("-o", "deep/a.pfm"))
        self.assert_whole(self.folder / "c.pfm")
        self.assertEqual(self.files(), ["c.pfm", "deep"])

    def test_links_that_lead_nowhere(self):
        (self.folder / "a.pfm").symlink_to("b.pfm")
        (self.folder / "b.pfm").symlink_to("a.pfm")
        (self.folder / "c.pfm").symlink_to("none/c.pfm")
        result = self.render("-o", "a.pfm")
        self.assert_one_line(result, "stage1: a.pfm cannot be written: ...")
        result = self.render("-o", "c.pfm")
        self.assert_one_line(result, "stage1: c.pfm cannot be written: there is no folder 'none'")
        self.assertEqual(self.files(), ["a.pfm", "b.pfm", "c.pfm"])

    def test_the_other_name_of_a_hard_link_keeps_the_old_picture(self):
        """As the README says: writing into the old file would risk both."""
        self.out.write_text(OLD)
        os.link(self.out, self.folder / "other.pfm")
        self.assert_done(self.render("-o", "out.pfm"))
        self.assert_whole(self.out)
        self.assertEqual((self.folder / "other.pfm").read_text(), OLD)

    def test_the_mode_is_kept(self):
        for mode in [0o600, 0o640, 0o666, 0o755]:
            self.out.write_text(OLD)
            self.out.chmod(mode)
            self.assert_done(self.render("-o", "out.pfm", "--report", "a.json"))
            self.assertEqual(oct(self.mode(self.out)), oct(mode))

    def test_a_new_file_has_the_mode_that_the_umask_leaves(self):
        for mask, mode in [(0o022, 0o644), (0o027, 0o640), (0o077, 0o600), (0, 0o666)]:
            self.assert_done(self.render("-o", "out.pfm", "--report", "a.json", umask=mask))
            for name in ["out.pfm", "a.json"]:
                self.assertEqual(oct(self.mode(self.folder / name)), oct(mode))
                (self.folder / name).unlink()

    def test_a_file_that_is_read_only_is_not_replaced(self):
        self.out.write_text(OLD)
        self.out.chmod(0o444)
        result = self.render_unprivileged("-o", "out.pfm")
        self.assert_one_line(result, "stage1: out.pfm cannot be written: it may not be written")
        self.assertEqual(self.out.read_text(), OLD)
        self.assertEqual(self.files(), ["out.pfm"])

    def test_into_a_folder_that_is_read_only(self):
        (self.folder / "closed").mkdir(mode=0o555)
        result = self.render_unprivileged("-o", "closed/out.pfm")
        self.assert_one_line(
            result, "stage1: closed/out.pfm cannot be written: no file can be made in 'closed'"
        )
        self.assertEqual(list((self.folder / "closed").iterdir()), [])

    def test_into_a_folder_that_may_not_be_searched(self):
        (self.folder / "closed").mkdir(mode=0o644)
        result = self.render_unprivileged("-o", "closed/out.pfm")
        self.assert_one_line(result, "stage1: closed/out.pfm cannot be written: Permission denied")

    def test_names_of_255_bytes(self):
        for letter in ["x", "\u00e9"]:
            size = (255 - len(".pfm")) // len(letter.encode())
            name = letter * size + ".pfm"
            name = "x" * (255 - len(name.encode())) + name
            report = name.removesuffix(".pfm")[1:] + ".json"
            for _ in range(2):
                self.assert_done(self.render("-o", name, "--report", report))
                self.assert_whole(self.folder / name)
            self.assertEqual(self.files(), sorted([name, report]))
            for file in [name, report]:
                (self.folder / file).unlink()
        result = self.render("-o", "x" * 252 + ".pfm")
        self.assert_one_line(result, f"stage1: {'x' * 252}.pfm cannot be written: File name too long")
        result = self.render("-o", "x" * 18_000 + ".pfm")
        self.assert_one_line(result, f"stage1: {'x' * 300}... cannot be written: File name too long")

    def test_control_characters_in_a_name_are_spelt_out(self):
        name = "a\x1b[2J\n\x7f\u009b\u00e9.pfm"
        said = self.render("-o", name)
        self.assert_done(said)
        self.assertTrue(
            said.stdout.startswith("a\\x1b[2J\\x0a\\x7f\\xc2\\x9b\u00e9.pfm: 8 x 8, 1 samples per pixel\n"),
            ascii(said.stdout),
        )
        self.assert_whole(self.folder / name)
        (self.folder / name).unlink()
        (self.folder / name).mkdir()
        refused = self.render("-o", name)
        self.assert_one_line(
            refused, "stage1: a\\x1b[2J\\x0a\\x7f\\xc2\\x9b\u00e9.pfm cannot be written: it is a folder"
        )


class PipesAndDevices(Outputs):
    def test_a_pipe_gets_the_picture(self):
        self.assert_done(self.render("-o", "plain.pfm"))
        os.mkfifo(self.out)
        reader = os.open(self.out, os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, reader)
        self.assert_done(self.render("-o", "out.pfm"))
        self.assertEqual(os.read(reader, 65536), (self.folder / "plain.pfm").read_bytes())
        self.assertTrue(self.out.is_fifo())
        self.assertEqual(self.files(), ["out.pfm", "plain.pfm"])

    def test_a_reader_who_goes_away_is_an_error(self):
        os.mkfifo(self.out)

        def read():
            with open(self.out, "rb", buffering=0) as pipe:
                pipe.read(1)

        threading.Thread(target=read, daemon=True).start()
        result = self.render("-o", "out.pfm", "-o", "b.pfm", "--size", "256x256", "--quiet")
        self.assert_one_line(result, "stage1: out.pfm cannot be written: it does not take all of the bytes")
        self.assertEqual(read_pfm(self.folder / "b.pfm")[:2], (256, 256))

    def test_the_standard_output(self):
        self.assert_done(self.render("-o", "plain.pfm"))
        expected = (self.folder / "plain.pfm").read_bytes()
        self.out.symlink_to("/dev/stdout")
        command = [BUILD / "stage1", BOX, *SMALL, "-o", "out.pfm", "--quiet"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True)
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, b"", expected))
        # The file is replaced like any other.
        with open(self.folder / "all", "wb") as file:
            subprocess.run(command, cwd=self.folder, stdout=file, check=True)
        self.assertEqual((self.folder / "all").read_bytes(), expected)
        self.assertEqual(self.files(), ["all", "out.pfm", "plain.pfm"])

    def test_a_device_gets_the_picture(self):
        """A separate terminal: a broken program run by root could replace /dev/null by a file."""
        self.assert_done(self.render("-o", "plain.pfm"))
        expected = (self.folder / "plain.pfm").read_bytes()
        ours, theirs = pty.openpty()
        tty.setraw(theirs)
        self.out.symlink_to(os.ttyname(theirs))
        self.assert_done(self.render("-o", "out.pfm"))
        data = b""
        while len(data) < len(expected):
            data += os.read(ours, 4096)
        self.assertEqual(data, expected)
        self.assertEqual(self.files(), ["out.pfm", "plain.pfm"])
        os.close(theirs)
        os.close(ours)

    @unittest.skipUnless(os.path.exists("/dev/full"), "needs Linux")
    def test_a_full_device_is_an_error(self):
        """An open file, and not as root: a broken program must not replace the device."""
        full = os.open("/dev/full", os.O_WRONLY)
        self.addCleanup(os.close, full)
        self.out.symlink_to(f"/dev/fd/{full}")
        result = self.render_unprivileged("-o", "out.pfm", pass_fds=[full])
        self.assert_one_line(result, "stage1: out.pfm cannot be written: it does not take all of the bytes")


class StandardOutput(Outputs):
    @unittest.skipUnless(os.path.exists("/dev/full"), "needs Linux")
    def test_a_full_one_is_an_error(self):
        self.assert_done(self.render("-o", "a.pfm", "--spp", "4"))
        for program, code, *arguments in [
            ("stage1", 1, "--help"),
            ("stage1", 1, "--version"),
            ("stage1", 1, BOX, "--pixel", "1,1"),
            ("stage1", 1, BOX, *SMALL, "-o", "c.pfm"),
            ("stage-diff", 2, "--help"),
            ("stage-diff", 2, "--version"),
            ("stage-diff", 2, "a.pfm", "a.pfm", "--json"),
        ]:
            with self.subTest(program, arguments=arguments), open("/dev/full", "w") as full:
                result = run(program, *arguments, folder=self.folder, stdout=full)
                self.assertEqual(result.returncode, code)
                self.assertEqual(
                    result.stderr, f"{program}: the standard output does not take all of the text\n"
                )
        self.assert_whole(self.folder / "c.pfm")


class SeveralFiles(Outputs):
    def test_the_others_are_written_where_one_fails(self):
        def let_no_file_grow():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

        self.out.write_text(OLD)
        result = self.render(
            *["-o", "out.pfm", "-o", "b.png", "--report", "c.json", "--size", "64x64"],
            preexec_fn=let_no_file_grow,
        )
        self.assertEqual(
            result.stderr, "stage1: out.pfm cannot be written: it cannot be written whole; is there room?\n"
        )
        self.assertEqual(result.returncode, 1)
        self.assertEqual(self.out.read_text(), OLD)
        self.assertEqual((self.folder / "b.png").read_bytes()[-8:-4], b"IEND")
        self.assertEqual(json.loads((self.folder / "c.json").read_text())["outputs"], ["b.png"])
        self.assertTrue(result.stdout.startswith("b.png: 64 x 64"), result.stdout)
        self.assertEqual(self.files(), ["b.png", "c.json", "out.pfm"])


class Interrupts(Outputs):
    """A program of 8 x 8 pixels that waits at its nth sample for a signal."""

    FIRST_PASS, LATER = 20, 64 + 20

    def interrupted(self, at, *signals, spp=1000, ignored=(), outputs=("out.pfm",)):
        arguments = ["--spp", str(spp), "--size", "8x8", "--threads", "1", "--report", "a.json"]
        for output in outputs:
            arguments += ["-o", output]
        process = subprocess.Popen(
            [BUILD / "pausing", BOX, *arguments],
            cwd=self.folder,
            env={**os.environ, "PAUSE_AT": str(at)},
            **with_signals(ignored),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "paused\n")
        for number in signals:
            process.send_signal(number)
            self.wait_until_delivered(process, number)
        stdout, stderr = communicate(process, "go on\n")
        return subprocess.CompletedProcess(process.args, process.returncode, stdout, stderr)

    def wait_until_delivered(self, process, number):
        status = pathlib.Path(f"/proc/{process.pid}/status")

        def delivered():
            pending = re.findall(r"(?:SigPnd|ShdPnd):\s*(\w+)", status.read_text())
            return not any(int(mask, 16) >> (number - 1) & 1 for mask in pending)

        if status.exists():  # Linux
            wait_until(process, delivered)

    def test_in_the_first_pass_the_old_picture_is_kept(self):
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            self.out.write_text(OLD)
            result = self.interrupted(self.FIRST_PASS, number)
            self.assertEqual(
                result.stderr,
                "pausing: out.pfm is kept as it was: the first pass over the picture was not finished\n"
                "pausing: interrupted after 0 of 1000 samples per pixel\n",
            )
            self.assertEqual(result.returncode, 130)
            self.assertEqual(self.out.read_text(), OLD)
            self.assertEqual(self.files(), ["a.json", "out.pfm"])
            self.assertNotIn("out.pfm", result.stdout)
            report = json.loads((self.folder / "a.json").read_text())
            self.assertEqual((report["interrupted"], report["outputs"]), (True, []))
            self.assertEqual(report["samples_per_pixel"], 0)

    def test_in_the_first_pass_a_new_picture_is_written_as_far_as_it_goes(self):
        """Since the old one cannot be lost; an empty file is no picture."""
        self.out.write_text("")
        (self.folder / "old.ppm").write_text(OLD)
        result = self.interrupted(self.FIRST_PASS, signal.SIGINT, outputs=["old.ppm", "out.pfm", "new.pfm"])
        self.assertEqual(
            result.stderr,
            "pausing: old.ppm is kept as it was: the first pass over the picture was not finished\n"
            "pausing: parts of out.pfm are black: the first pass over the picture was not finished\n"
            "pausing: parts of new.pfm are black: the first pass over the picture was not finished\n"
            "pausing: interrupted after 0 of 1000 samples per pixel\n",
        )
        self.assertEqual(result.returncode, 130)
        self.assertEqual((self.folder / "old.ppm").read_text(), OLD)
        for name in ["out.pfm", "new.pfm"]:
            *_, pixels = read_pfm(self.folder / name)
            black = pixels.count((0, 0, 0))
            self.assertTrue(0 < black < 64, f"{black} of 64 pixels are black")

    def test_later_the_picture_is_replaced_by_what_there_is(self):
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU]:
            self.out.write_text(OLD)
            result = self.interrupted(self.LATER, number)
            self.assertEqual(result.stderr, "pausing: interrupted after 1 of 1000 samples per pixel\n")
            self.assertEqual(result.returncode, 130)
            *_, pixels = read_pfm(self.out)
            self.assertNotIn((0, 0, 0), pixels)
            self.assertEqual(self.files(), ["a.json", "out.pfm"])
            self.assertTrue(json.loads((self.folder / "a.json").read_text())["interrupted"])

    def test_nohup(self):
        """A signal that is ignored when the program starts stays ignored."""
        for number in [signal.SIGHUP, signal.SIGTERM]:
            result = self.interrupted(self.FIRST_PASS, number, spp=2, ignored=[number])
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assert_whole(self.out)

    @unittest.skipUnless(os.path.isdir("/proc/self"), "needs Linux")
    def test_a_second_one_ends_the_program_at_once(self):
        for number in [signal.SIGINT, signal.SIGTERM]:
            self.out.write_text(OLD)
            result = self.interrupted(self.LATER, number, number)
            self.assertEqual((result.returncode, result.stderr), (-number, ""))
            self.assertEqual(self.out.read_text(), OLD)
            self.assertEqual(self.files(), ["out.pfm"])

    def test_a_terminal_that_closes_may_say_so_twice(self):
        """And where processor time is used up, the system says so each second."""
        for signals in [
            [signal.SIGHUP] * 2,
            [signal.SIGXCPU] * 2,
            [signal.SIGTERM, signal.SIGHUP],
            [signal.SIGHUP, signal.SIGTERM],
        ]:
            self.out.write_text(OLD)
            result = self.interrupted(self.LATER, *signals)
            self.assertEqual(result.returncode, 130, result.stderr)
            self.assert_whole(self.out)


del InFolder, Outputs  # unittest would run the tests that it imports

if __name__ == "__main__":
    unittest.main()
