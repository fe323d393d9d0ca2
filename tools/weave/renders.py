"""A picture of a figure: one run of a stage.

It is kept under the hash of the program, the scene and the options, so one
that would come out the same costs nothing.
"""

import hashlib
import json
import re
import shlex
import shutil
import tomllib

from compare.stages import BUILD, ROOT, Failure, render
from tools.weave import mistaken

WORDS = {
    "--spp": "{} samples per pixel",
    "--max-bounces": "{} bounces",
    "--seed": "seed {}",
    "--sampling": "{} sampling",
    "--size": "{} pixels",
    "--tone-map": "tones by {}",
}
ONE = {"1 samples per pixel": "1 sample per pixel", "1 bounces": "1 bounce"}


class Render:
    """One run of a stage: a picture, or the rays that a sample took."""

    def __init__(self, stage, scene, options, replace=(), mistake=None):
        self.stage, self.scene, self.mistake = stage, scene, mistake
        self.options = options + ["--seed", "1"]
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
        program = self.program()
        digest = hashlib.sha256(program.read_bytes())
        digest.update(self.text.encode())
        for name in self.images():
            digest.update(((ROOT / self.scene).parent / name).read_bytes())
        digest.update("\0".join(self.options).encode())
        return digest.hexdigest()[:20]

    def picture(self):
        """The picture's file, made if need be; its report is beside it."""
        cache = BUILD / "figures/cache"
        cache.mkdir(parents=True, exist_ok=True)
        made = cache / f"{self.key()}.png"
        if made.with_suffix(".json").exists():
            return made
        scene = ROOT / self.scene
        if self.changes:
            scene = made.with_suffix(".toml")
            scene.write_text(self.text)
            for name in self.images():  # a scene reads what lies beside it
                (cache / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy((ROOT / self.scene).parent / name, cache / name)
        try:
            report = render(self.program(), scene, made, *self.options)
        except Failure as failure:
            raise Failure(f"figures.toml: {self.command()}: {failure}") from None
        made.with_suffix(".json").write_text(json.dumps(report))
        return made

    def rays_per_sample(self):
        report = self.picture().with_suffix(".json")
        return json.loads(report.read_text())["rays_per_sample"]

    def facts(self):
        """What a caption says of the run: {scene, samples, bounces, ...}."""
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
