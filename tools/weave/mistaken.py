"""A stage's program with a known mistake in its header.

    python3 -m tools.weave.mistaken 2/rectangle-without-area SCENE OPTIONS

The mistakes are those of tests/mistakes/stageN.toml. A program is built once
for its header and for what else it is made of, and kept in build/figures.
"""

import hashlib
import json
import shlex
import subprocess
import sys
from types import SimpleNamespace

from compare.stages import BUILD, ROOT, Failure, stage_headers
from tests.mistakes.mistakes import CATALOGUE, changed_header, read_mistakes, run


def header_with(stage, name):
    """The stage's header, and its text with the mistake in it."""
    header = next((p for p in stage_headers() if p.parent.name[0] == str(stage)), None)
    catalogue = CATALOGUE / f"stage{stage}.toml"
    if not header or not catalogue.exists():
        raise Failure(f"stage {stage} has no mistakes")
    for mistake in read_mistakes(catalogue):
        if mistake.name == name:
            return header, changed_header(mistake, SimpleNamespace(header=header))
    raise Failure(f"{catalogue.relative_to(ROOT)}: no mistake is called '{name}'")


def link_words(stage):
    """How the build links the stage, without its own object."""
    if (BUILD / "build.ninja").exists():
        command = ["ninja", "-C", BUILD, "-t", "commands", f"stage{stage}"]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        line = said.strip().splitlines()[-1].removeprefix(": && ").removesuffix(" && :")
    else:
        line = (BUILD / f"CMakeFiles/stage{stage}.dir/link.txt").read_text()
    words = shlex.split(line.replace(r"\$ORIGIN", str(BUILD)))
    return [word for word in words if f"stage{stage}.dir/" not in word]


def compile_words(stage):
    """How the build compiles the stage's main.cpp, but faster."""
    commands = BUILD / "compile_commands.json"
    if not commands.is_file():
        raise Failure(f"{commands}, which says how to compile, is not there")
    for entry in json.loads(commands.read_text()):
        words = shlex.split(entry["command"])
        if f"/stage{stage}.dir/" in words[words.index("-o") + 1]:
            return ["-O1" if w in ("-O2", "-O3") else w for w in words if not w.startswith("-W")]
    raise Failure(f"{commands} has no stage{stage}")


def program(stage, name):
    """The program's file, built if need be."""
    header, text = header_with(stage, name)
    whole = BUILD / f"stage{stage}"
    if not whole.is_file():
        raise Failure(f"{whole} has not been built")
    # Words in comments change no picture.
    code = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("//"))
    digest = hashlib.sha256(code.encode() + whole.read_bytes()).hexdigest()
    folder = BUILD / "figures/mistakes" / digest[:20]
    made = folder / whole.name
    if made.exists():
        return made
    overlay = folder / header.relative_to(ROOT)
    overlay.parent.mkdir(parents=True, exist_ok=True)
    overlay.write_text(text)
    target = folder / "main.o"
    words = compile_words(stage)
    words[words.index("-o") + 1] = str(target)
    what = f"stage {stage} with {name}"
    run([*launcher(), words[0], f"-I{folder}", *words[1:]], f"{what} does not compile")
    words = link_words(stage)
    words[words.index("-o") + 1] = str(folder / "linked")
    words = [str(BUILD / w) if w.endswith(".o") else w for w in words]
    run([*words, str(target)], f"{what} does not link")
    target.unlink()
    (folder / "linked").rename(made)
    return made


def launcher():
    """What the build puts before its compiler, such as ccache."""
    for line in (BUILD / "CMakeCache.txt").read_text().splitlines():
        if line.startswith("CMAKE_CXX_COMPILER_LAUNCHER:"):
            return line.split("=", 1)[1].split(";") if line.split("=", 1)[1] else []
    return []


def main():
    if len(sys.argv) < 3 or "/" not in sys.argv[1]:
        raise Failure("say STAGE/MISTAKE SCENE OPTIONS")
    made = program(*sys.argv[1].split("/", 1))
    return subprocess.run([made, *sys.argv[2:]]).returncode


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as error:
        sys.exit(f"mistaken: {error}")
