"""`make check` with a stage that does not exist."""

import sys
import unittest

from programs import ROOT, run_command


class WrongUsage(unittest.TestCase):
    def refused(self, argument, said):
        result = run_command([sys.executable, "-m", "tools.exercises.check", argument], cwd=ROOT)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, rf"^check: {said}\n$")

    def test_a_stage_that_is_not_there(self):
        for argument, shown in [("9", "9"), ("one", "'one'"), ("1_diffuse", "'1_diffuse'"), ("1_", "'1_'")]:
            with self.subTest(argument):
                self.refused(argument, f"stage {shown} has no exercises in this tree; [1-9](, [1-9])* have")

    def test_an_unknown_option(self):
        self.refused("--wach", "unrecognized arguments: --wach")


if __name__ == "__main__":
    unittest.main()
