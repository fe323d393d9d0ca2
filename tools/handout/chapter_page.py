"""The chapter as one file that a student opens in a browser, made from the book's
page: without its solutions, its answers and its links to other pages."""

import base64
import difflib
import mimetypes
import re

from tools.book.built import article_of, glyphs_of, without_links
from tools.exercises.sheet import title_of
from tools.tree import BUILD, stage_headers, text_of

BOOK = BUILD / "book"
PAGE = """\
<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1">
<title>{title}</title>
<style>{styles}</style>
</head>
<body data-theme="auto">
<div class="page"><div class="main"><div class="content"><div class="article-container">
{article}
</div></div></div></div>
{glyphs}
<script>{scripts}</script>
</body>
</html>
"""
SOLUTION = re.compile(
    r'(<div class="exercise-body[^>]*>\s*<p>(?:(?!</p>).)*</p>\s*<div class="highlight-cpp[^>]*>'
    r'<div class="highlight"><pre>).*?(</pre></div>\s*</div>\s*</div>)',
    re.S,
)
FOLDED = r"<details[^>]*>\s*<summary[^>]*>\s*<span[^>]*>{}(?:(?!</details>).)*</details>"
STYLE = re.compile(r'<link rel="stylesheet"[^>]*href="\.\./_static/([^"?]+)')
FONT = re.compile(r"url\(\./files/([\w.-]+)\)")
SCRIPTS = ("live.js", "viewer.js")
# The writing systems that the book uses.
SUBSETS = re.compile(r"-(latin|latin-ext|greek)-wght-")


def book_page(header):
    """The book's page of the chapter, or None if `make book` has not run since
    the header changed."""
    path = BOOK / f"stages/{header.parent.name}.html"
    return path if path.exists() and path.stat().st_mtime >= header.stat().st_mtime else None


def without_solutions(article):
    article = SOLUTION.sub(r'\1<span class="c1">  // write it in path_tracer.hpp</span>\n\2', article)
    for title in ("What changed since", "Answer"):
        article = re.sub(FOLDED.format(title), "", article, flags=re.S)
    # The programs with mistakes are made by the course's own tools.
    commands = re.compile(FOLDED.format("The commands?"), re.S)
    return commands.sub(lambda found: "" if "tools.weave" in found[0] else found[0], article)


def is_here(address):
    """Within the page, or a paper's."""
    return address.startswith(("#", "https:"))


def data_of(path):
    """The file's content as an address."""
    kind = mimetypes.guess_type(path.name)[0] or "font/woff2"
    return f"data:{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"


def style_sheet(name):
    """The text of a style sheet, with the fonts that the book's language needs."""
    path = BOOK / "_static" / name
    text = path.read_text(encoding="utf-8")
    faces = re.split(r"(?=@font-face)", text)
    kept = [face for face in faces if not FONT.search(face) or SUBSETS.search(FONT.search(face)[1])]
    return FONT.sub(lambda font: f"url({data_of(path.parent / 'files' / font[1])})", "".join(kept))


def with_lines_of(handed_out, article, header):
    """With the numbers that lines have in the student's file."""
    theirs = handed_out.splitlines()
    matches = difflib.SequenceMatcher(None, text_of(header).splitlines(), theirs, autojunk=False)
    number = {one.a + i + 1: one.b + i + 1 for one in matches.get_matching_blocks() for i in range(one.size)}

    def renumbered(match):
        old = int(match[2])
        new = str(number.get(old, old))
        return f'<span class="linenos" id="L{new}">{match[1]}{new.rjust(len(match[2]))}</span>'

    return re.sub(r'<span class="linenos" id="L\d+">( *)(\d+)</span>', renumbered, article)


def table_of_contents(article, header):
    """Links to the sections, to the lab sheet and to the chapters before."""
    sections = re.findall(
        r'<section id="([^"]+)">\s*(?:<span[^>]*></span>)*<h2>(.*?)<a class="headerlink"', article
    )
    rows = "".join(f'<li><a href="#{name}">{title}</a></li>' for name, title in sections)
    links = ['<a href="README.md">The lab sheet</a>']
    for other in stage_headers():
        if other.parent.name < header.parent.name and book_page(other):
            links.append(f'<a href="../{other.parent.name}/chapter.html">Stage {other.parent.name[0]}</a>')
    return (
        f'<nav aria-label="Contents"><p>{" · ".join(links)}</p>'
        f"<details><summary>Contents</summary><ol>{rows}</ol></details></nav>"
    )


def chapter_page(header, handed_out):
    """The page, "chapter.html", by the text of the header that goes with it: {path:
    bytes}; nothing where the book is not there."""
    source = book_page(header)
    if not source:
        return {}
    text = source.read_text(encoding="utf-8")
    article = without_links(without_solutions(article_of(text)), is_here, "<span>{}</span>".format)
    article = with_lines_of(handed_out, article, header)
    article = article.replace("</h1>", "</h1>\n" + table_of_contents(article, header), 1)
    article = re.sub(
        r'src="\.\./_images/([^"]+)"', lambda image: f'src="{data_of(BOOK / "_images" / image[1])}"', article
    )
    styles = [style_sheet(name) for name in STYLE.findall(text)]
    styles += re.findall(r"<style>(.*?)</style>", text, re.S)  # the theme's
    scripts = [(BOOK / "_static" / name).read_text(encoding="utf-8") for name in SCRIPTS]
    page = PAGE.format(
        title=title_of(header),
        styles="\n".join(styles),
        article=article,
        glyphs=glyphs_of(text),
        scripts="\n".join(scripts),
    )
    return {"chapter.html": page.encode()}
