"""Whatever goes wrong when a file is written: it is whole, or it is the old one and the exit code tells.

A library that is preloaded makes one call fail (failing_writes.cpp). Each
format, each call and each error: the table at the end says what came of it.
"""

import collections
import errno
import functools
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

from programs import BUILD, SCENES, InFolder, run, with_signals

LIBRARY = BUILD / "libfailing_writes.so"
BOX = SCENES / "cornell_box_ceiling_diffuse.toml"
SMALL = ["--size", "16x16", "--spp", "1"]
OLD = b"the old file"
ERRORS = ["ENOSPC", "EIO", "EDQUOT", "EINTR", "short"]

# One call of a run: the second open is Call("open", 2).
Call = collections.namedtuple("Call", "name nth")
Fault = collections.namedtuple("Fault", "call error")

outcomes = {}  # (format, call, error): "ok", "told", or "bad"


def what(error):
    return error if error == "short" else str(getattr(errno, error))


def table():
    """A line for each format and call, and a column for each error."""
    rows = collections.defaultdict(dict)
    for (name, call, error), outcome in outcomes.items():
        rows[name, call][error] = outcome
    lines = [f"{'':12}{'call':10}" + "".join(f"{error:8}" for error in ERRORS)]
    for (name, call), row in rows.items():
        cells = "".join(f"{row.get(error, '-'):8}" for error in ERRORS)
        lines.append(f"{name:12}{call.name} {call.nth:<{9 - len(call.name)}}{cells}")
    count = collections.Counter(outcomes.values())
    lines.append(f"{len(outcomes)} runs: {count['ok']} ok, {count['told']} told, {count['bad']} bad")
    return "\n".join(line.rstrip() for line in lines)


def tearDownModule():
    print(table() if outcomes else "no fault could be injected", file=sys.stderr)


@unittest.skipUnless(
    LIBRARY.exists(), "faults are injected on Linux alone, and not under sanitizers: no libfailing_writes.so"
)
class Faults(InFolder):
    def setUp(self):
        super().setUp()
        self.log = self.folder / "calls"
        (self.folder / "out").mkdir()
        self.out = self.folder / "out"

    def environment(self, faults=(), **more):
        text = ",".join(":".join(map(str, fault)) for fault in faults)
        self.log.unlink(missing_ok=True)
        extra = {"LIGHTWALK_FAULTS": text, "LIGHTWALK_CALLS": str(self.log), "LD_PRELOAD": str(LIBRARY)}
        return {**os.environ, **extra, **more}

    def run_with(self, faults, program, *arguments, **more):
        """Runs with faults: (part of the path, call, which of them, what)."""
        environment = self.environment(faults, **more)
        return run(program, *arguments, folder=self.out, env=environment, **with_signals())

    def calls(self, folder=None):
        """The calls that the last run made on files in a folder."""
        counted = collections.Counter()
        calls = []
        for line in self.log.read_text().splitlines():
            name, path, *_ = line.split(" ")
            if path.startswith(f"{folder or self.out}/"):
                counted[name] += 1
                calls.append(Call(name, counted[name]))
        return calls

    def render(self, *arguments, faults=(), program="stage1", **more):
        return self.run_with(faults, program, BOX, *arguments, *SMALL, **more)

    def files_in(self, folder):
        return sorted(path.name for path in pathlib.Path(folder).iterdir())

    def new_old_file(self, path):
        path.parent.mkdir(exist_ok=True)
        for leftover in path.parent.iterdir():
            leftover.unlink()
        path.write_bytes(OLD)

    @staticmethod
    @functools.cache
    def image():
        """An image that stage-diff can compare, with itself for instance."""
        folder = tempfile.mkdtemp(prefix="lightwalk-")
        unittest.addModuleCleanup(shutil.rmtree, folder)
        path = pathlib.Path(folder, "a.exr")
        run("stage1", BOX, "-o", path, "--size", "16x16", "--spp", "2").check_returncode()
        return path

    def judge(self, name, fault, path, result, is_whole):
        """Whether the rule was kept: a whole file and 0, or the old one and a line."""
        said = [line for line in result.stderr.splitlines() if f"{path} cannot be written: " in line]
        whole = is_whole(path.read_bytes()) if path.exists() else False
        old = path.exists() and path.read_bytes() == OLD
        alone = self.files_in(path.parent) == [path.name]
        if alone and whole and not said:
            outcome = "ok"
        elif alone and old and len(said) == 1 and result.returncode != 0:
            outcome = "told"
        else:
            outcome = "bad"
        outcomes[name, fault.call, fault.error] = outcome
        with self.subTest(f"{name}, {fault.call.name} {fault.call.nth}, {fault.error}"):
            self.assertNotEqual(
                outcome,
                "bad",
                f"exit code {result.returncode}, {result.stderr!r}; in the folder: "
                f"{self.files_in(path.parent)}; the file is "
                f"{'whole' if whole else 'the old one' if old else 'neither old nor whole'}",
            )

    def faults(self, calls):
        """Each error that each of the calls can have."""
        return [
            Fault(call, error)
            for call in calls
            for error in ERRORS
            if error != "short" or call.name == "write"
        ]

    def check_calls(self, calls):
        """Nothing is written in a way that the library does not see."""
        for name in ["open", "write", "close", "rename"]:
            self.assertIn(Call(name, 1), calls, "this call is not seen: is the file written in another way?")

    def test_images(self):
        """All faults of a format in one run: each has a file in a folder of its own."""
        for ending in ["pfm", "ppm", "exr", "png"]:
            good = self.out / f"out.{ending}"
            self.new_old_file(good)
            self.assertEqual(self.render("-o", good).returncode, 0)
            expected = good.read_bytes()
            calls = self.calls()
            self.check_calls(calls)
            places = {}
            for i, fault in enumerate(self.faults(calls)):
                places[self.folder / f"{ending}{i}" / good.name] = fault
            while places:
                outputs, faults = [], []
                for path, fault in places.items():
                    self.new_old_file(path)
                    outputs += ["-o", path]
                    faults.append((f"{path.parent}/", *fault.call, what(fault.error)))
                result = self.render(*outputs, faults=faults)
                # What fails before the render has begun ends the run: the
                # others are asked again without it.
                lines = result.stderr.splitlines()
                refused = [
                    path
                    for path in places
                    if len(lines) == 1 and f": {path} cannot" in lines[0] and not self.rendered(places)
                ]
                for path in refused or places:
                    fault = places[path]
                    self.judge(ending, fault, path, result, lambda data: data == expected)
                    self.assertIn(fault.call, self.calls(path.parent), "the fault was never met")
                if any(path.read_bytes() == OLD for path in places):
                    self.assertEqual(result.returncode, 1, result.stderr)
                places = {path: places[path] for path in places if refused and path not in refused}

    def rendered(self, places):
        return any(Call("write", 1) in self.calls(path.parent) for path in places)

    def test_report(self):
        path = self.out / "report.json"

        def is_whole(data):
            return data[-2:] == b"}\n" and json.loads(data)["width"] == 16

        self.new_old_file(path)
        self.assertEqual(self.render("--report", path).returncode, 0)
        calls = self.calls()
        self.check_calls(calls)
        for fault in self.faults(calls):
            self.new_old_file(path)
            result = self.render("--report", path, faults=[("out/", *fault.call, what(fault.error))])
            self.judge("report", fault, path, result, is_whole)
            self.assertEqual(result.returncode, 0 if is_whole_file(path, is_whole) else 1)

    def test_picture_of_stage_diff(self):
        """Writes as the stages do; so each call has one of the errors, and all are interrupted at once."""
        path = self.out / "diff.png"
        image = self.image()

        def diff(*faults):
            self.new_old_file(path)
            return self.run_with(faults, "stage-diff", image, image, "-o", path)

        result = diff()
        self.assertEqual(result.returncode, 0, result.stderr)
        expected = path.read_bytes()
        calls = self.calls()
        self.check_calls(calls)
        errors = ["ENOSPC", "EIO", "EDQUOT"]
        for i, call in enumerate(calls):
            fault = Fault(call, errors[i % 3])
            result = diff(("out/", *call, what(fault.error)))
            self.judge("stage-diff", fault, path, result, lambda data: data == expected)
            self.assertEqual(result.returncode, 0 if path.read_bytes() == expected else 2)
        result = diff(*[("out/", *call, what("EINTR")) for call in calls], ("out/", "write", 2, "short"))
        for call in calls:
            self.judge("stage-diff", Fault(call, "EINTR"), path, result, lambda data: data == expected)

    def test_the_first_of_two_fails(self):
        first, second, report = (self.out / name for name in ["a.pfm", "b.pfm", "c.json"])
        self.new_old_file(first)
        faults = [("out/", "write", 1, what("ENOSPC"))]
        result = self.render("-o", first, "-o", second, "--report", report, faults=faults)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, f"stage1: {first} cannot be written: No space left on device\n")
        self.assertEqual(first.read_bytes(), OLD)
        self.assertNotIn(str(first), result.stdout)
        self.assertIn(f"{second}: 16 x 16", result.stdout)
        self.assertEqual(self.files_in(self.out), [first.name, second.name, report.name])
        self.assertEqual(json.loads(report.read_text())["outputs"], [str(second)])

    def test_two_renders_at_once_to_one_name(self):
        """The second begins and ends while the first is about to write."""
        for ending in ["pfm", "exr"]:
            path = self.out / f"out.{ending}"
            self.new_old_file(path)
            first = subprocess.Popen(
                [BUILD / "stage1", BOX, "-o", path, "--quiet", "--seed", "1", *SMALL],
                env=self.environment([("out/", "write", 1, f"signal{int(signal.SIGSTOP)}")]),
            )
            self.addCleanup(first.wait)
            self.addCleanup(first.kill)
            self.assertTrue(os.WIFSTOPPED(os.waitpid(first.pid, os.WUNTRACED)[1]))
            second = run("stage1", BOX, "-o", path, "--quiet", "--seed", "2", "--size", "24x24", "--spp", "4")
            self.assertEqual((second.returncode, second.stderr), (0, ""))
            first.send_signal(signal.SIGCONT)
            self.assertEqual(first.wait(60), 0)
            self.assertEqual(self.files_in(self.out), [path.name])
            written = path.read_bytes()
            self.assertEqual(self.render("-o", path, "--seed", "1").returncode, 0)
            self.assertEqual(written, path.read_bytes(), "the last to write is what is there")

    def test_no_name_can_be_foreseen(self):
        """What a run has used as a name is a trap for the next: a link, a pipe, a file."""
        path = self.out / "out.pfm"
        victim = self.folder / "victim"
        victim.write_text("precious")
        traps = {"out.pfm", ".out.unfinished.pfm"}
        (self.out / ".out.unfinished.pfm").symlink_to(victim)
        for make in [
            lambda trap: trap.symlink_to(victim),
            os.mkfifo,
            lambda trap: trap.write_text("mine"),
            None,
        ]:
            self.assertEqual(self.render("-o", path).returncode, 0)
            used = {line.split(" ")[1] for line in self.log.read_text().splitlines()}
            used = {pathlib.Path(name) for name in used if name.startswith(f"{self.out}/")} - {path}
            self.assertGreaterEqual(len(used), 1)
            for trap in used:
                self.assertNotIn(trap.name, traps, "the name of an earlier run again")
                if make:
                    make(trap)
                    traps.add(trap.name)
            self.assertEqual(self.files_in(self.out), sorted(traps))
        self.assertEqual(victim.read_text(), "precious")

    def test_a_link_that_somebody_plants_is_not_followed(self):
        """Even if its name was guessed: the library plants it when the file is opened."""
        victim = self.folder / "victim"
        for nth in [1, 2]:
            victim.write_text("precious")
            path = self.out / "out.pfm"
            self.new_old_file(path)
            planting = [("out/", "open", nth, "plant")]
            result = self.render("-o", path, faults=planting, LIGHTWALK_VICTIM=str(victim))
            self.assertEqual(victim.read_text(), "precious")
            links = [one for one in self.out.iterdir() if one.is_symlink()]
            self.assertEqual(len(links), 1, "somebody's file is left alone")
            if result.returncode:
                self.assertEqual(path.read_bytes(), OLD)
                why = f"no file can be made in '{path.parent}': File exists"
                self.assertEqual(result.stderr, f"stage1: {path} cannot be written: {why}\n")

    def test_a_signal_that_ends_the_program_leaves_no_unfinished_file(self):
        path = self.out / "out.pfm"
        for number in [signal.SIGINT, signal.SIGTERM]:
            for at in ["write", "fsync", "rename"]:
                self.new_old_file(path)
                # The first is an interrupt, and the second ends it at once.
                faults = [
                    ("out/", "open", 2, f"signal{int(number)}"),
                    ("out/", at, 1, f"signal{int(number)}"),
                ]
                result = self.render("-o", path, faults=faults)
                self.assertEqual(result.returncode, -number, result.stderr)
                self.assertEqual(path.read_bytes(), OLD)
                self.assertEqual(self.files_in(self.out), [path.name])
        image, path = self.image(), self.out / "diff.png"
        self.new_old_file(path)
        result = self.run_with([("out/", "write", 1, "signal2")], "stage-diff", image, image, "-o", path)
        self.assertEqual(result.returncode, -signal.SIGINT, result.stderr)
        self.assertEqual(path.read_bytes(), OLD)
        self.assertEqual(self.files_in(self.out), [path.name])

    def test_an_interrupt_while_the_file_is_written_loses_nothing(self):
        path = self.out / "out.pfm"
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            self.new_old_file(path)
            result = self.render("-o", path, faults=[("out/", "write", 1, f"signal{int(number)}")])
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(path.read_bytes()[:3], b"PF\n")


def is_whole_file(path, is_whole):
    data = path.read_bytes()
    return data != OLD and is_whole(data)


del InFolder  # unittest would run the tests that it imports

if __name__ == "__main__":
    unittest.main()
