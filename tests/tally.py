"""Counts tests that passed, failed and were skipped, and why they were skipped.

Prints the last lines of `make test` and `make test-site`:

    skipped: NAME: REASON
    N passed, N failed, N skipped

With CI=true, skipped tests and parts that the build leaves out
(build/left_out.txt) count as failures: what CI does not test, nobody tests.
"""

import os
import re
from xml.etree import ElementTree

from tools.tree import left_out


class Tally:
    def __init__(self):
        self.passed = self.failed = 0
        self.skipped = []  # "NAME: REASON"

    def add_text(self, text):
        """Adds the output of a runner: tests.runner or tests.scripts. Returns whether
        it contains the number of tests."""
        known = False
        for line in text.splitlines():
            if found := re.fullmatch(r"(\d+) passed, (\d+) failed, \d+ skipped", line):
                passed, failed = map(int, found.groups())
            elif found := re.fullmatch(r"(\d+) tests? pass(es)?", line):
                passed, failed = int(found[1]), 0
            elif found := re.match(r"(\d+) of (\d+) tests? fails?\b", line):
                passed, failed = int(found[2]) - int(found[1]), int(found[1])
            else:
                if line.startswith("skipped: "):
                    self.skipped.append(line.removeprefix("skipped: "))
                continue
            known = True
            self.passed += passed
            self.failed += failed
        return known

    def add(self, other):
        self.passed += other.passed
        self.failed += other.failed
        self.skipped += other.skipped

    def add_junit(self, path):
        """Adds the report of ctest: each of its entries is a program with many tests."""
        for entry in ElementTree.parse(path).getroot().iter("testcase"):
            text = "".join(entry.itertext())
            failures = self.failed
            known = self.add_text(text)
            if entry.get("status") == "run":
                self.passed += not known
            elif entry.get("status") == "fail":
                # The program may have ended before it counted.
                self.failed += self.failed == failures
            elif not known:
                reason = entry.find("skipped")
                reason = "it did not run" if reason is None else reason.get("message", "")
                self.skipped.append(f"{entry.get('name')}: {reason}")

    def add_tap(self, text):
        """Adds the output of node --test-reporter=tap."""
        for line in text.splitlines():
            if found := re.match(r"\s*(not )?ok \d+ - (.*?)(?: # SKIP ?(.*))?$", line):
                bad, name, reason = found.groups()
                if name.endswith(".cjs"):
                    continue  # a file, whose tests are counted
                if reason is not None:
                    self.skipped.append(f"{name}: {reason}")
                elif bad:
                    self.failed += 1
                else:
                    self.passed += 1

    def close(self, *where, broken=0):
        """Prints the last lines; returns the exit code. `where` are the parts of
        left_out.txt that these tests cover, `broken` is the number of programs that
        ended before they counted."""
        self.failed += broken
        missing = [f"not tested: {line}" for place in where for line in left_out(place)]
        lines = [f"skipped: {line}" for line in self.skipped] + missing
        if lines:
            print()
        print(*lines, sep="\n")
        strict = os.environ.get("CI") == "true" and lines
        if strict:
            print("These are failures where CI=true.")
        print(f"{self.passed} passed, {self.failed} failed, {len(self.skipped)} skipped", flush=True)
        return 1 if self.failed or strict or not self.passed else 0
