"""Which exercises of a stage are done, and what is wrong with the first that
is not: `make check`.

    python3 -m tools.exercises.check [STAGE] [--watch | --hint]

Exercises come in the order of the chapter, each judged by its own tests. Only
the first that is open or wrong is explained. When all are done, the whole suite
of the stage runs. A failure there belongs to the exercise that lists the test
under `later`, or else to the last exercise.
"""

import argparse
import contextlib
import dataclasses
import json
import os
import re
import subprocess
import sys
import textwrap
import time
import tomllib

from tests.runner import report, suite, watch
from tools.exercises.marks import marks
from tools.exercises.sheet import headers_with_exercises, read_tasks, title_of
from tools.exercises.words import plain
from tools.tree import BUILD, ROOT, Failure, tests_filter

NOTES = BUILD / "check"
SCREEN = 24


@dataclasses.dataclass
class Judged:
    """An exercise and its state."""

    number: str
    title: str
    where: str
    task: dict
    state: str = "done"  # or open, wrong, waits
    says: str = ""  # why it is open or wrong
    needs: str = ""  # the exercise that it waits for


def default_stage():
    """A handout's stage, else the newest that has exercises."""
    note = ROOT / "handout.json"
    if note.exists():
        return json.loads(note.read_text(encoding="utf-8"))["stage"]
    return int(headers_with_exercises()[-1].parent.name[0])


def header_of(stage):
    for header in headers_with_exercises():
        if header.parent.name.startswith(f"{stage}_"):
            return header
    known = ", ".join(header.parent.name[0] for header in headers_with_exercises())
    raise Failure(f"stage {stage} has no exercises in this tree; {known} have")


def build(target):
    """The compiler's output, and whether it has built the target."""
    done = subprocess.run(
        ["cmake", "--build", BUILD, "--target", target, "-j", str(os.cpu_count() or 2)],
        capture_output=True,
        text=True,
        errors="backslashreplace",
    )
    return done.stdout + done.stderr, done.returncode == 0


def first_words(text, most=SCREEN):
    """The output from the first error or warning on, at most a screenful."""
    lines = text.replace(str(ROOT) + "/", "").splitlines()
    start = next((n for n, line in enumerate(lines) if re.search(r"\b(error|warning)\b", line)), 0)
    kept = [line for line in lines[start:] if not re.match(r"\[\d+/\d+\]|ninja:|FAILED:|gmake", line)]
    return "\n".join(kept[:most])


def run_suite(stage, tests=()):
    """Runs some of the stage's tests, or all."""
    suffix = ".exe" if os.name == "nt" else ""
    options = [f"-tc={tests_filter(tests)}"] if tests else []
    return suite.run_by_kinds(BUILD / f"stage{stage}_tests{suffix}", *options)


def explained(outcome):
    """The first test of the suite's output that fails, or did not end."""
    text = report.first_failure(outcome)
    # If a test reached an open exercise, that may be the only reason.
    reached = [line for line in outcome.printed.splitlines() if "is still open" in line]
    return "\n".join([text, *reached[:1]]) if reached and reached[0] not in text else text.rstrip("\n")


def judge(stage, header):
    """All exercises of the stage, in order."""
    found = {one.number: one for one in marks(header)}
    judged = {}
    for number, task in read_tasks(header).items():
        mark = found.get(number)
        where = mark.where if mark else header.relative_to(ROOT).as_posix()
        one = judged[number] = Judged(number, mark.title if mark else "", where, task)
        waits = next((need for need in task["needs"] if judged.get(need, one).state != "done"), None)
        if mark and mark.is_open:
            one.state = "open"
        elif waits:
            one.state, one.needs = "waits", waits
        else:
            outcome = run_suite(stage, task["tests"])
            if not outcome.passed:
                one.state, one.says = "wrong", explained(outcome)
    return list(judged.values())


def late_failure(stage, judged, whole):
    """The exercise that a failing test of the whole stage belongs to: by its
    `later`, or else the last one, which all paths go through."""
    for one in judged:
        if one.task.get("later"):
            outcome = run_suite(stage, one.task["later"])
            if not outcome.passed:
                return dataclasses.replace(one, state="wrong", says=explained(outcome))
    return dataclasses.replace(judged[-1], state="wrong", says=explained(whole))


def list_of(judged):
    for one in judged:
        known = one.state in ("done", "open", "wrong")
        state = one.state if known else f"not run: needs {one.needs}"
        yield f"  {one.number:5}{one.title:44}{state}"


def wrapped(text, indent="  "):
    return textwrap.fill(text, 78, initial_indent=indent, subsequent_indent=indent)


def explain(one):
    """The first exercise that is not done, and what to do."""
    yield f"{one.number} {one.title}, {one.where}"
    yield ""
    if one.state == "open":
        yield wrapped(plain(one.task["task"]))
        next_step = "Write it there, and delete the line with open_exercise."
    else:
        yield one.says
        next_step = "Fix it, and run `make check` again."
    yield ""
    yield next_step + " `make hint` gives a hint, `make watch` checks whenever you save."


def check(stage):
    """Prints a screenful; True if all is well."""
    header = header_of(stage)
    if not any(BUILD.glob(f"stage{stage}_tests*")):
        print("Compiling the tests for the first time: a minute or more.\n", flush=True)
    said, made = build(f"stage{stage}_header")
    if not made:
        print("The stage does not compile yet. The first error:\n\n" + first_words(said))
        return False
    warnings = first_words(said, 12) if "warning:" in said else ""
    said, made = build(f"stage{stage}_tests")
    if not made:
        print("The tests do not compile with this stage: has a name or a type changed?")
        print("\n" + first_words(said))
        return False
    judged = judge(stage, header)
    done = sum(one.state == "done" for one in judged)
    print(f"{title_of(header)}  [{done}/{len(judged)}]\n")
    print("\n".join(list_of(judged)) + "\n")
    if warnings:
        print(warnings + "\n")
    first = next((one for one in judged if one.state in ("wrong", "open")), None)
    remember(stage, first)
    if first:
        print("\n".join(explain(first)))
        return False
    outcome = run_suite(stage)
    if not outcome.passed:
        late = late_failure(stage, judged, outcome)
        remember(stage, late)
        print(f"Each exercise passes its own tests, but {late.number} fails in the whole stage:\n")
        print("\n".join(explain(late)))
        return False
    print(report.summary(outcome))
    print(f"Stage {stage} is done. `make` renders its picture.")
    return True


def remember(stage, first):
    NOTES.mkdir(parents=True, exist_ok=True)
    (NOTES / f"stage{stage}.json").write_text(json.dumps(first.number if first else None))


def hint(stage):
    """Prints the next hint for the exercise that the last check explained."""
    tasks = read_tasks(header_of(stage))
    note = NOTES / f"stage{stage}.json"
    number = json.loads(note.read_text(encoding="utf-8")) if note.exists() else next(iter(tasks), None)
    if number not in tasks:
        print("All exercises are done: there are no more hints.")
        return
    shown = NOTES / f"hints{number}"
    count = min(int(shown.read_text(encoding="utf-8")) + 1 if shown.exists() else 1, len(tasks[number]["hints"]))
    shown.parent.mkdir(parents=True, exist_ok=True)
    shown.write_text(str(count))
    print(f"{number} {plain(tasks[number]['task'])}\n")
    for place, text in enumerate(tasks[number]["hints"][:count], 1):
        print(wrapped(plain(f"{place}. {text}")) + "\n")
    left = len(tasks[number]["hints"]) - count
    print(f"{left} more: `make hint`" if left else "That was the last one.")


def check_at_each_save(stage):
    """Checks whenever the header is saved, until Ctrl-C."""
    header = header_of(stage)
    seen = None
    try:
        while True:
            try:
                now = header.stat().st_mtime_ns
            except FileNotFoundError:  # an editor is saving
                now = seen
            if now != seen:
                seen = now
                print("\033[2J\033[H" if sys.stdout.isatty() else "", end="", flush=True)
                check(stage)
                picture(stage)
                print(f"\nWaiting for {header.relative_to(ROOT)} to be saved; Ctrl-C ends.", flush=True)
            time.sleep(0.3)
    except KeyboardInterrupt:
        print()


def picture(stage):
    """Renders a small picture with the stage so far."""
    goldens = tomllib.loads((ROOT / "tests/golden/goldens.toml").read_text(encoding="utf-8"))["golden"]
    scene = next((one["scene"] for one in goldens if one["stage"] == stage), None)
    if not scene or not build(f"stage{stage}")[1]:
        return
    target = BUILD / "pictures" / f"stage{stage}.png"
    target.parent.mkdir(exist_ok=True)
    options = ["-o", target, "--size", "128x128", "--spp", "16", "--quiet"]
    command = [BUILD / f"stage{stage}", ROOT / f"scenes/{scene}.toml", *options]
    quiet = {name: subprocess.DEVNULL for name in ("stdin", "stdout", "stderr")}
    with contextlib.suppress(watch.Endless), subprocess.Popen(command, **quiet) as process:
        watch.communicate(process)
        if process.returncode == 0:
            print(f"\nYour picture so far: {target}")


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """Says it in one line, without the usage."""
        self.exit(2, f"check: {message}\n")


def main():
    parser = Parser(description=__doc__.splitlines()[0])
    parser.add_argument("stage", nargs="?")
    parser.add_argument("--watch", action="store_true", help="check whenever the header is saved")
    parser.add_argument("--hint", action="store_true", help="the next hint for the exercise that is not done")
    options = parser.parse_args()
    stage = default_stage() if options.stage is None else options.stage
    if isinstance(stage, str):
        stage = int(stage) if stage.isdecimal() else repr(stage)
    try:
        header_of(stage)
    except Failure as error:
        parser.error(error)
    if options.hint:
        return hint(stage)
    if options.watch:
        return check_at_each_save(stage)
    return 0 if check(stage) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as error:
        sys.exit(f"check: {error}")
