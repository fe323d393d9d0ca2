"""Builds the book: weaves the headers, adds the pages, calls Sphinx.

    python3 -m tools.book.build     the site, build/book
    ... --check                     weaves and checks its source, and stops
"""

import contextlib
import io
import os
import re
import shutil
import sys
from pathlib import Path

from tools.book.catalogue import read_catalogue
from tools.book.definitions import link_definitions
from tools.book.figures import PlacedFigures
from tools.book.instructors import hours
from tools.book.keep_together import keep_together
from tools.book.measurements import with_tables
from tools.book.mistakes import figure_entry, mistakes_pages, read_gallery
from tools.book.page import page_of, weave
from tools.book.set_formulas import set_formulas
from tools.book.symbols import symbols_page
from tools.book.words import link_words, words_page
from tools.exercises.sheet import read_sheet, task_file
from tools.live.build import add_box, check_live
from tools.slides.deck import decks
from tools.tree import BUILD, ROOT, Failure, core_headers, listed_headers, stage_headers
from tools.weave.figures import BOOK, placed_names
from tools.weave.fonts import copy_fonts
from tools.weave.formulas import check_formulas, formulas, formulas_of_header
from tools.weave.names import check_names, check_text
from tools.weave.offline import check_offline
from tools.weave.transcripts import check_transcripts

HERE = Path(__file__).parent
PAGES = HERE / "pages"
STATIC = ("book.css", "keys.js", "contents.js", "reader.js", "scrollers.js", "viewer.js", "gallery.css", "gallery.js")
SIDEBAR_FROM = 97  # em of 16 px


def titled(headers):
    """The headers that are chapters of the book: they have a title."""
    return [path for path in headers if re.search(r"^// # ", path.read_text(), re.M)]


def other_headers():
    """The other chapters beside the stages', in order: {caption: headers}."""
    found = {"The core": titled(core_headers())}
    for header in stage_headers():
        found[f"For stage {header.parent.name[0]}"] = titled(listed_headers(header.parent))
    return {caption: headers for caption, headers in found.items() if headers}


def woven_headers():
    return stage_headers() + [header for headers in other_headers().values() for header in headers]


def write(path, lines):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n")


def check_every_name():
    for header in woven_headers():
        check_names(header)
    for header in stage_headers():
        for what, text in read_sheet(header).texts():
            check_text(text, f"{task_file(header)}: {what}")


def write_source(source, figures, *gallery):
    bare = ["---", "hide-toc: true", "---", ""]
    chapters = stage_headers()
    for header in woven_headers():
        sheet = read_sheet(header) if header in chapters else None
        write(source / f"{page_of(header)}.md", bare + weave(header, figures, sheet))
    for page in PAGES.glob("*.md"):
        if page.name != "index.md":
            write(source / page.name, bare + filled(page, figures, source).split("\n"))
    write(source / "symbols.md", bare + symbols_page())
    write(source / "words.md", bare + words_page())
    mistakes = mistakes_pages(figures, *gallery)
    for name, lines in mistakes.items():
        write(source / f"{name}.md", lines)
    write(source / "index.md", front_page(figures, list(mistakes)))


def filled(page, figures, source):
    """A page with its figures and tables in their places."""
    text = with_tables(figures.filled(page), source)
    return text.replace("{hours}", "\n".join(hours())) if "{hours}" in text else text


def front_page(figures, mistakes):
    text = figures.filled(PAGES / "index.md")
    rest = ["instructors", "symbols", "words", "measurements", "further_reading", *mistakes]
    lines = text.split("\n")
    lists = {"The stages": [page_of(header) for header in stage_headers()], "Beside them": rest}
    for caption, headers in other_headers().items():
        lists[caption] = [page_of(header) for header in headers]
    for caption, pages in lists.items():
        lines += ["```{toctree}", ":hidden:", f":caption: {caption}", "",
                  *pages, "```", ""]
    return lines


def check_every_formula(figures):
    found = [f for header in woven_headers() for f in formulas_of_header(header)]
    for page in sorted(PAGES.glob("*.md")):
        found += formulas(page.read_text(), page.relative_to(ROOT))
    found += formulas("\n".join(symbols_page()), "symbols.toml")
    for name, entry in figures.entries.items():
        found += formulas(entry["caption"], f"{entry['file']}, {name}")
    for header in stage_headers():
        for what, text in read_sheet(header).texts():
            found += formulas(text, f"{task_file(header)}, {what}")
    check_formulas(found)


def run_sphinx(source):
    """Sphinx's first warning is an error."""
    from sphinx.cmd.build import main as sphinx
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        failed = sphinx(["-W", "--keep-going", "-q", "-E",
                         "-c", str(HERE),
                         "-d", str(BUILD / "book-doctrees"),
                         str(source), str(BUILD / "book")])
    if failed:
        text = re.sub(r"\x1b\[[\d;]*m", "", said.getvalue())
        lines = [x for x in text.split("\n") if re.search("WARN|ERR|Exc", x)]
        raise Failure((lines or [text.strip()])[0].replace(f"{BUILD}/", ""))


def stand_in_for_slides(folder):
    """Chapters link to their decks, which `make slides` makes: until then a page
    there says so."""
    folder.mkdir(exist_ok=True)
    for deck in decks():
        page = folder / f"{deck.name}.html"
        if not page.exists():
            page.write_text(
                f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{deck.title}</title>'
                f"<main><h1>{deck.title}</h1><p>These slides are not made yet: <code>make slides</code>.</p></main>"
            )


def name_levels(book):
    """Adds the level to the captions of the sidebar's lists, which are headings."""
    for path in book.rglob("*.html"):
        text = path.read_text()
        path.write_text(text.replace('class="caption" role="heading"', 'class="caption" role="heading" aria-level="2"'))


def finish(book):
    """Post-processes the pages that Sphinx has made."""
    link_definitions(book, [(header, page_of(header)) for header in woven_headers()])
    set_formulas(book)
    keep_together(book)
    link_words(book)
    name_levels(book)
    # A narrow page has the menu instead of the sidebar: two columns must fit
    # beside the sidebar.
    style = book / "_static/styles/furo.css"
    style.write_text(style.read_text().replace("max-width:63em", f"max-width:{SIDEBAR_FROM}em"))


def main():
    source, static = BUILD / "book-source", BUILD / "book-static"
    for folder in (source, static):
        shutil.rmtree(folder, ignore_errors=True)
    static.mkdir(parents=True)
    (static / "formulas.css").touch()
    for name in STATIC:
        shutil.copy(HERE / name, static)
    live = sorted((HERE / "live").glob("*.js"))
    (static / "live.js").write_text("".join(path.read_text() for path in live))
    shutil.copy(HERE / "live/live.css", static)
    copy_fonts(static)
    figures = PlacedFigures(source / "figures")
    check_live(figures.entries)
    catalogue = read_catalogue()
    pairs, why = read_gallery(catalogue)
    shown = {entry["name"]: entry for entry in (figure_entry(one) for _, one in pairs)}
    figures.entries |= shown
    # Checks that take seconds come before the figures, which take minutes.
    check_every_name()
    check_every_formula(figures)
    figures.make(placed_names(BOOK) | shown.keys())
    write_source(source, figures, catalogue, pairs, why)
    for header in woven_headers():
        check_transcripts(header)
    if "--check" in sys.argv[1:]:
        return
    add_box(static)
    os.environ["BOOK_STATIC"] = str(static)
    run_sphinx(source)
    finish(BUILD / "book")
    stand_in_for_slides(BUILD / "slides")
    check_offline(BUILD / "book")
    print(f"The book is {BUILD}/book/index.html")


if __name__ == "__main__":
    try:
        main()
    except Failure as error:
        sys.exit(f"book: {error}")
