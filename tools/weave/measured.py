"""What `make measured` has stored, for pages, slides and drawings: no sentence has a
number of its own.

In a slide `{more variance of uniform or cosine}` becomes how many times as much the
first estimator has as the second.
"""

import re

from tools.tree import ROOT, Failure

FOLDER = ROOT / "tools/bench/measured"
RATIO = re.compile(r"\{more variance of (.+?)\}")


def stored(name):
    """The text of a stored file."""
    path = FOLDER / name
    if not path.exists():
        raise Failure(f"tools/bench/measured/{name} is not there: `make measured` writes it")
    return path.read_text()


def table(text):
    """The lines of the table in a text."""
    return [line for line in text.split("\n") if line.startswith("|")]


def rows(name):
    """The rows of a stored table: dictionaries by the heads of its columns."""
    lines = table(stored(name))
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

    def ratio(match):
        known = pairs()
        if match[1] not in known:
            raise Failure(f"{where}: efficiency.md has no question '{match[1]}'")
        first, second = (float(row["variance of a sample"]) for row in known[match[1]])
        return two_digits(first / second)

    return RATIO.sub(ratio, text)
