"""`make check`, as far as nothing has to be compiled: `make handouts` does that."""

import contextlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import types
import unittest
import unittest.mock as mock
import zlib
from pathlib import Path

from tests.runner import watch
from tests.runner.doctest_report import Test
from tests.runner.suite import Outcome
from tools.exercises import at_each_save, check, compiler, configure, judge, picture, screen, words
from tools.exercises.sheet import headers_with_exercises
from tools.tree import ROOT, stage_headers, sum_of


def make_endless(path):
    """A program that computes for ever."""
    path.write_text("#!/bin/sh\nwhile :; do :; done\n")
    path.chmod(0o755)


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
            for entry in tomllib.loads(path.read_text(encoding="utf-8")).get("exercise", []):
                for text in (entry["task"], *entry["hints"]):
                    with self.subTest(entry["number"]):
                        self.assertNotRegex(words.plain(text), r"[\\$]")

    def test_only_the_first_failing_test_is_explained(self):
        golden = Test("golden images", "golden images", [("much darker", "")], 1, True)
        mirror = Test("a mirror", "units", [("(0, 0, 3), expected (0, 0, 1)", "a.cpp:53")], 2, True)
        text = judge.explained(Outcome("stage3_tests", [golden, mirror]))
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
            judge.explained(crash),
            "It printed last:\n  optional:477: Assertion 'this->_M_is_engaged()' failed.\n\nThe tests crashed",
        )

    def test_a_sharper_failure_is_explained_before_a_crash(self):
        mirror = Test("a mirror", "units", [("says", "")], 1, True)
        crash = Outcome("stage3_tests", [mirror], end="crash", why="The tests crashed", kind=3)
        self.assertEqual(judge.explained(crash), "  a mirror\n    says\n\nThen the tests crashed")


HEADER = "stages/3_specular_refraction/path_tracer.hpp"
NO_MATCH = f"""[2/3] Building CXX object tests/CMakeFiles/stage3_header.dir/stage3.cpp.o
In file included from /usr/include/glm/glm.hpp:1:
{ROOT}/{HEADER}: In function 'lightwalk::Vec3 lightwalk::stage3::reflect(const Vec3&)':
{ROOT}/{HEADER}:115:12: error: no match for 'operator*' (operand types are 'int' and 'lightwalk::Vec3' {{aka 'glm::vec<3, float, glm::packed_highp>'}})
  115 |   return 2 * wo;
      |          ~ ^ ~~
/usr/include/glm/detail/type_vec1.hpp:265:44: note: candidate: 'template<class T> operator*(T, vec<1, T>)'
  265 |         vec<1, T, Q> operator*(
{ROOT}/{HEADER}:115:14: note:   mismatched types 'const glm::vec<1, T, Q>' and 'int'
  115 |   return 2 * wo;
ninja: build stopped: subcommand failed.
"""
CLANG = f"""{ROOT}/{HEADER}:5:10: error: invalid operands to binary expression ('int' and 'const Vec3' (aka 'const vec<3, float>'))
  return 2 * wo;
"""
WARNED = f"""{ROOT}/{HEADER}:210:3: warning: unused variable 'x' [-Wunused-variable]
{ROOT}/{HEADER}:310:3: warning: 'phi' is used uninitialized [-Wuninitialized]
  310 |   return phi;
{ROOT}/common/math/basis.hpp:4:3: warning: of the core
"""


class Compiler(unittest.TestCase):
    """Only what helps of the compiler's words, and no line is too long."""

    def test_an_error_with_its_line_and_what_it_means(self):
        for said in (NO_MATCH, CLANG):
            seen = compiler.first_error(said)
            self.assertTrue(seen.startswith(f"{HEADER}:"), seen)
            self.assertIn("return 2 * wo;", seen)
            self.assertIn("write 2.0f * v", seen)
            for word in ("note", "glm", "aka", "ninja", str(ROOT)):
                self.assertNotIn(word, seen)
            self.assertLessEqual(max(map(len, seen.splitlines())), compiler.WIDTH)

    def test_it_is_never_empty(self):
        self.assertIn("make clean", compiler.first_error(""))
        self.assertIn("ninja: error: x", compiler.first_error("ninja: error: x\n"))

    def test_warnings_about_the_header_alone(self):
        solved = types.SimpleNamespace(is_open=False, start=300, end=320)
        still_open = types.SimpleNamespace(is_open=True, start=200, end=220)
        seen = compiler.warnings(WARNED, HEADER, [solved, still_open])
        self.assertIn("'phi' is used", seen)
        self.assertNotIn("unused", seen)
        self.assertNotIn("core", seen)
        self.assertIn("unused", compiler.warnings(WARNED, HEADER, [solved]))

    @unittest.skipIf(os.name == "nt", "needs a shell")
    def test_a_compiler_that_does_not_end_is_stopped(self):
        with tempfile.TemporaryDirectory() as folder:
            make_endless(Path(folder) / "cmake")
            path = f"{folder}:{os.environ['PATH']}"
            with mock.patch.dict(os.environ, PATH=path), mock.patch.object(compiler, "MAX_SECONDS", 0.3):
                said, made = compiler.build("stage1")
            self.assertFalse(made)
            self.assertIn("does not come to an end", compiler.first_error(said))

    def test_a_division_of_integers(self):
        with tempfile.TemporaryDirectory() as folder:
            header = Path(folder) / "stages/3_x/path_tracer.hpp"
            header.parent.mkdir(parents=True)
            body = "  return (1 / 2) * kd;  // 1 / 3\n  return 1.0f / 2 + v1/2 + 4 / 2;\n"
            header.write_text(
                f"// #region a\n// #region exercise 3.1: x\n// #stub return 0;\n{body}// #endregion\n"
            )
            with mock.patch.object(check, "ROOT", Path(folder)):
                seen = list(check.integer_divisions(header))
        self.assertEqual(len(seen), 1, seen)
        self.assertIn("path_tracer.hpp:4: 1 / 2 is a division of integers: 0. Write 1.0f / 2.", seen[0])


class ToBeRead(unittest.TestCase):
    """What could forge a report is read by a person before it is graded."""

    def test_a_student_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            header = Path(folder) / "path_tracer.hpp"
            header.write_text("int a;\n#include <thread>\n")
            self.assertIn("note: line 2: #include: #include <thread>\n", check.to_be_read(header))
            header.write_text("int a;\n#include <vector>\n")
            self.assertEqual(check.to_be_read(header), "")

    def test_the_chapters_pass(self):
        for header in stage_headers()[:5]:
            self.assertEqual(screen.remark(header.read_text()), "", header)

    def test_what_students_write_passes(self):
        for code in (
            "  // a coordinate system, not an extern \\theta: don't",
            '#include <cmath>\n#include <iostream>\nstd::cerr << "in reflect: " << __func__ << std::endl;',
            "const float million = 1'000'000;",
            "float x = 1;  // the system's signal",
            '#include <math.h>\n#include <map>  // for the lights\n#include <stdexcept>\n#include "glm/glm.hpp"',
            "float system = 1, fork = 2;",
            '/* an extern lamp, it\'s "outside" */ float x;',
            "#define TWICE(x) \\\n  (2 * (x))\nfloat x = TWICE(1);",
            "#pragma once\n#pragma region mine\n#pragma endregion",
            "#if 0\n#else\n# endif\n#",
            "char a = '\"', b = '\\'', *c = \"//\", *d = \"/*\";",
        ):
            self.assertEqual(screen.remark(code), "", code)

    def test_it_says_where(self):
        code = "int a;\n#define B \\\n  2\n/*\n*/ void f() { as\\\nm(0); }"
        self.assertEqual(screen.remark(code), "line 5: asm: */ void f() { as\\")
        self.assertEqual(
            screen.remark("\n#include /**/ <thread>"), "line 2: #include: #include /**/ <thread>"
        )

    def test_attacks_do_not(self):
        for code in (
            'asm("nop");',
            '#include "/etc/passwd"',
            '#include "../../tests/golden/goldens.toml"',
            "#include <fstream>",
            "# include /**/ <thread>",
            '%:include "/etc/passwd"',
            '#include "common/../../x.hpp"',
            "#include MINE",
            "#include <a/*b>\nasm(0);\n// */",
            "#if 0\n' /*\n#endif\nasm(0);\n// */",
            "/* no end",
            '_Pragma("GCC optimize 0")',
            "[[/**/ gnu::constructor]] void f();",
            'extern "C" int open(const char*, int);',
            "#define A as##m",
            "as\\\nm(0);",
            "as\\ \t\r\nm(0);",
            "__asm__(0);",
            "[[gnu::constructor]] void f();",
            "[[ using gnu: constructor]] void f();",
            "__attribute__((constructor)) void f();",
            "#pragma GCC optimize 0",
            '#line 1 "tests/a.cpp"',
            "/*\n// */ asm(0);",
            'auto a = R"(\n// )"; asm(0);',
            '#define FOOR\nFOOR"(" ; asm(0); ")"',
            "// \\\n;\nasm(0);",
            "int a = 1'0; asm(0); int b = 1'0;",
            "int a = '\\\n//'; asm(0);",
            "int a = '//'; asm(0);",
        ):
            self.assertNotEqual(screen.remark(code), "", code)


class Configured(unittest.TestCase):
    """A build folder belongs to the tree in which it was made."""

    def test_a_copied_or_renamed_folder_is_compiled_anew(self):
        with tempfile.TemporaryDirectory() as top:
            tree = Path(top).resolve() / "me"
            build = tree / "build"
            for name in ("check", "pictures", "CMakeFiles"):
                (build / name).mkdir(parents=True)
            cache = build / "CMakeCache.txt"
            cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={tree}\nCMAKE_CACHEFILE_DIR:INTERNAL={build}\n")
            copy = Path(top) / "copy"
            shutil.copytree(tree, copy)
            for place, ours in ((tree, True), (copy, False)):
                with mock.patch.multiple(configure, ROOT=place, BUILD=place / "build"):
                    self.assertEqual(configure.is_ours(place / "build/CMakeCache.txt"), ours)
            with mock.patch.multiple(configure, ROOT=copy, BUILD=build):
                with self.assertRaisesRegex(configure.Failure, "build folder of another tree"):
                    configure.configure()
            self.assertTrue((build / "CMakeFiles").exists())
            with mock.patch.multiple(configure, ROOT=copy, BUILD=copy / "build"):
                configure.throw_away()
            self.assertEqual(sorted(path.name for path in (copy / "build").iterdir()), ["check", "pictures"])

    def test_a_name_that_cmake_takes_for_a_pattern(self):
        with mock.patch.multiple(
            configure, ROOT=Path("/home/me/[CG] lab"), BUILD=Path("/home/me/[CG] lab/build")
        ):
            with self.assertRaisesRegex(
                configure.Failure, r"takes \[ in a folder's name .*: rename /home/me"
            ):
                configure.configure()

    def test_without_a_compiler_or_cmake_it_is_a_sentence(self):
        with tempfile.TemporaryDirectory() as top, mock.patch.multiple(configure, BUILD=Path(top) / "build"):
            with mock.patch.object(configure.subprocess, "run", side_effect=FileNotFoundError):
                with self.assertRaisesRegex(configure.Failure, "(?s)^CMake is not installed.*apt-get"):
                    configure.configure()
            said = types.SimpleNamespace(
                returncode=1, stdout="No CMAKE_CXX_COMPILER could be found.", stderr=""
            )
            with mock.patch.object(configure.subprocess, "run", return_value=said):
                with self.assertRaisesRegex(configure.Failure, "no C\\+\\+ compiler that works"):
                    configure.configure()


class HandedOut(unittest.TestCase):
    def test_what_was_changed_of_the_course_is_named_first(self):
        with tempfile.TemporaryDirectory() as top:
            top = Path(top)
            texts = {"common/a.hpp": b"a\r\n", "common/b.hpp": b"B\n", "stages/1_x/p.hpp": b"mine\n"}
            for name, data in texts.items():
                (top / name).parent.mkdir(parents=True, exist_ok=True)
                (top / name).write_bytes(data)
            total = sum_of(b"a\n")
            sums = dict.fromkeys([*texts, "tests/gone.cpp"], total)
            (top / "handout.json").write_text(json.dumps({"stage": 1, "files": sums}))
            with mock.patch.multiple(check, ROOT=top, HANDED_OUT=top / "handout.json"):
                seen = list(check.changed_files())
        self.assertEqual(seen, ["common/b.hpp is not as it was handed out", "tests/gone.cpp is missing"])


class Verdicts(unittest.TestCase):
    """Who is named, and how many points there are."""

    TASKS = {
        "3.1": {"tests": ["a"], "needs": [], "points": 2, "later": ["late a"]},
        "3.2": {"tests": ["b"], "needs": ["3.1"], "points": 3},
    }

    def judged(self, failing="", open_one=""):
        header = headers_with_exercises()[2]
        ran = []

        def run(stage, option):
            kind, _, names = option.partition("=")
            names = [name.rstrip("*") for name in names.split(",")]
            tests = names if kind == "-tc" else [name for name in ("late a", "late b") if name not in names]
            ran.append(tests)
            return Outcome(
                "suite",
                [
                    Test(name, "units", [("says", "")] if name == failing else [], int(name == failing), True)
                    for name in tests
                ],
            )

        found = [
            types.SimpleNamespace(
                number=number, title=number, where=f"{HEADER}:1", is_open=number == open_one
            )
            for number in self.TASKS
        ]
        with mock.patch.multiple(
            judge, marks=lambda _: found, read_tasks=lambda _: self.TASKS, open_before=lambda _: []
        ):
            return judge.judge(3, header, run), ran

    def states(self, **options):
        verdict, _ = self.judged(**options)
        return [one.state for one in verdict.exercises], verdict.points, verdict.passed

    def test_states_and_points(self):
        self.assertEqual(self.states(), (["done", "done"], 5, True))
        self.assertEqual(self.states(failing="b"), (["done", "wrong"], 2, False))
        self.assertEqual(self.states(failing="a"), (["wrong", "waits"], 0, False))
        self.assertEqual(self.states(open_one="3.1"), (["open", "waits"], 0, False))

    def test_no_test_runs_twice(self):
        _, ran = self.judged()
        self.assertEqual(ran, [["a"], ["b"], ["late a", "late b"]])

    def test_a_test_of_the_whole_stage(self):
        verdict, _ = self.judged(failing="late a")
        self.assertEqual((verdict.late.number, verdict.points), ("3.1", 3))
        verdict, _ = self.judged(failing="late b")  # 3.2 is no part of the loop here
        self.assertEqual((verdict.late.number, verdict.late.title), ("", judge.LOOP))
        self.assertEqual(verdict.points, 5)

    def test_all_of_it_for_programs(self):
        verdict, _ = self.judged(failing="b")
        seen = json.loads(judge.as_json(3, "Stage 3", verdict, ""))
        self.assertEqual((seen["points"], seen["out_of"], seen["passed"]), (2, 5, False))
        row = seen["exercises"][1]
        self.assertEqual((row["number"], row["state"], row["test"]), ("3.2", "wrong", "b"))
        self.assertIn("says", row["message"])
        seen = json.loads(judge.as_json(3, "Stage 3", None, "no match"))
        self.assertEqual((seen["passed"], seen["error"]), (False, "no match"))
        seen = judge.as_markdown(3, "Stage 3", verdict, "")
        self.assertIn("2 of 5 points", seen)
        self.assertIn("| 3.2 | 3.2 | wrong | 0/3 |", seen)


@unittest.skipIf(os.name == "nt", "needs a shell")
class Saves(unittest.TestCase):
    def test_what_does_not_end_is_stopped_with_all_that_it_started(self):
        with tempfile.TemporaryDirectory() as folder:
            note = Path(folder) / "pid"
            code = (
                "import subprocess, sys, time; "
                "p = subprocess.Popen([sys.executable, '-c', 'while True: pass']); "
                f"open({str(note)!r}, 'w').write(str(p.pid)); time.sleep(1000)"
            )
            running = at_each_save.Running(["-c", code], ["-c", "0"])
            watch.wait_until(running.process, lambda: note.exists() and note.read_text())
            child = int(note.read_text())
            running.stop()
            self.assertFalse(running.go_on())
            until = time.monotonic() + 60
            while lives(child) and time.monotonic() < until:
                time.sleep(0.05)
            self.assertFalse(lives(child), "what it started lives on")


def lives(pid):
    """Whether a process runs; one that has ended may still have a number."""
    try:
        os.kill(pid, 0)
        return " Z " not in Path(f"/proc/{pid}/stat").read_text()
    except (ProcessLookupError, FileNotFoundError):
        return False


class CommandLine(unittest.TestCase):
    def test_wrong_usage_is_one_line(self):
        for argument, expected in (
            ("9", r"stage 9 has no exercises in this tree; [1-9](, [1-9])* have"),
            ("one", r"stage 'one' has no exercises in this tree; .*"),
            ("1_diffuse", r"stage '1_diffuse' has no exercises in this tree; .*"),
            ("--wach", r"unrecognized arguments: --wach"),
        ):
            with self.subTest(argument):
                command = [sys.executable, "-m", "tools.exercises.check", argument]
                done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertRegex(done.stderr, f"^check: {expected.replace('; [1', '; stages [1')}\n$")


class Pictures(unittest.TestCase):
    def test_three_pictures_side_by_side(self):
        bright, dark = [(1.0, 1.0, 1.0)] * 2, [(0.5, 0.5, 0.5)] * 2
        data = picture.side_by_side((2, 1, bright), (2, 1, dark))
        self.assertTrue(data.startswith(b"\x89PNG"))
        size = data[16:24]
        self.assertEqual(size, (3 * 200 + 2 * picture.GAP).to_bytes(4, "big") + (100).to_bytes(4, "big"))
        start = data.index(b"IDAT") + 4
        length = int.from_bytes(data[start - 8 : start - 4], "big")
        row = zlib.decompress(data[start : start + length])[1 : 1 + 3 * 608]
        self.assertEqual(row[:3], b"\xff\xff\xff")
        red, green, blue = row[-3:]  # mine is brighter
        self.assertTrue(red > 200 and green == blue == 0, (red, green, blue))

    @unittest.skipIf(os.name == "nt", "needs a shell")
    def test_one_that_does_not_end_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            make_endless(Path(folder) / "stage1")
            with (
                mock.patch.multiple(
                    picture,
                    BUILD=Path(folder),
                    program_path=lambda name: Path(folder) / name,
                    build=lambda target: ("", True),
                    SECONDS=0.2,
                ),
                contextlib.redirect_stdout(io.StringIO()) as said,
            ):
                picture.main(1)
            self.assertIn("does not come to an end", said.getvalue())


if __name__ == "__main__":
    unittest.main()
