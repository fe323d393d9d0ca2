"""Runs a suite, which is a program of doctest's, and says what has happened.

The suite contains code that is being written. It may crash, hang, print for
ever, or leave by std::exit(0) before the last test. So it is a process of its
own, and passes only if it came to its end; of any other one it is told in which
test it ended.
"""

import contextlib
import ctypes
import dataclasses
import os
import selectors
import signal
import subprocess
import sys
import tempfile
import uuid
from pathlib import Path
from xml.etree import ElementTree

from tests.runner import watch
from tests.runner.report import KINDS, SCENES

# So many bytes of the beginning, and as many of the end, of what a suite prints
# are kept; and so many of a test's failed checks.
MAX_PRINTED, MAX_CHECKS = 16_000, 100
CHUNK = 1 << 16
# All processes that a suite starts have it in their environment.
MARK = "LIGHTWALK_SUITE"


@dataclasses.dataclass
class Test:
    """A test that was begun."""

    name: str
    suite: str
    failed: list = dataclasses.field(default_factory=list)  # (what it says, place) of a check
    failures: int = 0  # checks that failed
    ended: bool = False
    seconds: float = 0  # where --duration is given

    def fail(self, says, place=""):
        self.failures += 1
        if len(self.failed) < MAX_CHECKS:
            self.failed.append((says, place))


@dataclasses.dataclass
class Outcome:
    """What became of a run."""

    program: str
    tests: list = dataclasses.field(default_factory=list)
    notes: list = dataclasses.field(default_factory=list)  # of tests that pass
    printed: str = ""  # by the code that is tested
    end: str = ""  # "time limit" or "crash", where it did not come to its end
    why: str = ""  # the same as a sentence about the test
    kind: int = 0  # of the tests that did not come to their end

    @property
    def passed(self):
        return bool(self.tests) and not self.why and not any(test.failed for test in self.tests)

    @property
    def caught_by(self):
        """The names of the tests that failed, or did not end."""
        return [test.name for test in self.tests if test.failed or not test.ended]


class SuiteReport:
    """doctest's report, read while it is being written."""

    def __init__(self):
        self.tests, self.notes = [], []
        self.suite = ""
        self.steps = 0  # tests and subcases that were begun
        self.threw = self.crashed = self.complete = False
        self.counted = -1  # tests, by doctest's own count at the end
        self.open = []
        self.parser = ElementTree.XMLPullParser(["start", "end"])

    @property
    def done(self):
        """Whether the last test has ended."""
        return self.complete and self.counted == sum(test.ended for test in self.tests)

    @property
    def test(self):
        """The name of the test that is running, or none."""
        return self.tests[-1].name if self.tests and not self.tests[-1].ended else None

    def feed(self, data):
        # After a crash doctest closes what is open, as if it had ended.
        if self.crashed or self.parser is None:
            return
        # doctest spells out most of what XML has no room for.
        self.parser.feed(data.translate(None, b"\x0b\x0c"))
        try:
            for event, element in self.parser.read_events():
                self.begin(element) if event == "start" else self.end(element)
        except ElementTree.ParseError:  # two threads at a time, or half of it
            self.parser = None

    def begin(self, element):
        self.open.append(element)
        if element.tag == "TestSuite":
            self.suite = element.get("name", "")
        elif element.tag == "TestCase":
            self.tests.append(Test(element.get("name", ""), self.suite))
        self.steps += element.tag in ("TestCase", "SubCase")

    def end(self, element):
        if self.crashed:
            return
        self.open.pop()
        parent = self.open[-1] if self.open else None
        if parent is not None and parent.tag in ("Expression", "Message"):
            return  # read with its parent
        test = self.tests[-1] if self.tests else None
        text = (element.text or "").strip()
        if element.tag == "Expression":
            self.check(test, element)
        elif element.tag == "Message":
            self.message(test, element)
        elif element.tag == "Exception":
            self.crashed = element.get("crash") == "true"
            # Of one in a subcase doctest says so first, and what it is later.
            self.threw = not self.crashed and not text.startswith("exception thrown in subcase")
            if self.threw:
                test.fail(f"threw: {text}")
        elif element.tag == "Info" and self.threw:  # noted before the exception
            says, place = test.failed[-1]
            test.failed[-1] = says + "\n" + text, place
        elif element.tag == "OverallResultsAsserts" and test:
            test.seconds = float(element.get("duration", 0))
        elif element.tag == "TestCase":
            test.ended = True
        elif element.tag == "OverallResultsTestCases":
            self.counted = int(element.get("successes")) + int(element.get("failures"))
        elif element.tag == "doctest":
            self.complete = True
        if parent is not None:
            parent.remove(element)

    @staticmethod
    def place(element):
        """The file as it is called in the tree, whose folders are known."""
        before, tests, after = element.get("filename", "").replace("\\", "/").rpartition("/tests/")
        return f"{tests[1:] or before}{after}:{element.get('line')}"

    def check(self, test, element):
        if element.get("success") == "true" or element.get("type", "").startswith("WARN"):
            return
        text = {part.tag: (part.text or "").strip() for part in element}
        says = [part.text.strip() for part in element.iter("Info") if part.text]
        says.append(text.get("Original", ""))
        if "Exception" in text:
            says.append(f"threw: {text['Exception']}")
        elif text.get("Expanded", says[-1]) != says[-1]:
            says.append(f"with values: {text['Expanded']}")
        test.fail("\n".join(says), self.place(element))

    def message(self, test, element):
        says = [part.text.strip() for part in element if part.text]
        if element.get("type") != "WARNING":
            test.fail("\n".join(says), self.place(element))
        elif says and says[0] not in self.notes:
            self.notes.append(says[0])


class Printed:
    """The beginning and the end of what a suite prints."""

    def __init__(self, echo):
        self.first = self.last = b""
        self.left_out = 0
        self.echo = echo

    def feed(self, data):
        room = MAX_PRINTED - len(self.first)
        self.first += data[:room]
        if self.echo and room:
            self.show(data[:room])
        rest = self.last + data[room:]
        self.last = rest[-MAX_PRINTED:]
        self.left_out += len(rest) - len(self.last)

    @staticmethod
    def show(data):
        sys.stdout.flush()
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()

    def rest(self):
        gap = f"\n... {self.left_out} more bytes are left out here ...\n" if self.left_out else ""
        return gap.encode() + self.last

    def text(self):
        if self.echo:
            self.show(self.rest())
        return (self.first + self.rest()).decode(errors="backslashreplace")


# Processes.

if sys.platform == "linux":
    prctl = ctypes.CDLL(None).prctl


def in_the_suite():
    """What the suite does before it starts."""
    import resource

    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if sys.platform == "linux":
        prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: it does not outlive this program


def kill_all(process, mark):
    """Ends the suite and what it has started, also what has a session of its own."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    for path in Path("/proc").glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            if f"{MARK}={mark}".encode() in path.read_bytes().split(b"\0"):
                os.kill(int(path.parent.name), signal.SIGKILL)


def listen(command, report, printed, options):
    """Runs the suite to its end, or until it is to be stopped: its exit code, and
    why it was stopped."""
    mark = uuid.uuid4().hex
    options["env"][MARK] = mark
    reading, writing = os.pipe()
    try:
        process = subprocess.Popen(
            [*command, f"-o=/dev/fd/{writing}"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            pass_fds=[writing],
            start_new_session=True,
            preexec_fn=in_the_suite,
            cwd=options["cwd"],
            env=options["env"],
        )
    except OSError:
        os.close(reading)
        raise
    finally:
        os.close(writing)
    readers = {reading: report.feed, process.stdout.fileno(): printed.feed}
    watcher = watch.Watch(process.pid, options["seconds"], options["idle_seconds"])
    stopped = ""
    try:
        with selectors.DefaultSelector() as pipes:
            for end in readers:
                os.set_blocking(end, False)
                pipes.register(end, selectors.EVENT_READ)

            def read(seconds):
                """Something of what has been written, and whether there may be more."""
                ready = pipes.select(seconds)
                for key, _ in ready:
                    data = os.read(key.fd, CHUNK)
                    readers[key.fd](data)
                    if not data:
                        pipes.unregister(key.fd)
                return bool(ready)

            def steps():
                # A pipe holds CHUNK bytes. More may come all the time.
                for _ in range(4):
                    if not read(0):
                        break
                return report.steps

            while process.poll() is None and not stopped:
                if pipes.get_map():
                    read(watch.PERIOD)
                else:  # it has closed them, and is about to end
                    with contextlib.suppress(subprocess.TimeoutExpired):
                        process.wait(watch.PERIOD)
                stopped = watcher.look(steps)
            steps()
            if stopped or pipes.get_map():  # somebody who holds a pipe is left
                kill_all(process, mark)
    finally:
        if process.poll() is None:
            kill_all(process, mark)
            process.wait()
        process.stdout.close()
        os.close(reading)
    return process.returncode, stopped


def listen_to_the_end(command, report, printed, options):
    """The same where pipes have no numbers: nothing is stopped there."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.xml"
        done = subprocess.run(
            [*command, f"-o={file}"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            cwd=options["cwd"],
            env=options["env"],
        )
        printed.feed(done.stdout)
        report.feed(file.read_bytes() if file.exists() else b"")
    return done.returncode, ""


def crash_in_words(number, printed):
    if number in (signal.SIGSEGV, signal.SIGBUS):
        return (
            "it used memory that it does not have (an index out of range, a null pointer), "
            "or its functions called each other without an end"
        )
    if number == signal.SIGFPE:
        return "an integer was divided by zero"
    if number == signal.SIGABRT:
        above = "; the lines above may say which" if printed else ""
        return f"std::abort: a failed assert, or an exception that nobody caught{above}"
    return f"signal {signal.strsignal(number)}"


def broken_off(report, code, stopped, printed, options):
    """Why a run is none that passes, ("time limit" or "crash", a sentence about
    the test it ended in). Empty where the suite came to its end."""
    when = (
        f' during the test\n"{report.test}"\n'
        if report.test is not None
        else " after the last test\n"
        if report.done
        else " between two tests, or before the first\n"
    )
    if stopped == "busy":
        return "time limit", (
            f"The tests do not end: stopped{when}which had computed for {options['seconds']:g} "
            "seconds of processor time. A loop or a path without an end?"
        )
    if stopped == "idle":
        return "time limit", (
            f"The tests do not end: stopped{when}in which nothing had moved for "
            f"{options['idle_seconds']:g} seconds. A lock that is never released?"
        )
    if code < 0:
        return "crash", f"The tests crashed{when}{crash_in_words(-code, printed)}"
    if not report.done:
        return "crash", (
            f"The program left by std::exit or the like, exit code {code},{when}"
            "so the tests did not come to their end, and have not passed."
        )
    if code and not any(test.failed for test in report.tests):
        return "crash", (
            f"The program ended with exit code {code}{when}though no test failed."
            + (" The lines above may say why." if printed else "")
        )
    return "", ""


def run(program, *options, seconds=None, idle_seconds=watch.IDLE_SECONDS, environment=None, echo=False):
    """Runs a suite as one process, with these options of doctest's. With `echo`
    what it prints is printed, too."""
    program = Path(program).absolute()
    given = {
        "seconds": seconds or watch.seconds_for(program.parent),
        "idle_seconds": idle_seconds,
        "cwd": program.parent,
        "env": os.environ | (environment or {}),
    }
    # The reporter is doctest's XML, but for a line: support/doctest.cpp.
    command = [program, *options, "-r=suite", "--no-skipped-summary"]
    report, printed = SuiteReport(), Printed(echo)
    code, stopped = (listen_to_the_end if os.name == "nt" else listen)(command, report, printed, given)
    text = printed.text()
    end, why = broken_off(report, code, stopped, text, given)
    return Outcome(str(program), report.tests, report.notes, text, end, why)


def run_by_kinds(program, *options, **others):
    """The same, the sharpest tests first. Where these come to no end, the others
    are not run."""
    whole = Outcome(str(Path(program).absolute()))
    for kind, name in enumerate(KINDS):
        chosen = f"-ts={name}"
        if kind == SCENES:  # and those in no suite
            chosen = f"-tse={','.join(other for other in KINDS if other != name)}"
        one = run(program, *options, chosen, **others)
        whole.tests += one.tests
        whole.notes += [note for note in one.notes if note not in whole.notes]
        whole.printed += one.printed
        whole.end, whole.why, whole.kind = one.end, one.why, kind
        if one.why:
            break
    return whole
