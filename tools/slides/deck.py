"""Reads a deck: its title, and its slides with their text and notes."""

import re
from dataclasses import dataclass, replace

from tools.tree import ROOT, Failure

COMMENT = re.compile(r"<!--\s*(.*?)\s*-->", re.S)


@dataclass
class Slide:
    number: int
    line: int
    text: str
    deck: "Deck"

    @property
    def where(self):
        return f"{self.deck.path.relative_to(ROOT)}:{self.line}"

    @property
    def heading(self):
        found = re.search(r"^# (.*)", self.text, re.M)
        return found[1].strip() if found else ""

    @property
    def kinds(self):
        found = re.search(r"<!-- _class: (.*?) -->", self.text)
        return found[1].split() if found else []

    @property
    def notes(self):
        """The lecturer's notes: the comments that are not directives."""
        return "\n".join(text for text in COMMENT.findall(self.text) if not text.startswith("_"))

    @property
    def minutes(self):
        found = re.match(r"(\d+(?:\.5)?) min\b", self.notes)
        return float(found[1]) if found else None

    @property
    def shown(self):
        """The text without its comments."""
        return COMMENT.sub("", self.text)


def for_students(slide):
    """The slide without its notes, and a question for the class without its answer."""
    text = COMMENT.sub(lambda found: found[0] if found[1].startswith("_") else "", slide.text)
    if "trap" in slide.kinds:
        question = re.search(r"^## .*\n", text, re.M)
        text = text[: question.end()] if question else text
    return replace(slide, text=text)


class Deck:
    def __init__(self, path):
        self.path, self.name = path, path.stem
        text = path.read_text()
        head = re.match(r"---\ntitle: (.*)\n---\n", text)
        if not head:
            raise Failure(f"{path.relative_to(ROOT)}:1: a deck begins with '---', 'title: ...' and '---'")
        self.title = head[1]
        self.slides, line = [], 4
        for number, part in enumerate(re.split(r"^---\n", text[head.end() :], flags=re.M), 1):
            self.slides.append(Slide(number, line, part, self))
            line += part.count("\n") + 1

    @property
    def minutes(self):
        return sum(slide.minutes or 0 for slide in self.slides)

    def check(self):
        """Every slide has a heading, and notes that begin with its time."""
        for slide in self.slides:
            if not slide.heading:
                raise Failure(f"{slide.where}: a slide without '# heading'")
            if slide.minutes is None:
                raise Failure(f"{slide.where}: the notes of '{slide.heading}' begin with '<!-- N min'")
            if re.search(r":\s", slide.notes):
                raise Failure(
                    f"{slide.where}: Marp takes a colon in notes for a setting; write the sentence without"
                )


def decks():
    return [Deck(path) for path in sorted(ROOT.glob("slides/[0-9]_*.md"))]
