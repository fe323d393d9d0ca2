"""The figures that live, where something is missing."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from compare.stages import Failure
from tools.live import box
from tools.live.build import add_live, check_live


class Live(unittest.TestCase):
    def test_without_a_compiler_the_box_stays_still_and_the_book_says_so(self):
        for missing in (["no-such-compiler"], ["false"]):
            folder = Path(tempfile.mkdtemp(prefix="lightwalk-live-"))
            said = io.StringIO()
            with mock.patch.object(box, "COMPILER", missing), contextlib.redirect_stderr(said):
                add_live(folder)
            self.assertEqual(said.getvalue().count("\n"), 1, said.getvalue())
            self.assertIn("tools/setup.sh live", said.getvalue())
            script = (folder / "live.js").read_text()
            self.assertNotIn("live.figures.box", script)
            self.assertIn("live.figures.snell", script)
            self.assertFalse((folder / "live-box.js").exists())

    def test_a_figure_that_no_script_makes_live(self):
        with self.assertRaisesRegex(Failure, "five-stages: no script makes 'cube' live"):
            check_live({"five-stages": {"name": "five-stages", "live": "cube"}})


if __name__ == "__main__":
    unittest.main()
