"""Tests handouts and `make check` without compiling anything: `make handouts`
does the rest."""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest
import unittest.mock as mock
from pathlib import Path

from tests.runner import watch
from tests.runner.doctest_report import Test
from tests.runner.suite import Outcome
from tools.exercises import check, words
from tools.exercises.marks import exercises, marks
from tools.exercises.sheet import headers_with_exercises
from tools.handout.contents import contents
from tools.handout.handout import add_to, git, make_new
from tools.handout.opened import opened
from tools.handout.prove import leaks
from tools.tree import ROOT, Failure


class Messages(unittest.TestCase):
    def test_formulas_are_plain_text(self):
        for tex, text in (
            (r"$f_r = k_d/\pi$", "f_r = k_d/π"),
            (r"$\frac{\eta_o}{\eta_i}\sin\theta_o$", "η_o/η_i sin θ_o"),
            (r"$\sqrt{1 - \xi_1}$", "√(1 - ξ_1)"),
            ("take `wo`", "take wo"),
        ):
            with self.subTest(tex):
                seen = words.plain(tex)
                self.assertEqual(re.sub(r"\s", "", seen), re.sub(r"\s", "", text), seen)

    def test_nothing_of_tex_is_left_in_any_task(self):
        for path in ROOT.glob("stages/*/exercises.toml"):
            for entry in tomllib.loads(path.read_text()).get("exercise", []):
                for text in (entry["task"], *entry["hints"]):
                    with self.subTest(entry["number"]):
                        self.assertNotRegex(words.plain(text), r"[\\$]")

    def test_only_the_first_failing_test_is_explained(self):
        golden = Test("golden images", "golden images", [("much darker", "")], 1, True)
        mirror = Test("a mirror", "units", [("(0, 0, 3), expected (0, 0, 1)", "a.cpp:53")], 2, True)
        text = check.explained(Outcome("stage3_tests", [golden, mirror]))
        self.assertEqual(
            text, "  a mirror\n  (a.cpp:53)\n    (0, 0, 3), expected (0, 0, 1)\n    (and 1 more in this test)"
        )

    def test_a_crash_is_told(self):
        assertion = (
            "/usr/include/c++/12/optional:477: constexpr _Tp& std::_Optional<_Tp>::_M_get() "
            "[with _Tp = float]: Assertion 'this->_M_is_engaged()' failed.\n"
        )
        crash = Outcome("stage3_tests", printed=assertion, end="crash", why="The tests crashed")
        self.assertEqual(
            check.explained(crash),
            "  optional:477: Assertion 'this->_M_is_engaged()' failed.\n\nThe tests crashed",
        )

    def test_a_sharper_failure_is_explained_before_a_crash(self):
        mirror = Test("a mirror", "units", [("says", "")], 1, True)
        crash = Outcome("stage3_tests", [mirror], end="crash", why="The tests crashed", kind=3)
        self.assertEqual(check.explained(crash), "  a mirror\n    says\n\nThen the tests crashed")

    @unittest.skipIf(os.name == "nt", "needs a shell")
    def test_a_picture_that_does_not_end_is_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "stage1"
            program.write_text("#!/bin/sh\nwhile :; do :; done\n")
            program.chmod(0o755)
            with (
                mock.patch.multiple(check, BUILD=Path(folder), build=lambda target: ("", True)),
                mock.patch.object(watch.communicate, "__defaults__", (None, 0.2)),
                contextlib.redirect_stdout(io.StringIO()) as said,
            ):
                check.picture(1)
            self.assertEqual(said.getvalue(), "")

    def test_the_compilers_first_error_comes_first(self):
        said = f"[1/2] Building\nFAILED: x\n{ROOT}/stages/a.hpp:3:1: error: no 'foo'\n  foo\n"
        self.assertTrue(check.first_words(said).startswith("stages/a.hpp:3:1: error"))


class Opened(unittest.TestCase):
    def test_an_open_exercise_calls_and_returns_its_stub(self):
        for header in headers_with_exercises():
            text = opened(header)
            self.assertNotIn("#stub", text)
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / header.relative_to(ROOT)
                path.parent.mkdir(parents=True)
                path.write_text(text)
                found = marks(path, Path(folder))
            self.assertEqual([one.number for one in found], [one.number for one in exercises(header)])
            for one in found:
                self.assertTrue(one.is_open, one.number)

    def test_a_solved_one_keeps_its_marks(self):
        header = headers_with_exercises()[0]
        numbers = [one.number for one in exercises(header)]
        text = opened(header, numbers)
        self.assertNotIn("open_exercise", text)
        self.assertEqual(text.count("// #region exercise"), len(numbers))


class Leaks(unittest.TestCase):
    def test_a_planted_line_is_found(self):
        tracked = git(ROOT, "ls-files").splitlines()
        header = headers_with_exercises()[0]
        files = contents(1, tracked, "previous")
        self.assertEqual(list(leaks(files, [header], [])), [])
        line = exercises(header)[1].body[1].strip()
        files["scenes/README.md"] += f"\n  {line}\n".encode()
        self.assertEqual(list(leaks(files, [header], [])), [("scenes/README.md", line)])

    def test_answers_stay_at_home(self):
        tracked = git(ROOT, "ls-files").splitlines()
        for stage, header in enumerate(headers_with_exercises(), 1):
            name = header.with_name("exercises.toml").relative_to(ROOT).as_posix()
            sheet = tomllib.loads(contents(stage, tracked, "previous")[name].decode())
            self.assertEqual([one["answer"] for one in sheet["question"]], [""] * 3)


class Folders(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name) / "student"

    def quietly(self, function, *arguments):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            function(*arguments)
        return said.getvalue()

    def test_from_one_stage_to_the_next(self):
        self.quietly(make_new, 1, "previous", self.folder)
        self.assertEqual(len(git(self.folder, "log", "--oneline").splitlines()), 1)
        self.assertEqual(git(self.folder, "status", "--porcelain"), "")
        self.assertEqual([path.name[0] for path in self.folder.glob("stages/[1-9]_*")], ["1"])
        mine = next(self.folder.glob("stages/1_*/path_tracer.hpp"))
        mine.write_text("// what I have written\n")
        (self.folder / "README.md").write_text("my notes\n")
        (self.folder / "my_scene.toml").write_text("# mine\n")
        said = self.quietly(add_to, 2, self.folder)
        self.assertEqual(mine.read_text(), "// what I have written\n")
        self.assertEqual((self.folder / "README.md").read_text(), "my notes\n")
        self.assertEqual((self.folder / "my_scene.toml").read_text(), "# mine\n")
        self.assertIn("README.md was changed there, and is as it was", said)
        new = next(self.folder.glob("stages/2_*/path_tracer.hpp"))
        self.assertIn("open_exercise(", new.read_text())
        self.assertEqual(json.loads((self.folder / "handout.json").read_text())["stage"], 2)
        with self.assertRaisesRegex(Failure, "has stage 2 already"):
            add_to(2, self.folder)

    def test_a_folder_with_something_in_it_stays_as_it_is(self):
        self.folder.mkdir()
        (self.folder / "thesis.txt").write_text("years of work")
        with self.assertRaisesRegex(Failure, "is not empty"):
            make_new(1, "previous", self.folder)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["thesis.txt"])
        with self.assertRaisesRegex(Failure, "is no handout"):
            add_to(2, self.folder)

    def test_wrong_usage_is_one_line(self):
        for arguments, expected in (
            (["x", "--out", "a"], "the stage is 'x', and a number is expected"),
            (["9", "--out", "a"], "stage 9 is not in this tree"),
            (["3"], "says where"),
        ):
            with self.subTest(arguments):
                done = subprocess.run(
                    [sys.executable, "-m", "tools.handout.handout", *arguments],
                    cwd=self.folder.parent,
                    env=os.environ | {"PYTHONPATH": str(ROOT)},
                    capture_output=True,
                    text=True,
                )
                self.assertEqual(done.returncode, 1)
                self.assertIn(expected, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
