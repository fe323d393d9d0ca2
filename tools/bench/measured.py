"""Keeps what was measured in the folder measured/, for the book and the README.

    make measured       python3 -m tools.bench.measured

Tables of efficiency, of every benchmark and of peers, and the chart, each with
the processor, the date and the command.
"""

import datetime
import os
import re
import shutil
import sys
from pathlib import Path

from compare.stages import BUILD, ROOT, Failure
from tools.book.measurements import benchmarks, table

FOLDER = ROOT / "measured"


def machine():
    """The processor's name and how many there are."""
    try:
        info = Path("/proc/cpuinfo").read_text()
        name = re.search(r"model name\s*: (.*)", info)[1]
    except (OSError, TypeError):
        name = os.uname().machine
    return f"{name}, {os.cpu_count()} processors"


def main():
    day = datetime.date.today().isoformat()

    def keep(name, command, lines):
        head = f"Measured by `{command}` on {day}: {machine()}."
        (FOLDER / name).write_text("\n".join([head, "", *lines, ""]))
        print(FOLDER / name)

    for needed in ("efficiency.md", "bench.json", "peers.md", "convergence.svg"):
        if not (BUILD / needed).exists():
            raise Failure(f"{BUILD / needed} is not there: run `make bench` and `make bench-peers` first")
    FOLDER.mkdir(exist_ok=True)
    keep("efficiency.md", "make bench", table(BUILD / "efficiency.md"))
    keep("benchmarks.md", "make bench", benchmarks(BUILD / "bench.json"))
    keep("peers.md", "make bench-peers", table(BUILD / "peers.md"))
    shutil.copy(BUILD / "convergence.svg", FOLDER / "convergence.svg")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as error:
        sys.exit(f"measured: {error}")
