"""Reports which exercises of a stage are done, and what is wrong with the first
that is not: `make check`.

    python3 -m tools.exercises.check [STAGE] [--watch | --hint | --json | --markdown]

The first exercise that is open or wrong is explained, and no other. Exit code 0
if the stage is done, 1 if not.
"""

import argparse
import contextlib
import json
import re
import signal
import sys
import textwrap

from tests.runner import report
from tools.exercises import compiler, screen
from tools.exercises.configure import configure
from tools.exercises.judge import as_json, as_markdown, judge
from tools.exercises.marks import marks
from tools.exercises.sheet import headers_with_exercises, read_tasks, title_of
from tools.exercises.words import plain
from tools.tree import BUILD, HANDOUT_NOTE, ROOT, Failure, sum_of, text_of

NOTES = BUILD / "check"
HANDED_OUT = ROOT / HANDOUT_NOTE
# What a student has no reason to change.
GIVEN = ("common/", "compare/", "cmake/", "tests/", "tools/", "third_party/")


def default_stage():
    """A handout's stage, else the newest that has exercises."""
    if HANDED_OUT.exists():
        return handed_out().get("stage", 1)
    return int(headers_with_exercises()[-1].parent.name[0])


def handed_out():
    """What a handout says of itself; nothing where the note is damaged."""
    try:
        return json.loads(HANDED_OUT.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def header_of(stage):
    for header in headers_with_exercises():
        if header.parent.name.startswith(f"{stage}_"):
            return header
    known = ", ".join(header.parent.name[0] for header in headers_with_exercises())
    raise Failure(f"stage {stage} has no exercises in this tree; stages {known} have")


def changed_files():
    """Files of the course that are not as they were handed out."""
    for path, total in handed_out().get("files", {}).items():
        if not path.startswith(GIVEN):
            continue
        try:
            data = (ROOT / path).read_bytes()
        except OSError:
            yield f"{path} is missing"
            continue
        if sum_of(data) != total:
            yield f"{path} is not as it was handed out"


def tell_changed_files():
    changed = list(changed_files())
    for line in changed[:3]:
        print(line)
    if changed[3:]:
        print(f"and {len(changed) - 3} more")
    if changed:
        name = changed[0].split(" is ")[0]
        print(f"`git checkout HEAD -- {name}` brings it back.\n")


def kept_warnings(stage, said, header):
    """The compiler's warnings about the header: it says them only when it compiles."""
    note = NOTES / f"warnings{stage}.txt"
    name = header.relative_to(ROOT).as_posix()
    if f"stage{stage}_header.dir" in said:
        NOTES.mkdir(parents=True, exist_ok=True)
        note.write_text(compiler.warnings(said, name, marks(header)), encoding="utf-8")
    text = note.read_text(encoding="utf-8") if note.exists() else ""
    return "\n".join(filter(None, [*integer_divisions(header), text]))


def integer_divisions(header):
    """1 / 2 is 0, and no compiler warns of it."""
    lines = text_of(header).splitlines()
    for one in marks(header):
        for number in range(one.first, one.last + 1):
            code = lines[number - 1].split("//")[0]
            found = re.search(r"(?<![\w.])(\d+) ?/ ?(\d+)(?![\w.])", code)
            if found and not one.is_open and int(found[2]) and int(found[1]) % int(found[2]):
                whole = int(found[1]) // int(found[2])
                where = f"{header.relative_to(ROOT).as_posix()}:{number}"
                yield f"{where}: {found[0]} is a division of integers: {whole}. Write {found[1]}.0f / {found[2]}."


def to_be_read(header):
    """What the grader will ask a person to read."""
    remark = screen.remark(text_of(header))
    return remark and f"note: {remark}\nNo exercise needs that, so it will be read before it is graded."


def built(stage, header):
    """Compiles the stage and its tests; returns what to say of the header, or None
    where they do not compile and all has been said."""
    if not any(BUILD.glob(f"stage{stage}_tests*")):
        print("The tests are compiled for the first time: half a minute or more.\n", flush=True)
    said, made = compiler.build(f"stage{stage}_tests")
    if made:
        return kept_warnings(stage, said, header)
    alone, made = compiler.build(f"stage{stage}_header")
    if made:
        print("The tests do not compile with this stage: has a name or a type changed?\n")
        print(compiler.first_error(said))
    else:
        print("The stage does not compile yet. The first error:\n")
        print(compiler.first_error(alone))
    return None


def list_of(verdict):
    for one in verdict.exercises:
        state = ("not run: " if one.state == "waits" else "") + verdict.state_of(one)
        yield f"  {one.number:5}{one.title:44}{state}"


def wrapped(text, indent="  "):
    """Paragraphs; a line that begins with "- " is one of its own."""
    parts = re.split(r"\n(?=\s*- )", text.strip())
    return "\n".join(
        textwrap.fill(" ".join(part.split()), report.WIDTH, initial_indent=indent, subsequent_indent=indent)
        for part in parts
    )


def explain(one, watched):
    """The first exercise that is not done, and what to do."""
    yield f"{one.number} {one.title}, {one.where}".lstrip()
    yield ""
    if one.state == "open":
        yield wrapped(plain(one.task["task"]))
        step = "Write it there, and delete the line that calls open_exercise."
        if has_code(one):
            step = "There is code behind the line that calls open_exercise: delete that line."
    else:
        yield one.says
        step = "Fix it and save." if watched else "Fix it and run `make check` again."
    yield ""
    yield step
    yield "`make hint` gives a hint." + ("" if watched else " `make watch` checks at each save.")


def has_code(one):
    """Whether an open exercise has more in it than its stub."""
    header = ROOT / one.where.rpartition(":")[0]
    mark = next(mark for mark in marks(header) if mark.number == one.number)
    return sum(bool(line.strip()) and not line.strip().startswith("//") for line in mark.body) > 3


def check(stage, watched=False):
    """Prints a screenful; returns the verdict, or None where nothing compiles."""
    header = header_of(stage)
    configure()
    tell_changed_files()
    warnings = built(stage, header)
    if warnings is None:
        return None
    verdict = judge(stage, header)
    points = f"{verdict.points} of {verdict.out_of} points"
    print(f"{title_of(header)}  [{len(verdict.done)}/{len(verdict.exercises)}, {points}]\n")
    print("\n".join(list_of(verdict)) + "\n")
    if warnings:
        print(warnings + "\n")
    if remark := to_be_read(header):
        print(remark + "\n")
    remember(stage, verdict.first)
    if verdict.late:
        print("Each exercise passes its own tests, but the whole stage does not:\n")
    if verdict.first:
        print("\n".join(explain(verdict.first, watched)))
    else:
        for note in verdict.notes:
            print(report.wrapped(f"note: {note}", "", 2), end="")
        print(f"Stage {stage} is done. `make` renders its picture.")
    return verdict


def check_for_programs(stage, form):
    """The same as one document, of JSON or Markdown."""
    header = header_of(stage)
    title = title_of(header)
    with contextlib.redirect_stdout(sys.stderr):
        configure()
    said, made = compiler.build(f"stage{stage}_tests")
    verdict = judge(stage, header) if made else None
    print(form(stage, title, verdict, "" if made else compiler.first_error(said)))
    return 0 if verdict and verdict.passed else 1


def remember(stage, first):
    NOTES.mkdir(parents=True, exist_ok=True)
    (NOTES / f"stage{stage}.json").write_text(json.dumps(first.number if first else None), encoding="utf-8")


def hint(stage):
    """Prints the next hint for the exercise that the last check explained."""
    tasks = read_tasks(header_of(stage))
    note = NOTES / f"stage{stage}.json"
    number = json.loads(note.read_text(encoding="utf-8")) if note.exists() else next(iter(tasks), None)
    if number not in tasks:
        print("All exercises are done: there are no more hints.")
        return
    hints = tasks[number]["hints"]
    shown = NOTES / f"hints{number}"
    count = min(int(shown.read_text(encoding="utf-8")) + 1 if shown.exists() else 1, len(hints))
    shown.parent.mkdir(parents=True, exist_ok=True)
    shown.write_text(str(count), encoding="utf-8")
    print(f"{number}\n{wrapped(plain(tasks[number]['task']))}\n")
    for place, text in enumerate(hints[:count], 1):
        print(wrapped(plain(f"{place}. {text}")) + "\n")
    left = len(hints) - count
    print(f"{left} more: `make hint`" if left else "That was the last hint.")


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """Says it in one line, without the usage."""
        self.exit(2, f"{self.prog}: {message}\n")


def main():
    parser = Parser(prog="check", description=__doc__.splitlines()[0])
    parser.add_argument("stage", nargs="?")
    parser.add_argument("--watch", action="store_true", help="check at each save")
    parser.add_argument("--hint", action="store_true", help="the next hint for the exercise that is not done")
    parser.add_argument("--json", action="store_true", help="the verdict for programs")
    parser.add_argument("--markdown", action="store_true", help="the verdict as a table")
    parser.add_argument("--watched", action="store_true", help=argparse.SUPPRESS)  # by --watch
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
    if options.json or options.markdown:
        return check_for_programs(stage, as_json if options.json else as_markdown)
    if options.watch:
        from tools.exercises.at_each_save import watch

        return watch(stage)
    verdict = check(stage, options.watched)
    return 0 if verdict and verdict.passed else 1


if __name__ == "__main__":
    # Leaves as at an error, so that what it has started ends, too.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    for stream in (sys.stdout, sys.stderr):
        # A terminal that has no π shows a question mark.
        stream.reconfigure(errors="replace")
    try:
        sys.exit(main())
    except Failure as error:
        sys.exit(f"check: {error}")
    except UnicodeDecodeError as error:
        sys.exit(f"check: a file is not UTF-8: {error}")
    except (KeyboardInterrupt, BrokenPipeError):
        sys.stderr.close()
        sys.exit(130)
