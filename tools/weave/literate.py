"""Reads a literate header: prose, code, and the regions that name code."""

import difflib
import re
from dataclasses import dataclass, field

from tools.exercises.marks import REGION, exercises, hidden
from tools.tree import ROOT, Failure, stage_headers

WIDEST = 78
CLOSING = re.compile(r"^(#pragma once|\}  // namespace [\w:]+|)$")


@dataclass
class Piece:
    """Consecutive lines of one kind, and their numbers in the header. Marks of
    exercises are left out; `exercises` are those whose body is in the piece."""

    kind: str  # "prose" or "code"
    region: str | None = None
    lines: list = field(default_factory=list)
    numbers: list = field(default_factory=list)
    exercises: list = field(default_factory=list)

    @property
    def line(self):
        return self.numbers[0]

    def add(self, number, line):
        self.numbers.append(number)
        self.lines.append(line)

    def exercise_at(self, number):
        """The exercise whose body has this line of the header, or None."""
        return next((one for one in self.exercises if one.first <= number <= one.last), None)


def pieces(path):
    """The header's prose and code in order; each region is a piece by itself."""
    found, region = [], None
    marked = exercises(path)
    unseen = hidden(marked)
    for number, line in enumerate(path.read_text().splitlines(), 1):
        where = f"{path.relative_to(ROOT)}:{number}"
        if len(line) > WIDEST:
            raise Failure(f"{where}: over {WIDEST} columns")
        if number in unseen:
            continue
        marker = REGION.match(line)
        if marker:
            end, name = marker.groups()
            if end and name != region:
                raise Failure(f"{where}: ends region {name}, not {region}")
            if not end and region:
                raise Failure(f"{where}: region {name} within {region}")
            region = None if end else name
            found.append(Piece("code", region))
            continue
        prose = region is None and re.match(r"//( |$)", line)
        kind = "prose" if prose else "code"
        if not found or found[-1].kind != kind:
            found.append(Piece(kind, region))
        found[-1].add(number, line[3:] if prose else line)
    if region:
        raise Failure(f"{path.relative_to(ROOT)}: region {region} not ended")
    return with_exercises([piece for piece in map(trimmed, found) if piece.lines], marked)


def with_exercises(found, marked):
    for piece in found:
        piece.exercises = [one for one in marked if one.first in piece.numbers]
    return found


def trimmed(piece):
    """Without empty lines at the ends, and without lines that only open or close."""
    for end in (-1, 0):
        while piece.lines and CLOSING.match(piece.lines[end]):
            piece.lines.pop(end)
            piece.numbers.pop(end)
    return piece


def regions(path):
    """The header's regions by name; those inside a class have its indent."""
    found, name = {}, None
    marked = exercises(path)
    unseen = hidden(marked)
    for number, line in enumerate(path.read_text().splitlines(), 1):
        marker = REGION.match(line.strip())
        if number in unseen:
            continue
        if marker and not marker.group(1):
            name = marker.group(2)
            if name in found:
                raise Failure(f"{path}:{number}: region {name} twice")
            found[name] = Piece("code", name)
        elif marker:
            name = None
        elif name:
            found[name].add(number, line)
    with_exercises(found.values(), marked)
    return found


def region(reference):
    """The code of the reference `path/to/header.hpp#name`."""
    path, _, name = reference.partition("#")
    header = ROOT / path
    if not header.is_file():
        raise Failure(f"{reference}: there is no such header")
    known = regions(header)
    if name not in known:
        raise Failure(f"{reference}: no such region; {path} has " + ", ".join(known))
    return known[name]


def earlier_version(path, name):
    """The region of that name in the nearest earlier stage, with its path."""
    for other in reversed([p for p in stage_headers() if p < path]):
        if path.parent.parent.name == "stages" and name in regions(other):
            return other, regions(other)[name].lines
    return None, None


def changed_lines(old, new):
    blocks = difflib.SequenceMatcher(None, old, new, False).get_opcodes()
    return [
        n + 1
        for tag, _, _, first, last in blocks
        if tag != "equal"
        for n in range(first, last)
        if new[n].strip()
    ]
