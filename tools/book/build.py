"""Builds the book: weaves the headers, adds the pages, calls Sphinx.

    build.py BUILD          BUILD/book is the site, BUILD/book-source its source
    build.py BUILD --check  weaves and checks the source, and stops there
"""

import contextlib
import io
import os
import re
import shutil
import sys
from pathlib import Path

from check_names import check_names
from figures import Figures
from formulas import check_formulas, formulas, formulas_of_header
from literate import ROOT, BookError, stage_headers
from measurements import measurements_page
from mistakes import mistakes_page
from offline import check_offline
from symbols import symbols_page
from weave import title_of, weave

PAGES = Path(__file__).parent / "pages"


def core_names():
    """The core's chapters in the order of its map, common/README.md."""
    text = (ROOT / "common/README.md").read_text()
    listed = re.findall(r"\]\((\w+/\w+)\.hpp\)", text)
    headers = {p.relative_to(ROOT / "common").with_suffix("").as_posix(): p
               for p in ROOT.glob("common/**/*.hpp")}
    if set(listed) != set(headers) or len(listed) != len(headers):
        odd = ", ".join(sorted(set(listed) ^ set(headers))) or "twice"
        raise BookError(f"common/README.md and common/ differ: {odd}")
    return [name for name in listed if "\n// # " in headers[name].read_text()]


def core_headers():
    return [ROOT / f"common/{name}.hpp" for name in core_names()]


def write(path, lines):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n")


def write_source(build, source, figures):
    for header in stage_headers():
        check_names(header)
        name = header.parent.name
        lines = weave(header, figures.for_chapter(name))
        figures.all_placed(name)
        contents = ["---", "hide-toc: true", "---", ""]
        write(source / f"stages/{name}.md", contents + lines)
    for header in core_headers():
        check_names(header)
        name = header.relative_to(ROOT / "common").with_suffix(".md")
        write(source / "core" / name,
              ["---", "hide-toc: true", "---", ""] + weave(header))
    for page in PAGES.glob("*.md"):
        write(source / page.name, figures.filled(page.read_text()).split("\n"))
    write(source / "symbols.md", symbols_page())
    write(source / "measurements.md", measurements_page(build, source))
    mistakes = mistakes_page(build, source)
    if mistakes:
        write(source / "mistakes.md", mistakes)
    write(source / "index.md", front_page(figures, bool(mistakes)))


def front_page(figures, with_mistakes):
    text = figures.filled((PAGES / "index.md").read_text())
    chapters = [f"stages/{p.parent.name}" for p in stage_headers()]
    core = [f"core/{name}" for name in core_names()]
    rest = ["symbols", "measurements", "further_reading"]
    rest += ["mistakes"] * with_mistakes
    lines = text.split("\n")
    for caption, pages in (("The stages", chapters), ("Beside them", rest),
                           ("The core", core)):
        lines += ["```{toctree}", ":hidden:", f":caption: {caption}", "",
                  *pages, "```", ""]
    return lines


def check_every_formula(build, figures):
    headers = stage_headers() + core_headers()
    found = [f for header in headers for f in formulas_of_header(header)]
    for page in sorted(PAGES.glob("*.md")):
        found += formulas(page.read_text(), page.relative_to(ROOT))
    found += formulas("\n".join(symbols_page()), "symbols.toml")
    for name, entry in figures.entries.items():
        found += formulas(entry["caption"], f"figures.toml, {name}")
    check_formulas(found, build)


def run_sphinx(build, source):
    """Sphinx's first warning is an error."""
    from sphinx.cmd.build import main as sphinx
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        failed = sphinx(["-W", "--keep-going", "-q", "-E",
                         "-c", str(Path(__file__).parent),
                         "-d", str(build / "book-doctrees"),
                         str(source), str(build / "book")])
    if failed:
        text = re.sub(r"\x1b\[[\d;]*m", "", said.getvalue())
        lines = [x for x in text.split("\n") if re.search("WARN|ERR|Exc", x)]
        raise BookError((lines or [text.strip()])[0].replace(f"{build}/", ""))


def main():
    build = Path(sys.argv[1]).resolve()
    source, static = build / "book-source", build / "book-static"
    for folder in (source, static):
        shutil.rmtree(folder, ignore_errors=True)
    (static / "mathjax").mkdir(parents=True)
    shutil.copy(build / "node/node_modules/mathjax-full/es5/tex-svg-full.js",
                static / "mathjax")
    for name in ("book.css", "keys.js"):
        shutil.copy(Path(__file__).parent / name, static)
    figures = Figures(build, source / "figures")
    write_source(build, source, figures)
    check_every_formula(build, figures)
    if "--check" in sys.argv[2:]:
        return
    os.environ["BOOK_STATIC"] = str(static)
    run_sphinx(build, source)
    check_offline(build / "book")
    print(f"The book is {build}/book/index.html")


if __name__ == "__main__":
    try:
        main()
    except BookError as error:
        sys.exit(f"book: {error}")
