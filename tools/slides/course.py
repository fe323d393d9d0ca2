"""Reads slides/course.toml: the facts on the slide "Before we begin"."""

import tomllib

from tools.tree import ROOT, Failure

FILE = "slides/course.toml"
OPEN = "fill in slides/course.toml"
MOST, LONGEST = 7, 64


def facts():
    """Pairs of what and when, where or how much; empty values are left out."""
    try:
        read = tomllib.loads((ROOT / FILE).read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise Failure(f"{FILE}: {error}") from None
    if list(read) != ["before_we_begin"]:
        raise Failure(f"{FILE}: has one table, [before_we_begin]")
    found = []
    for what, value in read["before_we_begin"].items():
        if not isinstance(value, str):
            raise Failure(f'{FILE}: "{what}" is a text in quotes')
        if len(what) + len(value) > LONGEST:
            raise Failure(f'{FILE}: "{what}" and its value have more than {LONGEST} letters')
        if value.strip():
            found.append((what, value.strip()))
    if not 0 < len(found) <= MOST:
        raise Failure(f"{FILE}: {len(found)} lines have a value; a slide has 1 to {MOST}")
    return found


def unfilled():
    return [what for what, value in facts() if value == OPEN]


def course_table():
    """The lines as Markdown."""
    rows = [f"| **{what}** | {value.replace('|', chr(92) + '|')} |" for what, value in facts()]
    return "\n".join(["| | |", "|---|---|", *rows])
