"""The lab's box as WebAssembly: all stages, right and with known mistakes.

The mistakes are those of tests/mistakes/stageN.toml, made in the stages' own
headers; each has its own namespace in one module. Clang compiles it, with the
headers and libraries that `tools/setup.sh site` installs.
"""

import base64
import json
import os
import subprocess
import sys
from pathlib import Path

from tests.mistakes.mistakes import CATALOGUE, read_mistakes
from tools.exercises.sheet import headers_with_exercises
from tools.tree import BUILD, ROOT, Failure, left_out
from tools.weave.mistaken import in_namespace

HERE = Path(__file__).parent
# The label of a mistake in the list, by stage and by its name.
MISTAKES = {
    (1, "pi-of-the-brdf-forgotten"): "without the 1/π of the BRDF",
    (1, "uniform-cosine-forgotten"): "without the cosine, by uniform sampling",
    (2, "lamps-counted-twice"): "lamps counted twice",
    (3, "eta-inverted"): "with the ratio of η inverted",
    (4, "not-divided-by-the-probability"): "not divided by the probability",
}
COMPILER = [os.environ.get("WASM_CXX", "clang++"), "--target=wasm32-wasi"]
# The options of the native programs, so that the bits are the same.
OPTIONS = ["-std=c++20", "-O2", "-DNDEBUG", "-ffp-contract=off", "-msimd128", "-fno-exceptions", "-fno-rtti"]


def find_glm(folder):
    """A folder with only GLM: the headers beside it are for another machine."""
    include = folder / "include"
    include.mkdir(exist_ok=True)
    for place in ("/usr/include", "/usr/local/include", "/opt/homebrew/include"):
        if (Path(place) / "glm").is_dir() and not (include / "glm").exists():
            (include / "glm").symlink_to(Path(place) / "glm")
    return include


def write_variants(folder):
    """Writes variants.inc. Returns the page's facts about each variant."""
    # Stage 6 paints the same as stage 5, with registers that a page does not have,
    # and stage 7's photons need threads and whole pictures.
    chapters = [path for path in headers_with_exercises() if int(path.parent.name[0]) < 6]
    headers = [str(path.relative_to(ROOT)) for path in chapters]
    tracers, facts = [], []
    for path in chapters:
        stage = int(path.parent.name[0])
        tracers.append(f"stage{stage}::PathTracer")
        facts.append({"stage": stage, "name": "", "label": "right", "sentence": ""})
    for number, ((stage, name), label) in enumerate(MISTAKES.items()):
        space = f"stage{stage}_mistake{number}"
        file = f"mistake{number}.hpp"
        (folder / file).write_text(in_namespace(stage, name, space))
        headers.append(file)
        tracers.append(f"{space}::PathTracer")
        known = {one.name: one.sentence for one in read_mistakes(CATALOGUE / f"stage{stage}.toml")}
        facts.append({"stage": stage, "name": name, "label": label, "sentence": known[name]})
    lines = [f'#include "{header}"' for header in headers]
    calls = ", ".join(f"f<{tracer}>" for tracer in tracers)
    (folder / "variants.inc").write_text("\n".join([*lines, f"#define LIGHTWALK_VARIANTS(f) {calls}", ""]))
    return facts


def run(words):
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        errors = [line for line in done.stderr.splitlines() if "error" in line]
        raise Failure(f"the live box does not compile: {(errors or [done.stderr])[0]}")


def box_script():
    """The script with the module and its worker. If no compiler for WebAssembly
    works, prints a line and returns None."""
    folder = BUILD / "live"
    folder.mkdir(exist_ok=True)
    if lacks := left_out("book"):
        print(f"book: left out: {lacks[0]}", file=sys.stderr)
        return None
    facts = write_variants(folder)
    made, module = folder / "box.o", folder / "box.wasm"
    places = [f"-I{ROOT}", f"-I{folder}", f"-isystem{find_glm(folder)}"]
    run([*COMPILER, *OPTIONS, *places, "-c", HERE / "box.cpp", "-o", made])
    # Linked without -O: Clang would call wasm-opt if it is installed.
    run([*COMPILER, "-mexec-model=reactor", "-Wl,--strip-all", made, "-o", module])
    box = {
        "wasm": base64.b64encode(module.read_bytes()).decode(),
        "worker": (HERE / "worker.js").read_text(),
        "variants": facts,
    }
    return f"window.lightwalkBox = {json.dumps(box, ensure_ascii=False)};\n"
