"""Runs what a student wrote where it can do no harm.

bubblewrap gives it a system of its own: no network, no other process, no file but
those that it needs, which it cannot write, and a scratch folder in memory. What it
makes comes out through pipes. prlimit bounds its processor time, memory, processes
and files, and `Guard` what all of its processes have together.
"""

import os
import re
import shlex
import shutil
import signal
import sys
from dataclasses import dataclass
from pathlib import Path

from tests.runner import process, watch
from tools.tree import Failure

MB = 1 << 20
PAGE = os.sysconf("SC_PAGE_SIZE")
# Who runs a student's code where root grades: no limit counts the processes of root.
NOBODY = 65534
OWNER = NOBODY if os.geteuid() == 0 else None
# Where a program finds libraries and the compiler its parts.
SYSTEM = ("bin", "sbin", "lib", "lib32", "lib64", "libx32")
CONFIGURED = ("/etc/alternatives", "/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d")


@dataclass(frozen=True)
class Limits:
    """Of one run. `memory` is for all processes together; bytes."""

    seconds: int = 300  # of processor time, of one process
    memory: int = 3072 * MB
    processes: int = 64
    scratch: int = 512 * MB


def system():
    """The words for all that is the same in every run."""
    words = ["--ro-bind", "/usr", "/usr"]
    for name in SYSTEM:
        path = Path("/", name)
        if path.is_symlink():
            words += ["--symlink", os.readlink(path), str(path)]
        elif path.is_dir():
            words += ["--ro-bind", str(path), str(path)]
    for path in CONFIGURED:
        words += ["--ro-bind-try", path, path]
    return words


def sandbox(reads, limits, clock, folder="/tmp", environment=None):
    """The words to put before a command. `reads` are files and folders that it may
    read, or pairs of one and the name that it has there. What time the command took
    comes out of the descriptor `clock`, for a Clock."""
    words = []
    if OWNER is not None:
        words += ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", "--no-new-privs"]
    words += ["bwrap", "--unshare-all", "--die-with-parent", "--new-session", "--clearenv"]
    for name, value in {"PATH": "/usr/bin:/bin", "LC_ALL": "C", **(environment or {})}.items():
        words += ["--setenv", name, value]
    words += system()
    # First, so that it does not hide what is read from below /tmp.
    words += ["--size", str(limits.scratch), "--tmpfs", "/tmp"]
    for one in reads:
        source, target = one if isinstance(one, tuple) else (one, one)
        words += ["--ro-bind", str(source), str(target)]
    words += ["--proc", "/proc", "--dev", "/dev", "--remount-ro", "/dev"]
    words += ["--remount-ro", "/", "--chdir", str(folder)]
    bounds = {
        "core": 0,
        "cpu": limits.seconds,
        "as": limits.memory,
        "nproc": limits.processes,
        "fsize": limits.scratch,
        "nofile": 256,
    }
    words += ["--", "prlimit", *(f"--{name}={value}" for name, value in bounds.items())]
    # bubblewrap ends before its child, whose time nobody gets then.
    script = f'times > /dev/fd/{clock}; "$@"; code=$?; times > /dev/fd/{clock}; exit $code'
    return [*words, "sh", "-c", script, "sh"]


class Guard(watch.Watch):
    """Watches the memory of all processes of a run, too."""

    def __init__(self, pid, seconds, idle_seconds, memory):
        super().__init__(pid, seconds, idle_seconds)
        self.memory = memory

    def look(self, step=lambda: 0):
        return super().look(step) or ("memory" if memory_of(self.pid) > self.memory else "")


def memory_of(pid):
    """Bytes that a process and its children hold."""
    try:
        total = int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE
        for task in Path(f"/proc/{pid}/task").iterdir():
            total += sum(map(memory_of, (task / "children").read_text().split()))
        return total
    except (OSError, ValueError, IndexError):
        return 0


class Taken:
    """What came out of a pipe; at most so many bytes are kept."""

    def __init__(self, most):
        self.data, self.most, self.too_much = b"", most, False

    def feed(self, data):
        self.too_much |= len(self.data) + len(data) > self.most
        self.data += data[: self.most - len(self.data)]


class Clock:
    """Adds up the processor time of all runs, and hears whether the last one began."""

    seconds, began = 0.0, False

    def feed(self, data):
        self.began |= bool(data)
        for minutes, seconds in re.findall(rb"(\d+)m([\d.]+)s", data):
            self.seconds += 60 * int(minutes) + float(seconds)


clock = Clock()


def begun(printed):
    """Fails where the sandbox did not even start the command: that is no student's fault."""
    if not clock.began:
        raise Failure(f"the sandbox does not work here: {' '.join(printed.split())[-300:]}")


@dataclass
class Done:
    """The end of a run: `code` is the shell's, `stopped` says why it was stopped."""

    code: int
    stopped: str
    printed: str
    files: list  # the bytes of each


def run(commands, reads, outputs=(), limits=Limits(), folder="/tmp", most=64 * MB):
    """Runs commands, each a list of words, as long as they succeed. The result has the
    files `outputs`, which they leave."""
    taken, printed = [Taken(most) for _ in outputs], process.Printed()
    lines = [shlex.join(map(str, one)) for one in commands]

    def words(time, *pipes):
        copies = [f"cat {shlex.quote(name)} > /dev/fd/{pipe}" for name, pipe in zip(outputs, pipes)]
        script = " && ".join([*lines, *copies])
        return [*sandbox(reads, limits, time, folder), "sh", "-c", script]

    clock.began = False
    code, stopped = process.follow(
        words,
        [clock.feed, *(one.feed for one in taken)],
        printed,
        (limits.seconds, watch.IDLE_SECONDS),
        watcher=lambda *of_run: Guard(*of_run, limits.memory),
        owner=OWNER,
        env={"PATH": os.environ.get("PATH", "/usr/bin:/bin")},
    )
    if any(one.too_much for one in taken):
        stopped = stopped or "much"
    elif code - 128 in (signal.SIGKILL, signal.SIGXCPU):
        stopped = stopped or "busy"  # by prlimit
    if not stopped:
        begun(printed.text())
    return Done(code, stopped, printed.text(), [one.data for one in taken])


def check():
    """Refuses to go on where there is no sandbox."""
    if sys.platform != "linux":
        raise Failure("the sandbox is bubblewrap, which is for Linux only")
    for program in ("bwrap", "prlimit", "setpriv"):
        if not shutil.which(program):
            raise Failure(f"{program} is missing, and nothing is run without it: tools/setup.sh class")
    run([["true"]], [])
