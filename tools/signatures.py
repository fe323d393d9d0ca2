#!/usr/bin/env python3
"""Keeps what each known mistake looks like; run mistakes.py first.

    signatures.py [--stage N] [-j JOBS] [--build build]

A mistake that a golden image catches has left its signature, the means and
variances of tiles. They are gathered in tests/golden/signatures/
stageN_scene.txt: a failing golden is compared with them, and names those that
it cannot be told from. Then every such mistake is rendered again with another
seed, and its diagnosis noted in build/mistakes/confusion.md: which is named
first, and is it the right one?
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

import mistakes as catalogue

ROOT = catalogue.ROOT
SIGNATURES = ROOT / "tests" / "golden" / "signatures"


def run_goldens(program):
    """What the golden test says of a mistake's program, with another seed."""
    environment = {**os.environ, "LIGHTWALK_GOLDEN_SEED": "77"}
    try:
        return subprocess.run(
            [program, "-tc=golden*"], env=environment, cwd=program.parent,
            capture_output=True, text=True, errors="replace", timeout=600,
            preexec_fn=catalogue.limit_time,
        ).stdout
    except subprocess.TimeoutExpired:
        return ""


def in_parallel(jobs, function, items):
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(function, items))


def collect(rows):
    """Writes the signatures of all programs, a file for a stage and scene."""
    SIGNATURES.mkdir(exist_ok=True)
    for old in SIGNATURES.glob("*.txt"):
        old.unlink()
    for _, program in rows:
        for path in sorted(program.parent.glob("stage*_*.txt")):
            with open(SIGNATURES / path.name, "a") as file:
                file.write(path.read_text())


def confusion(rows, reports):
    """A table of each mistake and what its pictures are diagnosed as."""
    lines = ["| stage | mistake | diagnosis | first is right |", "|---|---|---|---|"]
    caught = right = 0
    for (mistake, _), report in zip(rows, reports):
        failures = report.count(f"of stage{mistake.stage}: ")
        if not failures:
            continue
        caught += 1
        said = re.findall(r"it agrees with (.*)", report)
        first = [re.match(r"'([^']*)'", one)[1] for one in said]
        votes = {name: first.count(name) for name in first}
        best = max(votes, key=votes.get) if votes else "nothing"
        right += best == mistake.name
        lines.append(
            f"| {mistake.stage} | {mistake.name} | {'; '.join(said) or '-'} "
            f"| {'yes' if best == mistake.name else best} |"
        )
    lines.append(f"\n{right} of the {caught} that a golden catches are named first.")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--stage", type=int)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    options = parser.parse_args()
    build = options.build.resolve()
    folder = build / "mistakes"
    mistakes = [
        one
        for path in sorted(catalogue.CATALOGUE.glob("stage?.toml"))
        for one in catalogue.read_mistakes(path)
        if one.verdict == "fail" and options.stage in (None, one.stage)
    ]
    rows = [(one, folder / f"stage{one.stage}" / one.name / f"stage{one.stage}_tests")
            for one in mistakes]
    rows = [row for row in rows if any(row[1].parent.glob("stage*_*.txt"))]
    if options.stage is None:
        collect(rows)
    reports = in_parallel(options.jobs, lambda row: run_goldens(row[1]), rows)
    table = confusion(rows, reports)
    (folder / "confusion.md").write_text(table)
    print(table.splitlines()[-1])
    print(f"The table is {folder / 'confusion.md'}")


if __name__ == "__main__":
    main()
