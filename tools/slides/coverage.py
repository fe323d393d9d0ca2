"""Checks slides/coverage.toml: every title and formula of the course's slides
has its place in a chapter and in a deck."""

import re
import tomllib

from compare.stages import ROOT, Failure
from tools.slides.deck import decks
from tools.weave.literate import pieces, region

TABLE = ROOT / "slides/coverage.toml"


def normalised(tex):
    """Without what only looks different: spaces, and upright letters."""
    tex = re.sub(r"\\mathbf\{?(\w)\}?", r"\1", tex)
    tex = re.sub(r"\\[,;:! ]|\\q?quad|\\(left|right)(?![a-z])|[\s&]", "", tex)
    return re.sub(r"\\[dt]frac", r"\\frac", tex)


def prose_of(header):
    return "\n".join("\n".join(piece.lines) for piece in pieces(header) if piece.kind == "prose")


def shown_on(title, deck):
    """The slides with this heading."""
    return [slide for slide in deck.slides if slide.heading == title]


def check_entry(entry, by_name):
    title = entry["title"]
    where = f"slides/coverage.toml: '{title}'"
    if entry["deck"] not in by_name:
        raise Failure(f"{where}: there is no deck {entry['deck']}")
    deck = by_name[entry["deck"]]
    if not shown_on(title, deck):
        raise Failure(f"{where}: no slide of {deck.name} has this heading")
    if "chapter" not in entry:
        return
    path = entry["chapter"].split("#")[0]
    try:
        region(entry["chapter"])
    except Failure as error:
        raise Failure(f"{where}: {error}") from None
    chapter = normalised(prose_of(ROOT / path))
    slides = normalised("\n".join(s.shown for s in deck.slides))
    for formula in entry.get("formulas", []):
        wanted = normalised(formula)
        for text, place in ((chapter, path), (slides, deck.name)):
            if wanted not in text:
                raise Failure(f"{where}: {formula} is not in {place}")


def check_trap(entry, by_name):
    """A trap is a slide where the lecture stops and asks."""
    where = f"slides/coverage.toml: trap '{entry['title']}'"
    slides = shown_on(entry["title"], by_name[entry["deck"]])
    if not any("trap" in slide.kinds for slide in slides):
        raise Failure(f"{where}: {entry['deck']} has no such slide of class trap")


def table():
    return tomllib.loads(TABLE.read_text())


def check_coverage():
    by_name = {deck.name: deck for deck in decks()}
    for entry in table()["slide"]:
        check_entry(entry, by_name)
    for entry in table()["trap"]:
        check_trap(entry, by_name)
