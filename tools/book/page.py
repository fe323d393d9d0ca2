"""Weaves a literate header into a MyST page: prose left, code right."""

import difflib
import itertools
import re
from dataclasses import dataclass, field

from tools.tree import ROOT
from tools.weave.figures import figure_reference
from tools.weave.literate import changed_lines, earlier_version, pieces
from tools.weave.transcripts import transcripts_of

HEADING = re.compile(r"^(#+) (.*)")


def page_of(header):
    """The page that is woven from a header, without its ending."""
    if header.is_relative_to(ROOT / "stages"):
        chapter = header.parent if header.name == "path_tracer.hpp" else header.with_suffix("")
        return chapter.relative_to(ROOT).as_posix()
    return "core/" + header.relative_to(ROOT / "common").with_suffix("").as_posix()


def slug(path, name):
    chapter = path.parent if path.parent.parent.name == "stages" else path
    return chapter.stem.replace("_", "-") + f"-{name}"


def fenced(name, argument, body, options=(), depth=3, mark=":"):
    fence = mark * depth
    head = [f"{fence}{{{name}}} {argument}".rstrip()]
    head += [f":{option}" for option in options]
    return head + ([""] if mark == ":" else []) + body + [fence, ""]


def mark(path, piece):
    """A region compared with the previous stage: badge, lines, diff."""
    if path.parent.parent.name != "stages" or path.parent.name[0] == "1":
        return "", [], []
    other, old = earlier_version(path, piece.region)
    if other is None:
        return "{bdg-success}`new in this stage`", [], []
    before = other.parent.name[0]
    if old == piece.lines:
        return f"{{bdg-secondary}}`as in stage {before}`", [], []
    label = f"stage {before}"
    diff = list(difflib.unified_diff(old, piece.lines, lineterm="", n=2))[2:]
    box = fenced(
        "dropdown",
        f"What changed since {label}",
        fenced("code-block", "diff", diff, depth=3, mark="`"),
        depth=5,
    )
    return (f"{{bdg-warning}}`changed since {label}`", changed_lines(old, piece.lines), box)


def code_block(path, piece):
    """The piece's listing: in parts if some of its lines are exercises."""
    name = path.relative_to(ROOT)
    emphasized, box, title = [], [], f"{name}"
    if piece.region:
        badge, emphasized, box = mark(path, piece)
        title = f"{name}, **{piece.region}** {badge}".rstrip()

    def part(places, *options):
        first = places[0]
        lines = [str(n - first) for n in emphasized if n - 1 in places]
        options = [f"lineno-start: {piece.numbers[first]}", *options]
        options += ["emphasize-lines: " + ",".join(lines)] if lines else []
        return fenced("code-block", "cpp", [piece.lines[i] for i in places], options, 3, "`")

    if not piece.exercises:
        options = [f"caption: {title}"]
        options += [f"name: {slug(path, piece.region)}"] if piece.region else []
        return part(range(len(piece.lines)), *options) + box
    body = [f"({slug(path, piece.region)})="] if piece.region else []
    body += fenced("container", "code-block-caption", [title], depth=4)
    for exercise, places in itertools.groupby(
        range(len(piece.lines)), lambda i: piece.exercise_at(piece.numbers[i])
    ):
        lines = part(list(places))
        if exercise:
            link = f"[exercise {exercise.number}](#{exercise.anchor})"
            lines = fenced("container", "exercise-body", [link, "", *lines], depth=4)
        body += lines
    return fenced("container", "listing", body, depth=5) + box


@dataclass
class Row:
    """One row of the page, side by side: prose with its tasks, and figures,
    transcripts and code. Each figure is (name, where it is referred to)."""

    heading: str = ""
    prose: list = field(default_factory=list)
    beside: list = field(default_factory=list)
    code: list = field(default_factory=list)

    def has_prose(self):
        return any(line.strip() for line in self.prose)

    def has_exercises(self):
        return any(piece.exercises for piece in self.code)


def rows(path):
    """The header's rows in its order."""
    found = []
    for piece in pieces(path):
        if piece.kind == "code":
            # A task comes right before its region.
            if not found or (piece.exercises and found[-1].code):
                found.append(Row())
            found[-1].code.append(piece)
            continue
        found.append(Row())
        transcripts = {one.line: one for one in transcripts_of(piece, path)}
        until = 0
        for number, line in zip(piece.numbers, piece.lines):
            where = f"{path.relative_to(ROOT)}:{number}"
            name = figure_reference(line, where)
            if number < until:
                continue
            if name:
                found[-1].beside.append(("figure", name, where))
            elif number in transcripts:
                until = number + len(transcripts[number].lines)
                found[-1].beside.append(("transcript", transcripts[number].shown(), where))
            elif HEADING.match(line):
                found.append(Row(line))
            else:
                if found[-1].beside and line.strip():
                    found.append(Row())
                found[-1].prose.append(line)
    return [row for row in found if row.heading or row.code or row.beside or row.has_prose()]


def task_box(task):
    """An exercise's task, with its hints folded."""
    number, title = task.mark.number, task.mark.title
    facts = [f"{task.minutes} minutes", f"{task.points} point" + "s" * (task.points > 1)]
    facts += ["needs " + ", ".join(f"[{n}](#exercise-{n.replace('.', '-')})" for n in task.needs)] * bool(
        task.needs
    )
    body = [*task.task.strip().split("\n"), "", "*" + "; ".join(facts) + "*", ""]
    for place, hint in enumerate(task.hints, 1):
        body += fenced("dropdown", f"Hint {place}", hint.strip().split("\n"), depth=4)
    checks = ["“" + test + "”" for test in task.tests]
    body += fenced(
        "dropdown",
        "The test that checks it" if len(checks) == 1 else "The tests that check it",
        [
            f"(tests-{number.replace('.', '-')})=",
            "Test cases that begin " + ", ".join(checks) + ":",
            "",
            "```sh",
            *task.command(),
            "```",
        ],
        depth=4,
    )
    options = ["class: exercise", f"name: {task.mark.anchor}"]
    return fenced("admonition", f"Exercise {number}: {title}", body, options, depth=5)


def closing(sheet):
    """The questions, and the recap."""
    page = ["## Questions", ""] if sheet.questions else []
    for place, question in enumerate(sheet.questions, 1):
        body = [f"**{place}.** " + question["ask"].strip(), ""]
        body += fenced("dropdown", "Answer", question["answer"].strip().split("\n"), depth=5)
        page += fenced("container", "question", body, depth=6)
    page += ["## In five lines", ""] if sheet.recap else []
    return page + [f"{place}. {line.strip()}" for place, line in enumerate(sheet.recap, 1)] + [""]


def row_lines(row, path, figures, sheet):
    """A row: wide parts across the page, and the rest side by side."""
    across, right = [], []
    for kind, item, where in row.beside:
        wide = kind == "figure" and figures.is_wide(item, where)
        lines = figures.myst(item, path, where) if kind == "figure" else item
        (across if wide or not row.has_prose() else right).extend(lines)
    prose = list(row.prose)
    for piece in row.code:
        for exercise in piece.exercises:
            prose += ["", *task_box(sheet.tasks[exercise.number])]
    code = [line for piece in row.code for line in code_block(path, piece)]
    page = [row.heading, ""] if row.heading else []
    page += deck_link(path) if row.heading.startswith("# ") else []
    if across and code:  # the figure stands between the two
        head = Row(prose=row.prose)
        page += side_by_side(head.prose if head.has_prose() else [], right) + across
        return page + side_by_side(prose[len(row.prose) :], code)
    return page + side_by_side(prose, right + code) + across


def side_by_side(prose, right):
    """Prose left, the rest right, or the one that is there."""
    words = any(line.strip() for line in prose)
    body = fenced("container", "prose", prose, depth=6) if words else []
    body += fenced("container", "code", right, depth=6) if right else []
    kind = "row" + ("" if right else " alone") + (" bare" if not words else "")
    return fenced("container", kind, body, depth=7) if body else []


def deck_link(path):
    """A link to the chapter's deck, which is built beside the book."""
    name = path.parent.name
    if not (ROOT / f"slides/{name}.md").is_file():
        return []
    return [f'<p class="deck"><a href="../../slides/{name}.html">The slides of this chapter</a></p>', ""]


def weave(path, figures, sheet=None):
    """The page. `figures` makes those that the header refers to, and `sheet`
    has the tasks of its exercises."""
    page = []
    for row in rows(path):
        page += row_lines(row, path, figures, sheet)
    return page + (closing(sheet) if sheet else [])
