"""Reads doctest's XML report while doctest writes it.

The reporter "suite" writes it: support/doctest.cpp.
"""

import dataclasses
from xml.etree import ElementTree

# The number of a test's failed checks that are kept.
MAX_CHECKS = 100


@dataclasses.dataclass
class Test:
    """A test that has begun."""

    name: str
    suite: str
    failed: list = dataclasses.field(default_factory=list)  # (message, place) of a check
    failures: int = 0  # checks that failed
    ended: bool = False
    seconds: float = 0  # if --duration is given
    place: str = ""

    def fail(self, says, place=""):
        """A check that stands in a helper is found by its test."""
        self.failures += 1
        place = self.place if place.startswith("tests/support/") else place
        if len(self.failed) < MAX_CHECKS:
            self.failed.append((says, place))


class DoctestReport:
    """The report of a suite so far."""

    def __init__(self):
        self.tests, self.notes = [], []
        self.steps = 0  # tests and subcases that have begun
        self.suite = ""
        self.threw = self.crashed = self.complete = False
        self.counted = -1  # tests, by doctest's own count at the end
        self.open = []  # elements, the innermost last
        self.parser = ElementTree.XMLPullParser(["start", "end"])

    @property
    def done(self):
        """Whether the last test has ended."""
        return self.complete and self.counted == sum(test.ended for test in self.tests)

    @property
    def running(self):
        """The name of the test that is running, or None."""
        return self.tests[-1].name if self.tests and not self.tests[-1].ended else None

    def feed(self, data):
        # doctest escapes the characters that XML forbids, except for these two.
        self.parser.feed(data.translate(None, b"\x0b\x0c"))
        try:
            for event, element in self.parser.read_events():
                # After a crash doctest closes open elements as if they had ended.
                if not self.crashed:
                    self.begin(element) if event == "start" else self.end(element)
        except ElementTree.ParseError:  # two threads wrote at once; the report is never complete
            self.parser = ElementTree.XMLPullParser(["start"])

    def begin(self, element):
        self.open.append(element)
        self.steps += element.tag in ("TestCase", "SubCase")
        if element.tag == "TestSuite":
            self.suite = element.get("name", "")
        elif element.tag == "TestCase":
            self.tests.append(Test(element.get("name", ""), self.suite, place=self.place(element)))

    def end(self, element):
        self.open.pop()
        if self.open and self.open[-1].tag in ("Expression", "Message"):
            return  # read with its parent
        test = self.tests[-1] if self.tests else None
        text = (element.text or "").strip()
        if element.tag == "Expression":
            self.check(test, element)
        elif element.tag == "Message":
            self.message(test, element)
        elif element.tag == "Exception":
            self.crashed = element.get("crash") == "true"
            # For an exception in a subcase doctest first reports that, and later its text.
            self.threw = not self.crashed and not text.startswith("exception thrown in subcase")
            if self.threw:
                test.fail(f"threw: {text}")
        elif element.tag == "Info" and self.threw:  # INFO before the exception
            says, place = test.failed[-1]
            test.failed[-1] = f"{says}\n{text}", place
        elif element.tag == "OverallResultsAsserts" and test:
            test.seconds = float(element.get("duration", 0))
        elif element.tag == "TestCase":
            test.ended = True
        elif element.tag == "OverallResultsTestCases":
            self.counted = int(element.get("successes")) + int(element.get("failures"))
        elif element.tag == "doctest":
            self.complete = True
        if self.open:  # no tree grows
            self.open[-1].remove(element)

    @staticmethod
    def place(element):
        """The file's path in the tree, and the line."""
        before, tests, after = element.get("filename", "").replace("\\", "/").rpartition("/tests/")
        return f"{tests[1:] or before}{after}:{element.get('line')}"

    def check(self, test, element):
        if element.get("success") == "true" or element.get("type", "").startswith("WARN"):
            return
        text = {part.tag: (part.text or "").strip() for part in element}
        original = text.get("Original", "")
        says = [part.text.strip() for part in element.iter("Info") if part.text] + [original]
        if "Exception" in text:
            says.append(f"threw: {text['Exception']}")
        elif text.get("Expanded", original) != original:
            says.append(f"with values: {text['Expanded']}")
        test.fail("\n".join(says), self.place(element))

    def message(self, test, element):
        says = [part.text.strip() for part in element if part.text]
        if element.get("type") != "WARNING":
            test.fail("\n".join(says), self.place(element))
        elif says and says[0] not in self.notes:
            self.notes.append(says[0])
