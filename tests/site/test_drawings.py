"""Drawings, and that pages request nothing: see sources_copy.py."""

import subprocess
import sys
from xml.etree import ElementTree

from tests.site.sources_copy import Copy


class Drawings(Copy):
    """Drawings for light and dark pages."""

    def draw(self, body):
        """Adds a drawing of these lines to the copy, and draws it."""
        program = (
            "from tools.weave import drawing as d\nimport sys\n"
            "from tools.tree import Failure\n"
            f"@d.diagram('new', 541, 300)\ndef new():\n    {body}\n"
            "try:\n    print(*d.draw('new'), sep='\\0')\n"
            "except Failure as error:\n    sys.exit(f'drawing: {error}')\n"
        )
        return subprocess.run([sys.executable, "-c", program], cwd=self.root, capture_output=True, text=True)

    def assert_drawn(self, body):
        run = self.draw(body)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        light, dark = map(ElementTree.fromstring, run.stdout.split("\0"))
        self.assertEqual(len(list(light.iter())), len(list(dark.iter())))
        return light

    def texts(self, drawing):
        return [
            "".join(e.itertext()).replace("\u200b", "") for e in drawing.iter() if e.tag.endswith("}text")
        ]

    def test_an_arrow_an_angle_and_a_surface(self):
        drawn = self.assert_drawn(
            "yield from d.hatched(100, 200, 300, 200)\n"
            "    yield from d.arrow(200, 200, 200, 100, 'w_o', d.COOL)\n"
            "    yield from d.angle(200, 200, 0, 40, 50, 'θ')\n"
            "    yield d.dashed(0, 0, 9, 9)"
        )
        self.assertEqual(self.texts(drawn), ["ωo", "θ"])
        # Twenty strokes below a floor that is drawn from left to right.
        strokes = [
            e.get("d") for e in drawn.iter() if e.get("stroke-width") == "1" and not e.get("stroke-dasharray")
        ]
        self.assertEqual(len(strokes), 20)
        self.assertTrue(all(path.split()[-1] == "209.0" for path in strokes), strokes)

    def test_a_curve_goes_through_its_values(self):
        drawn = self.assert_drawn("yield from d.plot(100, 200, 80, 50, [(lambda t: t, d.WARM)], 0, 2, top=2)")
        points = next(e.get("points") for e in drawn.iter() if e.get("points")).split()
        self.assertEqual((points[0], points[40], points[80]), ("100.0,200.0", "140.0,175.0", "180.0,150.0"))

    def test_a_table_dots_and_a_tree(self):
        drawn = self.assert_drawn(
            "yield from d.boxes(10, 10, [['a', 'b'], ['c', 'd']], [50, 70], fills=[(1, 1, d.GLOW)])\n"
            "    yield from d.dots([(1, 2), (3, 4)])\n"
            "    yield from d.tree(270, 150, 400, ('A', [('B', []), ('C', [('D', []), ('E', [])])]))"
        )
        self.assertEqual(self.texts(drawn)[:4], ["a", "b", "c", "d"])
        self.assertEqual(sorted(self.texts(drawn)[4:]), ["A", "B", "C", "D", "E"])
        at = [(e.get("cx"), e.get("cy")) for e in drawn.iter() if e.get("r") == "13"]
        self.assertEqual(len(set(at)), 5)

    def test_small_letters_are_raised(self):
        drawn = self.assert_drawn("yield d.text(100, 100, 'small', size=9)")
        self.assertEqual([e.get("font-size") for e in drawn.iter() if e.tag.endswith("}text")], ["16"])

    def test_an_index_is_one_letter_or_max(self):
        drawn = self.assert_drawn("yield d.text(100, 100, 'sin t_max = w_o')")
        self.assertEqual(self.texts(drawn), ["sin θmax = ωo"])
        indices = [e.text for e in drawn.iter() if e.tag.endswith("}tspan") and e.get("font-size")]
        self.assertEqual(indices, ["max", "o"])

    def test_a_color_without_counterpart(self):
        run = self.draw("yield d.circle(10, 10, 5, '#123456')")
        self.assert_one_line(run, "drawing", ["'new'", "#123456 has no color on dark pages"])


class Offline(Copy):
    """The pages request nothing from other servers; links are no requests."""

    def check(self, name, text):
        pages = self.root / "pages"
        pages.mkdir()
        (pages / name).write_text(text)
        return self.run_tool("weave.offline", pages)

    def assert_found(self, name, text):
        run = self.check(name, text)
        self.assert_one_line(run, "offline", [f"pages/{name}", "example.org"])

    def test_a_script(self):
        self.assert_found("a.html", '<script src="https://example.org/a.js">')

    def test_a_picture_without_a_scheme(self):
        self.assert_found("a.html", "<img alt='' src='//example.org/a.png'>")

    def test_a_style_sheet(self):
        self.assert_found("a.html", '<link rel="stylesheet" href="https://example.org/a.css">')

    def test_a_font(self):
        self.assert_found("a.css", "@font-face { src: url(https://example.org/a.woff2) }")

    def test_an_import(self):
        self.assert_found("a.css", '@import "https://example.org/a.css";')

    def test_a_link_is_no_request(self):
        run = self.check(
            "a.html", '<a href="https://example.org">there</a><svg xmlns="http://www.w3.org/2000/svg"/>'
        )
        self.assertEqual((run.returncode, run.stderr), (0, ""))
