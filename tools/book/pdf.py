"""The whole book as one PDF, for paper: the chapters one after the other.

python3 -m tools.book.pdf     build/book/lightwalk.pdf, from the built book
"""

import re
import shutil
import subprocess
import sys

from tools.book.page import page_of
from tools.exercises.sheet import title_of
from tools.tree import BUILD, ROOT, Failure, stage_headers

BOOK, PRINT = BUILD / "book", BUILD / "book-print"
HEAD = re.compile(r"<head>.*?</head>", re.S)
ARTICLE = re.compile(r"<article.*?</article>", re.S)
GLYPHS = re.compile(r'<svg[^>]*id="MJX-SVG-global-cache".*?</svg>', re.S)
LINK = re.compile(r'<a\b[^>]*\bhref="([^"]*)"[^>]*>(.*?)</a>', re.S)
TITLE = """\
<section style="break-after: page"><h1>Lightwalk</h1>
<p><em>A course in path tracing that you can compile.</em></p><ol>{contents}</ol></section>
"""


def without_links(text):
    """Paper has no links but those to papers: others would name this machine."""
    text = re.sub(r'<a class="headerlink".*?</a>|<p class="deck">.*?</p>', "", text, flags=re.S)
    return LINK.sub(lambda link: link[0] if link[1].startswith("https:") else link[2], text)


def whole_book():
    """One page of all chapters, with the styles of the first."""
    texts = [(BOOK / f"{page_of(header)}.html").read_text() for header in stage_headers()]
    head = re.sub(r"<script.*?</script>", "", HEAD.search(texts[0])[0], flags=re.S)
    contents = "".join(f"<li>{title_of(header).split(': ', 1)[1]}</li>" for header in stage_headers())
    body = TITLE.format(contents=contents)
    for text in texts:
        article = without_links(ARTICLE.search(text)[0])
        body += f'<div style="break-before: page">{article}</div>' + "".join(GLYPHS.findall(text))
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
