"""Reads slides/plans.toml: the slides of a course of 1, 2 or 5 sessions, and their
time by the notes. Each session is a deck of its own, with its own opening."""

import re
import tomllib
from dataclasses import dataclass, replace

from tools.tree import ROOT, Failure

FILE = "slides/plans.toml"
OPENING = "Before we begin..."
TITLE = """
<!-- _class: title -->

# {title}

{plan}, {number} of {count}

{{figure}} {figure}

<!--
1 min
-->
"""
POINTS = """
# {opening}

{points}

<!--
1 min
Say what the class has written so far, and what it will write next.
-->
"""


@dataclass
class Part:
    """The part of a deck that a session shows."""

    deck: object
    skipped: list

    @property
    def slides(self):
        return [slide for slide in self.deck.slides if slide not in self.skipped]

    @property
    def minutes(self):
        return sum(slide.minutes for slide in self.slides)


@dataclass
class Session:
    """The slides of one session, in the way of a deck."""

    name: str
    title: str
    slides: list
    parts: list

    @property
    def minutes(self):
        return sum(slide.minutes for slide in self.slides)


def part(deck, skip):
    return Part(deck, [slide for slide in deck.slides if slide.heading in skip])


def opening(plan, number, entry, parts):
    """The title, and what the class has and will have; in the first session the
    course's facts, too."""
    first = parts[0].deck.slides[0]
    figure = re.search(r"^\{figure\} (.*)$", first.text, re.M)[1]
    title = TITLE.format(
        title=entry["title"], plan=plan["name"], number=number, count=len(plan["session"]), figure=figure
    )
    points = "\n".join(f"* {line}" for line in entry["before_we_begin"])
    yield replace(first, text=title)
    yield replace(first, text=POINTS.format(opening=OPENING, points=points))
    if number == 1:
        yield from (slide for one in parts for slide in one.slides if "{course}" in slide.text)


def session(plan, number, entry, by_name):
    where = f"{FILE}: '{plan['name']}', session {number}"
    for name in entry["decks"]:
        if name not in by_name:
            raise Failure(f"{where}: there is no deck {name}")
    decks = [by_name[name] for name in entry["decks"]]
    skip = entry.get("skip", [])
    for heading in skip:
        if all(slide.heading != heading for deck in decks for slide in deck.slides):
            raise Failure(f"{where}: no slide of its decks has the heading '{heading}'")
    parts = [part(deck, skip) for deck in decks]
    first, *others = [slide for one in parts for slide in one.slides]
    slides = [*opening(plan, number, entry, parts), *(one for one in others if one.heading != OPENING)]
    if plan.get("from_the_start"):  # nothing is known yet that could be recapitulated
        slides = [replace(one, text=re.sub("^# Recap: ", "# ", one.text, flags=re.M)) for one in slides]
    name = f"{plan['name'].lower().replace(' ', '_')}_{number}"
    made = Session(name, entry["title"], slides, parts)
    if made.minutes > plan["minutes"]:
        raise Failure(f"{where}: takes {made.minutes:g} minutes by the notes, not {plan['minutes']}")
    return made


def plans(every):
    """Pairs of a plan's table and its sessions."""
    by_name = {deck.name: deck for deck in every}
    tables = tomllib.loads((ROOT / FILE).read_text(encoding="utf-8"))["plan"]
    return [
        (plan, [session(plan, n, entry, by_name) for n, entry in enumerate(plan["session"], 1)])
        for plan in tables
    ]
