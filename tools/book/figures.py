"""The figures of the book and the slides, rendered by the stages themselves.

    figures.py BUILD      renders what is not in BUILD/figures yet

A picture is kept under the hash of the program, the scene and the options it
was made with, so one that would come out the same costs nothing.
"""

import hashlib
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import diagrams
import diagrams_of_paths  # noqa: F401, registers its own
from literate import ROOT, BookError

HERE = Path(__file__).parent
WORDS = {"--spp": "{} samples per pixel", "--max-bounces": "{} bounces",
         "--seed": "seed {}", "--sampling": "{} sampling",
         "--size": "{} pixels", "--tone-map": "tones by {}"}
ONE = {"1 samples per pixel": "1 sample per pixel", "1 bounces": "1 bounce"}


class Render:
    """One run of a stage: a picture, or the rays that a sample took."""

    def __init__(self, build, stage, scene, options, replace=()):
        self.build, self.stage, self.scene = build, stage, scene
        self.options = options + ["--seed", "1"]
        self.text = (ROOT / scene).read_text()
        self.changes = []
        for old, new in zip(replace[::2], replace[1::2]):
            if old not in self.text:
                raise BookError(f"figures.toml: '{old}' is not in {scene}")
            self.text = self.text.replace(old, new)
            self.changes.append(f"`{new}`")

    def key(self):
        program = self.build / f"stage{self.stage}"
        if not program.is_file():
            raise BookError(f"{program} has not been built")
        digest = hashlib.sha256(program.read_bytes())
        digest.update(self.text.encode())
        for picture in re.findall(r'image = "(.*?)"', self.text):
            path = (ROOT / self.scene).parent / picture
            digest.update(path.read_bytes())
        digest.update("\0".join(self.options).encode())
        return digest.hexdigest()[:20]

    def run(self, suffix):
        """The picture's file, made if need be; what was said is beside it."""
        cache = self.build / "figures/cache"
        cache.mkdir(parents=True, exist_ok=True)
        made = cache / f"{self.key()}{suffix}"
        if made.exists():
            return made
        scene = ROOT / self.scene
        if self.changes:
            scene = cache / f"{self.key()}.toml"
            scene.write_text(self.text)
        command = [self.build / f"stage{self.stage}", scene, "-o", made,
                   *self.options]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode:
            raise BookError(f"figures.toml: {shlex.join(map(str, command))}: "
                            f"{run.stderr.strip()}")
        made.with_suffix(".txt").write_text(run.stderr + run.stdout)
        return made

    def rays_per_sample(self):
        said = self.run(".png").with_suffix(".txt").read_text()
        return float(re.search(r"([\d.e+]+) rays per sample", said)[1])

    def facts(self):
        """What a caption says of the run: {scene, samples, bounces, ...}."""
        facts = [f"stage {self.stage}", f"`{self.scene}`"]
        if self.changes:
            facts.append("with " + ", ".join(self.changes))
        given = dict(zip(self.options[::2], self.options[1::2]))
        settings = tomllib.loads(self.text).get("render", {})
        if "--spp" not in given:
            given["--spp"] = settings.get("samples_per_pixel", 64)
        if "--max-bounces" not in given and self.stage < 4:
            given["--max-bounces"] = settings.get("max_bounces", 8)
        for option, words in WORDS.items():
            if option in given:
                fact = words.format(given[option])
                facts.append(ONE.get(fact, fact))
        if "--max-bounces" not in given:
            facts.append("no bound on the bounces")
        return facts

    def command(self):
        return shlex.join([f"build/stage{self.stage}", self.scene, "-o",
                           "picture.png", *self.options])


class Figures:
    def __init__(self, build, folder):
        self.build, self.folder = build, folder
        self.folder.mkdir(parents=True, exist_ok=True)
        entries = tomllib.loads((HERE / "figures.toml").read_text())["figure"]
        self.entries = {entry["name"]: entry for entry in entries}
        if len(self.entries) != len(entries):
            raise BookError("figures.toml: a name stands there twice")
        self.taken = {}

    def entry(self, name):
        if name not in self.entries:
            raise BookError(f"figure '{name}' is not in figures.toml")
        return self.entries[name]

    def renders(self, entry):
        return [Render(self.build, panel.get("stage", entry.get("stage")),
                       panel.get("scene", entry.get("scene")),
                       (entry.get("options", "") + " "
                        + panel.get("options", "")).split(),
                       [*entry.get("replace", ()),
                        *panel.get("replace", ())])
                for panel in entry.get("panels", [])]

    def files(self, name):
        """Makes the figure's pictures in `folder`, and returns their names."""
        entry = self.entry(name)
        if "panels" not in entry:
            drawing = diagrams.draw(name, self)
            (self.folder / f"{name}.svg").write_text(drawing)
            return [f"{name}.svg"]
        made = []
        for number, render in enumerate(self.renders(entry), 1):
            file = f"{name}-{number}.png"
            shutil.copy(render.run(".png"), self.folder / file)
            made.append(file)
        return made

    def facts(self, entry):
        """What all panels share, and their commands."""
        renders = self.renders(entry)
        if not renders:
            return "", []
        lists = [render.facts() for render in renders]
        shared = [f for f in lists[0] if all(f in other for other in lists)]
        return ", ".join(shared), [render.command() for render in renders]

    def myst(self, name, up=""):
        entry = self.entry(name)
        files = self.files(name)
        panels = entry.get("panels", [{}])
        facts, commands = self.facts(entry)
        lines = [f"({name})=", "",
                 f"::::::{{container}} figure panels-{len(files)}"]
        for file, panel in zip(files, panels):
            label = panel.get("label", "")
            lines += [":::::{container} panel",
                      f"![{entry['shows']} {label}]({up}figures/{file})", "",
                      label, ":::::"]
        lines += [":::::{container} caption", entry["caption"].strip(), ""]
        if facts:
            lines += [f"Made with {facts}.", ""]
        if commands:
            lines += ["::::{dropdown} The commands" if len(commands) > 1
                      else "::::{dropdown} The command", "```sh", *commands,
                      "```", "::::"]
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
            raise BookError(f"figures.toml: chapter {chapter} has no region "
                            f"nor section '{place}'")

    def filled(self, text):
        """The page with its lines `{figure} name` replaced."""
        return re.sub(r"^\{figure\} (\S+)$",
                      lambda m: "\n".join(self.myst(m[1])), text, flags=re.M)


if __name__ == "__main__":
    try:
        build = Path(sys.argv[1]).resolve()
        figures = Figures(build, build / "figures")
        for figure in figures.entries:
            figures.files(figure)
    except BookError as error:
        sys.exit(f"figures: {error}")
