"""A stage's program with a known mistake in its header.

    python3 -m tools.weave.mistaken 2/rectangle-without-area SCENE OPTIONS

The mistakes are those of tests/mistakes/stageN.toml. A program is kept in
build/figures, and built again only if its header or the rest of the stage
changes. Mistakes of one stage are compiled together, each in its own namespace:
the code that they share takes the most time, and is compiled once.
"""

import concurrent.futures
import functools
import hashlib
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

from tests.mistakes.mistakes import CATALOGUE, Command, changed_header, link_command, read_mistakes, run
from tools.tree import BUILD, ROOT, Failure, stage_headers

# More mistakes in one program take longer than several programs in parallel.
MOST_TOGETHER = 6


@functools.cache
def known_mistakes(stage):
    """The stage's header, and its mistakes by their names."""
    header = next((p for p in stage_headers() if p.parent.name[0] == str(stage)), None)
    catalogue = CATALOGUE / f"stage{stage}.toml"
    if not header or not catalogue.exists():
        raise Failure(f"stage {stage} has no mistakes")
    return header, {mistake.name: mistake for mistake in read_mistakes(catalogue)}


def header_with(stage, name):
    """The stage's header, and its text with the mistake in it."""
    header, known = known_mistakes(stage)
    if name not in known:
        raise Failure(f"tests/mistakes/stage{stage}.toml: no mistake is called '{name}'")
    return header, changed_header(known[name], SimpleNamespace(header=header))


def in_namespace(stage, name, space):
    """The text of the header with the mistake, in its own namespace."""
    text = header_with(stage, name)[1]
    old = f"namespace lightwalk::stage{stage} {{"
    if old not in text:
        raise Failure(f"stage {stage} has no line '{old}'")
    return text.replace(old, f"namespace lightwalk::{space} {{")


def link_words(stage):
    """How the build links the stage, without its own objects; it looks for the
    image library there."""
    words = link_command(f"stage{stage}", BUILD)
    return [word.replace(r"\$ORIGIN", str(BUILD)) for word in words if f"stage{stage}.dir/" not in word]


def compile_words(stage):
    """How the build compiles the stage's main.cpp, but faster."""
    words = Command(f"stage{stage}", "main.").words
    return ["-O1" if w in ("-O2", "-O3") else w for w in words if not w.startswith("-W")]


@functools.cache
def digest(stage, name):
    """A hash of everything that the program with the mistake is made from."""
    text = header_with(stage, name)[1]
    whole = BUILD / f"stage{stage}"
    if not whole.is_file():
        raise Failure(f"{whole} has not been built")
    # Comments change no picture.
    code = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("//"))
    return hashlib.sha256(code.encode() + whole.read_bytes()).hexdigest()[:20]


def place(stage, name):
    """The path of the program, built or not."""
    return BUILD / "figures/mistakes" / digest(stage, name) / name


def program(stage, name):
    """The program's file, built if need be."""
    build_programs([(stage, name)])
    return place(stage, name)


def build_programs(wanted, say=lambda line: None):
    """Builds the missing ones of these (stage, name)."""
    missing = [one for one in dict.fromkeys(wanted) if not place(*one).exists()]
    groups = []
    for stage in sorted({stage for stage, _ in missing}):
        names = [name for number, name in missing if number == stage]
        count = -(-len(names) // MOST_TOGETHER)
        groups += [(stage, names[first::count]) for first in range(count)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for line in pool.map(lambda group: build_together(*group), groups):
            say(line)


def whole_source(stage, names, folder):
    """The stage's main.cpp once for each mistake, whose header is written into
    the folder. The program's name selects the one that runs."""
    header = known_mistakes(stage)[0]
    own = f'#include "{header.relative_to(ROOT).as_posix()}"'
    text = (header.parent / "main.cpp").read_text()
    includes = re.findall(r"^#include .*$", text, re.M)
    body = re.sub(r"^#include .*$", "", text, flags=re.M)
    mains, choices = [], []
    for number, name in enumerate(names):
        space = f"stage{stage}_mistake{number}"
        (folder / f"{name}.hpp").write_text(in_namespace(stage, name, space))
        includes.insert(includes.index(own), f'#include "{name}.hpp"')
        mine = re.sub(rf"\bstage{stage}::", f"{space}::", body)
        mains.append(mine.replace("int main(", f"static int {space}("))
        choices.append(f'  if (name == "{name}") return {space}(argc, argv);')
    includes.remove(own)
    return "\n".join(
        [
            *includes,
            "#include <filesystem>",
            *mains,
            "int main(int argc, char** argv) {",
            "  const auto name = std::filesystem::path(argv[0]).filename();",
            *choices,
            "  return 2;",
            "}",
            "",
        ]
    )


def build_together(stage, names):
    """Builds one program for several mistakes of a stage, under all names;
    returns a line that says so."""
    what = f"stage {stage} with a mistake"
    kept = BUILD / "figures/mistakes"
    kept.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=kept) as made:
        folder = Path(made)
        source, target, linked = folder / "main.cpp", folder / "main.o", folder / "linked"
        source.write_text(whole_source(stage, names, folder))
        words = compile_words(stage)
        words[words.index("-o") + 1] = str(target)
        words[words.index("-c") + 1] = str(source)
        run([*launcher(), *words], f"{what} does not compile")
        words = link_words(stage)
        words[words.index("-o") + 1] = str(linked)
        run([*words, str(target)], f"{what} does not link", BUILD)
        for name in names:
            place(stage, name).parent.mkdir(exist_ok=True)
            # A rename is atomic, even if another process builds the same.
            os.link(linked, folder / name)
            (folder / name).replace(place(stage, name))
    return f"stage {stage} compiled with {', '.join(names)}"


def launcher():
    """The launcher that the build puts before its compiler, such as ccache."""
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
