"""Tests the post-processing of built pages: colors of code, words of formulas,
and lines that stay together."""

import importlib.util
import pathlib
import tempfile
import unittest
from types import SimpleNamespace

from tools.book.keep_together import keep_together
from tools.exercises.words import formula
from tools.slides.formulas import name_formulas
from tools.tree import Failure


def luminance(color):
    parts = [int(color[i : i + 2], 16) / 255 for i in (0, 2, 4)]
    red, green, blue = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue + 0.05


def contrast(one, other):
    dark, light = sorted((luminance(one), luminance(other)))
    return light / dark


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.page = pathlib.Path(folder.name) / "page.html"

    def kept(self, text):
        self.page.write_text(text)
        keep_together(self.page.parent)
        return self.page.read_text()


@unittest.skipUnless(importlib.util.find_spec("pygments"), "Pygments comes with the book")
class Colors(unittest.TestCase):
    # A listing, on a page and on a slide, and lines of it that are new.
    GROUNDS = ("f8f8f8", "f6e9cf", "f6f2ea", "fbe6b5")

    def test_every_kind_of_word_stands_out(self):
        from tools.weave.code_colors import CodeColors

        for token, style in CodeColors:
            if style["color"] and "Whitespace" not in str(token):
                for ground in self.GROUNDS:
                    with self.subTest(token=str(token), ground=ground):
                        self.assertGreaterEqual(contrast(style["color"], ground), 4.5, style["color"])


class Formulas(Page):
    def test_words_of_a_formula(self):
        self.assertEqual(formula(r"1/\sqrt N"), "1/√(N)")
        self.assertEqual(formula(r"\tfrac12 (r_s^2 + r_p^2)"), "1/2 (r_s^2 + r_p^2)")
        self.assertEqual(formula("\\frac{a}\n{b} \\qquad \\Phi"), "a/b Φ")

    def name(self, shown, html):
        self.page.write_text(html)
        slide = SimpleNamespace(shown=shown, where="slides/x.md:4")
        name_formulas(self.page, SimpleNamespace(name="x", slides=[slide]))
        return self.page.read_text()

    def test_a_slide_says_its_formulas(self):
        named = self.name(r"$p < 1$", '<mjx-container class="MathJax" jax="SVG"><svg width="2ex">')
        self.assertIn('<svg aria-label="p &lt; 1" width="2ex">', named)

    def test_another_number_of_formulas(self):
        with self.assertRaisesRegex(Failure, "x: 2 formulas in the deck, 0 on its slides"):
            self.name("$a$ and $b$", "<p>none</p>")


class Lines(Page):
    FORMULA = '<span class="math"><mjx-container>x</mjx-container></span>'

    def test_a_mark_stays_with_its_formula(self):
        self.assertEqual(
            self.kept(f"if ({self.FORMULA}), {self.FORMULA} is"),
            f'if <span class="keep">({self.FORMULA}),</span> {self.FORMULA} is',
        )

    def test_a_bracket_stays_with_its_word_of_code(self):
        word = '<code class="docutils literal notranslate"><span class="pre">a.toml</span></code>'
        self.assertEqual(
            self.kept(f"in ({word}, or {word} is"), f'in <span class="keep">({word},</span> or {word} is'
        )

    def test_an_option_is_not_divided(self):
        head = '<div class="highlight-none notranslate"><div class="highlight"><pre>'
        self.assertEqual(
            self.kept(f"{head}stage1 a-b.toml -o box.png</pre> a -o"),
            f'{head}stage1 a-b.toml <span class="keep">-o</span> box.png</pre> a -o',
        )

    def test_only_a_long_word_of_code_may_be_divided(self):
        short, long = "a" * 30, "a" * 31
        self.assertEqual(
            self.kept(f'<span class="pre">{short}</span><span class="pre">{long}</span>'),
            f'<span class="pre">{short}</span><span class="pre long">{long}</span>',
        )


if __name__ == "__main__":
    unittest.main()
