"""The glossary: its page, and a link with its meaning at each word that a chapter
introduces in italics."""

import re
from html import escape

from tools.exercises.words import plain
from tools.tree import ROOT

ROW = re.compile(r"^\| ([^|]+) \| ([^|]+) \|$", re.M)
INTRODUCED = re.compile(r"<em>([^<>]+)</em>")


def meanings():
    """{word: its meaning}, in the order of WORDS.md; "BRDF, BSDF" are two."""
    found = {}
    for words, meaning in ROW.findall((ROOT / "WORDS.md").read_text()):
        if words not in ("word", "---"):
            found |= {word.strip(): meaning for word in words.split(",")}
    return found


def place(word):
    return "word-" + re.sub(r"\W+", "-", word.lower())


def words_page():
    """The lines of WORDS.md, with a place for each word."""

    def row(match):
        if match[1] in ("word", "---"):
            return match[0]
        places = "".join(f'<span id="{place(word.strip())}"></span>' for word in match[1].split(","))
        return f"| {places}{match[1]} | {match[2]} |"

    return ROW.sub(row, (ROOT / "WORDS.md").read_text()).split("\n")


def link_words(book):
    """Links the words that chapters have in italics; the link's title is the card."""
    known = {word.lower(): (word, meaning) for word, meaning in meanings().items()}

    def link(match):
        text = match[1].lower()
        word, meaning = known.get(text) or known.get(text.removesuffix("s")) or (None, None)
        if word is None:
            return match[0]
        card = escape(f"{word}: {plain(meaning)}")
        return f'<a class="word" href="../words.html#{place(word)}" title="{card}">{match[0]}</a>'

    for path in book.glob("stages/*.html"):
        path.write_text(INTRODUCED.sub(link, path.read_text()))
