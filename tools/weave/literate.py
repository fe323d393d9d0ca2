"""Reads a literate header: prose, code, and the regions that name code."""

import difflib
import re
from dataclasses import dataclass, field

from compare.stages import ROOT, Failure, stage_headers

WIDEST = 78
MARKER = re.compile(r"// #(end)?region ([\w-]+)$")
CLOSING = re.compile(r"^(#pragma once|\}  // namespace [\w:]+|)$")


@dataclass
class Piece:
    """A run of lines of one kind. `line` is the first one's number."""

    kind: str  # "prose" or "code"
    line: int
    lines: list = field(default_factory=list)
    region: str | None = None


def pieces(path):
    """The header's prose and code in order, each region a piece by itself."""
    found, region = [], None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        where = f"{path.relative_to(ROOT)}:{number}"
        if len(line) > WIDEST:
            raise Failure(f"{where}: over {WIDEST} columns")
        marker = MARKER.match(line)
        if marker:
            end, name = marker.groups()
            if end and name != region:
                raise Failure(f"{where}: ends region {name}, not {region}")
            if not end and region:
                raise Failure(f"{where}: region {name} within {region}")
            region = None if end else name
            found.append(Piece("code", number + 1, region=region))
            continue
        prose = region is None and re.match(r"//( |$)", line)
        kind = "prose" if prose else "code"
        if not found or found[-1].kind != kind:
            found.append(Piece(kind, number, region=region))
        found[-1].lines.append(line[3:] if prose else line)
    if region:
        raise Failure(f"{path.relative_to(ROOT)}: region {region} not ended")
    return [piece for piece in map(trimmed, found) if piece.lines]


def trimmed(piece):
    """Without empty lines at the ends, nor lines that only open or close."""
    while piece.lines and CLOSING.match(piece.lines[-1]):
        piece.lines.pop()
    while piece.lines and CLOSING.match(piece.lines[0]):
        piece.lines.pop(0)
        piece.line += 1
    return piece


def regions(path):
    """The header's regions by name; those inside a class have its indent."""
    found, name = {}, None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        marker = MARKER.match(line.strip())
        if marker and not marker.group(1):
            name = marker.group(2)
            if name in found:
                raise Failure(f"{path}:{number}: region {name} twice")
            found[name] = Piece("code", number + 1, region=name)
        elif marker:
            name = None
        elif name:
            found[name].lines.append(line)
    return found


def region(reference):
    """The code that `path/to/header.hpp#name` stands for."""
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
