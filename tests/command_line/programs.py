"""What the tests of the command line share: runs with a limit, and a folder."""

import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from tests.runner import watch
from tools.tree import BUILD, ROOT, SCENES, built_stages, read_pfm  # noqa: F401

# More seconds of processor time than any program of the tests needs, so that a
# hang fails. There is no wall-clock limit, since the machine may be busy.
HANG = 240


# EXR files need OpenImageIO, in a module beside the programs.
HAS_EXR = any(BUILD.glob("*lightwalk_openimageio.*"))
ENDINGS = ["pfm", "ppm", "png", *(["exr"] if HAS_EXR else [])]


def communicate(process, text=None):
    return watch.communicate(process, text, HANG)


def wait_until(process, condition):
    return watch.wait_until(process, condition, HANG)


def run_command(command, seconds=HANG, **options):
    """Runs a command to its end; its output is text."""
    pipes = dict(stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    pipes |= dict(encoding="utf-8", errors="backslashreplace")
    with subprocess.Popen(command, **(pipes | options)) as process:
        said = watch.communicate(process, seconds=seconds)
    return subprocess.CompletedProcess(command, process.returncode, *said)


def run(program, *arguments, folder=None, **options):
    """The same for a program of the build."""
    return run_command([BUILD / program, *map(str, arguments)], cwd=folder, **options)


def sanitized():
    """Whether the programs are sanitizer builds, which reserve terabytes."""
    cache = (BUILD / "CMakeCache.txt").read_text()
    return "LIGHTWALK_SANITIZE:STRING=address" in cache


def with_signals(ignored=()):
    """The signal handling that a program starts with, even if the tests run under nohup."""

    def set_them():
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU):
            signal.signal(number, signal.SIG_IGN if number in ignored else signal.SIG_DFL)

    return {"preexec_fn": set_them}


class InFolder(unittest.TestCase):
    """A test with an empty folder of its own."""

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
