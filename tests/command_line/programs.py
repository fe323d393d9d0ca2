"""What the tests of the command line share: a run that ends, and a folder."""

import functools
import pathlib
import shutil
import signal
import tempfile
import unittest

from compare import stages
from compare.stages import BUILD, ROOT, SCENES, built_stages, read_pfm  # noqa: F401

# No test expects anything to take so long: a hang shall end in a failure.
HANG = 120

run = functools.partial(stages.run, timeout=HANG)


def sanitized():
    """Whether the programs are sanitizer builds, which reserve terabytes."""
    cache = (BUILD / "CMakeCache.txt").read_text()
    return "LIGHTWALK_SANITIZE:STRING=address" in cache


def with_signals(ignored=()):
    """What a program is to find when it starts, even if the tests run under nohup."""

    def set_them():
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN if number in ignored else signal.SIG_DFL)

    return {"preexec_fn": set_them}


class InFolder(unittest.TestCase):
    """A test that has an empty folder for itself."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lightwalk-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_one_line(self, result, message):
        """Exit code 1 and this line on stderr; "..." leaves its end open."""
        self.assertEqual(result.stdout, "")
        self.assertTrue(
            result.stderr.endswith("\n") and result.stderr.count("\n") == 1,
            f"not one line on stderr: {result.stderr[:2000]!r}",
        )
        line = result.stderr[:-1]
        unprintable = [c for c in line if ord(c) < 32 or 127 <= ord(c) < 160]
        self.assertEqual(unprintable, [], line)
        if message.endswith("..."):
            self.assertEqual(line[: len(message) - 3], message[:-3])
        else:
            self.assertEqual(line, message)
        self.assertEqual(result.returncode, 1)
