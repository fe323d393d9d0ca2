"""The report of a failing suite; no suite passes without its last test, and none
fails because the machine is busy."""

import contextlib
import os
import platform
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest
import unittest.mock as mock
from pathlib import Path

from programs import BUILD, ROOT, sanitized, with_signals

from tests.runner import process, report, suite, watch

SUITE = BUILD / "bad_suite"


def run(tests, **options):
    """The outcome of the tests with these names."""
    return suite.run_by_kinds(SUITE, f"-tc={tests}", **options)


@contextlib.contextmanager
def busy_machine(processes=16):
    """Occupies more processors than there are."""
    command = [sys.executable, "-c", "while True: pass"]
    others = [subprocess.Popen(command) for _ in range(processes)]
    try:
        yield
    finally:
        for other in others:
            other.kill()
            other.wait()


def marked():
    """The processes that a suite of this program has started and left."""
    found = []
    for path in Path("/proc").glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            if b"LIGHTWALK_TEST_OF_RUNNER=" + str(os.getpid()).encode() in path.read_bytes():
                found.append(int(path.parent.name))
    return set(found) - {os.getpid()}


class Runner(unittest.TestCase):
    def assert_says(self, tests, *sentences, passes=False, **options):
        outcome = run(tests, **options)
        text = report.summary(outcome)
        plain = " ".join(text.split())
        for sentence in sentences:
            self.assertIn(sentence, plain)
        self.assertEqual(outcome.passed, passes, text)
        return text


class Reports(Runner):
    def test_a_pass_is_a_line(self):
        text = self.assert_says("unit passes", passes=True)
        self.assertEqual(text, "1 test passes\n")

    def test_no_test_is_no_pass(self):
        self.assert_says("there is none", "no test has this name")

    def test_vectors_are_printed(self):
        self.assert_says("unit vector", "(0.1, 0.2, 0.3) == (1, 2, 3)", "(tests/command_line/bad_suite.cpp:")

    def test_a_sentence_needs_no_code(self):
        text = self.assert_says("unit sentence", "a ball is hit 0 times, expected 1", "bad_suite.cpp:")
        self.assertNotIn("==", text)
        self.assertNotIn("0x", text)

    def test_factors_have_names(self):
        self.assert_says("unit factor", "f = kd/pi: 0.5, expected 0.159155: pi times what it should be")

    def test_means_stand_beside_what_they_should_be(self):
        self.assert_says("unit mean", "L = kd ke: mean 0.64 +- 0.0004, expected 1.44: 1/2.25 (1/eta^2) times")
        self.assert_says("unit mean of nothing", "mean 0 +- 0, expected 1: there is none")

    def test_the_sharpest_comes_first(self):
        text = self.assert_says("golden fails,relation*,scene*,unit factor", "5 of 6 tests fail")
        order = ["unit factor", "scene fails\n", "relation fails", "golden fails", "scene fails again"]
        places = [text.index(name) for name in order]
        self.assertEqual(places, sorted(places))
        self.assertIn("zero == 1", text)  # the first of two checks
        self.assertNotIn("zero == 3", text)  # only named
        self.assertLessEqual(text.count("\n"), 28)

    def test_notes_are_kept(self):
        note = "note: box: its variance is 2.7 times the golden's"
        self.assert_says("relation notes", f"1 test passes {note}", passes=True)
        self.assert_says("relation notes,unit factor", note)

    def test_an_exception_is_a_failure(self):
        text = self.assert_says("ends exception,unit passes", "1 of 2 tests fails", "threw: no such thing")
        self.assertIn("zero := 0", text)  # the notes
        text = self.assert_says("ends exception in a subcase", "threw: no such thing zero := 0")
        self.assertNotIn("translate", text)

    def test_lines_are_of_at_most_80_columns(self):
        for tests in ("*unit*", "ends exit,unit factor", "ends abort"):
            for line in report.summary(run(tests)).splitlines()[:-1]:
                self.assertLessEqual(len(line), 80)

    def test_the_program_prints_it_and_what_the_suite_prints(self):
        command = [sys.executable, "-B", "-m", "tests.runner", SUITE, "-tc=unit passes,ends forged"]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertTrue(done.stdout.startswith("34 tests pass\n"), done.stdout)
        self.assertIn("The program called std::exit or the like, exit code 0", done.stdout)
        command[4:] = ["none/suite"]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(done.stderr, "tests.runner: none/suite: No such file or directory\n")


class Ends(Runner):
    def test_whoever_leaves_does_not_pass(self):
        names = ["exit", "_Exit", "forged"] + (["quick_exit"] if platform.system() == "Linux" else [])
        for name in names:
            with self.subTest(name):
                self.assert_says(
                    f"ends {name},unit factor",
                    "1 test fails: unit factor",
                    "pi times what it should be",
                    f'Then the program called std::exit or the like, exit code 0, during the test "ends {name}"',
                )

    def test_whoever_leaves_before_the_first_test_does_not_pass(self):
        self.assert_says(
            "unit passes",
            "called std::exit or the like, exit code 0, between two tests, or before the first",
            environment={"LIGHTWALK_EXIT_BEFORE_MAIN": "1"},
        )

    @unittest.skipIf(sanitized(), "a sanitizer has its own words")
    def test_a_crash_is_told(self):
        recursion = "called each other endlessly"
        for name, why in {
            "abort": "std::abort",
            "segment": "invalid memory",
            "recursion": recursion,
            "recursion in a thread": recursion,
            "exception in a thread": "an uncaught exception; the lines above may say which",
        }.items():
            with self.subTest(name):
                self.assert_says(
                    f"ends {name},unit factor",
                    "1 test fails: unit factor",
                    f'Then the tests crashed during the test "ends {name}"',
                    why,
                )
        # A failure in the same kind of tests is no sharper.
        self.assert_says(
            "ends abort,golden fails",
            'The tests crashed during the test "ends abort"',
            "Before that 1 test had failed: golden fails",
        )

    @unittest.skipIf(sanitized(), "a sanitizer has its own words")
    def test_what_the_library_says_of_a_crash_is_kept(self):
        self.assertIn("nobody catches it", report.first_failure(run("ends exception in a thread")))
        outcome = run("ends assertion")
        if "Assertion" in outcome.printed:  # from libstdc++, if GCC compiled it
            self.assertRegex(
                report.first_failure(outcome), r"^It printed last:\n  optional:\d+: Assertion '.*' failed\.\n"
            )

    @unittest.skipIf(platform.machine() not in ("x86_64", "AMD64"), "no such signal")
    @unittest.skipIf(sanitized(), "a sanitizer has its own words")
    def test_a_division_by_zero_is_told(self):
        self.assert_says("ends division", "an integer was divided by zero")


class Limits(Runner):
    def test_what_does_not_end_is_told(self):
        for name in ("loop", "checks", "prints"):
            with self.subTest(name):
                text = self.assert_says(
                    f"ends {name},unit factor",
                    "1 test fails: unit factor" if name != "checks" else "2 tests fail",
                    f'Then the tests do not end: stopped during the test "ends {name}" which had used '
                    "0.5 seconds of processor time. An endless loop",
                    seconds=0.5,
                )
                self.assertLess(len(text), 3000)

    def test_what_waits_for_ever_is_told(self):
        for name in ("sleep", "lock"):
            with self.subTest(name):
                self.assert_says(
                    f"ends {name},unit factor",
                    f'Then the tests do not end: stopped during the test "ends {name}" in which no thread '
                    "had run for 1 seconds. A lock that is never released?",
                    idle_seconds=1,
                )

    def test_what_is_printed_for_ever_is_cut(self):
        outcome = run("ends prints", seconds=0.5)
        self.assertLess(len(outcome.printed), 3 * process.MAX_PRINTED)
        self.assertRegex(outcome.printed, r"\n\.\.\. \d{6,} more bytes are left out here \.\.\.\n")
        self.assertTrue(outcome.printed.startswith("a line of many\n"))

    def test_each_subcase_has_all_the_time(self):
        self.assert_says("ends subcases", "1 test passes", passes=True, seconds=0.3)

    def test_a_busy_machine_makes_nothing_wrong(self):
        """Half a second of work beside 16 other processes: in wall-clock time it takes several seconds, and
        it runs in none of them for long."""
        with busy_machine():
            self.assert_says("ends subcases", passes=True, seconds=0.4, idle_seconds=1)

    def test_a_busy_machine_hides_nothing(self):
        with busy_machine():
            self.assert_says("ends lock", 'stopped during the test "ends lock" in which', idle_seconds=1)
            self.assert_says("ends loop", 'stopped during the test "ends loop" which had', seconds=0.2)

    def test_what_waits_for_a_processor_is_not_idle(self):
        """For any length of time: no test can make a machine that busy."""
        for willing, why in ((True, ""), (False, "idle")):
            with self.subTest(willing), mock.patch.object(watch, "usage", return_value=(1, willing)):
                watcher = watch.Watch(os.getpid(), idle_seconds=60)
                for _ in range(int(70 / watch.PERIOD)):
                    watcher.looked -= watch.PERIOD
                    said = watcher.look()
                self.assertEqual(said, why)

    def test_a_slow_build_has_ten_times_as_long(self):
        with self.subTest("this build"):
            expected = 200 if sanitized() else watch.SECONDS
            self.assertIn(watch.seconds_for(BUILD), (expected, 200))
        self.assertEqual(watch.seconds_for(BUILD / "nowhere"), 20)

    @unittest.skipUnless(shutil.which("ps"), "there is no ps")
    def test_ps_tells_the_same(self):
        """Without /proc, as on macOS."""
        with subprocess.Popen([sys.executable, "-c", "while True: pass"]) as process:
            while watch.usage_by_ps(process.pid)[0] < 1:
                time.sleep(0.05)
            seconds, willing = watch.usage_by_ps(process.pid)
            if sys.platform == "linux":
                used, would = watch.usage_by_proc(process.pid)
                self.assertLess(abs(used - seconds), 2)
                self.assertTrue(would)
            self.assertTrue(willing)
            process.kill()
        with subprocess.Popen(["sleep", "1000"]) as process:
            while watch.usage_by_ps(process.pid)[1]:
                time.sleep(0.05)
            process.kill()


@unittest.skipUnless(sys.platform == "linux", "needs /proc")
class NothingIsLeft(Runner):
    def setUp(self):
        self.environment = {"LIGHTWALK_TEST_OF_RUNNER": str(os.getpid())}
        self.addCleanup(self.end_all)

    def end_all(self):
        for pid in marked():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)

    def assert_nothing_left(self):
        end = time.monotonic() + 20  # the kernel may take a while to end them
        while left := marked():
            self.assertLess(time.monotonic(), end, f"{len(left)} processes are left")
            time.sleep(0.05)

    def test_what_a_suite_has_started_ends_with_it(self):
        self.assert_says("ends child", passes=True, environment=self.environment)
        self.assert_nothing_left()

    def test_what_a_stopped_suite_has_started_ends_with_it(self):
        self.assert_says("ends child and loop", "do not end", seconds=0.3, environment=self.environment)
        self.assert_nothing_left()

    def test_the_suite_ends_with_the_runner(self):
        command = [sys.executable, "-B", "-m", "tests.runner", SUITE]
        for number, tests in (
            (signal.SIGINT, "ends child and loop"),
            (signal.SIGTERM, "ends child and loop"),
            (signal.SIGHUP, "ends child and loop"),
            (signal.SIGKILL, "ends loop"),  # only the suite itself can notice
        ):
            with self.subTest(number.name):
                runner = subprocess.Popen(
                    [*command, f"-tc={tests}"],
                    cwd=ROOT,
                    env=os.environ | self.environment,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    **with_signals(),
                )
                # Its children exist, and it loops.
                count = 2 if tests == "ends loop" else 4
                while len(marked()) < count or not any(
                    watch.usage(pid)[0] > 0.2 for pid in marked() - {runner.pid}
                ):
                    self.assertIsNone(runner.poll())
                    time.sleep(0.05)
                runner.send_signal(number)
                _, errors = runner.communicate()
                self.assertEqual(errors, b"")
                self.assert_nothing_left()


class Threads(Runner):
    def test_suites_run_side_by_side(self):
        passed = []
        threads = [
            threading.Thread(target=lambda: passed.append(run("unit passes").passed)) for _ in range(4)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(passed, [True] * 4)


if __name__ == "__main__":
    unittest.main()
