"""Renders each known mistake, and keeps what it looks like.

    python3 -m tests.mistakes.signatures [--stage N] [-j JOBS]

A mistake that a golden image catches leaves its signature, the means and
variances of tiles, in tests/golden/signatures/stageN_scene.txt: a failing
golden is compared with them, and names those that it cannot be told from. Then
every such mistake is rendered again with another seed, and its diagnosis noted
in build/signatures/confusion.md: which is named first, and is it the right
one? The reports and pictures of that stay in build/signatures/, for the book.
"""

import argparse
import concurrent.futures
import os
import re
import sys

from compare.stages import BUILD, ROOT, Failure
from tests.mistakes import mistakes as catalogue

SIGNATURES = ROOT / "tests" / "golden" / "signatures"


def build_suite(mistake, suite, given, folder):
    """Compiles the golden test alone with the mistake. Returns the program."""
    folder = folder / f"stage{mistake.stage}" / mistake.name
    overlay = folder / suite.header.relative_to(ROOT)
    overlay.parent.mkdir(parents=True, exist_ok=True)
    program = folder / suite.target
    header = catalogue.changed_header(mistake, suite)
    if program.exists() and overlay.exists() and overlay.read_text() == header:
        return program
    overlay.write_text(header)
    source = ROOT / "tests" / f"stage{mistake.stage}" / "test_goldens.cpp"
    target = folder / "suite.o"
    options = [f"-I{folder}", "-include", str(given)]
    catalogue.run(suite.compile_command(source, target, options), mistake.name)
    place = suite.link.index("-o")
    rest = suite.link[place + 2 :]
    catalogue.run([*suite.link[:place], str(target), "-o", str(program), *rest], mistake.name)
    target.unlink()
    return program


def run_goldens(program, seed, name=None):
    """What the golden test says with this seed; signatures are left beside."""
    environment = {"LIGHTWALK_GOLDEN_SEED": str(seed)}
    if name:
        environment["LIGHTWALK_SIGNATURE"] = name
        for old in program.parent.glob("stage*_*.txt"):
            old.unlink()
    outcome = catalogue.run_program(program, environment=environment)
    return "\n".join(says for test in outcome.tests for says, _ in test.failed)


def in_parallel(jobs, function, items):
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(function, items))


def collect(rows, all_of_them):
    """Writes the signatures of all programs, a file for a stage and scene.

    Those of other mistakes stay, unless these are all that there are.
    """
    SIGNATURES.mkdir(exist_ok=True)
    made = {(f"stage{mistake.stage}", mistake.name) for mistake, _ in rows}
    for old in SIGNATURES.glob("*.txt"):
        stage = old.name.split("_")[0]
        lines = old.read_text().splitlines(keepends=True)
        kept = [] if all_of_them else [one for one in lines if (stage, one.split()[0]) not in made]
        old.write_text("".join(kept))
    for _, program in rows:
        for path in sorted(program.parent.glob("stage*_*.txt")):
            with open(SIGNATURES / path.name, "a") as file:
                file.write(path.read_text())
    for path in SIGNATURES.glob("*.txt"):
        if path.stat().st_size == 0:
            path.unlink()


def confusion(rows, reports):
    """A table of each mistake and what its pictures are diagnosed as."""
    lines = ["| stage | mistake | diagnosis | first is right |", "|---|---|---|---|"]
    caught = right = 0
    for (mistake, _), report in zip(rows, reports):
        failures = report.count(f"of stage{mistake.stage}: ")
        if not failures:
            continue
        caught += 1
        said = re.findall(r"known mistake makes the same picture, .*", report)
        first = [re.search(r'" \(([^)]*)\)', one)[1] for one in said]
        votes = {name: first.count(name) for name in first}
        best = max(votes, key=votes.get) if votes else "nothing"
        right += best == mistake.name
        lines.append(
            f"| {mistake.stage} | {mistake.name} | {'; '.join(first) or '-'} "
            f"| {'yes' if best == mistake.name else best} |"
        )
    lines.append(f"\n{right} of the {caught} that a golden catches are named first.")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--stage", type=int)
    parser.add_argument("names", nargs="*", help="stageN/name, only these")
    parser.add_argument("--signatures-only", action="store_true", help="half the time, and no table")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    folder = BUILD / "signatures"
    mistakes = [
        one
        for path in sorted(catalogue.CATALOGUE.glob("stage?.toml"))
        for one in catalogue.read_mistakes(path)
        if one.verdict == "fail"
        and options.stage in (None, one.stage)
        and (not options.names or f"stage{one.stage}/{one.name}" in options.names)
    ]
    suites = {n: catalogue.Suite(n) for n in sorted({m.stage for m in mistakes})}
    given = {n: catalogue.precompile(suite, folder / f"given{n}") for n, suite in suites.items()}

    def render(mistake):
        suite = suites[mistake.stage]
        program = build_suite(mistake, suite, given[mistake.stage], folder)
        report = run_goldens(program, 5, mistake.name)
        count = report.count("golden image ")
        print(f"stage {mistake.stage}: {mistake.name}: {count} goldens fail", flush=True)
        return mistake, program

    try:
        rows = in_parallel(options.jobs, render, mistakes)
    except Failure as failure:
        sys.exit(f"signatures: {failure}")
    collect(rows, all_of_them=not options.names and options.stage is None)
    if options.signatures_only:
        return
    reports = in_parallel(options.jobs, lambda row: run_goldens(row[1], 77), rows)
    for (_, program), report in zip(rows, reports):
        (program.parent / "report.txt").write_text(report)
    table = confusion(rows, reports)
    (folder / "confusion.md").write_text(table)
    print(table.splitlines()[-1])
    print(f"The table is {folder / 'confusion.md'}")


if __name__ == "__main__":
    main()
