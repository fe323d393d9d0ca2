"""The whole book as one PDF, for paper: `make book-pdf`.

    python3 -m tools.book.pdf     build/book/lightwalk.pdf

The chapters one after the other, from the built book.
"""

import re
import shutil
import subprocess
import sys

from tools.book.built import article_of, glyphs_of, without_links
from tools.book.page import page_of
from tools.exercises.sheet import title_of
from tools.tree import BUILD, ROOT, Failure, stage_headers

BOOK, PRINT = BUILD / "book", BUILD / "book-print"
HEAD = re.compile(r"<head>.*?</head>", re.S)
HEADER_LINK = re.compile(r'<a class="headerlink".*?</a>', re.S)
TITLE = """\
<section style="break-after: page"><h1>Lightwalk</h1>
<p><em>A course in path tracing that you can compile.</em></p><ol>{contents}</ol></section>
"""


def for_paper(page):
    """A chapter without links, but for those to papers: others would name this machine."""
    article = HEADER_LINK.sub("", article_of(page))
    return without_links(article, lambda address: address.startswith("https:"), str)


def whole_book():
    """One page of all chapters, with the styles of the first."""
    texts = [(BOOK / f"{page_of(header)}.html").read_text() for header in stage_headers()]
    head = re.sub(r"<script.*?</script>", "", HEAD.search(texts[0])[0], flags=re.S)
    contents = "".join(f"<li>{title_of(header).split(': ', 1)[1]}</li>" for header in stage_headers())
    body = TITLE.format(contents=contents)
    for text in texts:
        body += f'<div style="break-before: page">{for_paper(text)}</div>{glyphs_of(text)}'
    return f'<!doctype html><html lang="en">{head}<body><main class="content">{body}</main></body></html>'


def main():
    shutil.rmtree(PRINT, ignore_errors=True)
    (PRINT / "stages").mkdir(parents=True)
    for name in ("_static", "_images"):
        (PRINT / name).symlink_to(BOOK / name)
    page = PRINT / "stages/book.html"
    page.write_text(whole_book())
    target = BOOK / "lightwalk.pdf"
    done = subprocess.run(["node", ROOT / "tools/book/pdf.cjs", page, target], capture_output=True, text=True)
    if done.returncode:
        raise Failure((done.stderr.strip().splitlines() or ["no word"])[-1])
    print(f"The book on paper is {target}")


if __name__ == "__main__":
    try:
        main()
    except (Failure, FileNotFoundError) as error:
        sys.exit(f"book-pdf: {error}")
