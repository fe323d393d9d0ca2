"""The book and the slides are not built with a mistake in them: each one is
put into a copy of the sources, and the build must say it in one line."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from compare.stages import BUILD, ROOT, built_stages

SOURCES = ["common", "compare", "scenes", "slides", "stages", "tests/mistakes", "tools"]
STAGE1 = "stages/1_diffuse/path_tracer.hpp"
STAGE3 = "stages/3_specular_refraction/path_tracer.hpp"


class Copy(unittest.TestCase):
    """A test that has the sources to itself, and the programs and figures of
    the real build."""

    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="lightwalk-site-"))
        self.addCleanup(shutil.rmtree, self.root)
        for folder in SOURCES:
            shutil.copytree(ROOT / folder, self.root / folder, ignore=shutil.ignore_patterns("__pycache__"))
        self.build = self.root / "build"
        self.build.mkdir()
        for made in ("figures", "node", *built_stages()):
            (self.build / made).symlink_to((BUILD / made).resolve())

    def change(self, path, old, new):
        """Replaces a text that must be there once."""
        text = (self.root / path).read_text()
        self.assertEqual(text.count(old), 1, f"'{old}' in {path}")
        (self.root / path).write_text(text.replace(old, new))

    def run_tool(self, tool, *arguments):
        return subprocess.run(
            [sys.executable, "-m", f"tools.{tool}", *arguments],
            cwd=self.root,
            env=os.environ | {"LIGHTWALK_BUILD": str(self.build)},
            capture_output=True,
            text=True,
        )

    def assert_refused(self, tool, *parts, arguments=("--check",)):
        run = self.run_tool(f"{tool}.build", *arguments)
        self.assert_one_line(run, tool, parts)

    def assert_one_line(self, run, program, parts):
        self.assertEqual(run.returncode, 1, run.stderr or run.stdout)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertTrue(run.stderr.startswith(f"{program}: "), run.stderr)
        for part in parts:
            self.assertIn(part, run.stderr)


class Book(Copy):
    def test_the_sources_as_they_are_pass(self):
        run = self.run_tool("book.build", "--check")
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_a_figure_that_nobody_makes(self):
        self.change("tools/book/pages/index.md", "{figure} five-stages", "{figure} six-stages")
        self.assert_refused("book", "figure 'six-stages' is not in figures")

    def test_a_figure_after_a_region_that_there_is_not(self):
        self.change(STAGE1, "// #region weight", "// #region weights")
        self.change(STAGE1, "// #endregion weight", "// #endregion weights")
        self.assert_refused("book", "no region nor section 'weight'")

    def test_a_region_that_is_not_ended(self):
        self.change(STAGE1, "// #endregion path\n", "")
        self.assert_refused("book", f"{STAGE1}: region path not ended")

    def test_a_formula_that_is_broken(self):
        self.change(STAGE1, r"// $$f_r = \frac{k_d}{\pi}$$", r"// $$f_r = \frac{k_d}{\pi$$")
        self.assert_refused("book", STAGE1, r"f_r = \frac{k_d}{\pi", "Missing close brace")

    def test_a_formula_with_an_unknown_command(self):
        self.change(STAGE1, r"// $$f_r = \frac{k_d}{\pi}$$", r"// $$f_r = \fraction{k_d}{\pi}$$")
        self.assert_refused("book", STAGE1, r"\fraction")

    def test_a_line_of_prose_that_is_too_long(self):
        self.change(STAGE1, "// ## The material\n", "// ## The material\n//\n// " + "long " * 16 + "\n")
        self.assert_refused("book", STAGE1, "over 78 columns")

    def test_a_name_that_is_not_in_the_code(self):
        self.change(STAGE1, "on; `throughput` is", "on; `throughputs` is")
        self.assert_refused("book", STAGE1, "`throughputs` is not in the code")

    def test_a_reference_that_leads_nowhere(self):
        self.change(
            "tools/book/pages/further_reading.md",
            "([the basis](core/math/basis.md))",
            "([the basis](core/math/bases.md))",
        )
        self.assert_refused("book", "further_reading.md", "core/math/bases.md", arguments=())


class Slides(Copy):
    def test_the_sources_as_they_are_pass(self):
        run = self.run_tool("slides.build", "--check")
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_a_region_that_there_is_not(self):
        self.change("slides/2_next_event.md", "#direct-light", "#direct-lights")
        self.assert_refused(
            "slides", "slides/2_next_event.md:", "path_tracer.hpp#direct-lights: no such region"
        )

    def test_a_step_that_there_is_not(self):
        self.change("slides/5_fresnel_textures.md", "Draw an event", "Draw two events")
        self.assert_refused("slides", "slides/5_fresnel_textures.md:", "no step begins 'Draw two events'")

    def test_code_that_does_not_fit(self):
        self.change("slides/2_next_event.md", "#light-sample", "#sphere-light")
        self.assert_refused("slides", "do not fit a slide")

    def test_a_figure_that_nobody_makes(self):
        self.change("slides/2_next_event.md", "{figure} next-event", "{figure} last-event")
        self.assert_refused("slides", "figure 'last-event' is not in figures")

    def test_a_formula_that_is_broken(self):
        self.change("slides/2_next_event.md", r"$$\frac{I}{d^2}$$", r"$$\frac{I}{d^2$$")
        self.assert_refused("slides", "slides/2_next_event.md:", "Missing close brace")

    def test_a_name_that_is_not_in_the_code(self):
        self.change("slides/2_next_event.md", "We call it `intensity`", "We call it `power`")
        self.assert_refused("slides", "`power` is not in the code")

    def test_a_slide_whose_notes_have_no_time(self):
        self.change("slides/2_next_event.md", "2 min\nThe only light", "The only light")
        self.assert_refused("slides", "slides/2_next_event.md:", "the notes of 'A point light' begin with")

    def test_notes_that_marp_would_take_for_settings(self):
        self.change("slides/2_next_event.md", "The only light that", "Note: the only light that")
        self.assert_refused("slides", "a colon in notes")


class Coverage(Copy):
    def test_a_title_of_the_course_without_a_slide(self):
        self.change("slides/4_russian_roulette.md", "# Material combinations", "# Combinations")
        self.assert_refused("slides", "'Material combinations'", "no slide of 4_russian_roulette")

    def test_a_region_that_there_is_not(self):
        self.change("slides/coverage.toml", 'path_tracer.hpp#refract"', 'path_tracer.hpp#refraction"')
        self.assert_refused("slides", "coverage.toml", "#refraction: no such")

    def test_a_formula_that_the_chapter_has_not(self):
        self.change(STAGE3, r"$p(\omega_t) = 1$", r"$p(\omega_t)$ of 1")
        self.assert_refused("slides", r"p(\omega_t) = 1 is not in", STAGE3)

    def test_a_formula_that_the_deck_has_not(self):
        self.change("slides/3_specular_refraction.md", r"$$p(\omega_t) = 1$$", "certain")
        self.assert_refused("slides", r"p(\omega_t) = 1 is not in", "3_specular_refraction")

    def test_a_trap_where_the_lecture_does_not_stop(self):
        self.change("slides/2_next_event.md", "<!-- _class: trap -->\n# Counted once", "# Counted once")
        self.assert_refused("slides", "trap 'Counted once'")


class Offline(Copy):
    """The pages ask nobody for anything; links are no requests."""

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


if __name__ == "__main__":
    unittest.main()
