"""Remakes the golden images of goldens.toml, or only the named ones.

    python3 -m tests.golden.make_goldens [--times 64] [stage4/plastic ...]

Each stage renders its goldens with 64 times the samples of the tests, and a
seed that no test uses, so that their own error hardly counts. The file is the
.pfm that every stage writes (common/image/pfm.hpp): the mean, the variance of a
sample, and what was rendered. No library is needed to read it.
"""

import argparse
import tomllib
from pathlib import Path

from tools.tree import SCENES, render

HERE = Path(__file__).resolve().parent
SEED = 20_000_000


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--times", type=int, default=64)
    parser.add_argument("names", nargs="*", metavar="stageN/scene")
    options = parser.parse_args()
    goldens = tomllib.loads((HERE / "goldens.toml").read_text())["golden"]
    names = {f"stage{g['stage']}/{g['scene']}" for g in goldens}
    if unknown := set(options.names) - names:
        parser.error(f"goldens.toml does not list {', '.join(sorted(unknown))}")
    for golden in goldens:
        stage, scene = f"stage{golden['stage']}", golden["scene"]
        if options.names and f"{stage}/{scene}" not in options.names:
            continue
        folder = HERE / stage
        folder.mkdir(exist_ok=True)
        arguments = ["--spp", golden["samples"] * options.times, "--seed", SEED]
        if "max_bounces" in golden:
            arguments += ["--max-bounces", golden["max_bounces"]]
        print(f"{stage}/{scene}.pfm", flush=True)
        render(stage, SCENES / f"{scene}.toml", folder / f"{scene}.pfm", "--size", "32x32", *arguments)


if __name__ == "__main__":
    main()
