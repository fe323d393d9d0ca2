"""Builds the slides: fills in code and figures, and has Marp set them.

    build.py BUILD          BUILD/slides has the decks and an index.html
    build.py BUILD --check  fills in and checks the source, and stops there
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "book"))

from check_names import check_text
from coverage import check_coverage
from deck import decks
from figures import Figures
from formulas import check_formulas, formulas
from index import index_page
from listing import colors, fill
from literate import ROOT, BookError
from offline import check_offline

HEAD = """---
marp: true
theme: lightwalk
math: mathjax
paginate: true
title: {title}
footer: Lightwalk / {title}
---
"""


def figure(line, figures):
    """HTML for a line `{figure} name panels=1,2 height=300`."""
    name, *words = line.split()
    options = dict(word.split("=") for word in words)
    entry = figures.entry(name)
    files = figures.files(name)
    panels = entry.get("panels", [{}])
    numbers = [int(n) for n in options.get("panels", "").split(",") if n]
    shown = ""
    for number in numbers or range(1, len(files) + 1):
        label = panels[number - 1].get("label", "")
        file, size = files[number - 1], options.get("height", "360")
        drawn = file.endswith(".svg")
        shown += (f'<div{" class=drawn" * drawn}><img src="figures/{file}" '
                  f'alt="{entry["shows"]} {label}" '
                  f'style="{"max-" * drawn}height: {size}px">'
                  + f"<p>{label}</p>" * bool(label) + "</div>")
    facts, _ = figures.facts(entry)
    facts = facts.replace("`", "")
    source = f'<p class="source">{facts}</p>' if facts else ""
    return f'<div class="figure">{shown}</div>\n{source}'


def woven(deck, figures):
    """The deck as Marp takes it."""
    slides = []
    for slide in deck.slides:
        check_text(slide.shown, slide.where)
        text = fill(slide.text, slide.where, "trap" in slide.kinds)
        text = re.sub(r"^\{figure\} (.*)$",
                      lambda m: figure(m[1], figures), text, flags=re.M)
        text = re.sub(r"^::: (columns.*)$", r'<div class="\1"><div>\n', text,
                      flags=re.M)
        text = re.sub(r"^::: and$", "\n</div><div>\n", text, flags=re.M)
        text = re.sub(r"^::: end$", "\n</div></div>\n", text, flags=re.M)
        text = re.sub(r"^::: step$", "<div data-marpit-fragment>\n", text,
                      flags=re.M)
        text = re.sub(r"^::: (\w+)$", r'<div class="\1">\n', text, flags=re.M)
        slides.append(re.sub(r"^:::$", "\n</div>\n", text, flags=re.M))
    return HEAD.format(title=deck.title) + "\n---\n".join(slides)


def marp(build, *options):
    environment = dict(os.environ, CHROME_NO_SANDBOX="1")
    names = ("chromium", "google-chrome", "chromium-browser")
    chromium = next(filter(None, map(shutil.which, names)), None)
    if chromium:  # elsewhere Marp knows where to look
        environment.setdefault("CHROME_PATH", chromium)
    run = subprocess.run(
        ["node", build / "node/node_modules/@marp-team/marp-cli/marp-cli.js",
         "--no-config-file", "--no-stdin", "--html", "--theme-set",
         build / "slides-source/theme.css", "--input-dir",
         build / "slides-source", "--output", build / "slides", *options],
        capture_output=True, text=True, env=environment)
    if run.returncode:
        if "No suitable browser" in run.stderr:
            raise BookError("PDFs need Chromium or Chrome, and neither was "
                            "found; `make setup-slides` installs it")
        said = [x for x in run.stderr.split("\n") if "ERROR" in x]
        raise BookError((said or [run.stderr.strip()])[0])


def main():
    build = Path(sys.argv[1]).resolve()
    source, made = build / "slides-source", build / "slides"
    shutil.rmtree(source, ignore_errors=True)
    figures = Figures(build, source / "figures")
    every = decks()
    for deck in every:
        deck.check()
        (source / f"{deck.name}.md").write_text(woven(deck, figures))
    check_coverage()
    check_formulas([formula for deck in every for slide in deck.slides
                    for formula in formulas(
                        slide.text, f"slides/{deck.path.name}", slide.line)],
                   build)
    if "--check" in sys.argv[2:]:
        return
    shutil.rmtree(made, ignore_errors=True)
    (source / "theme.css").write_text(
        (ROOT / "slides/theme.css").read_text() + colors())
    marp(build)
    shutil.copytree(source / "figures", made / "figures")
    marp(build, "--pdf", "--allow-local-files", "--pdf-outlines",
         "--pdf-outlines.pages=false")
    (made / "index.html").write_text(index_page(every))
    check_offline(made)
    print(f"The slides are {made}/index.html")


if __name__ == "__main__":
    try:
        main()
    except BookError as error:
        sys.exit(f"slides: {error}")
