"""Grades small classes of stage 1, hostile submissions among them: `make test-class`."""

import contextlib
import csv
import io
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import types
import unittest
import unittest.mock
import zipfile
from pathlib import Path
from xml.etree import ElementTree

from tests.mistakes.mistakes import changed_header, read_mistakes
from tools.grading import one_node_slurm, page, sandbox, submissions, tables
from tools.grading.workshop import only_adds
from tools.handout.opened import opened
from tools.tree import BUILD, ROOT, Failure, stage_headers

HEADER = stage_headers()[0]
TEXT = HEADER.read_text()
NAME = HEADER.relative_to(ROOT)
FIRST = "inline Vec3 sample_uniform_hemisphere("
NO_SANDBOX = "" if shutil.which("bwrap") else "NOT TESTED: bubblewrap is missing: tools/setup.sh class"


def with_code(code):
    """The solution, and before its first function some code."""
    assert FIRST in TEXT
    return TEXT.replace(FIRST, f"{code}\n{FIRST}", 1)


def at_start(code):
    """Code that runs before the first test."""
    return with_code(f"struct Early {{ Early() {{ {code} }} }};\ninline Early early;")


MISTAKES = read_mistakes(ROOT / "tests/mistakes/stage1.toml")


def mistake(number):
    return changed_header(MISTAKES[number], types.SimpleNamespace(header=HEADER))


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="class-", dir=BUILD)
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.folder.chmod(0o755)  # nobody reads it where root grades
        self.given = self.folder / "given"
        self.given.mkdir()

    def put(self, name, text, place=NAME):
        path = self.given / name / place
        path.parent.mkdir(parents=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path


class Submissions(InFolder):
    """What counts as a submission, and which file of it is judged."""

    def header(self, name=None):
        found = {one.name: one for one in submissions.submissions(self.given).submissions}
        return (found[name] if name else next(iter(found.values()))).header(1)

    def assert_refused(self, sentence):
        with self.assertRaises(submissions.Refused) as raised:
            self.header()
        self.assertIn(sentence, str(raised.exception))

    def zip(self, *entries):
        with zipfile.ZipFile(self.given / "ana.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            for name, data in entries:
                archive.writestr(name, data)

    def test_a_header_a_folder_and_a_zip(self):
        (self.given / "ana.hpp").write_text("a")
        self.put("ben", "b")
        self.put("cem", "c", "deep/er/path_tracer.hpp")
        with zipfile.ZipFile(self.given / "dora.zip", "w") as archive:
            archive.writestr(f"work/{NAME}", "d")
            archive.writestr("work/stages/2_next_event/path_tracer.hpp", "of another stage")
        (self.given / ".hidden").mkdir()
        (self.given / "notes.txt").write_text("no submission")
        found = submissions.submissions(self.given)
        self.assertEqual(
            list(found.remarks()), ["not read, since it is no folder, .hpp, .zip or .bundle: notes.txt"]
        )
        self.assertEqual([(one.name, one.header(1)) for one in found.submissions],
                         [("ana", b"a"), ("ben", b"b"), ("cem", b"c"), ("dora", b"d")])  # fmt: skip

    @unittest.skipIf(NO_SANDBOX, NO_SANDBOX)
    def test_a_git_bundle(self):
        work = self.folder / "work"
        (work / NAME).parent.mkdir(parents=True)
        (work / NAME).write_text("e")
        git = ["git", "-c", "user.name=e", "-c", "user.email=e@example.org"]
        for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "done"],
                        ["bundle", "create", "-q", self.given / "emma.bundle", "HEAD"]):  # fmt: skip
            subprocess.run([*git, *command], cwd=work, check=True)
        self.assertEqual(self.header("emma"), b"e")
        branch = ["git", "bundle", "create", "-q", self.given / "emma.bundle", "--branches"]
        subprocess.run(branch, cwd=work, check=True)
        self.assertEqual(self.header("emma"), b"e")
        (self.given / "emma.bundle").write_bytes(b"# v2 git bundle\nno bundle")
        self.assert_refused("no git bundle that can be read")

    def test_nothing_and_too_much(self):
        self.put("ana", "x", "README.md")
        self.assert_refused("has no path_tracer.hpp of stage 1")
        self.put("ana", "x", "a/path_tracer.hpp")
        self.put("ana", "x", "b/path_tracer.hpp")
        self.assert_refused("has 2 headers of stage 1")

    def test_links_lead_nowhere(self):
        secret = self.folder / "secret"
        secret.mkdir()
        (secret / "path_tracer.hpp").write_text("secret")
        (self.given / "ana").symlink_to(secret)
        self.assert_refused("is a link")
        (self.given / "ana").unlink()
        (self.given / "ana").mkdir()
        (self.given / "ana/path_tracer.hpp").symlink_to(secret / "path_tracer.hpp")
        self.assert_refused("is a link")
        (self.given / "ana/path_tracer.hpp").unlink()
        (self.given / "ana/stages").symlink_to(secret)
        self.assert_refused("has no path_tracer.hpp")

    def test_a_zip_that_is_none_that_is_huge_or_has_a_link(self):
        self.zip(("path_tracer.hpp", bytes(submissions.MOST + 1)))
        self.assert_refused("is larger than 1 MB")
        link = zipfile.ZipInfo("path_tracer.hpp")
        link.external_attr = 0o120777 << 16
        self.zip((link, "/etc/passwd"))
        self.assert_refused("is a link")
        (self.given / "ana.zip").write_bytes(b"PK\3\4 no zip")
        self.assert_refused("no .zip that can be read")

    def test_a_roster(self):
        self.put("Ana Maria_17_file", "x")
        self.put("b2", "x")
        self.put("c3", "x")
        roster = self.folder / "roster.csv"
        roster.write_text("Full name,ID number\nAna Maria,a1\nBen,b2\nDora,d4\n", encoding="utf-8-sig")

        def found():
            every = submissions.submissions(self.given, roster).submissions
            return [(one.name, one.student, one.path and one.path.name) for one in every]

        moodle = "Ana Maria_17_file"
        self.assertEqual(
            found(),
            [(moodle, "Ana Maria", moodle), ("b2", "Ben", "b2"), ("Dora", "Dora", None), ("c3", "", "c3")],
        )
        # As a registrar exports it: semicolons, and letters of Windows.
        self.put("Öz, Cem", "x")
        text = "Nummer;Nachname;Vorname;Login\n17;Müller;Jörg;b2\n18;Öz;Cem;cem\n\n19;Alt;Eva;e5\n"
        roster.write_bytes(text.encode("cp1252"))
        self.assertEqual(
            found(),
            [
                ("b2", "Jörg Müller", "b2"),
                ("Öz, Cem", "Cem Öz", "Öz, Cem"),
                ("19", "Eva Alt", None),
                (moodle, "", moodle),
                ("c3", "", "c3"),
            ],
        )
        # An address, another case, letters of two parts, a name that was there already.
        self.put("EVA (1)", "x")
        self.put("Jo\u0308rg Mu\u0308ller_3_file", "x")
        roster.write_text("id,name,mail\n1,Jörg Müller,j@x.org\n2,Eva Alt,Eva@x.org\n3,Cem Öz,\n")
        names = [name for name, student, path in found() if student]
        self.assertEqual(names, ["Jo\u0308rg Mu\u0308ller_3_file", "EVA (1)", "Öz, Cem"])
        given = submissions.submissions(self.given, roster)
        self.assertEqual(list(given.remarks()), ["not in the roster: Ana Maria_17_file, b2, c3"])
        for text, sentence in (
            ("", "a line that names the columns is expected"),
            ("id,name\nb2,1\nb2,2\n", "row 3: b2 is there twice"),
            ("id,name\n,1\n", "row 2: its first column is empty"),
            ("id,name\nx,y\n", "no submission is called what stands in it, as"),
            ("id,other\nb2,c3\n", "b2 has 2 submissions: b2, c3"),
        ):
            roster.write_text(text)
            with self.assertRaisesRegex(Failure, sentence):
                found()


class Objects(unittest.TestCase):
    def test_what_may_be_added_to_a_header(self):
        given = ["namespace a {", "int f();", "class B {", "int x;", "};", "}"]
        self.assertTrue(only_adds(given, given))
        self.assertTrue(only_adds([*given[:2], "int g();", *given[2:]], given))
        self.assertFalse(only_adds([*given[:4], "int y;", *given[4:]], given))
        self.assertFalse(only_adds([given[0], *given[2:]], given))
        self.assertFalse(only_adds(["#define x y", *given], given))
        self.assertTrue(only_adds(['#include "common/open_exercise.hpp"', *given], given))
        self.assertFalse(only_adds([given[0], "int g();", given[1].replace("f", "h"), *given[2:]], given))


@unittest.skipIf(NO_SANDBOX, NO_SANDBOX)
class Sandbox(InFolder):
    """What a program in the sandbox can and cannot do."""

    def done(self, script, *reads, **limits):
        program = self.folder / "program.py"
        program.write_text(script)
        reads = [program, *reads]
        return sandbox.run([["/usr/bin/python3", program]], reads, limits=sandbox.Limits(**limits))

    def assert_says(self, says, script, *reads, **limits):
        done = self.done(script, *reads, **limits)
        self.assertEqual(done.printed.strip(), says)
        return done

    def test_it_sees_what_it_is_given_and_nothing_else(self):
        secret = self.folder / "secret"
        secret.write_text("secret")
        ask = "import os\nprint([os.path.exists(x) for x in ({paths})])"
        paths = ", ".join(
            map(repr, map(str, (secret, ROOT / "README.md", "/etc/passwd", "/home", BUILD / "stage1")))
        )
        self.assert_says("[False, False, False, False, False]", ask.format(paths=paths))
        self.assert_says("secret", f"print(open({str(secret)!r}).read())", secret)

    def test_what_lies_below_tmp_is_seen_too(self):
        with tempfile.TemporaryDirectory(dir="/tmp") as folder:
            Path(folder).chmod(0o755)
            given = Path(folder) / "given"
            given.write_text("seen")
            done = sandbox.run([["cat", given], ["touch", "/tmp/x"]], [given], folder=folder)
        self.assertEqual((done.code, done.printed), (0, "seen"))

    def test_it_writes_into_its_scratch_folder_alone(self):
        given = self.folder / "given/file"
        given.write_text("as it was")
        tries = (
            "import os\n"
            "def able(path):\n"
            "  try: open(path, 'a').write('x'); return True\n"
            "  except OSError: return False\n"
            f"print([able(x) for x in ('/x', '/usr/x', '/dev/x', '/dev/shm/x', {str(given)!r}, '/tmp/x')])"
        )
        self.assert_says("[False, False, False, False, False, True]", tries, given)
        self.assertEqual(given.read_text(), "as it was")

    def test_no_network_and_no_other_process(self):
        self.assert_says(
            "refused, 1 interfaces",
            "import socket\n"
            "try: socket.create_connection(('127.0.0.1', 22), 5); said = 'connected'\n"
            "except OSError: said = 'refused'\n"
            "print(f'{said}, {len(socket.if_nameindex())} interfaces')",
        )
        ask = "import os\nprint(sum(name.isdigit() for name in os.listdir('/proc')) < 8)"
        self.assert_says("True", ask)
        self.assert_says(
            "no such process",
            f"import os\ntry: os.kill({os.getpid()}, 9); print('killed')\n"
            "except (ProcessLookupError, PermissionError): print('no such process')",
        )

    def test_processes_memory_files_and_time_are_bounded(self):
        fork = (
            "import os, time\nmade = 0\n"
            "try:\n  while made < 500:\n    if os.fork() == 0: time.sleep(9); os._exit(0)\n    made += 1\n"
            "except OSError: pass\nprint(made < 64)"
        )
        self.assert_says("True", fork)
        self.assertIn("MemoryError", self.done("x = bytearray(1 << 30)", memory=256 << 20).printed)
        together = (
            "import os, time\nfor i in range(8):\n  if os.fork() == 0: break\n"
            "x = bytearray(120 << 20); x[::4096] = b'x' * len(x[::4096]); time.sleep(30)"
        )
        self.assertEqual(self.done(together, memory=512 << 20).stopped, "memory")
        disk = (
            "try:\n  for i in range(99): open(f'/tmp/{i}', 'wb').write(bytes(1 << 20))\n"
            "except OSError as error: print(error.strerror)"
        )
        self.assert_says("No space left on device", disk, scratch=8 << 20)
        done = self.done("while True: pass", seconds=2)
        self.assertTrue(done.stopped == "busy" or done.code, done)
        self.assertEqual(self.done("while True: print('x' * 1000000)").stopped, "much")

    def test_nothing_is_left(self):
        before = set(os.listdir("/proc"))
        self.done("import os, time\nfor i in range(5):\n  if os.fork() == 0: os.setsid(); time.sleep(600)\n")
        time.sleep(0.5)
        new = [one for one in set(os.listdir("/proc")) - before if one.isdigit()]
        lines = [Path(f"/proc/{one}/cmdline") for one in new]
        self.assertFalse([one for one in lines if one.exists() and b"program.py" in one.read_bytes()])

    def test_a_name_is_a_word(self):
        self.assertEqual(sandbox.run([["echo", "a'b\n$(c)"]], []).printed, "a'b\n$(c)\n")


def grade(given, out, *options, **others):
    command = [sys.executable, "-B", "-m", "tools.grading", given, "1", "--out", out, *options]
    return subprocess.run(list(map(str, command)), cwd=ROOT, capture_output=True, text=True, **others)


def results(out):
    with (out / "points.csv").open(encoding="utf-8", newline="") as file:
        return {row["id"]: row for row in csv.DictReader(file)}


@unittest.skipIf(NO_SANDBOX, NO_SANDBOX)
class Grading(InFolder):
    def of_class(self, out=None, *options):
        out = out or self.folder / "out"
        done = grade(self.given, out, *options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return results(out), done.stdout

    def test_right_wrong_and_hostile_ones(self):
        weird = "o'Neil \"<script>alert(1)</script> Åsa"
        forged = r"""
          for (int f = 3; f < 30; ++f) {
            if (FILE* out = fdopen(f, "w")) {
              fputs("<?xml version=\"1.0\"?><X binary=\"x\"><TestSuite>", out);
              fflush(out);
            }
          }
          std::exit(0);"""
        class_of = {
            "right": TEXT,
            "from-a-handout": TEXT.replace("#include", '#include "common/open_exercise.hpp"\n#include', 1),
            "handed-out": opened(HEADER),
            "right-with-more": with_code("inline float twice(float x) { return 2 * x; }"),
            weird.replace("/", "_"): TEXT,
            "wrong": mistake(0),
            "no-semicolon": TEXT.replace("std::sqrt(1", "std::sqr(1", 1),
            "exit": at_start("std::exit(0);"),
            "forged": "#include <cstdio>\n" + at_start(forged),
            "endless": with_code("constexpr int f(int n) { while (true) ++n; }\nconstexpr int x = f(1);"),
            "of-stage-2": stage_headers()[1].read_text(),
            "asm": at_start('asm volatile("nop");'),
            "crash": at_start("int* p = nullptr; *const_cast<volatile int*>(p) = 1;"),
            "exits-in-a-test": TEXT.replace("return Basis(", "std::exit(0); return Basis(", 1),
        }
        for name, text in class_of.items():
            self.put(name, text)
        before = self.everything()
        found, said = self.of_class()
        self.assertEqual(self.everything(), before, "the tree has changed")
        full = found["right"]["out of"]
        points = {name: row["points"] for name, row in found.items()}
        self.assertEqual((states := found["handed-out"])["state"], "judged", states)
        self.assertEqual(points["handed-out"], "0")
        for name in ("right", "from-a-handout", "right-with-more", weird.replace("/", "_")):
            self.assertEqual((found[name]["state"], points[name]), ("judged", full), found[name])
        self.assertNotEqual(points["wrong"], full)
        for name in ("exit", "forged", "asm", "crash", "endless", "no-semicolon"):
            self.assertEqual(points[name], "0", name)
        self.assertNotEqual(points["exits-in-a-test"], full)
        states = {name: row["state"] for name, row in found.items()}
        self.assertEqual(states["no-semicolon"], "does not compile")
        self.assertEqual(states["endless"], "does not compile")
        self.assertEqual(states["asm"], "to be read")
        self.assertEqual(states["of-stage-2"], "refused")
        self.assertIn("it is the header of stage 2", said)

        # The page says what a name says, and does nothing else.
        text = (self.folder / "out/index.html").read_text()
        self.assertNotIn("<script>alert", text)
        self.assertIn("&lt;script&gt;alert", text)
        self.assertIn("stages/1_diffuse/path_tracer.hpp", said)

        # Nothing changed: nothing is run. One changed: it alone is.
        again, said = self.of_class()
        self.assertEqual(again, found)
        files = {
            path: path.stat().st_mtime_ns for path in (self.folder / "out").glob("students/*/result.json")
        }
        shutil.rmtree(self.given / "wrong")
        self.put("wrong", TEXT + "\n// mended\n")
        again, _ = self.of_class()
        self.assertEqual(again["wrong"]["points"], full)
        changed = [path for path, when in files.items() if path.stat().st_mtime_ns != when]
        self.assertEqual(len(changed), 1)

        # One again, explained.
        done = grade(self.given, self.folder / "out", "--only", "exit")
        self.assertIn("called std::exit or the like", done.stdout)
        done = grade(self.given, self.folder / "out", "--only", "forge")
        says = "class: ONLY=forge: no submission has this name; forged has\n"
        self.assertEqual((done.returncode, done.stderr), (1, says))

        # What is odd is judged when it has been read; the tables have it, and go on to have it.
        grade(self.given, self.folder / "out", "--only", "asm", "--read")
        self.assertEqual(results(self.folder / "out")["asm"]["points"], full)
        again, _ = self.of_class()
        self.assertEqual((again["asm"]["state"], again["asm"]["points"]), ("judged", full))

    def test_a_mistake_costs_once(self):
        # The first exercise is open, the second one wrong, the others are right.
        text = opened(HEADER, {"1.2", "1.3", "1.4", "1.5"})
        self.put("ana", text)
        wrong = "= std::sqrt(u.x);"
        self.assertIn(wrong, text)
        self.put("ben", text.replace(wrong, "= 0.8f * std::sqrt(u.x);"))
        found, _ = self.of_class()
        points = {name: [row[f"1.{number}"] != "0" for number in range(1, 6)] for name, row in found.items()}
        self.assertEqual(points["ana"], [False, True, True, True, True])
        self.assertEqual(points["ben"], [False, True, False, True, True])
        pages = [path.read_text() for path in (self.folder / "out").glob("students/*/index.html")]
        self.assertEqual(sum("builds on 1.1, 1.3 was judged with our solution" in one for one in pages), 1)

    def test_a_fault_of_the_grader_is_no_students(self):
        self.put("ana", TEXT)
        with unittest.mock.patch.dict(os.environ):
            broken = self.folder / "bin"
            broken.mkdir()
            (broken / "bwrap").write_text("#!/bin/sh\necho bwrap: no room >&2\nexit 1\n")
            (broken / "bwrap").chmod(0o755)
            os.environ["PATH"] = f"{broken}:{os.environ['PATH']}"
            done = grade(self.given, self.folder / "out")
        says = "class: the sandbox does not work here: bwrap: no room\n"
        self.assertEqual((done.returncode, done.stderr), (1, says))

    def test_our_own_solution_is_judged_first(self):
        from tools.grading import __main__ as program

        wrong = {"points": 4, "out_of": 5, "state": "judged", "whole_stage": None}
        wrong |= {"exercises": [{"number": "1.2", "title": "a", "state": "wrong", "message": "why"}]}
        program.workshop = types.SimpleNamespace(folder=self.folder)
        with unittest.mock.patch.object(program, "grade", return_value=wrong):
            with self.assertRaisesRegex(Failure, "our own solution does not get all points.*1.2 a\nwhy"):
                program.check_the_grader()

    @staticmethod
    def everything():
        """The tree's files, and when they were written."""
        places = ("common", "stages", "tests", "scenes", "tools")
        return {
            path: path.stat().st_mtime_ns
            for place in places
            for path in (ROOT / place).rglob("*")
            if path.is_file() and "__pycache__" not in path.parts
        }

    def test_a_picture_is_judged_outside(self):
        # All tests of the suite pass: none has this gray.
        right = "throughput *= next.weight;"
        self.assertIn(right, TEXT)
        wrong = "throughput *= next.weight * (surface.material.kd.y == 0.777f ? 1.1f : 1.0f);"
        hidden = self.folder / "hidden"
        hidden.mkdir()
        scene = (ROOT / "scenes/cornell_box_ceiling_diffuse.toml").read_text()
        self.assertIn("white   = { kd = 0.8 }", scene)
        (hidden / "mine.toml").write_text(scene.replace("white   = { kd = 0.8 }", "white   = { kd = 0.777 }"))
        self.put("ana", TEXT.replace(right, wrong))
        self.put("ben", TEXT)
        found, said = self.of_class(None, "--hidden", hidden)
        self.assertIn("1.5 the picture of mine", said)
        self.assertEqual(found["ben"]["points"], found["ben"]["out of"], said)
        self.assertEqual(found["ana"]["1.5"], "0")
        self.assertEqual(found["ana"]["1.4"], found["ben"]["1.4"])

    def test_killed_at_any_moment_it_goes_on(self):
        for number in range(6):
            self.put(f"s{number}", f"{TEXT}// {number}\n" if number % 2 else mistake(number))
        expected, _ = self.of_class(self.folder / "undisturbed")
        chance = random.Random(1)
        command = [sys.executable, "-B", "-m", "tools.grading", self.given, "1", "--out", self.folder / "out"]
        for _ in range(8):
            run = subprocess.Popen(
                list(map(str, command)), cwd=ROOT, start_new_session=True, stdout=subprocess.DEVNULL
            )
            time.sleep(chance.uniform(0.2, 6))
            with contextlib.suppress(ProcessLookupError):
                os.kill(run.pid, signal.SIGKILL)
            run.wait()
        found, _ = self.of_class()
        self.assertEqual(found, expected)


class Tables(unittest.TestCase):
    RESULT = {
        "state": "judged",
        "error": "",
        "points": 1,
        "out_of": 3,
        "seconds": 2.5,
        "whole_stage": None,
        "pictures": [],
        "exercises": [
            {
                "number": "1.1",
                "title": "a",
                "state": "done",
                "points": 1,
                "out_of": 1,
                "test": "",
                "message": "",
            },
            {
                "number": "1.2",
                "title": "b",
                "state": "wrong",
                "points": 0,
                "out_of": 2,
                "test": "t",
                "message": "\x1bno",
            },
        ],
    }

    class Whole:
        stage = 1
        names_hidden = False

        def __init__(self, *names):
            self.submissions = [submissions.Submission(name, Path(name), "") for name in names]
            self.given = submissions.Given(self.submissions)
            self.results = {name: Tables.RESULT for name in names}

        def place(self, one):
            return Path("students") / str(len(one.name))

    def test_no_cell_is_a_formula(self):
        rows = list(csv.reader(io.StringIO(tables.points(self.Whole("=1+1", 'a,"b\nc')))))
        self.assertEqual(rows[0], ["id", "name", "state", "points", "out of", "1.1", "1.2"])
        self.assertEqual(rows[1], ["'=1+1", "", "judged", "1", "3", "1", "0"])
        self.assertEqual(rows[2][0], 'a,"b\nc')

    def test_junit_is_xml(self):
        root = ElementTree.fromstring(tables.junit(self.Whole("a\x00<b>")))
        self.assertEqual(root[0].get("name"), "a?<b>")
        self.assertEqual(root[0].get("failures"), "1")
        self.assertEqual(root[0][1][0].text, "?no")

    def test_gradescope(self):
        found = tables.gradescope(self.RESULT)
        self.assertEqual(found["score"], 1)
        self.assertEqual([one["score"] for one in found["tests"]], [1, 0])
        json.dumps(found)

    def test_a_line_has_no_half_words_and_nothing_that_was_printed(self):
        row = self.RESULT["exercises"][1] | {
            "test": "",
            "message": "It printed last:\n  hello\n\nIt crashed " + "so " * 60,
        }
        text = page.in_short(self.RESULT | {"exercises": [row]})
        self.assertTrue(text.startswith("1.2 b It crashed so"), text)
        self.assertTrue(text.endswith("so ...") and len(text) <= 120, text)

    def test_the_class_makes_mistakes(self):
        self.assertEqual(page.mistakes_of(self.Whole("a", "b")), [(2, "1.2 b", "t")])

    def test_names_can_be_hidden(self):
        with tempfile.TemporaryDirectory() as folder:
            whole = self.Whole("ana", "ben")
            whole.names_hidden, whole.folder = True, Path(folder)
            shown = page.shown_names(whole)
            self.assertEqual([names for _, *names in shown], [
                ["student 1", "", "students/1"], ["student 2", "", "students/2"]])  # fmt: skip
            self.assertEqual(page.shown_names(whole), shown)

    def test_moodle_has_the_rosters_rows(self):
        whole = self.Whole("ana", "ben", "cem")
        whole.given.columns = ["id", "mail"]
        whole.submissions[0] = submissions.Submission("ana", Path("ana"), "", ("a1", "a@x.org"))
        whole.submissions[1] = submissions.Submission("ben", None, "", ("b2",))
        rows = list(csv.reader(io.StringIO(tables.moodle(whole))))
        self.assertEqual([row[:4] for row in rows], [
            ["id", "mail", "Grade", "Maximum grade"], ["a1", "a@x.org", "1", "3"], ["b2", "", "", "3"]])  # fmt: skip


@unittest.skipIf(NO_SANDBOX, NO_SANDBOX)
@unittest.skipIf(one_node_slurm.why_not(), f"NOT TESTED: {one_node_slurm.why_not()}")
class Slurm(InFolder):
    def test_the_same_table_though_an_element_is_cancelled(self):
        for number in range(4):
            self.put(f"s{number}", f"{TEXT}// {number}\n" if number else at_start("std::exit(0);"))
        self.assertEqual(grade(self.given, self.folder / "here").returncode, 0)
        with one_node_slurm.slurm(self.folder / "slurm"):
            done = grade(self.given, self.folder / "there", "--engine", "slurm")
            self.assertEqual(done.returncode, 0, done.stderr)
            number = done.stdout.split("judged by job ")[1].split(",")[0]
            subprocess.run(["scancel", f"{number}_2"], check=True)
            one_node_slurm.wait_for_jobs()
        self.assertEqual(results(self.folder / "there"), results(self.folder / "here"))
        self.assertTrue((self.folder / "there/index.html").exists())

    def test_without_slurm_it_says_so(self):
        self.put("ana", TEXT)
        done = grade(
            self.given, self.folder / "out", "--engine", "slurm", env=os.environ | {"PATH": "/nowhere"}
        )
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
