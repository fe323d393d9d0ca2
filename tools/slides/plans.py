"""Reads slides/plans.toml: the slides of a course of 1, 2 or 5 sessions, and their
time by the notes."""

import tomllib
from dataclasses import dataclass

from tools.tree import ROOT, Failure

FILE = "slides/plans.toml"


@dataclass
class Part:
    """The part of a deck that a session shows."""

    deck: object
    skipped: list

    @property
    def minutes(self):
        return self.deck.minutes - sum(slide.minutes for slide in self.skipped)


def part(deck, skip):
    return Part(deck, [slide for slide in deck.slides if slide.heading in skip])


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
    takes = sum(one.minutes for one in parts)
    if takes > plan["minutes"]:
        raise Failure(f"{where}: takes {takes:g} minutes by the notes, not {plan['minutes']}")
    return parts


def plans(every):
    """Pairs of a plan's table and its sessions, each a list of parts."""
    by_name = {deck.name: deck for deck in every}
    tables = tomllib.loads((ROOT / FILE).read_text(encoding="utf-8"))["plan"]
    return [
        (plan, [session(plan, n, entry, by_name) for n, entry in enumerate(plan["session"], 1)])
        for plan in tables
    ]
