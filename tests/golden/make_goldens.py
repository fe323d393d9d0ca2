"""Remakes the golden images of goldens.toml, or only the named ones.

    python3 -m tests.golden.make_goldens [--times 64] [stage4/plastic ...]

Each stage renders its goldens with 64 times the samples of the tests, and a
seed that no test uses, so that their own error hardly counts. But if an entry has
`photons`, the picture has a bias that falls with the samples: its golden is the mean
of 64 pictures of other seeds, each with the test's samples, and has the same bias.
The file is the
.pfm that every stage writes (common/image/pfm.hpp): the mean, the variance of a
sample, and what was rendered. No library is needed to read it.
"""

import argparse
import array
import math
import re
import tomllib
from pathlib import Path

from tools.tree import SCENES, render

HERE = Path(__file__).resolve().parent
SEED = 20_000_000


def mean_of(pictures):
    """The mean of .pfm files with the same head and as many samples. In a file the
    mean is followed by the variance of a sample, which has a head of its own."""
    size = 32 * 32 * 12
    start = pictures[0].index(b"-1.0\n") + 5
    head, middle = pictures[0][:start], pictures[0][start + size : -size]

    def mean(parts):
        columns = zip(*(array.array("f", part) for part in parts), strict=True)
        return array.array("f", (math.fsum(column) / len(column) for column in columns)).tobytes()

    samples = int(re.search(rb"samples_per_pixel (\d+)", middle)[1])
    middle = middle.replace(
        b"samples_per_pixel %d" % samples, b"samples_per_pixel %d" % (samples * len(pictures))
    )
    return (
        head
        + mean(one[start : start + size] for one in pictures)
        + middle
        + mean(one[-size:] for one in pictures)
    )


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
        for key in ("max_bounces", "photons", "neighbors"):
            if key in golden:
                arguments += [f"--{key.replace('_', '-')}", golden[key]]
        print(f"{stage}/{scene}.pfm", flush=True)
        made = folder / f"{scene}.pfm"
        if "photons" not in golden:
            render(stage, SCENES / f"{scene}.toml", made, "--size", "32x32", *arguments)
            continue
        pictures = []
        for seed in range(SEED, SEED + options.times):
            arguments[1], arguments[3] = golden["samples"], seed
            render(stage, SCENES / f"{scene}.toml", made, "--size", "32x32", *arguments)
            pictures.append(made.read_bytes())
        made.write_bytes(mean_of(pictures))


if __name__ == "__main__":
    main()
