"""When a process is stopped because it does not end.

No limit here is one of the clock. A busy machine may take a hundred times as
long as an idle one, and a right program must not look wrong for that. So a
process is stopped when it has used too much processor time, or when nothing in
it has moved for a long time though it could have.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

# Seconds of processor time, of all threads together, for one test or one of its
# subcases. It is an amount of work: the number of processors does not change
# it. A right test needs at most a fifth of it.
SECONDS = 20
# Seconds in which no thread runs or wants to run: a lock that is never released.
IDLE_SECONDS = 60
# Seconds between two looks at a process; each look elsewhere than on Linux
# starts a program.
PERIOD = 0.1 if sys.platform == "linux" else 1.0


def seconds_for(build):
    """SECONDS, or ten times that where the build is ten times as slow."""
    cache = Path(build) / "CMakeCache.txt"
    text = cache.read_text() if cache.exists() else ""
    slow = re.search(r"^(LIGHTWALK_SANITIZE:\w+=.|CMAKE_BUILD_TYPE:\w+=Debug$)", text, re.MULTILINE)
    return 10 * SECONDS if slow else SECONDS


def usage_by_proc(pid):
    """As `usage`, on Linux."""

    def fields(path):
        return path.read_text().rpartition(")")[2].split()

    folder = Path(f"/proc/{pid}")
    times = fields(folder / "stat")
    seconds = (int(times[11]) + int(times[12])) / os.sysconf("SC_CLK_TCK")
    # A thread that waits for a processor (R) or for a disk (D) would go on.
    return seconds, any(fields(task / "stat")[0] in "RD" for task in folder.glob("task/*"))


def usage_by_ps(pid):
    """As `usage`, by a program that every Unix has."""
    said = subprocess.run(["ps", "-o", "state=,time=", "-p", str(pid)], capture_output=True, text=True).stdout
    state, time = said.split()
    seconds = 0.0
    for part in re.split("[-:]", time):  # days would count as hours: enough to be stopped
        seconds = 60 * seconds + float(part)
    return seconds, state[0] in "RDU"


def usage(pid):
    """The processor time that a process has used, and whether it would use more
    if it got a processor. What cannot be seen, as after its end, would."""
    try:
        return (usage_by_proc if sys.platform == "linux" else usage_by_ps)(pid)
    except (OSError, ValueError, IndexError):
        return 0.0, True


class Watch:
    """Looks at a process from time to time, and says when it is to be stopped."""

    def __init__(self, pid, seconds=SECONDS, idle_seconds=IDLE_SECONDS):
        self.pid = pid
        self.seconds, self.idle_seconds = seconds, idle_seconds
        self.step, self.start, self.last, self.idle = 0, 0.0, 0.0, 0.0

    def look(self, step=lambda: 0):
        """To be called once in a PERIOD. `step` counts the steps that are done:
        each has all the seconds for itself. Returns why the process is to be
        stopped: "" or "busy" or "idle"."""
        used, willing = usage(self.pid)
        now = step()
        if now != self.step:
            # The step may have begun after `used` was read.
            self.step, self.start, self.idle = now, usage(self.pid)[0], 0.0
            return ""
        # A look is one PERIOD however long ago the last one was: where the
        # machine has no time for looks, it has none for the process.
        self.idle = 0.0 if willing or used > self.last else self.idle + PERIOD
        self.last = used
        if used - self.start > self.seconds:
            return "busy"
        return "idle" if self.idle > self.idle_seconds else ""
