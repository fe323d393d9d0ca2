"""What all submissions of a stage share, made once: the suite's objects, the core's,
the program's, and the pictures of the reference."""

import functools
import hashlib
import json
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from tests.mistakes.mistakes import Command, Suite, link_command
from tools.exercises.compiler import build
from tools.exercises.marks import marks
from tools.exercises.sheet import read_tasks
from tools.grading import sandbox
from tools.tree import BUILD, ROOT, SCENES, Failure, program_path, write_whole

# What a handout's headers include, and this tree's do not.
HANDED_OUT = ROOT / "tools/handout/tree"
# Of a picture that is compared: a student's samples, and the reference's.
SIZE, SAMPLES, REFERENCE_SAMPLES = 64, 64, 1024


@dataclass(frozen=True)
class Picture:
    """A scene that the student's program renders, and the reference's picture of it."""

    name: str
    scene: Path
    options: tuple
    reference: Path


class Workshop:
    """How to build a stage's suite and program with another header."""

    def __init__(self, stage, hidden=None):
        sandbox.check()
        self.stage = stage
        said, made = build(f"stage{stage}_tests", f"stage{stage}", "stage-diff")
        if not made:
            raise Failure(f"the reference does not build: {said[-500:]}")
        self.suite = Suite(stage)
        self.header = self.suite.header
        self.main = Command(f"stage{stage}", "main.cpp")
        self.link = link_command(f"stage{stage}", self.suite.folder)
        self.folder = BUILD / "class" / "shared" / f"stage{stage}"
        self.folder.mkdir(parents=True, exist_ok=True)
        self.pictures = [*self.goldens(), *self.hidden(hidden)]
        if any("photons" in one for one in self.entries()):
            self.pictures = []  # pixels that share photons are wrong together: no test of noise holds
            if hidden:
                raise Failure(f"HIDDEN={hidden}: the pictures of stage {stage} are not compared")
        self.key = self.hash()
        self.make()

    def goldens(self):
        """The scenes of the stage's golden images; the goldens themselves stay here."""
        for one in self.entries():
            bounds = ["--max-bounces", str(one["max_bounces"])] if "max_bounces" in one else []
            yield self.picture(SCENES / f"{one['scene']}.toml", bounds)

    def entries(self):
        """Those of the stage's golden images."""
        goldens = tomllib.loads((ROOT / "tests/golden/goldens.toml").read_text())["golden"]
        return [one for one in goldens if one["stage"] == self.stage]

    def hidden(self, folder):
        """The instructor's own scenes."""
        if folder and not folder.is_dir():
            raise Failure(f"HIDDEN={folder}: there is no such folder")
        for scene in sorted(folder.glob("*.toml")) if folder else ():
            yield self.picture(scene.resolve(), [])

    def picture(self, scene, bounds):
        options = (*bounds, "--size", f"{SIZE}x{SIZE}", "--quiet")
        text = scene.read_bytes() + repr((options, REFERENCE_SAMPLES, self.suite.given_key)).encode()
        text += self.header.read_bytes()
        name = f"{scene.stem}-{hashlib.sha256(text).hexdigest()[:12]}.pfm"
        return Picture(scene.stem, scene, options, self.folder / name)

    def hash(self):
        """Of all that a verdict depends on, but the submission."""
        whole = hashlib.sha256(self.suite.key(self.header.read_text()).encode())
        for path in sorted([*Path(__file__).parent.glob("*"), *(ROOT / "tools/exercises").glob("*.py")]):
            if path.is_file():
                whole.update(path.read_bytes())
        whole.update(self.header.with_name("exercises.toml").read_bytes())
        for one in self.pictures:
            whole.update(repr((one.name, one.options)).encode() + one.reference.name.encode())
        return whole.hexdigest()

    def make(self):
        """What is not there yet, or is not of today's tree. Each file appears whole."""
        note = self.folder / "made.json"
        if not note.exists() or json.loads(note.read_text()) != self.key:
            seal = Path(__file__).with_name("seal.cpp")
            self.suite.tests.run(seal, self.folder / "seal.o")
            declared = BUILD / "tests/generated/declared"
            self.main.run(self.main.source, self.folder / "main.o", [f"-I{declared}"])
            write_whole(note, json.dumps(self.key))
        for one in self.pictures:
            if not one.reference.exists():
                self.render_reference(one)

    def render_reference(self, one):
        made = one.reference.with_name("new-" + one.reference.name)
        command = [program_path(f"stage{self.stage}"), one.scene, "-o", made, *one.options]
        done = subprocess.run(
            [*command, "--spp", str(REFERENCE_SAMPLES), "--seed", "1"], capture_output=True, text=True
        )
        if done.returncode:
            raise Failure(f"{one.scene}: {done.stderr.strip()}")
        made.replace(one.reference)

    @functools.cached_property
    def tasks(self):
        """{number: (title, task)} of the exercises."""
        titles = {one.number: one.title for one in marks(self.header)}
        return {number: (titles[number], task) for number, task in read_tasks(self.header).items()}

    @functools.cache
    def tests_of(self, options):
        """The names of the tests that the reference runs with these options."""
        program = program_path(f"stage{self.stage}_tests")
        command = [program, *options, "-ltc", "-r=xml"]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return [one.get("name") for one in ElementTree.fromstring(said).iter("TestCase")]

    def libraries(self):
        """What a program loads from the build folder."""
        return list(BUILD.glob("*.so"))

    def compiler_reads(self):
        """What the compiler needs: the core, the earlier stages, what both have in a
        precompiled header. No solution of this stage, no test, no golden."""
        stages = [path for path in ROOT.glob("stages/*") if path.name[0] < self.header.parent.name[0]]
        own = [path for path in self.header.parent.iterdir() if path.is_dir()]
        given = [ROOT / "common", HANDED_OUT, *stages, *ROOT.glob("stages/*.hpp"), *own, ROOT / "third_party"]
        return [path for path in (*given, BUILD / "tests/CMakeFiles/core_of_stages.dir") if path.exists()]

    def split(self, folder):
        """Splits the header of a folder; returns its code, and whether the shared objects
        of the tests fit it."""
        code = self.suite.split(folder)
        mine = (folder / "declared" / self.suite.name).read_text(errors="replace").splitlines()
        given = self.suite.declared.read_text(errors="replace").splitlines()
        return code, only_adds(mine, given)

    def compiling(self, source, target):
        return self.suite.code.words_for(source, target, [f"-I{HANDED_OUT}"])

    def compiling_anew(self, declared, suite, main):
        """The tests and the program's main file with what a header declares, where that is
        not what they were compiled with."""
        options = [f"-I{declared}", f"-I{HANDED_OUT}"]
        yield self.suite.tests.words_for(self.suite.tests.source, suite, options)
        yield self.main.words_for(self.main.source, main, options)

    def test_reads(self):
        """What the tests are compiled from: no solution, no golden."""
        made, suite = BUILD / "tests", f"stage{self.stage}"
        paths = [
            made / "generated/declared",
            made / "generated" / suite,
            made / f"CMakeFiles/{suite}_tests.dir",
        ]
        tests = [path for path in (ROOT / "tests").iterdir() if path.name != "golden"]
        return [*paths, self.main.source, *tests]

    def linking_tests(self, code, suite, target):
        """The suite, with the student's code, and with the tests where they were compiled
        anew. The seal is linked first."""
        objects, gone = [self.folder / "seal.o", code], [f"stage{self.stage}_header.dir/"]
        if suite:
            objects.append(suite)
            gone.append(f"stage{self.stage}_tests.dir/")
        return relinked(self.suite.link, objects, gone, target)

    def linking_program(self, code, main, target):
        return relinked(self.link, [main, code], [f"stage{self.stage}.dir/"], target)

    def read_by(self, words):
        """The files that a link reads."""
        paths = {self.suite.folder / word for word in words if word.endswith((".o", ".a", ".so"))}
        return [path for path in paths if path.exists() and not path.is_relative_to("/usr")]


def relinked(link, objects, gone, target):
    """A link's words with these objects first, and without those that they replace."""
    words = [word for word in link if not any(name in word for name in gone)]
    place = words.index("-o")
    return [words[0], *map(str, objects), *words[1:place], "-o", target, *words[place + 2 :]]


def only_adds(mine, given):
    """Whether a header declares all that the given one does, in this order, and what it
    adds is a function or a constant of the namespace: then objects that were compiled
    with the given one fit."""
    depth, left = 0, list(given)
    for line in mine:
        if left and line == left[0]:
            left.pop(0)
        elif depth > 1 or (line.startswith("#") and not line.startswith("#include ")):
            return False
        depth += line.count("{") - line.count("}")
    return not left
