"""Tests the handouts: `make handouts`.

    python3 -m tools.handout.prove [--orders N] [--keep FOLDER]

First: no handout contains a solution or anything of a later stage, whether
earlier stages are open or not. Then one folder plays a student's through the
whole course: each stage is added, compiles without warnings, and lists its open
exercises, and only these fail. The solutions are inserted one by one, in the
chapter's order and in others; each exercise's tests pass as soon as it and the
exercises it needs are solved.
"""

import argparse
import html
import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from tools.exercises.marks import exercises, marks
from tools.exercises.sheet import headers_with_exercises, read_sheet
from tools.handout.contents import contents, stage_of
from tools.handout.handout import add_to, make_new
from tools.handout.repository import tracked_files
from tools.tree import Failure, tests_filter

# A shorter line of a solution may occur anywhere by chance.
LONGEST_CHANCE = 20
TEXTS = {".hpp", ".cpp", ".h", ".py", ".md", ".toml", ".txt", ".json", ".cmake", ".html", ""}


def lines_of(text):
    return {line.strip() for line in text.splitlines()}


def shown(path, data):
    """A file's text; that of a page as a browser shows it, without the numbers
    of its lines."""
    text = data.decode(errors="replace")
    if not path.endswith(".html"):
        return text
    text = re.sub(r'<span class="linenos"[^>]*>[^<]*</span>', "", text)
    return html.unescape(re.sub(r"<[^>]*>", "", text))


def leaks(files, opened, solved):
    """(path, line) of each line that the handout's files share with the solutions
    of the headers `opened`. Lines that a `solved` header shows are allowed, and
    so are those that an opened one has outside its exercises."""
    secret, given = set(), set()
    for header in opened:
        lines = header.read_text(encoding="utf-8").splitlines()
        for one in reversed(exercises(header)):
            secret |= {line.strip() for line in one.body if len(line.strip()) > LONGEST_CHANCE}
            del lines[one.first - 1 : one.last]
        given |= lines_of("\n".join(lines))
    for header in solved:
        given |= lines_of(header.read_text(encoding="utf-8"))
    # Comments name the steps, and the chapter may repeat them.
    secret = {line for line in secret - given if not line.startswith("//")}
    for path, data in files.items():
        if Path(path).suffix not in TEXTS or path.startswith("third_party/"):
            continue
        for line in lines_of(shown(path, data)) & secret:
            yield path, line


def check_contents():
    """Checks each handout's files, without building any."""
    tracked = tracked_files()
    headers = headers_with_exercises()
    for header in headers:
        stage = stage_of(header)
        before = [other for other in headers if stage_of(other) < stage]
        for solutions in ("previous", "none"):
            files = contents(stage, tracked, solutions)
            solved = before if solutions == "previous" else []
            opened = [header] if solutions == "previous" else [*before, header]
            for path, line in leaks(files, opened, solved):
                raise Failure(f"stage {stage}, {solutions}: {path} holds a line of a solution: {line}")
            for path in files:
                later = re.match(r"(?:stages/|tests/(?:every_stage/from_|golden/(?:\w+/)?)?stage)(\d)", path)
                if later and int(later[1]) > stage:
                    raise Failure(f"stage {stage}: {path} belongs to a later stage")
                if path.startswith(("tests/mistakes/", "tests/mutants/", "slides/")):
                    raise Failure(f"stage {stage}: {path} gives solutions away")
        print(f"stage {stage}: {len(files)} files, no solution among them")


class Student:
    """A student's folder with handouts, and its build."""

    def __init__(self, folder):
        self.folder = folder
        self.build = folder / "build"

    def run(self, *command, **options):
        return subprocess.run(
            [str(word) for word in command],
            cwd=self.folder,
            capture_output=True,
            text=True,
            errors="backslashreplace",
            env=os.environ
            | {"LIGHTWALK_BUILD": str(self.build), "CMAKE_ARGS": "-DLIGHTWALK_WARNINGS_AS_ERRORS=ON"},
            **options,
        )

    def made(self, what, *command):
        done = self.run(*command)
        if done.returncode:
            raise Failure(f"{what}:\n{(done.stdout + done.stderr)[-3000:]}")

    def compile(self, *targets):
        self.made("cmake", sys.executable, "-m", "tools.exercises.configure")
        jobs = str(os.cpu_count() or 2)
        self.made(
            f"build of {', '.join(targets)}", "cmake", "--build", self.build, "-j", jobs, "--target", *targets
        )

    def header(self, stage):
        return next(self.folder.glob(f"stages/{stage}_*/path_tracer.hpp"))

    def passes(self, stage, tests):
        """Whether the stage's tests with these names pass."""
        suite = self.build / f"stage{stage}_tests"
        command = [sys.executable, "-m", "tests.runner", suite, f"-tc={tests_filter(tests)}"]
        return self.run(*command).returncode == 0

    def put_in(self, stage, solved, text):
        """The handout's header with the bodies of these exercises."""
        lines = text.splitlines()
        for one in reversed(marks_of(text, self.header(stage))):
            if one.number in solved:
                lines[one.first - 1 : one.last] = solved[one.number]
        self.header(stage).write_text("\n".join(lines) + "\n")


def marks_of(text, path):
    path.write_text(text)
    return marks(path)


def orders(numbers, count):
    """The chapter's order, its reverse, and others."""
    yield list(numbers)
    shuffled = list(reversed(numbers))
    for seed in range(1, count):
        yield list(shuffled)
        random.Random(seed).shuffle(shuffled)


def prove(student, header, count):
    """Takes one stage in the student's folder from open to solved."""
    stage, tasks = stage_of(header), read_sheet(header).tasks
    bodies = {one.number: one.body for one in exercises(header)}
    text = student.header(stage).read_text(encoding="utf-8")
    student.compile(f"stage{stage}_header", f"stage{stage}", f"stage{stage}_tests")
    said = student.run(sys.executable, "-m", "tools.exercises.check", stage)
    if said.returncode == 0:
        raise Failure(f"stage {stage}: make check passes while everything is open")
    for number, one in tasks.items():
        if not re.search(rf"^  {re.escape(number)} .* open$", said.stdout, re.MULTILINE):
            raise Failure(f"stage {stage}: make check does not say that {number} is open:\n{said.stdout}")
        if student.passes(stage, one.tests):
            raise Failure(f"exercise {number} is open, and its tests pass")
    built = 1
    for order in orders(list(bodies), count):
        solved = {}
        for number in order:
            solved[number] = bodies[number]
            student.put_in(stage, solved, text)
            student.compile(f"stage{stage}_tests")
            built += 1
            for other in solved:
                ready = all(need in solved for need in tasks[other].needs if need in bodies)
                if ready and not student.passes(stage, tasks[other].tests):
                    raise Failure(
                        f"stage {stage}: {', '.join(solved)} are solved, and the tests of {other} fail"
                    )
    done = student.run(sys.executable, "-m", "tools.exercises.check", stage)
    if done.returncode:
        raise Failure(f"stage {stage}: all is solved, and make check fails:\n{done.stdout}{done.stderr}")
    print(f"stage {stage}: {len(bodies)} exercises, {built} states, each as it should be", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--orders", type=int, default=2, help="orders in which the solutions are put in")
    parser.add_argument("--keep", type=Path, help="a folder for the student, which stays")
    options = parser.parse_args()
    check_contents()
    with tempfile.TemporaryDirectory() as temporary:
        student = Student(options.keep.absolute() if options.keep else Path(temporary) / "student")
        for header in headers_with_exercises():
            stage = stage_of(header)
            if student.folder.exists():
                add_to(stage, student.folder)
            else:
                make_new(stage, "previous", student.folder)
            prove(student, header, options.orders)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as error:
        sys.exit(f"handouts: {error}")
