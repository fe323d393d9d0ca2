"""`make single-header`: each stage as one header that needs GLM alone.

Tests the header of the newest stage; `make test-single-header` takes every stage,
each installed compiler, and the programs of the how-tos as they are.
"""

import functools
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from programs import BUILD, ROOT, InFolder, communicate, run

from tools.tree import stage_headers

EVERY_STAGE = bool(os.environ.get("LIGHTWALK_EVERY_STAGE"))
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion"]
CACHE = (BUILD / "CMakeCache.txt").read_text() if (BUILD / "CMakeCache.txt").exists() else ""


def configured(name):
    """A variable of the build folder's CMake cache."""
    found = re.search(rf"^{name}:\w+=(.*)$", CACHE, re.MULTILINE)
    return found[1] if found else ""


def glm():
    """The option with GLM's folder, searched after the compiler's own folders."""
    prefix = re.match(r"(.*)/(share|lib\w*)/", configured("glm_DIR"))
    folder = f"{prefix[1]}/include" if prefix else ""
    return ["-idirafter", folder] if os.path.isdir(f"{folder}/glm") else []


def compiler():
    return os.environ.get("CXX") or configured("CMAKE_CXX_COMPILER") or "c++"


def number(header):
    return int(header.parent.name[0])


def make(build, root=ROOT, **environment):
    """Does what `make single-header` does in a tree, into a build folder."""
    env = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **environment}
    env |= {"LIGHTWALK_BUILD": str(build), "PYTHONPATH": str(root)}
    command = [sys.executable, "-m", "tools.handout.single_header"]
    return subprocess.run(command, cwd=root, env=env, capture_output=True, text=True)


@functools.cache
def texts():
    """The single headers of this tree, by stage."""
    with tempfile.TemporaryDirectory() as folder:
        done = make(folder)
        if done.returncode:
            raise AssertionError(done.stderr)
        return {
            number(one): Path(folder, f"single/stage{number(one)}.hpp").read_text() for one in stage_headers()
        }


def program_of(text):
    """The program in the how-to."""
    shown = re.search(r"^//     #include.*?^//     }$", text, re.MULTILINE | re.DOTALL)[0]
    return "".join(f"{line[7:]}\n" for line in shown.splitlines())


def together(*commands, folder):
    """Runs them in parallel; returns their exit codes and output."""
    pipes = dict(cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    running = [subprocess.Popen(command, **pipes) for command in commands]
    try:
        said = [communicate(one)[0] for one in running]
    finally:
        for one in running:
            one.kill()
    return [(one.returncode, text) for one, text in zip(running, said)]


class Compiled(InFolder):
    """A folder with only a single header, and nothing of the tree."""

    def put(self, stage):
        self.stage = stage
        self.name = f"stage{self.stage}.hpp"
        self.text = texts()[stage]
        (self.folder / self.name).write_text(self.text)

    def build(self, cxx, program, *options):
        """Two translation units, the header alone and the program."""
        (self.folder / "box.cpp").write_text(program)
        base = [cxx, "-std=c++20", *WARNINGS, *glm()]
        results = together(
            [*base, "-x", "c++", "-c", self.name, "-o", "alone.o"],
            [*base, *options, "-MD", "-MF", "needs", "-c", "box.cpp", "-o", "box.o"],
            folder=self.folder,
        )
        self.assertEqual(results, [(0, "")] * 2)
        link = [cxx, "-pthread", "alone.o", "box.o", "-o", "box"]
        self.assertEqual(together(link, folder=self.folder), [(0, "")])

    def assert_needs_only_glm(self):
        """Among the included files, GLM is the only library."""
        needs = (self.folder / "needs").read_text().replace("\\\n", " ").split()[1:]
        self.assertEqual([name for name in needs if not name.startswith("/")], ["box.cpp", self.name])
        self.assertEqual([name for name in needs if str(ROOT) in name], [])
        for library in ["toml++", "CLI", "OpenImageIO", "nlohmann", "boost"]:
            self.assertEqual([name for name in needs if f"/{library}/" in name], [])
        self.assertTrue(any("/glm/" in name for name in needs))

    def assert_paints_like_the_tree(self, samples, *options):
        done = together([self.folder / "box"], folder=self.folder)
        self.assertEqual(done, [(0, "")])
        scene = ROOT / re.search(r"build/stage\d (scenes/\S+)", self.text)[1]
        tree = run(
            *[f"stage{self.stage}", scene, "-o", "tree.pfm", "--spp", samples, *options], folder=self.folder
        )
        self.assertEqual(tree.returncode, 0, tree.stderr)
        self.assert_same_bytes("box.pfm", "tree.pfm")

    def assert_same_bytes(self, one, other):
        ours, theirs = ((self.folder / name).read_bytes() for name in (one, other))
        theirs = theirs[: len(ours)]  # in the tree's file the variance follows the mean
        differ = sum(a != b for a, b in zip(ours, theirs)) + abs(len(ours) - len(theirs))
        self.assertEqual(differ, 0, f"{one} and {other} differ in {differ} of {len(theirs)} bytes")


class NewestStage(Compiled):
    def test_paints_what_the_tree_paints(self):
        self.put(max(texts()))
        program = program_of(self.text)
        # Small, since it is compiled without optimization.
        small, count = re.subn(
            r"( *)const auto picture = paint",
            r"\1box.camera.width = box.camera.height = 48;\n\g<0>",
            program.replace("samples_per_pixel = 16", "samples_per_pixel = 4"),
        )
        self.assertEqual((count, "pixel = 4" in small), (1, True))
        self.build(compiler(), small, "-ffp-contract=off")
        self.assert_needs_only_glm()
        self.assert_paints_like_the_tree(4, "--size", "48x48")

    def test_says_first_what_is_missing(self):
        self.put(max(texts()))
        without_glm = self.text.replace("<glm/", "<no-glm/")
        (self.folder / "without_glm.hpp").write_text(without_glm)
        (self.folder / "two.hpp").write_text(f'#include "{self.name}"\n#include "older.hpp"\n')
        older = self.text.replace(f"LIGHTWALK_STAGE{self.stage}_HPP", "LIGHTWALK_STAGE0_HPP")
        (self.folder / "older.hpp").write_text(older)
        check = [compiler(), *glm(), "-fsyntax-only", "-x", "c++"]
        cases = [
            ("needs C++20", self.name, "-std=c++17"),
            ("needs GLM", "without_glm.hpp", "-std=c++20"),
            ("another stage is included", "two.hpp", "-std=c++20"),
        ]
        commands = [[*check, standard, file] for _, file, standard in cases]
        for (message, *_), (code, said) in zip(cases, together(*commands, folder=self.folder)):
            errors = [line for line in said.splitlines() if re.search(r"\berror:", line)]
            self.assertEqual((code != 0, len(errors)), (True, 1), said)
            self.assertIn(message, errors[0])


class Text(InFolder):
    def test_the_same_bytes_each_time(self):
        seen = []
        for seed in ("1", "2"):
            self.assertEqual(make(self.folder / seed, PYTHONHASHSEED=seed).stderr, "")
            files = sorted((self.folder / seed / "single").iterdir())
            seen.append({path.name: path.read_bytes() for path in files})
        self.assertEqual(list(seen[0]), [f"stage{number(header)}.hpp" for header in stage_headers()])
        self.assertEqual(seen[0], seen[1])

    def test_every_line_of_the_tree_is_there(self):
        """Prose, code and marks stay, in order; only includes and `#pragma once` go."""
        gone = re.compile(r'#pragma once$|#include ["<](?!immintrin|hwy)')
        for text in texts().values():
            parts = re.split(r"^// ==== (\S+) =+\n", text, flags=re.MULTILINE)[1:]
            parts[-1] = parts[-1][: parts[-1].rindex("#endif  // what")]
            listed = re.findall(r"^// +(\d+)  (\S+\.hpp)$", text, re.MULTILINE)
            self.assertEqual([name for _, name in listed], parts[::2])
            for name, part in zip(parts[::2], parts[1::2]):
                lines = (ROOT / name).read_text().splitlines()
                kept = [line for line in lines if line and not gone.match(line)]
                self.assertEqual([line for line in part.splitlines() if line], kept, name)

    def test_says_in_which_line_what_is(self):
        for text in texts().values():
            lines = text.splitlines()
            contents = [re.match(r"// +(\d+)  +(\S+\.hpp|exercise .*)$", line) for line in lines]
            found = [match.groups() for match in contents if match]
            self.assertGreater(len(found), 10)
            for line, what in found:
                self.assertIn(what, lines[int(line) - 1])
            marks = sum("#region exercise" in line for line in lines)
            self.assertEqual(sum(what.startswith("exercise") for _, what in found), marks)

    def test_the_how_to_is_short(self):
        for text in texts().values():
            program = [line for line in program_of(text).splitlines() if line.strip()]
            self.assertLessEqual(len(program), 21, "an #include and 20 lines")
            self.assertIn((ROOT / "LICENSE").read_text().splitlines()[-1], text)


class Trees(InFolder):
    """Small trees, and the messages about wrong ones."""

    CORE = ["render/paint.hpp", "image/pfm.hpp", "image/ppm.hpp"]

    def make(self, core="", stage="", exercise=""):
        files = {f"common/{name}": f"#pragma once\n{core}\n" for name in self.CORE}
        chapter = f"#pragma once\n\n// # Stage 4: a title\n{stage}\n\nint f() {{\n{exercise}}}\n"
        files["stages/4_small/path_tracer.hpp"] = chapter
        files["CMakeLists.txt"] = "cmake_minimum_required(VERSION 3.22)\nproject(x VERSION 1.2)\n"
        files["LICENSE"] = "None.\n"
        for name, text in files.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text(text)
        shutil.copytree(ROOT / "tools/handout", self.folder / "tools/handout")
        shutil.copy(ROOT / "tools/tree.py", self.folder / "tools")
        return make(self.folder / "build", self.folder)

    def test_an_open_exercise_stays_as_it_is(self):
        exercise = "  // #region exercise 4.1: a choice\n  // #stub return 7;\n  return 7;\n  // #endregion\n"
        self.assertEqual(self.make(exercise=exercise).stderr, "")
        text = (self.folder / "build/single/stage4.hpp").read_text()
        self.assertIn(exercise, text)
        self.assertRegex(text, r"// +\d+    exercise 4\.1: a choice\n")
        self.assertTrue(text.startswith("// stage4.hpp - Lightwalk 1.2, stage 4: a title\n"))

    def assert_refused(self, message, **texts):
        done = self.make(**texts)
        self.assertEqual((done.returncode, done.stderr), (1, f"single_header: {message}\n"))

    def test_another_library(self):
        message = "common/render/paint.hpp:2: <toml++/toml.hpp> is neither of GLM nor of the standard library"
        self.assert_refused(message, core="#include <toml++/toml.hpp>")

    def test_a_header_of_the_system(self):
        message = "common/render/paint.hpp:2: <windows.h> is neither of GLM nor of the standard library"
        self.assert_refused(message, core="#include <windows.h>")

    def test_a_header_that_is_not_there(self):
        chapter = "stages/4_small/path_tracer.hpp:4"
        message = f'{chapter}: there is no header "common/tensor.hpp"'
        self.assert_refused(message, stage='#include "common/tensor.hpp"')

    def test_an_include_under_a_condition(self):
        chapter = "stages/4_small/path_tracer.hpp:5"
        message = f"{chapter}: vector is included under a condition, and must not be"
        self.assert_refused(message, stage="#ifdef X\n#include <vector>\n#endif")

    def test_an_include_by_a_macro(self):
        chapter = "stages/4_small/path_tracer.hpp:4"
        message = f'{chapter}: #include "file" or <file> is expected, and nothing else'
        self.assert_refused(message, stage="#include NAME")


class EveryStage(Compiled):
    """The how-to's program as it is, with every compiler, optimized and not."""

    def test_paints_what_the_tree_paints(self):
        compilers = {os.path.realpath(shutil.which(compiler())): compiler()}
        for name in ("g++", "clang++"):
            if path := shutil.which(name):
                compilers.setdefault(os.path.realpath(path), name)
            else:
                with self.subTest(compiler=name):
                    self.skipTest(f"{name} is missing (tools/setup.sh compilers)")
        for stage in texts():
            self.put(stage)
            for cxx in compilers.values():
                with self.subTest(stage=self.stage, compiler=cxx):
                    self.paint(cxx)

    def paint(self, cxx):
        program = program_of(self.text)
        self.build(cxx, program, "-O2", "-ffp-contract=off")
        self.assert_needs_only_glm()
        if cxx == compiler():
            self.assert_paints_like_the_tree(16)
        else:
            self.assertEqual(together([self.folder / "box"], folder=self.folder), [(0, "")])
        # The tree's own headers, with the same compiler and options.
        (self.folder / "box.pfm").rename(self.folder / "single.pfm")
        headers = re.findall(r"^// ==== (\S+)", self.text, re.MULTILINE)
        includes = "".join(f'#include "{name}"\n' for name in headers) + "#include <fstream>"
        from_tree = program.replace(f'#include "{self.name}"', includes)
        (self.folder / "tree.cpp").write_text(from_tree)
        options = ["-std=c++20", "-O2", "-ffp-contract=off", "-pthread", "-I", ROOT, *glm()]
        command = [cxx, *options, "tree.cpp", "-o", "tree"]
        self.assertEqual(together(command, folder=self.folder), [(0, "")])
        self.assertEqual(together([self.folder / "tree"], folder=self.folder), [(0, "")])
        self.assert_same_bytes("single.pfm", "box.pfm")
        # With no option but that of the C++ standard.
        bare = [cxx, "-std=c++20", "-x", "c++", "-fsyntax-only", *glm(), self.name]
        self.assertEqual(together(bare, folder=self.folder), [(0, "")])


if not EVERY_STAGE:  # minutes: `make test-single-header`
    del EveryStage


if __name__ == "__main__":
    unittest.main()
