"""Measures chapter 4's table: the gain by Russian roulette at equal time.

    python3 -m tools.bench.equal_time    writes tools/bench/measured/equal_time.toml

Stages 3 and 4 render `scenes/plastic.toml` with several bounds on the bounces,
on one thread, in turns, with SEEDS seeds each. The variance of a sample is
that of a pixel over the seeds, times its samples, averaged over pixels and
channels. The time of a sample is CPU time, the minimum of all runs. T seconds
are enough for T / time samples, so the variance is then variance * time / T. The
ratio of the two products says how many times as long stage 3 takes for the same
noise. Takes minutes. Needs only the standard library.
"""

import argparse
import pathlib
import tempfile
from statistics import mean, variance

from tools.bench.machine import machine
from tools.tree import ROOT, SCENES, read_pfm, render

TABLE = ROOT / "tools/bench/measured/equal_time.toml"
SCENE, SIZE, SEEDS = "plastic", "64x64", 6
# The bound, and each stage's samples per pixel.
RUNS = [(1, 256, 256), (2, 128, 256), (4, 32, 256), (6, 8, 256), (8, 4, 256)]
UNBOUNDED = 4096


def paint(stage, bound, spp, seed):
    """The report, and the picture's values."""
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / "picture.pfm"
        options = f"--size {SIZE} --threads 1 --spp {spp} --seed {seed} --max-bounces {bound}"
        report = render(f"stage{stage}", SCENES / f"{SCENE}.toml", picture, *options.split())
        return report, [channel for pixel in read_pfm(picture)[2] for channel in pixel]


def summary(runs, spp):
    """Rays, microseconds and variance of a sample, and the picture's mean."""
    reports, pictures = zip(*runs)
    each = [values for values in zip(*pictures)]
    return {
        "rays": mean(report["rays_per_sample"] for report in reports),
        "microseconds": min(report["cpu_seconds"] / report["samples"] for report in reports) * 1e6,
        "variance": mean(map(variance, each)) * spp,
        "light": mean(map(mean, each)),
    }


def measure(bound, spp3, spp4):
    """Both stages with one bound, in turns."""
    runs = {3: [], 4: []}
    for seed in range(1, SEEDS + 1):
        for stage, spp in ((3, spp3), (4, spp4)):
            if spp:
                runs[stage].append(paint(stage, bound, spp, seed))
    return (runs[3] and summary(runs[3], spp3)), summary(runs[4], spp4)


def row(bound, three, four, light):
    """One row of the table, as TOML."""
    values = {"missing": 1 - four["light"] / light}
    for stage, found in ((3, three), (4, four)):
        for key in ("rays", "microseconds", "variance"):
            values[f"{key}{stage}"] = found[key]
    values["times"] = three["variance"] * three["microseconds"] / (four["variance"] * four["microseconds"])
    return "\n".join(["[[row]]", f"bounces = {bound}", *(f"{key} = {x:.3g}" for key, x in values.items())])


def main():
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    _, all_light = measure(UNBOUNDED, 0, 256)
    lines = [
        "# Measured by `python3 -m tools.bench.equal_time`; the figure equal-time draws it.",
        f'machine = "{machine()}"',
        f'how = "scenes/{SCENE}.toml, {SIZE}, one thread, {SEEDS} seeds, CPU time"',
    ]
    for bound, spp3, spp4 in RUNS:
        lines += ["", row(bound, *measure(bound, spp3, spp4), all_light["light"])]
        print(lines[-1], flush=True)
    TABLE.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
