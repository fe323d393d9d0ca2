"""Parts of the book's pages as they are built: for handouts, and for paper."""

import re

ARTICLE = re.compile(r"<article.*?</article>", re.S)
# What the formulas of a page are drawn with.
GLYPHS = re.compile(r'<svg[^>]*id="MJX-SVG-global-cache".*?</svg>', re.S)
LINK = re.compile(r'<a\b[^>]*\bhref="([^"]*)"[^>]*>(.*?)</a>', re.S)
DECK_LINK = re.compile(r'<p class="deck">.*?</p>', re.S)


def article_of(page):
    return ARTICLE.search(page)[0]


def glyphs_of(page):
    """Empty for a page without formulas."""
    found = GLYPHS.search(page)
    return found[0] if found else ""


def without_links(article, kept, shown):
    """Links whose address `kept` accepts; of the others what `shown` makes of their
    words. There are no decks beside the page."""
    return LINK.sub(lambda link: link[0] if kept(link[1]) else shown(link[2]), DECK_LINK.sub("", article))
