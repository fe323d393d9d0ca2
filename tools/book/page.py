"""Weaves a literate header into a MyST page: prose left, code right."""

import difflib
import re

from compare.stages import ROOT
from tools.weave.literate import changed_lines, earlier_version, pieces

HEADING = re.compile(r"^(#+) (.*)")


def slug(path, name):
    chapter = path.parent if path.parent.parent.name == "stages" else path
    return chapter.stem.replace("_", "-") + f"-{name}"


def fenced(name, argument, body, options=(), depth=3, mark=":"):
    fence = mark * depth
    head = [f"{fence}{{{name}}} {argument}".rstrip()]
    head += [f":{option}" for option in options]
    return head + ([""] if mark == ":" else []) + body + [fence, ""]


def mark(path, piece):
    """What to say of a region beside the stage before: badge, lines, diff."""
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
    name = path.relative_to(ROOT)
    options = [f"lineno-start: {piece.line}"]
    box = []
    if piece.region:
        badge, lines, box = mark(path, piece)
        title = f"{name}, **{piece.region}** {badge}".rstrip()
        options.append(f"name: {slug(path, piece.region)}")
        if lines:
            options.append("emphasize-lines: " + ",".join(map(str, lines)))
    else:
        title = f"{name}"
    options.insert(1, f"caption: {title}")
    return fenced("code-block", "cpp", piece.lines, options, 3, "`") + box


def rows(path):
    """(heading, prose, code pieces) in the header's order."""
    found = []
    for piece in pieces(path):
        if piece.kind == "code":
            if not found:
                found.append(["", [], []])
            found[-1][2].append(piece)
            continue
        found.append(["", [], []])
        for line in piece.lines:
            heading = HEADING.match(line)
            if heading:
                found.append([line, [], []])
            else:
                found[-1][1].append(line)
    return [row for row in found if row[0] or row[2] or any(row[1])]


def weave(path, figures=None):
    """The page. `figures` maps a region, or a section's title, to MyST lines;
    those that stand beside prose or after a row are taken out of it."""
    figures = figures if figures is not None else {}
    page = []
    for heading, prose, code in rows(path):
        title = HEADING.match(heading).group(2) if heading else None
        if heading:
            page += [heading, ""]
        right = [line for piece in code for line in code_block(path, piece)]
        beside = figures.pop(title, [])
        body = []
        if any(line.strip() for line in prose):
            body += fenced("container", "prose", prose, depth=6)
        if right or beside:
            body += fenced("container", "code", right + beside, depth=6)
        kind = "row" + ("" if right or beside else " alone")
        if right and not any(line.strip() for line in prose):
            kind += " bare"
        if body:
            page += fenced("container", kind, body, depth=7)
        for piece in code:
            page += figures.pop(piece.region, [])
    return page
