"""The figures of the book and the slides: a chapter's figures.toml lists its
figures, and its drawings.py draws some of them. The files of these names beside
this one have the figures outside the chapters."""

import importlib
import os
import re
import shutil
import tomllib
from concurrent.futures import ThreadPoolExecutor, as_completed

from tools.tree import ROOT, Failure
from tools.weave.drawing import draw
from tools.weave.fonts import with_letters
from tools.weave.mistaken import build_programs
from tools.weave.png import strip_curve
from tools.weave.renders import Render, spent

REFERENCE = re.compile(r"!\[\]\(([\w-]+)\)$")
PLACE = re.compile(r"^// !\[\]\(([\w-]+)\)$|^\{figure\} (\S+)", re.M)
BOOK = ("stages/**/*.hpp", "common/**/*.hpp", "tools/book/pages/*.md")
SLIDES = ("slides/*.md",)
FOLDERS = ("tools/weave", "stages/*")
# A render uses all processors, except at its start and its end.
MOST_AT_ONCE = 4


def figure_reference(line, where):
    """The name of the figure that this line of prose places, or None."""
    found = REFERENCE.match(line)
    if "![" in line and not found:
        raise Failure(f"{where}: a figure is a line by itself, '// ![](name)'")
    return found[1] if found else None


def placed_names(patterns):
    """The names of the figures that these headers, pages or slides show."""
    texts = [path.read_text() for pattern in patterns for path in ROOT.glob(pattern)]
    return {match[1] or match[2] for text in texts for match in PLACE.finditer(text)}


def of_all_folders(name):
    """The files of this name, with their names in messages."""
    for folder in FOLDERS:
        for path in sorted(ROOT.glob(f"{folder}/{name}")):
            yield path, path.relative_to(ROOT).as_posix()


def read_entries():
    """The entries of all figures.toml, by the figures' names; `file` names the file."""
    found = {}
    for path, file in of_all_folders("figures.toml"):
        for entry in tomllib.loads(path.read_text())["figure"]:
            name = entry["name"]
            if name in found:
                raise Failure(f"{file}: '{name}' stands in {found[name]['file']} already")
            found[name] = entry | {"file": file}
    return found


def load_drawings():
    """Imports all drawings.py: `diagram` of drawing.py registers their functions."""
    for _, file in of_all_folders("drawings.py"):
        importlib.import_module(file.removesuffix(".py").replace("/", "."))


def one_exposure(entry, options):
    """The options that show the same radiance the same in all panels: no step may
    depend on the picture's own maximum, as `equalize` does."""
    where = f"{entry['file']}: {entry['name']}"
    if entry["exposure"] != "shared":
        raise Failure(f'{where}: exposure is "shared" or not there')
    for panel in entry["panels"]:
        for option in ("--tone-map", "--exposure", "--gamma"):
            if option in panel.get("options", ""):
                raise Failure(f"{where}: a panel has {option}, and the exposure is shared")
    if "--tone-map" not in options:
        return [*options, "--tone-map", "clamp,gamma"]
    if "equalize" in options[options.index("--tone-map") + 1]:
        raise Failure(f"{where}: equalize gives each panel an exposure of its own")
    return options


class Figures:
    def __init__(self, folder):
        self.folder = folder
        self.folder.mkdir(parents=True, exist_ok=True)
        self.made = {}
        self.entries = read_entries()
        placed = placed_names(BOOK + SLIDES)
        for name, entry in self.entries.items():
            if name not in placed:
                raise Failure(f"{entry['file']}: no chapter, page or slide shows '{name}'")
        load_drawings()

    def entry(self, name, where=""):
        if name not in self.entries:
            raise Failure((f"{where}: " if where else "") + f"figure '{name}' is in no figures.toml")
        return self.entries[name]

    def renders(self, entry):
        shared = entry.get("options", "").split()
        if "exposure" in entry:
            shared = one_exposure(entry, shared)
        return [
            Render(
                panel.get("stage", entry.get("stage")),
                panel.get("scene", entry.get("scene")),
                shared + panel.get("options", "").split(),
                [*entry.get("replace", ()), *panel.get("replace", ())],
                panel.get("mistake"),
            )
            for panel in entry.get("panels", [])
        ]

    def make(self, names):
        """Makes these figures, several at a time, and prints a line for each that
        takes time. Ignores unknown names: `entry` reports them."""
        entries = [self.entries[name] for name in sorted(names) if name in self.entries]
        renders = [render for entry in entries for render in self.renders(entry)]
        wrong = [(render.stage, render.mistake) for render in renders if render.mistake]
        build_programs(wrong, lambda line: print(line, flush=True))

        def make_one(name):
            spent.seconds = 0
            self.files(name)
            return name, spent.seconds

        pool = ThreadPoolExecutor(min(MOST_AT_ONCE, os.cpu_count()))
        try:
            for one in as_completed([pool.submit(make_one, entry["name"]) for entry in entries]):
                name, seconds = one.result()
                if seconds:
                    print(f"{name}: {seconds:.1f} s of processor time", flush=True)
        finally:
            pool.shutdown(cancel_futures=True)

    def files(self, name):
        """Makes the figure's pictures in `folder`, and returns their names."""
        if name not in self.made:
            self.made[name] = self.draw_or_render(name)
        return self.made[name]

    def draw_or_render(self, name):
        entry = self.entry(name)
        if "beside" in entry:  # listings
            return []
        if "panels" not in entry:
            light, dark = draw(name)
            (self.folder / f"{name}.svg").write_text(with_letters(light))
            (self.folder / f"{name}-dark.svg").write_text(with_letters(dark))
            return [f"{name}.svg"]
        made = []
        for number, render in enumerate(self.renders(entry), 1):
            file = f"{name}-{number}.png"
            shutil.copy(render.picture(), self.folder / file)
            if entry["panels"][number - 1].get("bare"):
                strip_curve(self.folder / file)
            made.append(file)
        return made

    def facts(self, entry):
        """The facts that all panels share, and their commands."""
        renders = self.renders(entry)
        if not renders:
            return "", []
        lists = [render.facts() for render in renders]
        shared = [f for f in lists[0] if all(f in other for other in lists)]
        return ", ".join(shared), [render.command() for render in renders]
