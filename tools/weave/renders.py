"""A picture of a figure: one run of a stage.

It is cached under the hash of the program, the scene and the options, so the
same picture is rendered only once.
"""

import hashlib
import json
import re
import shlex
import shutil
import tempfile
import threading
import tomllib
from collections import defaultdict
from pathlib import Path

from tools.tree import BUILD, ROOT, Failure, render
from tools.weave import mistaken

WORDS = {
    "--spp": "{} samples per pixel",
    "--max-bounces": "{} bounces",
    "--seed": "seed {}",
    "--sampling": "{} sampling",
    "--size": "{} pixels",
    "--tone-map": "tones by {}",
}
CACHE = BUILD / "figures/cache"
ONE = {"1 samples per pixel": "1 sample per pixel", "1 bounces": "1 bounce"}


class Spent(threading.local):
    """The cost of this thread's renders, in seconds of processor time."""

    seconds = 0.0


spent = Spent()
in_work = defaultdict(threading.Lock)  # by key: no two threads make the same render


class Render:
    """One run of a stage: a picture, or the rays that a sample took."""

    def __init__(self, stage, scene, options, replace=(), mistake=None):
        self.stage, self.scene, self.mistake = stage, scene, mistake
        self.options = options + ["--seed", "1"] * ("--seed" not in options)
        self.text = (ROOT / scene).read_text()
        self.changes = []
        for old, new in zip(replace[::2], replace[1::2]):
            if old not in self.text:
                raise Failure(f"figures.toml: '{old}' is not in {scene}")
            self.text = self.text.replace(old, new)
            self.changes.append(f"`{new}`")

    def program(self):
        if self.mistake:
            return mistaken.program(self.stage, self.mistake)
        program = BUILD / f"stage{self.stage}"
        if not program.is_file():
            raise Failure(f"{program} has not been built")
        return program

    def images(self):
        return re.findall(r'image = "(.*?)"', self.text)

    def key(self):
        if self.mistake:  # known before the program is there
            digest = hashlib.sha256(mistaken.digest(self.stage, self.mistake).encode())
        else:
            digest = hashlib.sha256(self.program().read_bytes())
        digest.update(self.text.encode())
        for name in self.images():
            digest.update(((ROOT / self.scene).parent / name).read_bytes())
        digest.update("\0".join(self.options).encode())
        return digest.hexdigest()[:20]

    def files(self, *suffixes):
        """The render as files of these kinds, made if missing, and its report."""
        key = self.key()
        made = [CACHE / (key + suffix) for suffix in (*suffixes, ".json")]
        with in_work[key]:
            if not all(path.exists() for path in made):
                try:
                    self.make(key, suffixes)
                except Failure as failure:
                    raise Failure(f"figures.toml: {self.command()}: {failure}") from None
        return made

    def make(self, key, suffixes):
        """Writes the cache's files, each whole or not at all."""
        CACHE.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=CACHE) as name:
            folder = Path(name)
            scene = ROOT / self.scene
            if self.changes:
                scene = folder / "scene.toml"
                scene.write_text(self.text)
                for image in self.images():  # a scene reads images from its folder
                    (folder / image).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy((ROOT / self.scene).parent / image, folder / image)
            images = [folder / (key + suffix) for suffix in suffixes]
            more = [word for image in images[1:] for word in ("-o", image)]
            report = render(self.program(), scene, images[0], *more, *self.options)
            spent.seconds += report["cpu_seconds"]
            said = folder / f"{key}.json"
            said.write_text(json.dumps(report))
            for made in (*images, said):
                made.replace(CACHE / made.name)

    def picture(self):
        return self.files(".png")[0]

    def rays_per_sample(self):
        # A .pfm does not load the image library, which takes longer than the render.
        return json.loads(self.files(".pfm")[1].read_text())["rays_per_sample"]

    def facts(self):
        """The facts of the run for a caption: [stage, scene, samples, bounces, ...]."""
        facts = [f"stage {self.stage}", f"`{self.scene}`"]
        if self.changes:
            facts.append("with " + ", ".join(self.changes))
        if self.mistake:
            facts.append(f"the mistake *{self.mistake}*")
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
        program = [f"build/stage{self.stage}"]
        if self.mistake:
            program = ["python3", "-m", "tools.weave.mistaken", f"{self.stage}/{self.mistake}"]
        return shlex.join([*program, self.scene, "-o", "picture.png", *self.options])
