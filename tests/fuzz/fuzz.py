"""Fuzzes the readers and the geometry with inputs that nobody would write.

Each harness, tests/fuzz/NAME.cpp, is a program with libFuzzer: it mutates its
inputs, keeps those that reach new lines of the project's code, and ends if the
program crashes, a sanitizer complains or a check fails. It starts from small
seeds, which this program makes from the tree's scenes and pictures. The corpus
stays in build/fuzz/corpus/, the findings in build/fuzz/findings/. With a
finding the program ends with 1, and says how to reproduce it.
"""

import argparse
import concurrent.futures
import os
import random
import re
import shlex
import struct
import subprocess
import sys
import tempfile

from tools.tree import BUILD, ROOT

FOLDER = BUILD / "fuzz"
HERE = ROOT / "tests/fuzz"
# The longest input in bytes, and options of libFuzzer.
HARNESSES = {
    "pfm": [300],
    "ppm": [300],
    "scene": [4000, f"-dict={HERE}/toml.dict"],
    "shapes": [200],
    "tree": [400],
}
LIMITS = ["-timeout=10", "-rss_limit_mb=2048"]
ENVIRONMENT = {"UBSAN_OPTIONS": "print_stacktrace=1"}


def seeds(name):
    """The inputs that a harness starts from."""
    if name == "scene":
        return [path.read_bytes() for path in ROOT.glob("scenes/*.toml")]
    if name == "pfm":
        pixels = struct.pack("<12f", *range(12))
        one = b"PF\n2 2\n-1.0\n" + pixels
        two = one + one.replace(b"PF\n", b"PF\n# seed 7\n# samples_per_pixel 4\n")
        most = two.replace(b"7", b"9" * 20).replace(b"pixel 4", b"pixel " + b"9" * 20)
        return [one, two, most, b"Pf\r\n4 3\r\n1\r\n" + pixels]
    if name == "ppm":
        return [b"P3\n#MAX=2.5\n2 1\n255\n0 128 255\t1 2 3\n", b"P3 1 1 65535 1 2 65535 # end\n"]
    numbers = random.Random(name)
    return [numbers.randbytes(size) for size in (20, 50, 100, 200) for _ in range(8)]


def prepare(name):
    """The folders of a harness: its corpus, and its seeds."""
    corpus, start = FOLDER / "corpus" / name, FOLDER / "seeds" / name
    for folder in (corpus, start, FOLDER / "findings"):
        folder.mkdir(parents=True, exist_ok=True)
    for number, seed in enumerate(seeds(name)):
        (start / f"{number:02}").write_bytes(seed)
    return [corpus, start]


def last_number(pattern, text):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


def run(name, seconds, temporary):
    """Runs a harness; returns a line about it, and its finding or None."""
    max_bytes, *options = HARNESSES[name]
    program = FOLDER / f"fuzz_{name}"
    options += LIMITS
    log = FOLDER / f"{name}.log"
    with open(log, "wb") as output:
        done = subprocess.run(
            [program, *prepare(name), *options, f"-max_len={max_bytes}"]
            + [f"-max_total_time={seconds}", "-print_final_stats=1"]
            + [f"-artifact_prefix={FOLDER}/findings/{name}-"],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            env=os.environ | ENVIRONMENT | {"TMPDIR": temporary},
        )
    text = log.read_text(errors="replace")
    executions = last_number(r"stat::number_of_executed_units:\s*(\d+)", text)
    each_second = last_number(r"stat::average_exec_per_sec:\s*(\d+)", text)
    covered = last_number(r"cov: (\d+)", text)
    line = f"{name:8} {executions:11,} executions {each_second:8,}/s  coverage {covered:6,}"
    if done.returncode == 0:
        return line + "  nothing found", None
    why = re.search(r"fuzz: .*|runtime error: .*|ERROR: \w+: .*", text)
    finding = why[0] if why else f"exit code {done.returncode}"
    saved = re.findall(r"Test unit written to (\S+)", text)
    again = [os.path.relpath(program), *options, *map(os.path.relpath, saved[-1:])]
    return f"{line}  FOUND: {finding}", (
        f"see it again:  {shlex.join(again)}\n  what it said:  {os.path.relpath(log)}"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("harnesses", nargs="*", help=f"which [all]: {' '.join(HARNESSES)}")
    parser.add_argument("--seconds", type=int, default=60, help="for all of them together [60]")
    parser.add_argument("-j", "--jobs", type=int, default=1, help="how many at a time [1]")
    arguments = parser.parse_args()
    names = arguments.harnesses or list(HARNESSES)
    if unknown := [name for name in names if name not in HARNESSES]:
        sys.exit(f"there is no harness '{unknown[0]}': there are {', '.join(HARNESSES)}")
    jobs = max(1, min(arguments.jobs, len(names)))
    share = max(1, arguments.seconds * jobs // len(names))
    found = []
    with (
        tempfile.TemporaryDirectory(prefix="lightwalk-fuzz-") as temporary,
        concurrent.futures.ThreadPoolExecutor(jobs) as pool,
    ):
        for line, finding in pool.map(lambda name: run(name, share, temporary), names):
            print(line, flush=True)
            if finding:
                print(f"  {finding}", flush=True)
                found.append(finding)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
