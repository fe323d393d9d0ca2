"""Runs all CTest tests of the programs: `make test`.

python3 -m tests.run [OPTION OF CTEST...]
"""

import subprocess
import sys

from tests.tally import Tally
from tools.tree import BUILD


def main():
    junit = BUILD / "tests.xml"
    junit.unlink(missing_ok=True)
    done = subprocess.run(
        ["ctest", "--test-dir", BUILD, "--no-tests=error", "--output-on-failure", "--output-junit", junit]
        # The output of all tests is counted, also of those that pass.
        + ["--test-output-size-passed", "1000000", "--test-output-size-failed", "1000000"]
        + sys.argv[1:]
    )
    if not junit.exists():
        return done.returncode or 1
    tally = Tally()
    tally.add_junit(junit)
    return tally.close("programs", "tests") or done.returncode


if __name__ == "__main__":
    sys.exit(main())
