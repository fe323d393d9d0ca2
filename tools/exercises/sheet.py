"""A chapter's exercises and questions: exercises.toml beside the header.

    recap = [five lines]
    [[exercise]]     number, task, hints = [three], tests = [prefixes of the
                     names of test cases], needs = [numbers], minutes, points;
                     later = [tests that check it, and need the whole stage]
    [[question]]     ask, answer; three of them

Every mark of the header has its [[exercise]], and the other way round.
"""

import functools
import tomllib
from dataclasses import dataclass, field

from tools.exercises.marks import Exercise, exercises, order
from tools.tree import ROOT, Failure, stage_headers, test_names, tests_filter, text_of

QUESTIONS, RECAP, HINTS = 3, 5, 3
KEYS = {
    "number": str,
    "task": str,
    "hints": list,
    "tests": list,
    "needs": list,
    "minutes": int,
    "points": int,
}
OPTIONAL = {"later": list}


@dataclass
class Task:
    mark: Exercise
    task: str
    hints: list
    tests: list
    needs: list
    minutes: int
    points: int
    later: list = field(default_factory=list)

    @property
    def stage(self):
        return self.mark.number.split(".")[0]

    def command(self):
        """Builds and runs the tests of the exercise."""
        return [
            f"cmake --build build --target stage{self.stage}_tests",
            f"build/stage{self.stage}_tests -tc='{tests_filter(self.tests)}'",
        ]


@dataclass
class Sheet:
    """All of one exercises.toml; empty where a chapter has none."""

    tasks: dict = field(default_factory=dict)
    questions: list = field(default_factory=list)
    recap: list = field(default_factory=list)

    def texts(self):
        """All prose, with the name of the entry that it belongs to."""
        for number, task in self.tasks.items():
            for text in (task.task, *task.hints):
                yield f"exercise {number}", text
        for place, question in enumerate(self.questions, 1):
            yield f"question {place}", question["ask"]
            yield f"question {place}", question["answer"]
        for text in self.recap:
            yield "recap", text


def read_tasks(header):
    """The [[exercise]] tables by their numbers, unchecked: for a tree in which
    a student works."""
    path = header.with_name("exercises.toml")
    sheet = tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    return {table["number"]: table for table in sheet.get("exercise", [])}


def headers_with_exercises():
    """The chapters with exercises; others are for reading."""
    return [header for header in stage_headers() if read_tasks(header)]


def title_of(header):
    """The chapter's, "Stage 3: perfect mirrors and glass"."""
    return next(line[5:] for line in text_of(header).splitlines() if line.startswith("// # "))


def task_file(header):
    return header.with_name("exercises.toml").relative_to(ROOT)


@functools.cache
def known_numbers():
    return {one.number for header in stage_headers() for one in exercises(header)}


def checked(entry, mark, where):
    """The task of a valid entry."""
    for key, kind in (KEYS | OPTIONAL).items():
        if key in OPTIONAL and key not in entry:
            continue
        if key not in entry:
            raise Failure(f"{where}: {key} is missing")
        if type(entry[key]) is not kind:
            raise Failure(f"{where}: {key} is not of type {kind.__name__}")
        if kind is list and not all(isinstance(x, str) for x in entry[key]):
            raise Failure(f"{where}: {key} is a list of strings")
    for key in entry.keys() - KEYS.keys() - OPTIONAL.keys():
        raise Failure(f"{where}: there is no key {key}")
    if len(entry["hints"]) != HINTS:
        raise Failure(f"{where}: has {len(entry['hints'])} hints, not {HINTS}")
    for key in ("minutes", "points"):
        if entry[key] < 1:
            raise Failure(f"{where}: {key} is {entry[key]}, not 1 or more")
    if not entry["tests"]:
        raise Failure(f"{where}: no test checks it")
    names = test_names(f"stage{mark.number.split('.')[0]}")
    for test in entry["tests"] + entry.get("later", []):
        if not test or not any(name.startswith(test) for name in names):
            raise Failure(f'{where}: no test case of its stage begins "{test}"')
    for number in entry["needs"]:
        if number not in known_numbers() or order(number) >= order(mark.number):
            raise Failure(f"{where}: needs {number}, which is no exercise before it")
    return Task(mark, *(entry[key] for key in KEYS if key != "number"))


def read_sheet(header):
    """The exercises.toml beside the header."""
    marks = {one.number: one for one in exercises(header)}
    name = task_file(header)
    path = ROOT / name
    if not path.exists():
        for one in marks.values():
            raise Failure(f"{one.where}: exercise {one.number} has no task: there is no {name}")
        return Sheet()
    try:
        found = tomllib.loads(path.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise Failure(f"{name}: {error}") from None
    for key in found.keys() - {"exercise", "question", "recap"}:
        raise Failure(f"{name}: there is no key {key}")
    tasks = {}
    for entry in found.get("exercise", []):
        number = entry.get("number", "?")
        if number not in marks:
            raise Failure(f"{name}: exercise {number} has no mark in {header.name}")
        if number in tasks:
            raise Failure(f"{name}: exercise {number} is there twice")
        tasks[number] = checked(entry, marks[number], f"{name}: exercise {number}")
    for number, one in marks.items():
        if number not in tasks:
            raise Failure(f"{one.where}: exercise {number} has no task in {name}")
    questions, recap = found.get("question", []), found.get("recap", [])
    if len(questions) != QUESTIONS:
        raise Failure(f"{name}: has {len(questions)} questions, not {QUESTIONS}")
    for place, question in enumerate(questions, 1):
        if question.keys() != {"ask", "answer"}:
            raise Failure(f"{name}: question {place} must have exactly ask and answer")
    if len(recap) != RECAP:
        raise Failure(f"{name}: recap has {len(recap)} lines, not {RECAP}")
    tasks = {number: tasks[number] for number in marks}
    return Sheet(tasks, questions, recap)
