"""Reads the marks of exercises in a stage's header.

    // #region exercise 3.1: mirror direction
    // #stub return normal;
    return (what a solution returns);
    // #endregion

The body is the solution; the stub, one line or several, replaces it while the
exercise is open. Marks are within a region, with any indent.

In a handout a call of `open_exercise` comes before the stub. The student who
solves the exercise deletes it.

    python3 -m tools.exercises.marks    lists them
"""

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

from tools.tree import Failure, stage_headers, text_of

LONGEST = 20
REGION = re.compile(r"// #(end)?region ([\w-]+)$")
OPENS = re.compile(r"// #region exercise (\d+)\.(\d+): (\S.*)$")
CLOSES = "// #endregion"
OPEN_CALL = re.compile(r"^\s*open_exercise\(")
STUB = re.compile(r"// #stub (\S.*)$")


@dataclass
class Exercise:
    """`first` and `last` are the lines of the body, `start` and `end` those of
    its marks; `body` has the header's indent, `stub` none."""

    number: str
    title: str
    path: Path
    region: str
    start: int
    first: int = 0
    last: int = 0
    end: int = 0
    body: list = field(default_factory=list)
    stub: list = field(default_factory=list)

    @property
    def where(self):
        return f"{place_in_tree(self.path)}:{self.start}"

    @property
    def is_open(self):
        return any(OPEN_CALL.search(line) for line in self.body)

    @property
    def anchor(self):
        return "exercise-" + self.number.replace(".", "-")


def place_in_tree(path):
    """stages/3_.../path_tracer.hpp, in whatever tree it is."""
    return "/".join(path.parts[-3:])


def order(number):
    """3.10 comes after 3.9."""
    return tuple(map(int, number.split(".")))


def opened(line, where, path, region, exercises):
    """The exercise that this mark opens."""
    mark = OPENS.match(line)
    if not mark:
        raise Failure(f"{where}: a mark is '// #region exercise 3.1: title'")
    stage, place, title = mark.groups()
    number = f"{stage}.{place}"
    chapter = path.parent.name[0] if path.parent.parent.name == "stages" else None
    if stage != chapter:
        raise Failure(f"{where}: exercise {number} does not belong to this header")
    if region is None:
        raise Failure(f"{where}: exercise {number} stands in no region")
    for other in exercises:
        if other.number == number:
            raise Failure(f"{where}: exercise {number} again, after line {other.start}")
    if int(place) != len(exercises) + 1:
        raise Failure(f"{where}: exercise {number}, but {stage}.{len(exercises) + 1} comes next")
    return Exercise(number, title, path, region, 0)


def check_solved(exercise):
    """Refuses an exercise without stub or body, or with too long a body."""
    if not exercise.stub:
        raise Failure(f"{exercise.where}: exercise {exercise.number} has no '// #stub' after its mark")
    if not any(line.strip() for line in exercise.body):
        raise Failure(f"{exercise.where}: exercise {exercise.number} has no body")
    if len(exercise.body) > LONGEST:
        raise Failure(
            f"{exercise.where}: exercise {exercise.number} has {len(exercise.body)} lines, "
            f"and at most {LONGEST} are an exercise"
        )


def exercises(path):
    """The header's exercises, in its order, each with a solution and a stub."""
    found = marks(path)
    for one in found:
        check_solved(one)
    return found


def marks(path):
    """The header's exercises in any state."""
    found, region, now = [], None, None
    for number, line in enumerate(text_of(path).splitlines(), 1):
        bare = line.strip()
        where = f"{place_in_tree(path)}:{number}"
        marker = REGION.match(bare)
        if bare.startswith("// #region exercise"):
            if now:
                raise Failure(f"{where}: an exercise within exercise {now.number}")
            now = opened(bare, where, path, region, found)
            now.start = number
        elif bare == CLOSES:
            if not now:
                raise Failure(f"{where}: '{CLOSES}' ends no exercise")
            now.first, now.last, now.end = number - len(now.body), number - 1, number
            found.append(now)
            now = None
        elif bare.startswith("// #stub"):
            stub = STUB.match(bare)
            if not now or now.body or not stub:
                raise Failure(f"{where}: '// #stub statement' follows the mark of an exercise")
            now.stub.append(stub[1])
        elif marker and now:
            raise Failure(f"{now.where}: exercise {now.number} is not ended by '{CLOSES}'")
        elif marker:
            region = None if marker[1] else marker[2]
        elif now:
            now.body.append(line)
    if now:
        raise Failure(f"{now.where}: exercise {now.number} is not ended by '{CLOSES}'")
    return found


def hidden(found):
    """The numbers of the lines that readers do not see: marks and stubs."""
    return {n for one in found for n in (*range(one.start, one.first), one.end)}


def main():
    for header in stage_headers():
        for one in exercises(header):
            print(f"{one.number}  {one.title}  {place_in_tree(one.path)}:{one.first}-{one.last}")


if __name__ == "__main__":
    try:
        main()
    except Failure as error:
        sys.exit(f"exercises: {error}")
