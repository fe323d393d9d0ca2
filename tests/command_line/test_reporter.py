"""What a failing suite says, and that none passes without its last test."""

import os
import platform
import subprocess
import unittest

from programs import BUILD, sanitized

SUITE = "./bad_suite"


def run(tests, seconds=60, env=None):
    """The report on the tests with these names, and the exit code."""
    done = subprocess.run(
        ["./run_suite", "--seconds", str(seconds), SUITE, f"-tc={tests}"],
        cwd=BUILD,
        capture_output=True,
        text=True,
        timeout=300,
        env=os.environ | (env or {}),
    )
    return done.stdout, done.returncode


class Reporter(unittest.TestCase):
    def assert_says(self, tests, *sentences, code=1, **options):
        report, ended = run(tests, **options)
        plain = " ".join(report.split())
        for sentence in sentences:
            self.assertIn(sentence, plain)
        self.assertEqual(ended, code, report)
        return report

    def test_a_pass_is_a_line(self):
        report = self.assert_says("unit passes", code=0)
        self.assertEqual(report, "1 test passes\n")

    def test_no_test_is_no_pass(self):
        self.assert_says("there is none", "no test has such a name")

    def test_vectors_are_printed(self):
        self.assert_says("unit vector", "(0.1, 0.2, 0.3) == (1, 2, 3)", "(tests/command_line/bad_suite.cpp:")

    def test_factors_have_names(self):
        self.assert_says("unit factor", "f = kd/pi: 0.5, expected 0.159155: pi times what it should be")

    def test_means_stand_beside_what_they_should_be(self):
        self.assert_says("unit mean", "L = kd ke: mean 0.64 +- 0.0004, expected 1.44: 1/2.25 (1/eta^2) times")
        self.assert_says("unit mean of nothing", "mean 0 +- 0, expected 1: there is none")

    def test_the_sharpest_comes_first(self):
        report = self.assert_says("golden fails,relation*,scene*,unit factor", "5 of 6 tests fail")
        order = ["unit factor", "scene fails\n", "relation fails", "golden fails", "scene fails again"]
        places = [report.index(name) for name in order]
        self.assertEqual(places, sorted(places))
        self.assertIn("zero == 1", report)  # the first of two checks
        self.assertNotIn("zero == 3", report)  # only named
        self.assertLessEqual(report.count("\n"), 28)

    def test_notes_are_kept(self):
        self.assert_says(
            "relation notes", "1 test passes note: box: its variance is 2.7 times the golden's", code=0
        )
        self.assert_says("relation notes,unit factor", "note: box: its variance")

    def test_whoever_leaves_does_not_pass(self):
        names = ["exit", "_Exit"] + (["quick_exit"] if platform.system() == "Linux" else [])
        for name in names:
            with self.subTest(name):
                self.assert_says(
                    f"ends {name},unit factor",
                    f'left by std::exit or the like, exit code 0, during the test "ends {name}"',
                    "Before that 1 test had failed: unit factor",
                    "pi times what it should be",
                )

    def test_whoever_leaves_before_the_first_test_does_not_pass(self):
        self.assert_says(
            "unit passes",
            "left by std::exit or the like, exit code 0, between two tests, or before the first",
            env={"LIGHTWALK_EXIT_BEFORE_MAIN": "1"},
        )

    @unittest.skipIf(sanitized(), "a sanitizer has its own words")
    def test_a_crash_is_told(self):
        recursion = "called each other without an end"
        for name, why in {
            "abort": "std::abort",
            "segment": "memory that it does not have",
            "recursion": recursion,
            "recursion in a thread": recursion,
            "exception in a thread": "an exception that nobody caught",
        }.items():
            with self.subTest(name):
                self.assert_says(
                    f"ends {name},unit factor",
                    f'The tests crashed during the test "ends {name}"',
                    why,
                    "Before that 1 test had failed: unit factor",
                )

    @unittest.skipIf(platform.machine() not in ("x86_64", "AMD64"), "no such signal")
    @unittest.skipIf(sanitized(), "a sanitizer has its own words")
    def test_a_division_by_zero_is_told(self):
        self.assert_says("ends division", "an integer was divided by zero")

    def test_an_exception_is_a_failure(self):
        self.assert_says("ends exception,unit passes", "1 of 2 tests fails", "threw: no such thing")

    def test_what_does_not_end_is_told(self):
        for name in ("sleep", "loop", "lock"):
            with self.subTest(name):
                self.assert_says(
                    f"ends {name},unit factor",
                    f'The tests do not end: stopped during the test "ends {name}" '
                    "which had been going on for 0.5 seconds",
                    "Before that 1 test had failed: unit factor",
                    seconds=0.5,
                )


if __name__ == "__main__":
    unittest.main()
