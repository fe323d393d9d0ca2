"""Runs files of Python tests, and reports at the end how many were skipped, and why.

    python3 -m tests.scripts FILE... [-k PATTERN]

Exit codes: 0 all pass, 1 some fail, 77 all were skipped. With CI=true, a skipped
test counts as failed.
"""

import argparse
import importlib.util
import os
import sys
import unittest
from pathlib import Path

SKIPPED = 77


class Result(unittest.TextTestResult):
    """Counts the passed tests, too."""

    passed = 0

    def addSuccess(self, test):
        super().addSuccess(test)
        self.passed += 1


def load(path):
    """The tests of a file, as a module of its name."""
    spec = importlib.util.spec_from_file_location(Path(path).stem, path)
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(Path(path).parent.resolve()))
    spec.loader.exec_module(module)
    return unittest.defaultTestLoader.loadTestsFromModule(module)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+")
    parser.add_argument("-k", help="only tests whose names contain this", dest="pattern", action="append")
    options = parser.parse_args()
    if options.pattern:
        unittest.defaultTestLoader.testNamePatterns = [f"*{one}*" for one in options.pattern]
    suite = unittest.TestSuite(load(path) for path in options.files)
    result = unittest.TextTestRunner(stream=sys.stdout, resultclass=Result).run(suite)
    for test, reason in result.skipped:
        print(f"skipped: {test.id()}: {reason}")
    failed = len(result.failures) + len(result.errors) + len(result.unexpectedSuccesses)
    print(f"{result.passed} passed, {failed} failed, {len(result.skipped)} skipped")
    if failed or not result.testsRun or (result.skipped and os.environ.get("CI") == "true"):
        return 1
    return SKIPPED if not result.passed else 0


if __name__ == "__main__":
    sys.exit(main())
