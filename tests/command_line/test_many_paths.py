"""Stage 6 follows many paths at once wherever it can, and does not become stage 5."""

import platform
import re
import unittest
from pathlib import Path

from programs import BUILD, run


def switched_off():
    """What the build was configured to leave out."""
    cache = (BUILD / "CMakeCache.txt").read_text()
    return re.findall(r"^(LIGHTWALK_(?:HIGHWAY|NATIVE)):BOOL=OFF$", cache, re.MULTILINE)


def processor_can():
    """On x86 rows need AVX2, on ARM every processor will do."""
    info = Path("/proc/cpuinfo")
    if platform.machine().lower() in ("arm64", "aarch64"):
        return True
    return info.exists() and " avx2 " in info.read_text()


class ManyPaths(unittest.TestCase):
    @unittest.skipIf(switched_off(), f"switched off: {' '.join(switched_off())}")
    @unittest.skipUnless(processor_can(), "this processor has no AVX2")
    def test_stage_6_says_that_it_follows_many_paths(self):
        said = run("stage6", "--version").stdout
        why = "tools/setup.sh installs Highway, which it needs"
        self.assertRegex(said, r": (4|8|16) paths at once$", why)


if __name__ == "__main__":
    unittest.main()
