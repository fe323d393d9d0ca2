"""The links in a slide's corner: to the same topic in the book, its exercise and
its tests. The book is built beside the slides."""

import re

from tools.book.page import page_of, slug
from tools.tree import ROOT, Failure
from tools.weave.literate import pieces, region

BOOK = "../book"
OWN = re.compile(r"<!-- _book: (.*?) -->\n*")
REFERENCE = re.compile(r"^```cpp region=(\S+)", re.M)
TO_THE_BOOK = re.compile(rf'<a [^>]*href="{re.escape(BOOK)}/[^"]*"[^>]*>(.*?)</a>')


def references(slide):
    """The regions `path#name` that the slide shows, or those that it names in
    `<!-- _book: path or path#name, none, or several -->`."""
    own = OWN.search(slide.text)
    if own:
        return own[1].split() if own[1] != "none" else []
    return list(dict.fromkeys(REFERENCE.findall(slide.text)))


def page_address(path):
    """The address of the book's page about a header."""
    return f"{BOOK}/{page_of(ROOT / path)}.html"


def anchor(reference):
    """The anchor on the page, as docutils writes it: ids begin with a letter. A
    region within a struct has no id."""
    path, _, name = reference.partition("#")
    if all(piece.region != name for piece in pieces(ROOT / path)):
        return ""
    return "#" + re.sub(r"^[^a-z]+", "", slug(ROOT / path, name))


def address(reference):
    return page_address(reference.split("#")[0]) + anchor(reference)


def exercises_of(reference):
    path, _, name = reference.partition("#")
    return [(page_address(path), one.number) for one in region(reference).exercises] if name else []


def name_of(reference):
    """A region's name, or a header's."""
    return re.sub(r"\.hpp$", "", re.split("[#/]", reference)[-1]).replace("_", " ")


def corner(slide):
    """HTML for the links, or an empty string."""
    known = references(slide)
    try:
        links = [f'<a href="{address(one)}">book: {name_of(one)}</a>' for one in known]
        exercises = dict.fromkeys(two for one in known for two in exercises_of(one))
    except Failure as error:
        raise Failure(f"{slide.where}: {error}") from None
    for page, number in exercises:
        place = number.replace(".", "-")
        links.append(f'<a href="{page}#exercise-{place}">exercise {number}</a>')
        links.append(f'<a href="{page}#tests-{place}">its tests</a>')
    return f'<p class="links">{"".join(links)}</p>' if links else ""


def without_links(text):
    """For paper: links to the book become words, since a PDF would have the
    absolute addresses of the machine that made it."""
    text = re.sub(r'<p class="links">.*?</p>', "", text)
    return TO_THE_BOOK.sub(r"\1", text)
