"""Judges a stage's exercises, each by its own tests, and then the whole stage.

Exercises come in the order of the chapter. When all of them are done, the tests
that are left are run. One that fails there and is listed as `later` in the sheet
speaks of that exercise, and any other of the path loop, which all paths go through.
"""

import dataclasses
import json
import os
import re
import time

from tests.runner import report, suite
from tools.exercises.marks import marks, place_in_tree
from tools.exercises.sheet import read_tasks
from tools.tree import exact_tests_filter, program_path, stage_headers, tests_filter, text_of

LOOP = "path loop (given)"


@dataclasses.dataclass
class Judged:
    """An exercise, and its result."""

    number: str
    title: str
    where: str
    task: dict
    state: str = "done"  # or open, wrong, waits
    test: str = ""  # the first that fails
    says: str = ""  # if open or wrong
    needs: str = ""  # the exercise that it waits for
    seconds: float = 0

    @property
    def points(self):
        return self.task.get("points", 0) if self.state == "done" else 0


@dataclasses.dataclass
class Verdict:
    """A whole stage."""

    exercises: list
    late: Judged | None = None  # what a test of the whole stage says
    notes: list = dataclasses.field(default_factory=list)  # of tests that pass

    def take_notes(self, outcome):
        self.notes += [note for note in outcome.notes if note not in self.notes]

    @property
    def passed(self):
        return self.late is None and all(one.state == "done" for one in self.exercises)

    @property
    def first(self):
        """What to work at: the first exercise that is wrong or open."""
        return next((one for one in self.exercises if one.state in ("wrong", "open")), self.late)

    def is_late(self, one):
        """Whether the whole stage speaks of this exercise, which passes its own tests."""
        return self.late is not None and one.number == self.late.number

    def state_of(self, one):
        """In words."""
        if self.is_late(one):
            return "wrong in the whole stage"
        return f"needs {one.needs}" if one.state == "waits" else one.state

    def points_of(self, one):
        return 0 if self.is_late(one) else one.points

    @property
    def done(self):
        """The exercises that are right, in the whole stage too."""
        return [one for one in self.exercises if one.state == "done" and not self.is_late(one)]

    @property
    def points(self):
        return sum(one.points for one in self.done)

    @property
    def out_of(self):
        return sum(one.task.get("points", 0) for one in self.exercises)


def run_suite(stage, *options):
    return suite.run_by_kinds(program_path(f"stage{stage}_tests"), *options, first_only=True)


def explained(outcome):
    """The first test of the suite that fails, or that does not end."""
    text = report.first_failure(outcome)
    # If a test reaches an open exercise, the program's line may be all that is known.
    reached = [line for line in outcome.printed.splitlines() if "is still open" in line]
    return "\n".join([text, *reached[:1]]) if reached and reached[0] not in text else text.rstrip("\n")


def first_test(outcome):
    failed = report.sharpest_first(outcome)
    return failed[0].name if failed else next(iter(outcome.caught_by), "")


def open_before(stage):
    """The open exercises of the stages before, which this one is built on."""
    return [
        one
        for header in stage_headers()
        if int(header.parent.name[0]) < stage
        for one in marks(header)
        if one.is_open
    ]


def judge(stage, header, run=run_suite):
    """The verdict on a stage whose tests are built. `run` runs them, with doctest's options."""
    found = {one.number: one for one in marks(header)}
    missing = {one.number: "open" for one in open_before(stage)}
    exercises, states, ran = [], dict(missing), []
    verdict = Verdict(exercises)
    for number, task in read_tasks(header).items():
        mark = found.get(number)
        where = mark.where if mark else place_in_tree(header)
        one = Judged(number, mark.title if mark else "", where, task)
        exercises.append(one)
        waits = next((need for need in task["needs"] if states.get(need, "done") != "done"), None)
        if mark and mark.is_open:
            one.state = "open"
        elif waits:
            one.state, one.needs = "waits", waits
        else:
            start = time.perf_counter()
            outcome = run(stage, f"-tc={tests_filter(task['tests'])}")
            one.seconds = time.perf_counter() - start
            ran += [test.name for test in outcome.tests]
            verdict.take_notes(outcome)
            if not outcome.passed:
                reached = re.search(r"exercise ([\d.]+) \(.*is still open", outcome.printed)
                if reached and reached[1] in missing:
                    one.state, one.needs = "waits", reached[1]
                else:
                    one.state, one.test, one.says = "wrong", first_test(outcome), explained(outcome)
        states[number] = one.state
    if all(one.state == "done" for one in exercises):
        judge_the_rest(stage, header, verdict, ran, run)
    return verdict


def judge_the_rest(stage, header, verdict, ran, run):
    """Runs the tests that no exercise has."""
    outcome = run(stage, f"-tce={exact_tests_filter(ran)}")
    verdict.take_notes(outcome)
    if outcome.passed or not (outcome.tests or outcome.why):
        return
    test = first_test(outcome)
    late = next(
        (
            one
            for one in verdict.exercises
            if any(test.startswith(name) for name in one.task.get("later", []))
        ),
        None,
    )
    if late is None:
        late = last_in_the_loop(header, verdict.exercises)
    verdict.late = dataclasses.replace(late, state="wrong", test=test, says=explained(outcome))


def last_in_the_loop(header, exercises):
    """The last exercise, if it lies in the path loop; else the loop itself."""
    lines = text_of(header).splitlines()
    loop = next((n for n, line in enumerate(lines, 1) if re.match(r"class PathTracer\b", line)), 0)
    last = exercises[-1]
    if loop and int(last.where.rpartition(":")[2] or 0) > loop:
        return last
    return Judged("", LOOP, f"{place_in_tree(header)}:{loop}", {})


def as_dictionary(stage, title, verdict):
    """All of it, for programs."""
    rows = [
        {
            "number": one.number,
            "title": one.title,
            "state": verdict.state_of(one),
            "points": verdict.points_of(one),
            "out_of": one.task.get("points", 0),
            "test": one.test,
            "message": one.says,
            "seconds": round(one.seconds, 3),
        }
        for one in verdict.exercises
    ]
    late = verdict.late
    whole = late and {"number": late.number, "title": late.title, "test": late.test, "message": late.says}
    return {
        "stage": stage,
        "title": title,
        "passed": verdict.passed,
        "points": verdict.points,
        "out_of": verdict.out_of,
        "exercises": rows,
        "whole_stage": whole,
        "notes": verdict.notes,
    }


def as_json(stage, title, verdict, error):
    """The same as a document; `error` is the compiler's, where there is no verdict."""
    if verdict is None:
        found = {"stage": stage, "title": title, "passed": False, "points": 0, "error": error}
    else:
        found = as_dictionary(stage, title, verdict)
    return json.dumps(found, indent=1)


def as_markdown(stage, title, verdict, error):
    """A table for people, with what the first failing test says."""
    if verdict is None:
        return f"## {title}\n\nIt does not compile.\n\n```\n{error}\n```"
    lines = [
        f"## {title}: {verdict.points} of {verdict.out_of} points",
        "",
        "| | exercise | | points |",
        "|---|---|---|---|",
    ]
    for one in verdict.exercises:
        lines.append(
            f"| {one.number} | {one.title} | {verdict.state_of(one)} "
            f"| {verdict.points_of(one)}/{one.task.get('points', 0)} |"
        )
    first = verdict.first
    if first and first.says:
        lines += ["", f"{first.number} {first.title}".strip(), "", "```", first.says, "```"]
    return "\n".join(lines)
