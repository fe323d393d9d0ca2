"""The pages of mistakes: a gallery with pictures, and the catalog to search.

gallery.toml lists the mistakes with pictures. Each is a figure of two panels,
the right picture and the wrong one, which the program with the mistake renders.
"""

import re
import tomllib

from docutils.nodes import make_id

from tools.book.catalogue import diff_html, escaped
from tools.book.page import fenced
from tools.tree import ROOT, Failure, tests_filter

GALLERY = ROOT / "tools/book/gallery.toml"


def plain(text):
    """Plain text as MyST."""
    return re.sub(r"([\\`*_<\[\]$|^])", r"\\\1", text)


def raw(*lines):
    return fenced("raw", "html", list(lines), mark="`") if lines else []


def slug(heading):
    """As MyST names a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def figure_name(shown):
    return f"gallery-{shown['stage']}-{shown['name']}"


def figure_entry(shown):
    """The pair of pictures, as figures.toml has its figures."""
    return {
        "name": figure_name(shown),
        "file": "tools/book/gallery.toml",
        "caption": shown["look"],
        "shows": shown["title"] + ":",
        "exposure": "shared",
        "panels": [{"label": "right"}, {"label": "wrong", "mistake": shown["name"]}],
        **{key: shown[key] for key in ("stage", "scene", "options", "replace") if key in shown},
    }


def figure(shown, figures):
    """The pair of pictures, as the book has its figures."""
    lines = figures.myst(figure_name(shown), GALLERY, f"gallery.toml: {shown['name']}")
    place = next(i for i, line in enumerate(lines) if line.endswith("figure panels-2"))
    lines[place] += " compare"
    return lines


def card(entry, shown, figures):
    """A mistake with its pictures."""
    test = tests_filter([entry.mistake.caught_by])
    section = entry.section()
    words = [
        plain(entry.sentence),
        "",
        *fenced("code-block", "diff", entry.changed(context=1)[1], mark="`"),
        f"Caught by the test “{plain(entry.test)}”:",
        "",
        *fenced("code-block", "sh", [f"build/stage{shown['stage']}_tests -tc='{test}'"], mark="`"),
        f"In the chapter: [{plain(section)}]({entry.page('.md')}#{slug(section)})",
        "",
    ]
    pair = figure(shown, figures)
    return [
        *raw(*(f'<span id="{name}"></span>' for name in entry.anchors())),
        f"({entry.anchor})=",
        f"#### {shown['title']}",
        "",
        *fenced("container", "mistake", pair + fenced("container", "words", words, depth=5), depth=6),
    ]


def contact_sheet(pairs):
    """The wrong pictures, to find a mistake by its look: a row for each stage."""
    rows = []
    for stage in sorted({shown["stage"] for _, shown in pairs}):
        body = [f"Stage {stage}", ""]
        for entry, shown in pairs:
            if shown["stage"] == stage:
                picture = f"figures/gallery-{stage}-{shown['name']}-2.png"
                body += [f"[![]({picture}) {plain(shown['title'])}](#{entry.anchor})", ""]
        rows += fenced("container", "wrong", body, depth=4)
    return fenced("container", "contact-sheet", rows, depth=5)


def row(entry, last, pictured):
    """A row of a table, with a link to the pictures if there are any."""
    diff = entry.change[1]
    stage, section = entry.mistake.stage, entry.section()
    bare = "".join(f' id="{name}"' for name in entry.anchors())
    see = f' <a href="mistakes.html#{entry.anchor}">Pictures</a>' if pictured else ""
    return (
        f'<tr id="{entry.anchor}"><td>{stage}</td><td{bare}><p>{escaped(entry.sentence)}{see}</p>'
        f"<details><summary>The change <code>{entry.mistake.name}</code></summary>{diff_html(diff)}"
        f'<p>In the chapter: <a href="{entry.page(".html")}#{make_id(section)}">{escaped(section)}</a></p>'
        f"</details></td><td>{escaped(last)}</td></tr>"
    )


def table(what, heads, rows, kind=""):
    head = "".join(f'<th scope="col">{text}</th>' for text in heads)
    return raw(
        f'<table class="docutils mistakes{kind}" aria-label="{what}">',
        f"<thead><tr>{head}</tr></thead><tbody>",
        *rows,
        "</tbody></table>",
    )


def read_gallery(catalogue):
    """The entries with pictures, each with its table of gallery.toml, and the
    reasons why variants are right."""
    known = {entry.anchor: entry for entry in catalogue}
    read = tomllib.loads(GALLERY.read_text())
    pairs = []
    for shown in read["mistake"]:
        entry = known.get(f"stage{shown['stage']}-{shown['name']}")
        if not entry or entry.is_right:
            raise Failure(f"gallery.toml: stage {shown['stage']} has no mistake called '{shown['name']}'")
        pairs.append((entry, shown))
    variants = {entry.mistake.name for entry in catalogue if entry.is_right}
    for name in sorted(variants ^ read["why"].keys()):
        missing = "does not say why it is right" if name in variants else "is no variant that must pass"
        raise Failure(f"gallery.toml: '{name}' {missing}")
    return pairs, read["why"]


def mistakes_pages(figures, catalogue, pairs, why):
    """The lines of each page; no pages if there are no known mistakes."""
    if not catalogue:
        return {}
    wrong = [entry for entry in catalogue if not entry.is_right]
    right = [entry for entry in catalogue if entry.is_right]
    return {
        "mistakes": gallery_page(figures, pairs, len(wrong), len(right)),
        "known_mistakes": tables_page({entry.anchor for entry, _ in pairs}, wrong, right, why),
    }


def gallery_page(figures, pairs, wrong, right):
    cards = []
    for stage in sorted({shown["stage"] for _, shown in pairs}):
        cards += [f"### Stage {stage}", ""]
        for entry, shown in pairs:
            cards += card(entry, shown, figures) if shown["stage"] == stage else []
    return [
        *["---", "hide-toc: true", "---", ""],
        "# A gallery of mistakes",
        "",
        f"Does your picture look like one of these? Each of the {len(pairs)} was rendered by the "
        "program of its stage with one mistake in it. Choose a picture to see it beside the right "
        f"one, with the lines that cause it. All {wrong} known mistakes are "
        "[in a table](known_mistakes.md) that you can search, and so are "
        f"[{right} changes that are no mistakes](known_mistakes.md#changes-that-are-no-mistakes).",
        "",
        *contact_sheet(pairs),
        f"## {len(pairs)} mistakes that can be seen",
        "",
        "Both pictures of a pair have the same scene, the same options and the same exposure. A "
        "test finds each mistake sooner than the eye: its command is below the lines.",
        "",
        *cards,
    ]


def tables_page(pictured, wrong, right, why):
    return [
        *["---", "hide-toc: true", "---", ""],
        "# All known mistakes",
        "",
        f"[The gallery](mistakes.md) shows how {len(pictured)} of these look. "
        "Each was inserted into the right header, and the named test failed. Many pictures look "
        "alike, so search for what your code does or for the test that fails.",
        "",
        *table(
            "All known mistakes",
            ["Stage", "Mistake", "Test that catches it"],
            [row(entry, entry.test, entry.anchor in pictured) for entry in wrong],
            " caught",
        ),
        "## Changes that are no mistakes",
        "",
        "These look like mistakes and are right: the mean of a pixel stays the same, and the tests "
        "must pass with each of them. Only the noise, the time or the order of the random numbers "
        "may differ.",
        "",
        *table(
            "Changes that are no mistakes",
            ["Stage", "Change", "Why it is right"],
            [row(entry, why[entry.mistake.name], False) for entry in right],
        ),
    ]
