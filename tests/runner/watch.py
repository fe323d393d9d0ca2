"""Stops processes that do not end.

No limit here is a wall-clock time. A busy machine may take a hundred times as
long as an idle one, and a right program must not fail for that. So a process is
stopped when it has used too much processor time, or when none of its threads
has run, or wanted to run, for a long time.
"""

import os
import re
import subprocess
import sys
import time
from pathlib import Path

# Seconds of processor time, of all threads together, for one test or one of its
# subcases: an amount of work, whatever the number of processors. The longest
# test of a right program takes 2.4 (core, on a slow machine).
SECONDS = 20
# Seconds in which no thread runs or wants to run: a lock that is never released.
IDLE_SECONDS = 60
# Seconds between two looks at a process; each look elsewhere than on Linux
# starts a program.
PERIOD = 0.1 if sys.platform == "linux" else 1.0


def seconds_for(build):
    """SECONDS, or ten times that if the build is ten times as slow."""
    cache = Path(build) / "CMakeCache.txt"
    text = cache.read_text() if cache.exists() else ""
    slow = re.search(r"^(LIGHTWALK_SANITIZE:\w+=.|CMAKE_BUILD_TYPE:\w+=Debug$)", text, re.MULTILINE)
    return 10 * SECONDS if slow else SECONDS


def usage_by_proc(pid):
    """`usage` on Linux."""

    def fields(path):
        return path.read_text().rpartition(")")[2].split()

    folder = Path(f"/proc/{pid}")
    times = fields(folder / "stat")[11:15]  # its own, and of children that have ended
    seconds = sum(map(int, times)) / os.sysconf("SC_CLK_TCK")
    willing = False
    for task in folder.glob("task/*"):
        # A thread that runs or waits for a processor (R) or a disk (D) would go on.
        willing |= fields(task / "stat")[0] in "RD"
        children = task / "children"
        for child in children.read_text().split() if children.exists() else ():
            used, would = usage(child)
            seconds, willing = seconds + used, willing or would
    return seconds, willing


def usage_by_ps(pid):
    """`usage` by a program that every Unix has."""
    said = subprocess.run(["ps", "-A", "-o", "pid=,ppid=,state=,time="], capture_output=True, text=True)
    rows = {pid: row for pid, *row in map(str.split, said.stdout.splitlines())}
    family = [str(pid)]
    for parent in family:
        family += [child for child, row in rows.items() if row[0] == parent]
    seconds = 0.0
    for one in family:
        used = 0.0
        for part in re.split("[-:]", rows[one][2]):  # a day counts as 60 hours: long enough
            used = 60 * used + float(part)
        seconds += used
    return seconds, any(rows[one][1][0] in "RDU" for one in family)


def usage(pid):
    """The processor time that a process and its children have used, and whether
    they would use more if they got a processor. (0, True) if that is unknown, as
    after their end."""
    try:
        return (usage_by_proc if sys.platform == "linux" else usage_by_ps)(pid)
    except (OSError, ValueError, LookupError):
        return 0.0, True


class Watch:
    """Looks at a process from time to time, and says when to stop it."""

    def __init__(self, pid, seconds=SECONDS, idle_seconds=IDLE_SECONDS):
        self.pid = pid
        self.seconds, self.idle_seconds = seconds, idle_seconds
        self.step, self.start, self.last, self.idle = 0, 0.0, 0.0, 0.0
        self.looked = time.monotonic()

    def look(self, step=lambda: 0):
        """Call this at least once in a PERIOD. `step` counts the steps that are
        done: each may take all the seconds. Returns why to stop the process:
        "busy" or "idle", or "" to go on."""
        if time.monotonic() - self.looked < PERIOD:
            return ""
        used, willing = usage(self.pid)
        now = step()
        if now != self.step:
            # The step may have begun after `used` was read.
            self.step, self.start, self.idle = now, usage(self.pid)[0], 0.0
            return ""
        # Each look counts as one PERIOD, however long ago the last one was: if the
        # machine has no time for looks, it has none for the process.
        self.looked = time.monotonic()
        self.idle = 0.0 if willing or used > self.last else self.idle + PERIOD
        self.last = used
        if used - self.start > self.seconds:
            return "busy"
        return "idle" if self.idle > self.idle_seconds else ""


class Endless(Exception):
    """A process that was stopped."""


def go_on(watcher, process):
    if why := watcher.look():
        process.kill()
        raise Endless(f"{process.args} does not come to an end: it is {why}")


def wait_until(process, condition, seconds=SECONDS):
    """Returns when the condition holds, or the process has ended."""
    watcher = Watch(process.pid, seconds)
    while process.poll() is None and not condition():
        time.sleep(0.01)
        go_on(watcher, process)


def communicate(process, text=None, seconds=SECONDS):
    """Like Popen.communicate, whose only limit is a wall-clock time."""
    watcher = Watch(process.pid, seconds)
    while True:
        try:
            return process.communicate(text, timeout=PERIOD)
        except subprocess.TimeoutExpired:
            text = None
            go_on(watcher, process)
