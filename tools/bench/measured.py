"""Stores measurements in the folder tools/bench/measured/, for the book and the README.

    make measured       python3 -m tools.bench.measured

Tables of efficiency, of every benchmark and of peers, and the chart. Each table
names its command and date, the processors, the compiler and the commit.
"""

import datetime
import json
import shutil
import subprocess
import sys
from statistics import median

from tools.bench.machine import machine
from tools.tree import BUILD, ROOT, Failure
from tools.weave.measured import FOLDER, table


def commit_at(time):
    """The commit that was checked out at this time, if the reflog has it."""
    asked = subprocess.run(
        ["git", "rev-parse", "--short", f"HEAD@{{{time.isoformat()}}}"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    return f"commit {asked.stdout.strip()}" if asked.returncode == 0 else "no commit"


def with_unit(x, unit):
    for factor, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ")):
        if x >= factor:
            return f"{x / factor:.3g} {prefix}{unit}"
    return f"{x / 1e-9:.3g} n{unit}"


def benchmarks(text):
    """The medians of a Google Benchmark run, as a table."""
    scale = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}
    runs = {}
    for run in json.loads(text)["benchmarks"]:
        if run["run_type"] == "iteration" and "error_occurred" not in run:
            runs.setdefault(run["run_name"], []).append(run)
    lines = ["| benchmark | median | in a second |", "|---|---|---|"]
    for name, same in runs.items():
        time = median(run["real_time"] * scale[run["time_unit"]] for run in same)
        rate = median(run.get("items_per_second", 0) for run in same)
        lines.append(f"| {name} | {with_unit(time, 's')} | {with_unit(rate, '/s') if rate else ''} |")
    return lines


def main():

    def keep(name, command, source, lines):
        time = datetime.datetime.fromtimestamp(source.stat().st_mtime).astimezone()
        head = f"Measured by `{command}` on {time.date()}: {machine()}, {commit_at(time)}."
        (FOLDER / name).write_text("\n".join([head, "", *lines, ""]))
        print(FOLDER / name)

    for needed in ("efficiency.md", "bench.json", "peers.md", "convergence.svg"):
        if not (BUILD / needed).exists():
            raise Failure(f"{BUILD / needed} is not there: run `make bench` and `make bench-peers` first")
    FOLDER.mkdir(exist_ok=True)
    for name, command, source, lines in (
        ("efficiency.md", "make bench", BUILD / "efficiency.md", table),
        ("benchmarks.md", "make bench", BUILD / "bench.json", benchmarks),
        ("peers.md", "make bench-peers", BUILD / "peers.md", table),
    ):
        keep(name, command, source, lines(source.read_text()))
    shutil.copy(BUILD / "convergence.svg", FOLDER / "convergence.svg")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as error:
        sys.exit(f"measured: {error}")
