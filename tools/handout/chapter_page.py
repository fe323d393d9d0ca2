"""The chapter as a page for a student's browser, made from the book's page:
without solutions, answers and links to other pages."""

import re
from pathlib import Path

from tools.exercises.sheet import title_of
from tools.tree import BUILD

BOOK = BUILD / "book"
PAGE = """\
<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1">
<title>{title}</title>
{styles}
</head>
<body data-theme="auto">
<div class="page"><div class="main"><div class="content"><div class="article-container">
{article}
</div></div></div></div>
{glyphs}
{scripts}
</body>
</html>
"""
SOLUTION = re.compile(
    r'(<div class="exercise-body[^>]*>\s*<p>(?:(?!</p>).)*</p>\s*<div class="highlight-cpp[^>]*>'
    r'<div class="highlight"><pre>).*?(</pre></div>\s*</div>\s*</div>)',
    re.S,
)
FOLDED = r"<details[^>]*>\s*<summary[^>]*>\s*<span[^>]*>{}(?:(?!</details>).)*</details>"
LINK = re.compile(r'<a\b[^>]*\bhref="([^"]*)"[^>]*>(.*?)</a>', re.S)
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
    return article


def without_links(article):
    """Keeps only links within the page and to papers."""

    def text(match):
        address, words = match.groups()
        return match[0] if address.startswith(("#", "https:")) else f"<span>{words}</span>"

    article = re.sub(r'<p>\s*<a[^>]*href="[^"]*slides/[^"]*"[^>]*>[^<]*</a>\s*</p>', "", article)
    return LINK.sub(text, article)


def static_files(styles):
    """The style sheets, their fonts and the scripts: {path: bytes}."""
    names = [*styles, *SCRIPTS]
    for style in styles:
        fonts = FONT.findall((BOOK / "_static" / style).read_text(encoding="utf-8"))
        names += [f"{Path(style).parent}/files/{font}" for font in fonts if SUBSETS.search(font)]
    return {f"static/{name}": (BOOK / "_static" / name).read_bytes() for name in names}


def chapter_page(header):
    """The page and all files that it needs, in the folder chapter/: {path: bytes};
    empty if the book is not built."""
    source = book_page(header)
    if not source:
        return {}
    text = source.read_text(encoding="utf-8")
    article = text[text.index("<article") : text.index("</article>") + len("</article>")]
    article = without_links(without_solutions(article))
    styles = STYLE.findall(text)
    files = static_files(styles)
    links = [f'<link rel="stylesheet" href="static/{name}">' for name in styles]
    links += re.findall(r"<style>.*?</style>", text, re.S)  # the theme's
    for name in set(re.findall(r'src="\.\./_images/([^"]+)"', article)):
        files[f"images/{name}"] = (BOOK / "_images" / name).read_bytes()
    glyphs = re.search(r'<svg[^>]*id="MJX-SVG-global-cache".*?</svg>', text, re.S)
    page = PAGE.format(
        title=title_of(header),
        styles="\n".join(links),
        article=article.replace('src="../_images/', 'src="images/'),
        glyphs=glyphs[0] if glyphs else "",
        scripts="\n".join(f'<script src="static/{name}"></script>' for name in SCRIPTS),
    )
    files["index.html"] = page.encode()
    return {f"chapter/{path}": data for path, data in files.items()}
