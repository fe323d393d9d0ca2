"""Checks at each save: `make watch`.

The check and the picture are processes of their own. A save stops them, however
long they would go on, and they begin again with what was saved.
"""

import contextlib
import os
import select
import signal
import subprocess
import sys
import time

from tools.tree import ROOT

try:
    import termios
    import tty
except ImportError:  # Windows: no keys
    termios = None

# What a student may change.
WATCHED = ("stages/**/*.hpp", "stages/**/*.cpp", "common/**/*.hpp", "common/**/*.cpp", "scenes/*.toml")
PERIOD = 0.2
KEYS = "h hint, l list again, q quit"


def state_of_files():
    """When each file was last written; an editor may be saving one."""
    seen = {}
    for pattern in WATCHED:
        for path in ROOT.glob(pattern):
            with contextlib.suppress(OSError):
                seen[path] = path.stat().st_mtime_ns
    return seen


@contextlib.contextmanager
def keys():
    """A function that returns the key that was pressed, "" if none was, or None
    where there is no keyboard."""
    if termios is None or not sys.stdin.isatty():
        yield lambda: time.sleep(PERIOD)
        return
    before = termios.tcgetattr(sys.stdin)

    def pressed():
        ready, _, _ = select.select([sys.stdin], [], [], PERIOD)
        return os.read(sys.stdin.fileno(), 1).decode(errors="replace") if ready else ""

    tty.setcbreak(sys.stdin)
    try:
        yield pressed
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


class Running:
    """Commands that run one after the other, until they are stopped."""

    def __init__(self, *commands):
        self.left = list(commands)
        self.process = None
        self.go_on()

    def go_on(self):
        """Starts the next command when one has ended; returns whether any runs."""
        if self.process is not None and self.process.poll() is None:
            return True
        if not self.left:
            return False
        command = [sys.executable, *self.left.pop(0)]
        apart = {} if os.name == "nt" else {"start_new_session": True}
        self.process = subprocess.Popen(command, cwd=ROOT, stdin=subprocess.DEVNULL, **apart)
        return True

    def stop(self):
        self.left = []
        if self.process is None or self.process.poll() is not None:
            return
        # It ends its own: the compiler, the suite.
        self.process.send_signal(signal.SIGTERM)
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(2)
        with contextlib.suppress(OSError):
            os.killpg(self.process.pid, signal.SIGKILL) if os.name != "nt" else self.process.kill()
        self.process.wait()


def watch(stage):
    """Until q or Ctrl-C."""
    module = ["-B", "-m", "tools.exercises.check", str(stage)]
    check, hint = [*module, "--watched"], [*module, "--hint"]
    picture = ["-B", "-m", "tools.exercises.picture", str(stage)]
    seen, running, told = None, Running(), True
    with keys() as pressed:
        try:
            while True:
                now = state_of_files()
                key = "l" if seen is not None and now != seen else ""
                seen = now
                if running.go_on():
                    told = False
                elif not told:
                    told = True
                    print(f"\nWaiting for a save. Keys: {KEYS}.", flush=True)
                key = key or pressed() or ""
                if key == "q":
                    return
                if key == "l" or running.process is None:
                    running.stop()
                    print("\033[2J\033[H" if sys.stdout.isatty() else "", end="", flush=True)
                    running = Running(check, picture)
                elif key == "h":
                    running.stop()
                    print(flush=True)
                    running = Running(hint)
        except KeyboardInterrupt:
            print()
        finally:
            running.stop()
