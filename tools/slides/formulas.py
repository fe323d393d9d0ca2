"""Adds text alternatives to a deck's formulas, which Marp renders as pictures."""

import re
from html import escape

from tools.exercises.words import formula
from tools.tree import Failure
from tools.weave.formulas import formulas

SET = re.compile(r'(<mjx-container class="MathJax"[^>]*><svg )')


def name_formulas(page, deck):
    """Gives each formula of the built page its text, in the deck's order."""
    words = [formula(one["tex"]) for slide in deck.slides for one in formulas(slide.shown, slide.where)]
    text = page.read_text()
    places = len(SET.findall(text))
    if places != len(words):
        raise Failure(f"{deck.name}: {len(words)} formulas in the deck, {places} on its slides")
    each = iter(words)
    page.write_text(SET.sub(lambda found: f'{found[1]}aria-label="{escape(next(each))}" ', text))
