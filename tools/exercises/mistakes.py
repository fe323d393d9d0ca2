"""Which exercise does `make check` name for each known mistake?

    python3 -m tools.exercises.mistakes [--stage N] [-j JOBS]

Makes each mistake of the catalog that is in the body of an exercise, with all
else solved, and judges the exercises in the chapter's order, each by its own
tests, and then by its `later` tests of the whole stage. The first that fails
should be the one with the mistake.
Writes the table to build/mistakes/exercises.md, and exits with 1 if a mistake is
found in no exercise.
"""

import argparse
import concurrent.futures
import os
import sys

from tests.mistakes import mistakes as catalogue
from tools.exercises.judge import LOOP, last_in_the_loop
from tools.exercises.marks import exercises
from tools.exercises.sheet import read_sheet
from tools.tree import BUILD, Failure, tests_filter


def exercise_of(mistake, suite):
    """The number of the exercise that the mistake's first change is in."""
    text = suite.header.read_text(encoding="utf-8")
    for find, _ in mistake.edits:
        if text.count(find) != 1:
            continue
        first = text[: text.index(find)].count("\n") + 1
        last = first + find.rstrip("\n").count("\n")
        for one in exercises(suite.header):
            if one.first <= last and first <= one.last:
                return one.number
    return None


def first_failing(mistake, suite, tasks, folder):
    """The number of the first exercise whose tests fail, or None."""
    folder = folder / f"stage{mistake.stage}" / mistake.name
    program = catalogue.build_with(catalogue.changed_header(mistake, suite), suite, folder)
    try:
        asked = [(number, task.tests) for number, task in tasks.items()]
        asked += [(number, task.later) for number, task in tasks.items() if task.later]
        last = last_in_the_loop(suite.header, exercises(suite.header))
        asked += [(last.number or LOOP, [""])]  # any other test
        for number, tests in asked:
            if not catalogue.run_program(program, f"-tc={tests_filter(tests)}").passed:
                return number
        return None
    finally:
        program.unlink()


def judged(stage, jobs):
    """(mistake, its exercise, the named exercise) of one stage."""
    suite = catalogue.Suite(stage)
    tasks = read_sheet(suite.header).tasks
    folder = BUILD / "mistakes" / "exercises"
    path = catalogue.CATALOGUE / f"stage{stage}.toml"
    asked = [(one, exercise_of(one, suite)) for one in catalogue.read_mistakes(path) if one.verdict == "fail"]
    asked = [(one, number) for one, number in asked if number]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        found = pool.map(lambda pair: first_failing(pair[0], suite, tasks, folder), asked)
        for (mistake, number), named in zip(asked, found):
            print(f"{number}: {mistake.name}: {named or 'NOT FOUND'}", flush=True)
            yield mistake, number, named


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--stage", type=int)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    stages = (
        [options.stage]
        if options.stage
        else [int(path.stem[-1]) for path in sorted(catalogue.CATALOGUE.glob("stage?.toml"))]
    )
    rows = [row for stage in stages for row in judged(stage, options.jobs)]
    lines = [
        "| stage | mistakes in exercises | named there | in another exercise | not found |",
        "|---|---|---|---|---|",
    ]
    for stage in stages:
        mine = [row for row in rows if row[0].stage == stage]
        there = sum(number == named for _, number, named in mine)
        missed = sum(named is None for *_, named in mine)
        lines.append(f"| {stage} | {len(mine)} | {there} | {len(mine) - there - missed} | {missed} |")
    lines += ["", "| mistake | its exercise | named |", "|---|---|---|"]
    lines += [f"| {one.name} | {number} | {named or '-'} |" for one, number, named in rows if number != named]
    text = "\n".join(lines) + "\n"
    (BUILD / "mistakes" / "exercises.md").write_text(text)
    print("\n" + text)
    return 1 if any(named is None for *_, named in rows) else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as error:
        sys.exit(f"mistakes: {error}")
