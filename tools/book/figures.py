"""The book's figures: with a caption, at the line that names them."""

import re
from collections import Counter

from tools.book.page import page_of
from tools.tree import ROOT, Failure
from tools.weave.figures import Figures

WIDEST_BESIDE = 4  # panels


def pages_depth(path):
    """How many folders the page of a header or of a page's source is down:
    stages/N_name, core/room/name, or index."""
    return page_of(path).count("/") if path.suffix == ".hpp" else 0


def picture(file, shows):
    """A picture; a drawing twice, for light and for dark pages."""
    if not file.endswith(".svg"):
        return [f"![{shows}]({file})"]
    versions = (("only-light", file), ("only-dark", file.replace(".svg", "-dark.svg")))
    return [
        line
        for kind, name in versions
        for line in (f":::{{image}} {name}", f":alt: {shows}", f":class: {kind}", ":::", "")
    ]


class PlacedFigures(Figures):
    def __init__(self, folder):
        super().__init__(folder)
        self.shown = {}
        self.counted = Counter()

    def number(self, path):
        """The next figure's number on the page, such as "3.4"; empty if the
        page is no chapter."""
        if path.suffix == ".md":
            return ""
        self.counted[path] += 1
        parts = path.relative_to(ROOT).parts
        stage = parts[1][0] + "." if parts[0] == "stages" else ""
        return f"{stage}{self.counted[path]}"

    def myst(self, name, path, where):
        """The figure on the page that is woven from the file at `path`."""
        entry = self.entry(name, where)
        if name in self.shown:
            raise Failure(f"{where}: figure '{name}' stands at {self.shown[name]} already")
        self.shown[name] = where
        up = "../" * pages_depth(path)
        files = self.files(name)
        panels = entry.get("panels", [{}])
        facts, commands = self.facts(entry)
        live = f" live-{name}" if entry.get("live") else ""
        lines = [f"({name})=", "", f":::::{{container}} figure panels-{len(files)}{live}"]
        for file, panel in zip(files, panels):
            label = panel.get("label", "")
            shows = f"{entry['shows']} {label}".strip()
            lines += ["::::{container} panel", *picture(f"{up}figures/{file}", shows), "", label, "::::"]
        number = self.number(path)
        caption = (f"**Figure {number}.** " if number else "") + entry["caption"].strip()
        lines += ["::::{container} caption", caption, ""]
        if facts:
            lines += [f"Made with {facts}.", ""]
        if commands:
            lines += [
                ":::{dropdown} The commands" if len(commands) > 1 else ":::{dropdown} The command",
                "```sh",
                *commands,
                "```",
                ":::",
            ]
        return lines + ["::::", ":::::", ""]

    def is_wide(self, name, where):
        """Whether it needs more than the column beside the prose."""
        return len(self.entry(name, where).get("panels", [])) > WIDEST_BESIDE

    def filled(self, page):
        """The page's text with its lines `{figure} name` replaced."""

        def made(match):
            return "\n".join(self.myst(match[1], page, page.relative_to(ROOT)))

        return re.sub(r"^\{figure\} (\S+)$", made, page.read_text(), flags=re.M)
