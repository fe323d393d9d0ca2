"""What a student reads when tests fail: at most a screenful, the most precise
failure first. A test of one function says more than a scene with an exact
solution, and that says more than two pictures that differ."""

import re

# Kinds of tests, the sharpest first. Each is a test suite of doctest's.
KINDS = ("units", "analytic scenes", "relations", "golden images")
SCENES = 1

FIRST_LINES, GOLDEN_LINES, OTHER_LINES = 9, 8, 3
MAX_LINES, MIN_NAMED = 24, 3
WIDTH = 78


def kind_of(test):
    """The place in KINDS; tests in no suite are scenes."""
    return KINDS.index(test.suite) if test.suite in KINDS else SCENES


def wrapped(text, indent="", most=8):
    """The text in lines of at most WIDTH columns; leaves out all beyond `most` lines."""
    rows = []
    for line in text.splitlines():
        row = indent
        for word in line.split():
            if row != indent and len(row) + 1 + len(word) > WIDTH:
                rows.append(row)
                row = indent
            row += (" " if row != indent else "") + word
        if row != indent:
            rows.append(row)
    if len(rows) > most:
        rows[most - 1 :] = [rows[most - 1] + " ..."]
    return "".join(row + "\n" for row in rows)


def sharpest_first(outcome):
    """The failed tests."""
    return sorted((test for test in outcome.tests if test.failed), key=kind_of)


def described(test, most=FIRST_LINES):
    """A failed test, and what its first failed check says."""
    says, place = test.failed[0]
    text = f"\n  {test.name}\n" + (f"  ({place})\n" if place else "") + wrapped(says, "    ", most)
    return text + (f"    (and {test.failures - 1} more in this test)\n" if test.failures > 1 else "")


def failures(tests):
    """The first of each kind, and the names of the others."""
    text = described(tests[0], MAX_LINES - 4 if len(tests) == 1 else FIRST_LINES)
    kind, rest = kind_of(tests[0]), []
    for test in tests[1:]:
        if kind_of(test) > kind:
            kind = kind_of(test)
            text += described(test, GOLDEN_LINES if KINDS[kind] == "golden images" else OTHER_LINES)
        else:
            rest.append(test.name)
    if not rest:
        return text
    room = max(MIN_NAMED, MAX_LINES - text.count("\n") - 6)
    text += "\nand\n" + "".join(f"  {name}\n" for name in rest[:room])
    return text + (f"  and {len(rest) - room} more\n" if len(rest) > room else "")


def last_words(outcome):
    """The last lines that a suite printed before it was cut short: usually a
    library's assertion, or an uncaught exception."""
    lines = [line.strip() for line in outcome.printed.splitlines() if line.strip()]
    # libstdc++ names the file, and the function with all its types.
    lines = [re.sub(r"^/\S*/(\S+:\d+): .*: (Assertion '.*)", r"\1: \2", line) for line in lines[-4:]]
    return "".join(wrapped(line, "  ", 3) for line in lines)


def came_first(outcome, tests):
    """Whether a sharper test had failed before the run was cut short."""
    return bool(tests) and kind_of(tests[0]) < outcome.kind


def fail(count, among=None):
    """Says how many tests fail; `among` is how many have run."""
    tests = "test" if (among or count) == 1 else "tests"
    tests = f"of {among} {tests}" if among else tests
    return f"{count} {tests} " + ("fails" if count == 1 else "fail. Start with the first") + ":\n"


def summary(outcome):
    """The report, at most a screenful."""
    tests, count = sharpest_first(outcome), len(outcome.tests)
    failed = failures(tests) if tests else ""
    if outcome.why and came_first(outcome, tests):
        text = fail(len(tests)) + failed + "\n" + wrapped(f"Then t{outcome.why[1:]}")
    elif outcome.why:
        before = f"Before that {len(tests)} {'test' if len(tests) == 1 else 'tests'} had failed:\n"
        text = wrapped(outcome.why) + (before + failed if tests else "")
    elif tests:
        text = fail(len(tests), count) + failed
    elif count:
        text = "1 test passes\n" if count == 1 else f"{count} tests pass\n"
    else:
        text = "no test has this name\n"
    text += "".join(wrapped(f"note: {note}", "", 2) for note in outcome.notes)
    return text + (f"\nThe full report: {outcome.program}\n" if tests else "")


def first_failure(outcome):
    """The same for one test: the first that fails, or that did not end."""
    tests = sharpest_first(outcome)
    failed = described(tests[0]).strip("\n") + "\n" if tests else ""
    if not outcome.why:
        return failed or summary(outcome)
    words = last_words(outcome) if outcome.end == "crash" else ""
    words = f"It printed last:\n{words}\n" if words else ""
    if came_first(outcome, tests):
        return f"{failed}\n{words}" + wrapped(f"Then t{outcome.why[1:]}")
    return words + wrapped(outcome.why) + ("\n" + failed if failed else "")
