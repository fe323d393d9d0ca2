"""The page of speed and convergence, from the results of `make measured`."""

import json
import shutil
from statistics import median

from tools.tree import ROOT, Failure

MEASURED = ROOT / "tools/bench/measured"


def table(path):
    return [line for line in path.read_text().split("\n") if line.startswith("|")]


def with_unit(x, unit):
    for factor, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "u")):
        if x >= factor:
            return f"{x / factor:.3g} {prefix}{unit}"
    return f"{x / 1e-9:.3g} n{unit}"


def benchmarks(path):
    """The medians of a Google Benchmark run, as a table."""
    scale = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}
    runs = {}
    for run in json.loads(path.read_text())["benchmarks"]:
        if run["run_type"] == "iteration" and "error_occurred" not in run:
            runs.setdefault(run["run_name"], []).append(run)
    lines = ["| benchmark | median | items |", "|---|---|---|"]
    for name, same in runs.items():
        time = median(run["real_time"] * scale[run["time_unit"]] for run in same)
        rate = median(run.get("items_per_second", 0) for run in same)
        lines.append(f"| {name} | {with_unit(time, 's')} | {with_unit(rate, '/s') if rate else ''} |")
    return lines


def measurements_page(source):
    """The page's lines, from the folder tools/bench/measured/."""
    for name in ("efficiency.md", "peers.md", "benchmarks.md", "convergence.svg"):
        if not (MEASURED / name).exists():
            raise Failure(f"tools/bench/measured/{name} is not there: `make measured` writes it")
    (source / "figures").mkdir(parents=True, exist_ok=True)
    shutil.copy(MEASURED / "convergence.svg", source / "figures/convergence.svg")

    def kept(name):
        return (MEASURED / name).read_text().split("\n")

    return [
        "# Speed and convergence",
        "",
        "Samples of different estimators are not equally good. So the first table has the "
        "*efficiency*: one over variance times time, relative to the first of each pair. "
        "Twice the efficiency is the same picture in half the time.",
        "",
        *kept("efficiency.md"),
        "![Noise against time for each estimator](figures/convergence.svg)",
        "",
        "All lines fall with slope -1/2: half the noise costs four times the time, with any "
        "estimator. The lower line is the better one.",
        "",
        "## Beside another renderer",
        "",
        "Stages 5 and 6 and [Mitsuba 3](https://www.mitsuba-renderer.org) with its compiler for "
        "vectors, on the lab's boxes of 256 x 256 pixels. Runs alternate, and we compare medians. "
        "A number above 1 says how many times as long Mitsuba takes. Its scenes only resemble ours: "
        "it has no plastic like the course's.",
        "",
        *kept("peers.md"),
        "## What everything costs",
        "",
        *kept("benchmarks.md"),
    ]
