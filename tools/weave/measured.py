"""What `make measured` has stored, for pages, slides and drawings: no sentence has a
number of its own.

In a page or a slide `{more variance of uniform or cosine}` becomes how many times as
much of a column the first estimator has as the second.
"""

import re

from tools.tree import ROOT, Failure

FOLDER = ROOT / "tools/bench/measured"
RATIO = re.compile(r"\{more (variance|time) of (.+?)\}")


def rows(name):
    """The rows of a table: dictionaries by the heads of its columns."""
    path = FOLDER / name
    if not path.exists():
        raise Failure(f"tools/bench/measured/{name} is not there: `make measured` writes it")
    lines = [line for line in path.read_text().split("\n") if line.startswith("|")]
    head, _, *body = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    # Of two columns of one name the first counts.
    return [dict(reversed(list(zip(head, cells)))) for cells in body]


def pairs():
    """The rows of efficiency.md, two by two: {question: (first, second)}."""
    found = {}
    for row in rows("efficiency.md"):
        found.setdefault(row["question"], []).append(row)
    return found


def two_digits(x):
    return f"{x:.0f}" if x >= 10 else f"{x:.2g}"


def with_ratios(text, where):
    """The text with its ratios worked out."""
    column = {"variance": "variance of a sample", "time": "µs per sample"}

    def ratio(match):
        if match[2] not in pairs():
            raise Failure(f"{where}: efficiency.md has no question '{match[2]}'")
        first, second = (float(row[column[match[1]]]) for row in pairs()[match[2]])
        return two_digits(first / second)

    return RATIO.sub(ratio, text)
