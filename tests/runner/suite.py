"""Runs a suite, which is a doctest program, and reports the outcome.

The suite contains code that is being written. It may crash, hang, print
forever, or call std::exit(0) before the last test. So it is a separate process,
and passes only if it reaches its end; otherwise the report names the test in
which it ended.
"""

import dataclasses
import itertools
import os
import signal
from pathlib import Path

from tests.runner import process, watch
from tests.runner.doctest_report import DoctestReport
from tests.runner.report import KINDS, SCENES


@dataclasses.dataclass
class Outcome:
    """The outcome of a run."""

    program: str
    tests: list = dataclasses.field(default_factory=list)
    notes: list = dataclasses.field(default_factory=list)  # of tests that pass
    printed: str = ""  # by the code under test
    end: str = ""  # "time limit" or "crash", if it did not reach its end
    why: str = ""  # the same as a sentence about the test
    kind: int = 0  # of the tests that did not reach their end

    @property
    def passed(self):
        return bool(self.tests) and not self.why and not any(test.failed for test in self.tests)

    @property
    def caught_by(self):
        """The names of the tests that failed, or did not end."""
        return [test.name for test in self.tests if test.failed or not test.ended]


def crash_in_words(number, printed):
    if number in (signal.SIGSEGV, signal.SIGBUS):
        return (
            "its functions called each other endlessly (a path without an end), "
            "or it used invalid memory (a null pointer, an index out of range)"
        )
    if number == signal.SIGFPE:
        return "an integer was divided by zero"
    if number == signal.SIGABRT:
        above = "; the lines above may say which" if printed else ""
        return f"std::abort: a failed assert, or an uncaught exception{above}"
    return f"signal {signal.strsignal(number)}"


def broken_off(report, code, stopped, printed, limits):
    """Why a run does not pass: "time limit" or "crash", and a sentence about the
    test in which it ended. Empty if the suite reached its end."""
    when = " after the last test\n" if report.done else " between two tests, or before the first\n"
    if report.running is not None:
        when = f' during the test\n"{report.running}"\n'
    seconds, idle_seconds = limits
    if stopped:
        why = {
            "busy": f"which had used {seconds:g} seconds of processor time. An endless loop or path?",
            "idle": f"in which no thread had run for {idle_seconds:g} seconds. A lock that is never released?",
            "much": "which had printed more than a gigabyte. An endless loop?",
            "memory": "which had used up the memory that it may have. Something that grows without an end?",
        }[stopped]
        return "time limit", f"The tests do not end: stopped{when}{why}"
    if code < 0:
        return "crash", f"The tests crashed{when}{crash_in_words(-code, printed)}"
    if not report.done:
        return "crash", (
            f"The program called std::exit or the like, exit code {code},{when}"
            "so the tests did not reach their end, and have not passed."
        )
    if code and not any(test.failed for test in report.tests):
        above = " The lines above may say why." if printed else ""
        return "crash", f"The program ended with exit code {code}{when}though no test failed.{above}"
    return "", ""


def run(
    program, *options, seconds=None, idle_seconds=watch.IDLE_SECONDS, environment=None, within=None, **others
):
    """Runs a suite as one process, with these doctest options. `within` makes the words
    before the command from the descriptors of the pipes of `feeds` (process.listen)."""
    program = Path(program).absolute()
    limits = seconds or watch.seconds_for(program.parent), idle_seconds
    command = [program, *options, "-r=suite", "--no-skipped-summary"]
    words = (lambda *pipes: [*within(*pipes), *command]) if within else command
    report, printed = DoctestReport(), process.Printed()
    code, stopped = (process.run_to_the_end if os.name == "nt" else process.listen)(
        words, report, printed, limits, cwd=program.parent, env=os.environ | (environment or {}), **others
    )
    if within and code > 128:
        code = 128 - code  # a signal, as a shell says it
    text = printed.text()
    end, why = broken_off(report, code, stopped, text, limits)
    return Outcome(str(program), report.tests, report.notes, text, end, why)


def run_by_kinds(program, *options, first_only=False, kinds=KINDS, run=run, **others):
    """The same, the sharpest tests first, and of each kind the stage's own before
    those that every stage has. If these do not reach their end, the others are not
    run; with `first_only` the first check that fails ends the run."""
    options = [*options, "--abort-after=1"] if first_only else options
    whole = Outcome(str(Path(program).absolute()))
    for (kind, name), place in itertools.product(enumerate(kinds), ("-sfe", "-sf")):
        chosen = f"-ts={name}"
        if kind == SCENES:  # and those in no suite
            chosen = f"-tse={','.join(other for other in KINDS if other != name)}"
        one = run(program, *options, chosen, f"{place}=*/every_stage/*", **others)
        whole.tests += one.tests
        whole.notes += [note for note in one.notes if note not in whole.notes]
        whole.printed += one.printed
        whole.end, whole.why, whole.kind = one.end, one.why, kind
        if one.why or (first_only and one.caught_by):
            break
    return whole
