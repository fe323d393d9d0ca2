"""The known mistakes of tests/mistakes/stageN.toml, as the book shows them."""

import difflib
import functools
import html
import re
import textwrap
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

from tests.mistakes.mistakes import CATALOGUE, Mistake, changed_header, read_mistakes
from tools.book.page import page_of
from tools.tree import stage_headers, test_names


@dataclass
class Entry:
    """One mistake, or a correct variant."""

    mistake: Mistake
    header: Path
    test: str  # the full name of the test that catches it
    first: bool  # no earlier stage has one of this name

    @property
    def anchor(self):
        return f"stage{self.mistake.stage}-{self.mistake.name}"

    @property
    def sentence(self):
        return " ".join(self.mistake.sentence.split())

    @property
    def is_right(self):
        return self.mistake.verdict == "pass"

    def anchors(self):
        """More anchors of this entry: only one entry can have the bare name."""
        return [self.mistake.name] * self.first

    def changed(self, context=0):
        """The number of the first changed line, and the diff's lines."""
        old = self.header.read_text().split("\n")
        new = changed_header(self.mistake, SimpleNamespace(header=self.header)).split("\n")
        diff = list(difflib.unified_diff(old, new, lineterm="", n=context))[2:]
        first = int(re.match(r"@@ -(\d+)", diff[0])[1])
        lines = [x for x in diff if not re.match(r" *// #", x)]  # regions and stubs
        code = textwrap.dedent("\n".join(x[1:] for x in lines if x[0] != "@")).split("\n")
        found = []
        for line in lines:
            if line[0] != "@":
                found.append(f"{line[0]} {code.pop(0)}".rstrip())
            elif found:
                found.append("  ...")
        return first, found

    @functools.cached_property
    def change(self):
        """`changed` without context lines, which several parts of the page need."""
        return self.changed()

    def section(self):
        """The heading of the chapter above the change."""
        lines = self.header.read_text().split("\n")[: self.change[0]]
        return next(m[1] for line in lines[::-1] if (m := re.match(r"// #{1,3} (.*)", line)))

    def page(self, suffix):
        return page_of(self.header) + suffix


def read_catalogue():
    """All entries, stage by stage."""
    found, seen = [], set()
    for header in stage_headers():
        stage = header.parent.name[0]
        path = CATALOGUE / f"stage{stage}.toml"
        tests = test_names(f"stage{stage}")
        for mistake in read_mistakes(path) if path.exists() else []:
            begin = mistake.caught_by
            test = next((t for t in tests if begin and t.startswith(begin)), begin)
            found.append(Entry(mistake, header, test, mistake.name not in seen))
            seen.add(mistake.name)
    return found


def escaped(text):
    """Plain text as HTML, with typographic quotes."""
    return html.escape(text, quote=False).replace("'", "’")


def diff_html(lines):
    tags = {"-": "del", "+": "ins"}
    made = []
    for line in lines:
        tag, text = tags.get(line[0]), html.escape(line, quote=False)
        made.append(f"<{tag}>{text}</{tag}>" if tag else text)
    return '<pre class="diff">' + "\n".join(made) + "</pre>"
