"""Tests the book and the slides: `make test-site`.

    python3 -m tests.site.run [-j JOBS] [FILE...]

Python tests on copies of the sources what stops a build; node tests in a browser
what was built. Several files run at a time. A file that passes prints one line.
"""

import argparse
import concurrent.futures
import os
import subprocess
import sys
from pathlib import Path

from tests.tally import Tally
from tools.tree import ROOT

FILES = ("tests/site/test_*.py", "tools/book/test_*.py", "tools/slides/test_*.py", "tests/site/*.test.cjs")


def run(path):
    """The output of the file's tests, and the exit code."""
    python = [sys.executable, "-m", "tests.scripts", path]
    command = python if path.suffix == ".py" else ["node", "--test", "--test-reporter=tap", path]
    done = subprocess.run(
        command,
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    return done.stdout, done.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("files", nargs="*", type=Path)
    options = parser.parse_args()
    # The slowest first: those in a browser.
    files = options.files or [path for pattern in reversed(FILES) for path in sorted(ROOT.glob(pattern))]
    tally, broken = Tally(), 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for path, (text, code) in zip(files, pool.map(run, files)):
            one = Tally()
            (one.add_text if path.suffix == ".py" else one.add_tap)(text)
            tally.add(one)
            name = path.relative_to(ROOT) if path.is_absolute() else path
            if code in (0, 77) and not one.failed:
                print(f"{name}: {one.passed} passed", flush=True)
                continue
            broken += not one.failed  # it did not reach its last line
            print(f"{name}: exit code {code}\n{text}", flush=True)
    return tally.close("book", broken=broken)


if __name__ == "__main__":
    sys.exit(main())
