"""Figures as the book has them: with a caption, in the place that they name."""

import re

from compare.stages import Failure
from tools.weave.figures import Figures


class PlacedFigures(Figures):
    def __init__(self, folder):
        super().__init__(folder)
        self.taken = {}

    def myst(self, name, up=""):
        entry = self.entry(name)
        files = self.files(name)
        panels = entry.get("panels", [{}])
        facts, commands = self.facts(entry)
        lines = [f"({name})=", "", f"::::::{{container}} figure panels-{len(files)}"]
        for file, panel in zip(files, panels):
            label = panel.get("label", "")
            lines += [
                ":::::{container} panel",
                f"![{entry['shows']} {label}]({up}figures/{file})",
                "",
                label,
                ":::::",
            ]
        lines += [":::::{container} caption", entry["caption"].strip(), ""]
        if facts:
            lines += [f"Made with {facts}.", ""]
        if commands:
            lines += [
                "::::{dropdown} The commands" if len(commands) > 1 else "::::{dropdown} The command",
                "```sh",
                *commands,
                "```",
                "::::",
            ]
        return lines + [":::::", "::::::", ""]

    def for_chapter(self, chapter):
        """Figures of a chapter by the region or section that they are at."""
        places = {}
        for name, entry in self.entries.items():
            if entry.get("chapter") == chapter:
                place = entry.get("after") or entry["beside"]
                places.setdefault(place, []).extend(self.myst(name, "../"))
        self.taken[chapter] = places
        return places

    def all_placed(self, chapter):
        for place in self.taken[chapter]:
            raise Failure(f"figures.toml: chapter {chapter} has no region nor section '{place}'")

    def filled(self, text):
        """The page with its lines `{figure} name` replaced."""
        return re.sub(r"^\{figure\} (\S+)$", lambda m: "\n".join(self.myst(m[1])), text, flags=re.M)
