"""What the book refuses, except in exercises and transcripts: see sources_copy.py."""

import re

from tests.mistakes.mistakes import read_mistakes
from tests.site.sources_copy import STAGE1, Copy
from tools.tree import ROOT


class Book(Copy):
    def test_the_sources_as_they_are_pass(self):
        run = self.run_tool("book.build", "--check")
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_a_figure_that_nobody_makes(self):
        self.change("tools/book/pages/index.md", "{figure} five-stages", "{figure} six-stages")
        self.assert_refused("book", "figure 'six-stages' is in no figures.toml")

    def test_a_figure_that_no_script_makes_live(self):
        self.change("tools/book/live/snell.js", 'live("snell"', 'live("snail"')
        self.assert_refused("book", "snell is live, and no script says how")

    def test_without_a_compiler_for_webassembly_the_box_stays_still(self):
        static = self.root / "static"
        static.mkdir()
        (self.build / "left_out.txt").write_text("book: the box (no compiler; tools/setup.sh site)\n")
        run = self.run_tool("live.build", static)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn("tools/setup.sh site", run.stderr)
        self.assertEqual((static / "lab.js").read_text(), "")
        self.assertFalse((static / "lab-module.js").exists())

    def test_a_figure_of_a_chapter_that_nobody_makes(self):
        self.change(STAGE1, "![](hemisphere)", "![](hemispheres)")
        self.assert_refused("book", f"{STAGE1}:", "figure 'hemispheres' is in no figures.toml")

    def test_a_figure_that_nobody_shows(self):
        self.change("stages/4_russian_roulette/path_tracer.hpp", "// ![](event-bar)\n", "")
        for tool in ("book", "slides"):
            self.assert_refused(
                tool, "stages/4_russian_roulette/figures.toml: no chapter, page or slide shows 'event-bar'"
            )

    def test_a_figure_that_stands_there_twice(self):
        self.change(STAGE1, "// ![](samples)\n", "// ![](samples)\n//\n// ![](hemisphere)\n")
        self.assert_refused("book", f"{STAGE1}:", "'hemisphere' stands at", "already")

    def test_a_figure_within_a_line_of_prose(self):
        self.change(STAGE1, "// ![](samples)\n", "// See ![](samples)\n")
        self.assert_refused("book", f"{STAGE1}:", "a figure is a line by itself")

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

    def test_a_wish_to_cmake_that_it_does_not_know(self):
        self.change("stages/6_many_paths/path_tracer.hpp", "`-DLIGHTWALK_NATIVE=", "`-DLIGHTWALK_NAIVE=")
        self.assert_refused("book", "`-DLIGHTWALK_NAIVE=OFF` is not in the code")

    def test_a_reference_that_leads_nowhere(self):
        self.change(
            "tools/book/pages/further_reading.md",
            "([the basis](core/math/basis.md))",
            "([the basis](core/math/bases.md))",
        )
        self.assert_refused("book", "further_reading.md", "core/math/bases.md", arguments=())


class Mistaken(Copy):
    """Figures that show a known mistake."""

    FIGURES = "stages/2_next_event/figures.toml"

    def test_a_mistake_that_nobody_knows(self):
        self.change(self.FIGURES, '"rectangle-without-area"', '"rectangle-without-edges"')
        self.assert_refused(
            "book", "tests/mistakes/stage2.toml: no mistake is called 'rectangle-without-edges'"
        )

    def test_an_exposure_that_is_shared_and_is_not(self):
        first = '"right"%s },\n  { label = "no A"'
        self.change(self.FIGURES, first % "", first % ', options = "--exposure 1"')
        self.assert_refused("book", "lamp-mistakes: a panel has --exposure, and the exposure is shared")

    def test_a_tone_map_that_looks_at_its_own_picture(self):
        self.change(
            self.FIGURES, "--spp 32 --exposure -1", "--spp 32 --exposure -1 --tone-map equalize,gamma"
        )
        self.assert_refused("book", "lamp-mistakes: equalize gives each panel an exposure of its own")

    def test_the_command_of_the_book_renders_the_figure(self):
        """And the picture shows the mistake: without A it differs."""
        self.assertEqual(self.run_tool("book.build", "--check").returncode, 0)
        page = (self.build / "book-source/stages/2_next_event.md").read_text()
        self.assertIn("python3 -m tools.weave.mistaken 2/rectangle-without-area scenes/", page)
        folder = self.build / "book-source/figures"
        pictures = {path.read_bytes() for path in folder.glob("lamp-mistakes-*.png")}
        self.assertEqual(len(pictures), 4)
        scene = "scenes/cornell_box_lamp_diffuse.toml"
        options = "--size 160x160 --spp 32 --exposure -1 --tone-map clamp,gamma --seed 1".split()
        run = self.run_tool(
            "weave.mistaken", "2/rectangle-without-area", scene, "-o", self.root / "a.png", *options
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual((self.root / "a.png").read_bytes(), (folder / "lamp-mistakes-2.png").read_bytes())


class Gallery(Copy):
    """The pages of mistakes."""

    GALLERY = "tools/book/gallery.toml"

    def test_every_mistake_has_its_place(self):
        self.assertEqual(self.run_tool("book.build", "--check").returncode, 0)
        gallery = (self.build / "book-source/mistakes.md").read_text()
        self.assertNotIn("<table", gallery)
        page = (self.build / "book-source/known_mistakes.md").read_text()
        places = re.findall(r'\bid="([\w-]+)"', page)
        self.assertEqual(len(places), len(set(places)))
        for path in sorted((ROOT / "tests/mistakes").glob("stage*.toml")):
            for mistake in read_mistakes(path):
                self.assertIn(mistake.name, places)
                self.assertIn(f"stage{mistake.stage}-{mistake.name}", places)

    def test_a_picture_of_a_mistake_that_nobody_knows(self):
        self.change(self.GALLERY, 'name = "cosine-twice"', 'name = "cosine-thrice"')
        self.assert_refused("book", "gallery.toml: stage 1 has no mistake called 'cosine-thrice'")

    def test_a_picture_of_what_is_no_mistake(self):
        self.change(self.GALLERY, 'name = "cosine-twice"', 'name = "acos-sqrt-xi"')
        self.assert_refused("book", "gallery.toml: stage 1 has no mistake called 'acos-sqrt-xi'")

    def test_a_variant_of_which_nobody_says_why_it_is_right(self):
        self.change(self.GALLERY, "two-numbers-for-a-pair = ", "three-numbers = ")
        self.assert_refused("book", "gallery.toml: 'three-numbers' is no variant that must pass")

    def test_a_pair_of_unlike_exposures(self):
        self.change(
            self.GALLERY, "--max-bounces 2 --exposure -1.5", "--max-bounces 2 --tone-map equalize,gamma"
        )
        self.assert_refused("book", "equalize gives each panel an exposure of its own")
