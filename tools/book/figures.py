"""The book's figures: with a caption, at the line that names them."""

import re
import textwrap
from collections import Counter
from pathlib import PurePath

from tools.book.page import page_of
from tools.tree import ROOT, Failure
from tools.weave.figures import Figures
from tools.weave.literate import region

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


def parts(reference, first):
    """A region's lines from the comment `first` to the end of its block: {comment:
    its lines}, without the indent."""
    found, name, indent = {}, None, ""
    for line in region(reference).lines:
        if line.strip() == first:
            indent = line[: -len(first)]
        if found and line.strip() and not line.startswith(indent):
            break
        if line.strip().startswith("// ") and (found or line.strip() == first):
            name = line.strip()
            found[name] = []
        if name:
            found[name].append(line)
    return {name: textwrap.dedent("\n".join(lines)).strip().split("\n") for name, lines in found.items()}


def listings_beside(entry):
    """Two regions of code with the same comments, part beside part."""
    left, right = (parts(reference, entry["first"]) for reference in entry["beside"])
    if list(left) != list(right):
        raise Failure(
            f"{entry['file']}: {entry['name']}: the comments of {' and '.join(entry['beside'])} differ"
        )
    for reference in entry["beside"]:
        yield from ["::::{container} half", f"**{reference.replace('#', ', ')}**", "::::"]
    for name in left:
        for lines in (left[name], right[name]):
            yield from ["::::{container} half", "```{code-block} cpp", "", *lines, "```", "::::"]


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
        files = [] if "beside" in entry else self.files(name)
        panels = entry.get("panels", [{}])
        facts, commands = self.facts(entry)
        live = f" live-{name}" if entry.get("live") else ""
        kind = "beside" if "beside" in entry else f"panels-{len(files)}"
        lines = [f"({name})=", "", f":::::{{container}} figure {kind}{live}"]
        lines += listings_beside(entry) if "beside" in entry else []
        for file, panel in zip(files, panels):
            label = panel.get("label", "")
            shows = f"{entry['shows']} {label}".strip()
            scene = PurePath(panel.get("scene", entry.get("scene", ""))).stem.replace("_", "-")
            lines += [
                f"::::{{container}} panel {scene and f'scene-{scene}'}".rstrip(),
                *picture(f"{up}figures/{file}", shows),
                "",
                label,
                "::::",
            ]
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
        entry = self.entry(name, where)
        return "beside" in entry or len(entry.get("panels", [])) > WIDEST_BESIDE

    def filled(self, page):
        """The page's text with its lines `{figure} name` replaced."""

        def made(match):
            return "\n".join(self.myst(match[1], page, page.relative_to(ROOT)))

        return re.sub(r"^\{figure\} (\S+)$", made, page.read_text(), flags=re.M)
