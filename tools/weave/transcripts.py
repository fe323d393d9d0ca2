"""Runs commands in the prose, and compares their output with the prose.

An indented block of prose that begins with `$ build/...` is a transcript:

    $ build/stage3 scenes/cornell_box_point.toml --pixel 170,200
    ...
    vertex 0: sphere[1] of 'glass', bounce 0
      kt         (     0.9, ...

A line `...` stands for any lines, and `...` at the end of a line for its rest.
Spaces and empty lines do not count. A number with a decimal point or an exponent
agrees if the program's number, rounded to the digits shown, is the same; a whole
number has to be the same. A command continues on a line that begins with `> `,
as in a shell; comments of C++ must not end with a `\\`, so the book adds it.
"""

import difflib
import re
import shlex
import subprocess
import tempfile
from dataclasses import dataclass, field
from decimal import Decimal
from pathlib import Path

from tools.tree import BUILD, ROOT, Failure
from tools.weave.literate import pieces

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?!\w)")
INDENT = "    "


@dataclass
class Transcript:
    """`lines` are those of the prose; `line` is the number of the first."""

    path: Path
    line: int
    lines: list = field(default_factory=list)

    def shown(self):
        """The transcript in MyST."""
        lines = [line[len(INDENT) :] for line in self.lines]
        for place, line in enumerate(lines):
            if line.startswith("> "):
                lines[place - 1] += " \\"
        return ["```console", *lines, "```", ""]

    def steps(self):
        """Each command with its line number and the (number, line) that it should
        print."""
        found = []
        for number, line in enumerate(self.lines, self.line):
            line = line[len(INDENT) :].rstrip()
            if line.startswith("$ "):
                found.append([line[2:], number, []])
            elif line.startswith("> ") and not found[-1][2]:
                found[-1][0] += line[1:]
            elif line:
                found[-1][2].append((number, line.strip()))
        return found


def transcripts_of(piece, path):
    """The transcripts of a piece of prose."""
    found, now = [], None
    for number, line in zip(piece.numbers, piece.lines):
        if now is None and line.startswith(INDENT + "$ "):
            now = Transcript(path, number)
            found.append(now)
        elif now is not None and line.strip() and not line.startswith(INDENT):
            now = None
        if now is not None:
            now.lines.append(line)
    for one in found:
        while not one.lines[-1].strip():
            one.lines.pop()
    return found


def output(command, where):
    """The lines that a command of build/ prints; it runs in a temporary folder
    that has the scenes."""
    words = shlex.split(command)
    name = re.fullmatch(r"build/([\w-]+)", words[0])
    if not name:
        raise Failure(f"{where}: '{words[0]}' is no program of build/")
    if not (BUILD / name[1]).is_file():
        raise Failure(f"{where}: {words[0]} has not been built")
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "scenes").symlink_to(ROOT / "scenes")
        done = subprocess.run(
            [BUILD / name[1], *words[1:]],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
    said = [line for line in done.stdout.splitlines() if line.strip()]
    if done.returncode:
        raise Failure(f"{where}: {command.strip()}: {(said or ['failed'])[-1]}")
    return said


def same_number(shown, said):
    if not re.search(r"[.eE]", shown):
        return shown == said
    step = Decimal(1).scaleb(Decimal(shown).as_tuple().exponent)
    return abs(Decimal(shown) - Decimal(said)) <= step / 2


def same_line(shown, said):
    """Whether the program's line agrees with the one in the prose."""
    shown, said = " ".join(shown.split()), " ".join(said.split())
    words, numbers = NUMBER.split(shown), NUMBER.findall(shown)
    whole = not shown.endswith("...")
    words[-1] = words[-1].removesuffix("...").rstrip()
    told, values = NUMBER.split(said), NUMBER.findall(said)
    if whole:
        alike = squeezed(words) == squeezed(told)
    else:
        told, values = told[: len(words)], values[: len(numbers)]
        alike = len(told) == len(words) and squeezed(words[:-1]) == squeezed(told[:-1])
        alike = alike and squeezed(told)[-1].startswith(squeezed(words)[-1])
    return alike and all(map(same_number, numbers, values))


def squeezed(words):
    """Without spaces, which only align numbers."""
    return [re.sub(r"\s", "", word) for word in words]


def find(part, said, first, anywhere):
    """The end of the lines of `part` in the output, from `first` on; or if they are
    not there, the first wrong line at the place where most of them agree."""
    best = ((-1,),)
    for start in range(first, len(said) + 1) if anywhere else [first]:
        for place, (number, line) in enumerate(part):
            there = said[start + place] if start + place < len(said) else "nothing more"
            if not same_line(line, there):
                likeness = difflib.SequenceMatcher(None, line, there.strip()).ratio()
                best = max(best, ((place, likeness), number, there, line), key=lambda x: x[0])
                break
        else:
            return start + len(part), None
    return None, best[1:]


def check(transcript):
    name = transcript.path.relative_to(ROOT)
    for command, at, lines in transcript.steps():
        said = output(command, f"{name}:{at}")
        parts = [[]]
        for number, line in lines:
            if line == "...":
                parts.append([])
            else:
                parts[-1].append((number, line))
        place = 0
        for index, part in enumerate(parts):
            if not part:
                continue
            place, wrong = find(part, said, place, index > 0)
            if wrong:
                number, there, line = wrong
                raise Failure(
                    f"{name}:{number} says '{' '.join(line.split())}', "
                    f"the program says '{' '.join(there.split())}'"
                )
        if parts[-1] and place < len(said):
            raise Failure(
                f"{name}:{lines[-1][0]} ends there, the program says more: '{' '.join(said[place].split())}'"
            )


def check_transcripts(header):
    for piece in pieces(header):
        if piece.kind == "prose":
            for one in transcripts_of(piece, header):
                check(one)
