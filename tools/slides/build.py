"""Builds the slides: fills in code and figures, and renders them with Marp.

    python3 -m tools.slides.build   the decks and an index.html
    ... --check                     fills in and checks the source, and stops
"""

import os
import re
import shutil
import subprocess
import sys

from tools.slides.course import course_table, unfilled
from tools.slides.deck import decks, for_students
from tools.slides.formulas import name_formulas
from tools.slides.index import index_page
from tools.slides.links import OWN, corner, without_links
from tools.slides.listing import colors, fill
from tools.slides.plans import Session, plans
from tools.tree import BUILD, ROOT, Failure
from tools.weave.figures import SLIDES, Figures, placed_names
from tools.weave.fonts import copy_fonts, faces
from tools.weave.formulas import check_formulas, formulas
from tools.weave.measured import with_ratios
from tools.weave.names import check_text
from tools.weave.offline import check_offline

HEAD = """---
marp: true
theme: lightwalk
math: mathjax
paginate: true
lang: en
title: {title}
footer: Lightwalk / {title}
---
"""


def figure(line, figures):
    """HTML for a line `{figure} name panels=1,2 height=300 labels=step`: the
    panels' labels appear at once, with their own step, or not at all
    (labels=none). Each panel of `later=2` appears with its own step."""
    name, *words = line.split()
    options = dict(word.split("=") for word in words)
    entry = figures.entry(name)
    files = figures.files(name)
    panels = entry.get("panels", [{}])
    numbers = [int(n) for n in options.get("panels", "").split(",") if n]
    shown, first = "", True
    labels = options.get("labels", "shown")
    later = options.get("later", "").split(",")
    for number in numbers or range(1, len(files) + 1):
        label = panels[number - 1].get("label", "")
        file, size = files[number - 1], options.get("height", "360")
        drawn = file.endswith(".svg")
        step = " data-marpit-fragment" * (str(number) in later)
        shown += (f'<div{" class=drawn" * drawn}{step}><img src="figures/{file}" '
                  f'alt="{entry["shows"]} {label}" '
                  f'style="{"max-" * drawn}height: {size}px">'
                  + panel_label(label, labels, first) + "</div>")
        first = False
    facts, _ = figures.facts(entry)
    facts = facts.replace("`", "")
    source = f'<p class="source">{facts}</p>' if facts else ""
    return f'<div class="figure">{shown}</div>\n{source}'


def panel_label(label, labels, first):
    """The label below a panel. Labels with a step all appear with the first."""
    if not label or labels == "none":
        return ""
    if labels == "shown":
        return f"<p>{label}</p>"
    return f"<p data-marpit-fragment>{label}</p>" if first else f"<p data-with-it>{label}</p>"


def woven(deck, figures, course):
    """The deck, or the session, as Marp's input."""
    slides = []
    for slide in deck.slides:
        check_text(slide.shown, slide.where)
        text = fill(slide.text, slide.where, "trap" in slide.kinds)
        text = with_ratios(text.replace("{course}", course), slide.where)
        text = OWN.sub("", text).rstrip("\n") + "\n\n" + corner(slide) + "\n"
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


def marp(source, *options):
    environment = dict(os.environ, CHROME_NO_SANDBOX="1")
    names = ("chromium", "google-chrome", "chromium-browser")
    chromium = next(filter(None, map(shutil.which, names)), None)
    if chromium:  # on other systems Marp finds it
        environment.setdefault("CHROME_PATH", chromium)
    run = subprocess.run(
        ["node", BUILD / "node/node_modules/@marp-team/marp-cli/marp-cli.js",
         "--no-config-file", "--no-stdin", "--html", "--theme-set",
         BUILD / "slides-source/theme.css", "--input-dir",
         BUILD / source, "--output", BUILD / "slides", *options],
        capture_output=True, text=True, env=environment)
    if run.returncode:
        if "No suitable browser" in run.stderr:
            raise Failure("PDFs need Chromium or Chrome, and neither was "
                            "found; `make setup-slides` installs it")
        said = [x for x in run.stderr.split("\n") if "ERROR" in x]
        raise Failure((said or [run.stderr.strip()])[0])


def main():
    source, made = BUILD / "slides-source", BUILD / "slides"
    shutil.rmtree(source, ignore_errors=True)
    figures = Figures(source / "figures")
    printed = BUILD / "slides-printed"  # no links on paper
    shutil.rmtree(printed, ignore_errors=True)
    every, course = decks(), course_table()
    figures.make(placed_names(SLIDES))
    for deck in every:
        deck.check()
        (source / f"{deck.name}.md").write_text(woven(deck, figures, course))
    of_plans = plans(every)
    sessions = [one for _, of_plan in of_plans for one in of_plan]
    for one in sessions:
        (source / f"{one.name}.md").write_text(woven(one, figures, course))
    check_formulas([formula for deck in every for slide in deck.slides
                    for formula in formulas(
                        slide.text, f"slides/{deck.path.name}", slide.line)])
    if "--check" in sys.argv[1:]:
        return
    shutil.rmtree(made, ignore_errors=True)
    (source / "theme.css").write_text(
        (ROOT / "slides/theme.css").read_text() + colors() + faces())
    marp(source)
    for deck in [*every, *sessions]:
        name_formulas(made / f"{deck.name}.html", deck)
    shutil.copytree(source / "figures", made / "figures")
    copy_fonts(source)
    shutil.copytree(source / "fonts", made / "fonts")
    shutil.copytree(source, printed)
    for one in sessions:
        (printed / f"{one.name}.md").unlink()
    for deck in every:
        slides = [for_students(slide) for slide in deck.slides]
        questions = Session(f"{deck.name}_questions", deck.title, slides, [])
        (printed / f"{questions.name}.md").write_text(woven(questions, figures, course))
    for path in printed.glob("*.md"):
        path.write_text(without_links(path.read_text()))
    marp(printed, "--pdf", "--pdf-notes", "--allow-local-files", "--pdf-outlines",
         "--pdf-outlines.pages=false")
    (made / "index.html").write_text(index_page(every, of_plans))
    check_offline(made)
    for line in unfilled():
        print(f"slides: slides/course.toml has no value yet for: {line}")
    print(f"The slides are {made}/index.html")


if __name__ == "__main__":
    try:
        main()
    except Failure as error:
        sys.exit(f"slides: {error}")
