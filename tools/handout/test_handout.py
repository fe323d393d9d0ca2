"""Tests handouts and `make check` without compiling anything: `make handouts`
does the rest."""

import contextlib
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
import unittest.mock as mock
from pathlib import Path

from tools.exercises.marks import exercises, marks
from tools.exercises.sheet import headers_with_exercises
from tools.handout import contents as contents_of_handouts
from tools.handout import handout, repository
from tools.handout.contents import contents, stage_of
from tools.handout.handout import add_to, all_files, make_new
from tools.handout.opened import opened
from tools.handout.prove import leaks
from tools.handout.repository import commit_all, git, tracked_files
from tools.handout.student_tree import is_inside
from tools.tree import HANDOUT_NOTE, ROOT, Failure, sum_of


class Opened(unittest.TestCase):
    def test_an_open_exercise_calls_and_returns_its_stub(self):
        for header in headers_with_exercises():
            text = opened(header)
            self.assertNotIn("#stub", text)
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / header.relative_to(ROOT)
                path.parent.mkdir(parents=True)
                path.write_text(text)
                found = marks(path)
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
        tracked = tracked_files()
        header = headers_with_exercises()[0]
        files = contents(1, tracked, "previous")
        self.assertEqual(list(leaks(files, [header], [])), [])
        line = exercises(header)[1].body[1].strip()
        files["scenes/README.md"] += f"\n  {line}\n".encode()
        self.assertEqual(list(leaks(files, [header], [])), [("scenes/README.md", line)])

    def test_answers_stay_at_home(self):
        tracked = tracked_files()
        for header in headers_with_exercises():
            stage = stage_of(header)
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
        self.assertEqual(mine.read_text(encoding="utf-8"), "// what I have written\n")
        self.assertEqual((self.folder / "README.md").read_text(encoding="utf-8"), "my notes\n")
        self.assertEqual((self.folder / "my_scene.toml").read_text(encoding="utf-8"), "# mine\n")
        self.assertIn("README.md was changed there, and is as it was", said)
        new = next(self.folder.glob("stages/2_*/path_tracer.hpp"))
        self.assertIn("open_exercise(", new.read_text(encoding="utf-8"))
        self.assertEqual(json.loads((self.folder / "handout.json").read_text(encoding="utf-8"))["stage"], 2)
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


class StudentTrees(unittest.TestCase):
    """A folder of a student's is not believed, and nothing outside it is touched."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.top = Path(temporary.name).resolve()
        brought = {stage: all_files(stage, "previous") for stage in (1, 2)}
        patch = mock.patch.object(handout, "all_files", lambda stage, _: brought[stage])
        patch.start()
        cls.addClassCleanup(patch.stop)
        cls.brought = brought[2]
        with contextlib.redirect_stdout(io.StringIO()):
            make_new(1, "previous", cls.top / "first")

    def setUp(self):
        self.place = self.top / self.id().rpartition(".")[2]
        self.student = self.place / "student"
        shutil.copytree(self.top / "first", self.student)

    def outside(self, text="years of work"):
        path = self.place / "thesis.txt"
        path.write_text(text)
        return path

    def add(self):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            add_to(2, self.student)
        return said.getvalue()

    def edit_note(self, change):
        path = self.student / HANDOUT_NOTE
        found = json.loads(path.read_text())
        change(found)
        path.write_text(json.dumps(found))

    def refused(self, expected):
        before = sorted(self.place.rglob("*"))
        with self.assertRaisesRegex(Failure, expected):
            self.add()
        self.assertEqual(sorted(self.place.rglob("*")), before)

    def test_names_in_the_note_lead_nowhere_else(self):
        thesis = self.outside()
        total = sum_of(thesis.read_bytes())
        names = ("../thesis.txt", str(thesis), "tests/../../thesis.txt", "..\\thesis.txt", "C:\\thesis.txt")
        self.edit_note(lambda found: found["files"].update(dict.fromkeys(names, total)))
        self.add()
        self.assertTrue(thesis.exists())
        self.assertEqual(list(filter(is_inside, names)), [])

    @unittest.skipIf(os.name == "nt", "links need rights there")
    def test_links_are_not_followed(self):
        thesis = self.outside()
        for name, target in (
            ("README.md", thesis),
            ("scenes/cornell_box_point_diffuse.toml", self.place / "not_there"),
            ("tests", self.place / "elsewhere"),
        ):
            with self.subTest(name):
                place = self.student / name
                if place.is_dir():
                    shutil.move(place, target)
                place.unlink(missing_ok=True)
                place.symlink_to(target)
                self.refused(f"{name} is a link")
                place.unlink()
        self.assertEqual(thesis.read_text(), "years of work")

    @unittest.skipIf(os.name == "nt", "has no such files")
    def test_what_is_no_file_is_in_the_way(self):
        golden, readme = self.student / "tests/golden/goldens.toml", self.student / "README.md"
        golden.unlink()
        golden.mkdir()
        self.refused("goldens.toml is no file")
        golden.rmdir()
        readme.unlink()
        os.mkfifo(readme)
        self.refused("README.md is no file")
        readme.unlink()
        (self.student / "stages/2_next_event").write_text("my plan")
        self.refused("2_next_event is no folder")

    def test_a_damaged_note_is_one_sentence(self):
        path = self.student / HANDOUT_NOTE
        text = path.read_text()
        for damaged in (
            "",
            "{}",
            text[:4000],
            "<<<<<<< HEAD\n" + text,
            '{"stage": "1", "files": {}}',
            '{"stage": 0, "files": {}}',
            99999 * "[",
        ):
            path.write_text(damaged)
            self.refused("handout.json is damaged")

    def test_a_name_in_the_note_is_no_way_to_the_students_work(self):
        mine = self.student / "stages/1_diffuse/path_tracer.hpp"
        head = self.student / ".git/HEAD"
        names = {
            "./stages/1_diffuse/path_tracer.hpp": mine,
            "stages//1_diffuse/path_tracer.hpp": mine,
            "Stages/1_diffuse/path_tracer.hpp": mine,
            ".git/HEAD": head,
            "./LICENSE": self.student / "LICENSE",
            300 * "a": mine,
        }
        sums = {name: sum_of(path.read_bytes()) for name, path in names.items()}
        self.edit_note(lambda found: found["files"].update(sums))
        self.add()
        for path in names.values():
            self.assertTrue(path.exists(), path)

    def test_what_a_student_saves_meanwhile_stays(self):
        readme, replace = self.student / "README.md", os.replace

        def save(source, target):
            replace(source, target)
            if Path(target).name != "README.md":
                readme.write_text("saved meanwhile")

        with mock.patch("os.replace", save):
            self.assertIn("README.md was changed there", self.add())
        self.assertEqual(readme.read_text(), "saved meanwhile")

    @unittest.skipIf(os.name == "nt", "links need rights there")
    def test_a_link_that_comes_meanwhile_is_not_followed(self):
        replace, elsewhere = os.replace, self.place / "elsewhere"

        def swap(source, target):
            replace(source, target)
            if not elsewhere.exists():
                (self.student / "tests").rename(elsewhere)
                (self.student / "tests").symlink_to(elsewhere)

        with (
            mock.patch("os.replace", swap),
            self.assertRaisesRegex(Failure, "tests is a link.*goes on from here"),
        ):
            self.add()
        self.assertFalse((elsewhere / "stage2").exists())

    def test_an_own_chapter_of_the_next_stage_is_in_the_way(self):
        mine = self.student / "stages/2_next_event/path_tracer.hpp"
        mine.parent.mkdir()
        mine.write_text("my own")
        self.refused("is there already and was not handed out: move it away")

    def test_line_ends_do_not_matter(self):
        for path in self.student.rglob("*"):
            if path.suffix in (".toml", ".cpp", ".hpp", ".md") or path.name == "Makefile":
                path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
        self.assertNotIn("was changed", self.add())
        self.assertIn("stage = 2", (self.student / "tests/golden/goldens.toml").read_text())

    def test_a_chapter_that_was_handed_out_stays(self):
        page = self.student / "stages/1_diffuse/chapter.html"
        page.parent.mkdir(exist_ok=True)
        page.write_text("the page")
        name = page.relative_to(self.student).as_posix()
        self.edit_note(lambda found: found["files"].update({name: sum_of(page.read_bytes())}))
        self.add()
        self.assertTrue(page.exists())

    def test_a_student_makes_a_single_header(self):
        subprocess.run(
            [sys.executable, "-m", "tools.handout.single_header"],
            cwd=self.student,
            env=os.environ | {"LIGHTWALK_BUILD": str(self.place / "build")},
            stdout=subprocess.DEVNULL,
            check=True,
        )
        self.assertIn("#region exercise 1.1", (self.place / "build/single/stage1.hpp").read_text())

    def test_a_renamed_chapter_does_not_come_again(self):
        (self.student / "stages/1_diffuse").rename(self.student / "stages/1_mine")
        self.assertIn("stages/1_diffuse/path_tracer.hpp is not there", self.add())
        self.assertFalse((self.student / "stages/1_diffuse").exists())

    def add_to_a_full_disk(self):
        """The disk is full in the middle."""
        replace, count = os.replace, 0

        def full(source, target):
            nonlocal count
            count += 1
            if count == 9:
                raise OSError(28, "No space left on device")
            replace(source, target)

        with (
            mock.patch("os.replace", full),
            self.assertRaisesRegex(Failure, "No space left on device; the same command goes on"),
        ):
            self.add()

    def all_is_there(self):
        for path, data in self.brought.items():
            if not path.startswith("stages/1_"):
                self.assertEqual((self.student / path).read_bytes(), data, path)
        self.assertEqual(list(self.student.rglob(".handout-*")), [])

    def test_what_is_broken_off_goes_on(self):
        self.add_to_a_full_disk()
        self.assertNotIn("was changed", self.add())
        self.all_is_there()

    # What the first one has written is not taken for the student's work.
    def test_what_is_broken_off_goes_on_from_a_newer_tree(self):
        newer = {path: data + b"\n" for path, data in self.brought.items()}
        with mock.patch.object(handout, "all_files", lambda *_: newer):
            self.add_to_a_full_disk()
        self.assertNotIn("was changed", self.add())
        self.all_is_there()


class Repositories(unittest.TestCase):
    """What anybody has set for git stays outside; and where a tree comes from."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.top = Path(temporary.name).resolve()

    def committed(self, **environment):
        folder = self.top / "student"
        folder.mkdir()
        (folder / "scene.toml").write_text("x = 1\n")
        with mock.patch.dict(os.environ, environment):
            commit_all(folder, ["scene.toml"], "All of it")
        self.assertEqual(git(folder, "ls-files"), "scene.toml\n")
        self.assertEqual(git(folder, "log", "--format=%an %s"), "Lightwalk All of it\n")

    def test_a_hook_has_set_GIT_DIR(self):
        other = self.top / "course"
        other.mkdir()
        git(other, "init", "--quiet")
        self.committed(GIT_DIR=str(other / ".git"), GIT_WORK_TREE=str(other), GIT_INDEX_FILE="x")
        self.assertEqual(git(other, "status", "--porcelain"), "")

    def test_the_instructors_settings(self):
        hooks = self.top / "hooks"
        hooks.mkdir()
        (hooks / "commit-msg").write_text("#!/bin/sh\nexit 1\n")
        (hooks / "commit-msg").chmod(0o755)
        (self.top / "ignore").write_text("*.toml\n")
        settings = f"[commit]\ngpgsign = true\n[core]\nhooksPath = {hooks.as_posix()}\nautocrlf = true\n"
        settings += f"excludesFile = {(self.top / 'ignore').as_posix()}\n"
        (self.top / ".gitconfig").write_text(settings)
        self.committed(HOME=str(self.top), USERPROFILE=str(self.top))

    def test_what_git_leaves_out_is_told(self):
        (self.top / "a").write_text("")
        with self.assertRaisesRegex(Failure, "git has not taken 1 files, b for one"):
            commit_all(self.top, ["a", "b"], "All")

    def test_a_tree_from_an_archive(self):
        for name in ("CMakeLists.txt", "scenes/señal [1].toml", "build/x", "tools/__pycache__/x.pyc"):
            (self.top / name).parent.mkdir(parents=True, exist_ok=True)
            (self.top / name).write_text("")
        git(self.top.parent, "init", "--quiet", self.top.name)
        with mock.patch.object(repository, "ROOT", self.top):
            with self.assertRaisesRegex(Failure, "`git add` them"):
                tracked_files()
            shutil.rmtree(self.top / ".git")
            expected = ["CMakeLists.txt", "scenes/señal [1].toml"]
            self.assertEqual(sorted(tracked_files()), expected)


class Scenes(unittest.TestCase):
    """All scenes that a stage can read are handed out, whatever their names."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.top = Path(temporary.name)
        patch = mock.patch.object(contents_of_handouts, "ROOT", self.top)
        patch.start()
        self.addCleanup(patch.stop)
        (self.top / "stages").mkdir()
        (self.top / "stages/introductions.hpp").write_text('{"image", 5}\n')

    def scenes(self, stage, **texts):
        for name, data in texts.items():
            (self.top / name).parent.mkdir(parents=True, exist_ok=True)
            (self.top / name).write_bytes(data)
        return sorted(contents_of_handouts.scenes_until(stage, list(texts)))

    def test_names(self):
        texts = {
            name: b"x = 1" for name in ("scenes/my-scene.toml", "scenes/señal.toml", "scenes/lab1/a b.toml")
        }
        self.assertEqual(self.scenes(1, **texts), sorted(texts))

    def test_images_lie_beside_the_scene(self):
        texts = {"scenes/lab1/globe.toml": b'image = "../earth.png"', "scenes/earth.png": b""}
        self.assertEqual(self.scenes(5, **texts), sorted(texts))
        self.assertEqual(self.scenes(4, **texts), [])
        with self.assertRaisesRegex(Failure, "scenes/a.toml: the tree has no image scenes/b.png"):
            self.scenes(5, **{"scenes/a.toml": b'image = "b.png"'})

    def test_a_byte_order_mark_and_what_is_no_toml(self):
        self.assertEqual(self.scenes(1, **{"scenes/a.toml": b"\xef\xbb\xbfx = 1"}), ["scenes/a.toml"])
        for broken in (b"x = ", b"x = '\xf1'"):
            with self.assertRaisesRegex(Failure, "scenes/a.toml: "):
                self.scenes(1, **{"scenes/a.toml": broken})


if __name__ == "__main__":
    unittest.main()
