"""Runs a suite and prints its report.

    python3 -m tests.runner PROGRAM [OPTION...]

The options are doctest's: -tc="a floor*" runs the tests whose names match.
"""

import argparse
import signal
import sys

from tests.runner import report, suite, watch


def main():
    parser = argparse.ArgumentParser(
        prog="tests.runner", description=__doc__.splitlines()[0], allow_abbrev=False
    )
    parser.add_argument("--seconds", type=float, help="of processor time, for each test")
    parser.add_argument("--idle-seconds", type=float, default=watch.IDLE_SECONDS, help="with idle threads")
    parser.add_argument("program")
    chosen, options = parser.parse_known_args()
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)  # Windows lacks one of them
        if number and signal.getsignal(number) != signal.SIG_IGN:  # nohup
            # Exits as after an error, so that the suite is killed.
            signal.signal(number, lambda number, _: sys.exit(128 + number))
    limits = {"seconds": chosen.seconds, "idle_seconds": chosen.idle_seconds}
    try:
        outcome = suite.run_by_kinds(chosen.program, *options, **limits)
    except OSError as error:
        sys.exit(f"tests.runner: {chosen.program}: {error.strerror}")
    sys.stdout.reconfigure(errors="backslashreplace")
    if outcome.printed:
        print(outcome.printed.rstrip("\n"))
    print(report.summary(outcome), end="")
    return 0 if outcome.passed else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
