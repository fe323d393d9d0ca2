"""Runs a separate process, and kills everything that it starts."""

import contextlib
import ctypes
import os
import selectors
import signal
import subprocess
import sys
import tempfile
import uuid
from pathlib import Path

from tests.runner import watch

# Of a suite's output this many bytes of the beginning, and as many of the end,
# are kept.
MAX_PRINTED = 16_000
# A process that prints more than this is stopped.
MAX_LEFT_OUT = 1 << 30
CHUNK = 1 << 16
# All processes that a suite starts have this variable in their environment.
MARK = "LIGHTWALK_SUITE"
if sys.platform == "linux":
    prctl = ctypes.CDLL(None).prctl


class Printed:
    """The beginning and the end of a process's output."""

    def __init__(self):
        self.first = self.last = b""
        self.left_out = 0

    def feed(self, data):
        room = MAX_PRINTED - len(self.first)
        self.first += data[:room]
        rest = self.last + data[room:]
        self.last = rest[-MAX_PRINTED:]
        self.left_out += len(rest) - len(self.last)

    def text(self):
        gap = f"\n... {self.left_out} more bytes are left out here ...\n" if self.left_out else ""
        return (self.first + gap.encode() + self.last).decode(errors="backslashreplace")


def in_the_suite():
    """Runs in the new process before the suite starts."""
    import resource

    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if sys.platform == "linux":
        prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: the suite does not outlive this program


def kill_all(process, mark):
    """Kills the suite and all that it has started, even in other sessions."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    for path in Path("/proc").glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            if f"{MARK}={mark}".encode() in path.read_bytes().split(b"\0"):
                os.kill(int(path.parent.name), signal.SIGKILL)


def follow(
    command, feeds, printed, limits, steps=lambda: 0, watcher=watch.Watch, owner=None, pass_fds=(), **options
):
    """Runs a command to its end, or until a limit stops it. Each of `feeds` takes what
    comes out of a pipe: `command` makes the words from the pipes' descriptors, and `owner`
    is the user who opens them by name. Returns the exit code, and why the process was
    stopped."""
    mark = uuid.uuid4().hex
    with contextlib.ExitStack() as at_the_end:
        pairs = [os.pipe() for _ in feeds]
        writing = [end for _, end in pairs]
        for reading, end in pairs:
            at_the_end.callback(os.close, reading)
            if owner is not None:
                os.fchown(end, owner, owner)
        try:
            process = subprocess.Popen(
                command(*writing),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                pass_fds=[*writing, *pass_fds],
                start_new_session=True,
                preexec_fn=in_the_suite,
                **options | {"env": options["env"] | {MARK: mark}},
            )
        finally:
            for end in writing:
                os.close(end)
        at_the_end.callback(process.stdout.close)
        at_the_end.callback(process.wait)
        readers = {reading: feed for (reading, _), feed in zip(pairs, feeds)}
        readers[process.stdout.fileno()] = printed.feed
        pipes = at_the_end.enter_context(selectors.DefaultSelector())
        for end in readers:
            os.set_blocking(end, False)
            pipes.register(end, selectors.EVENT_READ)

        def read(seconds):
            """Reads some of the output; returns whether there was any."""
            ready = pipes.select(seconds)
            for key, _ in ready:
                data = os.read(key.fd, CHUNK)
                readers[key.fd](data)
                if not data:
                    pipes.unregister(key.fd)
            return bool(ready)

        def read_steps():
            # A pipe holds a CHUNK, and more may arrive at any time.
            for _ in range(4):
                if not read(0):
                    break
            return steps()

        watching, stopped = watcher(process.pid, *limits), ""
        try:
            while process.poll() is None and not stopped:
                if pipes.get_map():
                    read(watch.PERIOD)
                else:  # the process has closed its pipes, and is about to end
                    with contextlib.suppress(subprocess.TimeoutExpired):
                        process.wait(watch.PERIOD)
                stopped = "much" if printed.left_out > MAX_LEFT_OUT else watching.look(read_steps)
            read_steps()
        finally:
            # A process that holds a pipe is left.
            if process.poll() is None or pipes.get_map():
                kill_all(process, mark)
    return process.returncode, stopped


def listen(command, report, printed, limits, feeds=(), **options):
    """Runs a suite, whose report comes out of a pipe of its own; `feeds` take others."""

    def words(writing, *others):
        given = command(*others) if callable(command) else command
        return [*given, f"-o=/dev/fd/{writing}"]

    return follow(words, [report.feed, *feeds], printed, limits, lambda: report.steps, **options)


def run_to_the_end(command, report, printed, limits, **options):
    """The same for Windows, where nothing is stopped."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.xml"
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "stdin": subprocess.DEVNULL}
        done = subprocess.run([*command, f"-o={file}"], **pipes, **options)
        printed.feed(done.stdout)
        report.feed(file.read_bytes() if file.exists() else b"")
    return done.returncode, ""
