"""The book and the slides are not built with a mistake in them: each one is
put into a copy of the sources, and the build must say it in one line."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

from compare.stages import BUILD, ROOT, built_stages
from tests.mistakes.mistakes import read_mistakes

SOURCES = ["common", "compare", "measured", "scenes", "slides", "stages", "tests/mistakes", "tools"]
SOURCES += [f"tests/{name.replace('_tests', '')}" for name in built_stages()]
STAGE1 = "stages/1_diffuse/path_tracer.hpp"
STAGE3 = "stages/3_specular_refraction/path_tracer.hpp"
TASKS3 = "stages/3_specular_refraction/exercises.toml"


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
        for made in (
            "figures",
            "node",
            "stage-diff",
            "compile_commands.json",
            "CMakeCache.txt",
            *built_stages(),
        ):
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

    def test_a_figure_that_no_script_makes_live(self):
        self.change("tools/book/live/snell.js", 'live("snell"', 'live("snail"')
        self.assert_refused("book", "snell is live, and no script says how")

    def test_without_a_compiler_for_webassembly_the_box_stays_still(self):
        os.environ["WASM_CXX"] = "no-such-compiler"
        self.addCleanup(os.environ.pop, "WASM_CXX")
        static = self.root / "static"
        static.mkdir()
        run = self.run_tool("live.build", static)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn("tools/setup.sh site", run.stderr)
        self.assertEqual((static / "lab.js").read_text(), "")
        self.assertFalse((static / "lab-module.js").exists())

    def test_a_figure_of_a_chapter_that_nobody_makes(self):
        self.change(STAGE1, "![](hemisphere)", "![](hemispheres)")
        self.assert_refused("book", f"{STAGE1}:", "figure 'hemispheres' is not in figures.toml")

    def test_a_figure_that_nobody_shows(self):
        self.change("stages/4_russian_roulette/path_tracer.hpp", "// ![](event-bar)\n", "")
        for tool in ("book", "slides"):
            self.assert_refused(tool, "figures.toml: no chapter, page or slide shows 'event-bar'")

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

    def test_a_reference_that_leads_nowhere(self):
        self.change(
            "tools/book/pages/further_reading.md",
            "([the basis](core/math/basis.md))",
            "([the basis](core/math/bases.md))",
        )
        self.assert_refused("book", "further_reading.md", "core/math/bases.md", arguments=())


MARK = """  // #region exercise 3.1: mirror direction
  // #stub return normal;
  return 2 * dot(wo, normal) * normal - wo;
  // #endregion
"""


class Exercises(Copy):
    """Marks in a header, and exercises.toml beside it."""

    def mark(self, old, new):
        self.change(STAGE3, MARK, MARK.replace(old, new))

    def task(self, old, new, *parts):
        self.change(TASKS3, old, new)
        self.assert_refused("book", TASKS3, *parts)

    def test_they_are_listed(self):
        run = self.run_tool("exercises.marks")
        self.assertIn("3.1  mirror direction  " + STAGE3 + ":", run.stdout)

    def test_readers_see_no_mark_but_a_badge(self):
        self.assertEqual(self.run_tool("book.build", "--check").returncode, 0)
        self.assertEqual(self.run_tool("slides.build", "--check").returncode, 0)
        page = (self.build / "book-source/stages/3_specular_refraction.md").read_text()
        slide = (self.build / "slides-source/3_specular_refraction.md").read_text()
        for text in (page, slide):
            self.assertNotRegex(text, r"#region|#stub|#endregion|return normal;")
        # The number of the line is the header's, marks included.
        header = (self.root / STAGE3).read_text()
        line = header[: header.index("return 2 * dot(wo")].count("\n") + 1
        self.assertIn(f":lineno-start: {line}\n  return 2 * dot(wo", page)
        self.assertIn("[exercise 3.1](#exercise-3-1)", page)
        self.assertIn("3_specular_refraction.html#exercise-3-1", slide)
        self.assertIn('<span class="exercise">', slide)
        task, code = page.index(":name: exercise-3-1"), page.index("inline Vec3 reflect")
        self.assertLess(task, code)

    def test_a_mark_changes_nothing_beside_the_next_stage(self):
        """A region that a later stage repeats without marks is as it was."""
        name = "stages/4_russian_roulette/path_tracer.hpp"
        region = "// #region reflect\nint x = 1;\n// #endregion reflect\n"
        self.change(name, "// #region lobe-probabilities\n", region + "\n// #region lobe-probabilities\n")
        header = self.root / STAGE3
        text = header.read_text()
        head, tail = text.split("// #region reflect\n")
        body = "// #region exercise 3.1: mirror direction\n// #stub int x = 0;\nint x = 1;\n// #endregion\n"
        header.write_text(head + "// #region reflect\n" + body + tail[tail.index("// #endregion reflect") :])
        says = (
            "from tools.book.page import mark; from tools.weave.literate import pieces; "
            "from compare.stages import stage_headers; path = stage_headers()[3]; "
            "print(next(mark(path, one)[0] for one in pieces(path) if one.region == 'reflect'))"
        )
        run = subprocess.run([sys.executable, "-c", says], cwd=self.root, capture_output=True, text=True)
        self.assertEqual(run.stdout.strip(), "{bdg-secondary}`as in stage 3`", run.stderr)

    def test_a_number_that_leaves_a_gap(self):
        self.mark("exercise 3.1", "exercise 3.2")
        self.assert_refused("book", f"{STAGE3}:", "exercise 3.2, but 3.1 comes next")

    def test_a_number_that_is_there_twice(self):
        self.change(STAGE3, MARK, MARK + MARK)
        self.assert_refused("book", f"{STAGE3}:", "exercise 3.1 again, after line")

    def test_a_number_of_another_stage(self):
        self.mark("exercise 3.1", "exercise 2.1")
        self.assert_refused("book", f"{STAGE3}:", "2.1 does not belong to this header")

    def test_a_mark_without_title(self):
        self.mark(": mirror direction", "")
        self.assert_refused("book", f"{STAGE3}:", "a mark is '// #region exercise 3.1: title'")

    def test_a_mark_that_is_not_ended(self):
        self.mark("  // #endregion\n", "")
        self.assert_refused("book", f"{STAGE3}:", "exercise 3.1 is not ended")

    def test_a_mark_within_another(self):
        self.mark("  return 2", "  // #region exercise 3.2: half of it\n  return 2")
        self.assert_refused("book", f"{STAGE3}:", "within exercise 3.1")

    def test_a_mark_outside_of_a_region(self):
        self.change(STAGE3, MARK, "")
        self.change(STAGE3, "// #region reflect\n", MARK + "// #region reflect\n")
        self.assert_refused("book", f"{STAGE3}:", "exercise 3.1 stands in no region")

    def test_a_stub_that_is_missing(self):
        self.mark("  // #stub return normal;\n", "")
        self.assert_refused("book", f"{STAGE3}:", "exercise 3.1 has no '// #stub'")

    def test_a_stub_after_the_body(self):
        self.mark("  // #endregion", "  // #stub return wo;\n  // #endregion")
        self.assert_refused("book", f"{STAGE3}:", "follows the mark of an exercise")

    def test_a_body_that_is_too_long(self):
        self.mark("  return 2", "  // Long.\n" * 20 + "  return 2")
        self.assert_refused("book", f"{STAGE3}:", "has 21 lines, and at most 20")

    def test_a_task_without_mark(self):
        self.task('number = "3.1"', 'number = "3.9"', "exercise 3.9 has no mark in path_tracer.hpp")

    def test_a_mark_without_task(self):
        self.change(STAGE3, "// #endregion path", MARK.replace("3.1", "3.6") + "// #endregion path")
        self.assert_refused("book", f"{STAGE3}:", "exercise 3.6 has no task in", TASKS3)

    def test_a_chapter_without_tasks(self):
        (self.root / TASKS3).unlink()
        self.assert_refused("book", f"{STAGE3}:", "exercise 3.1 has no task", f"there is no {TASKS3}")

    def test_a_test_that_there_is_not(self):
        self.task(
            '"mirrored twice', '"mirrored thrice', "3.1", 'no test case of its stage begins "mirrored thrice'
        )

    def test_a_need_that_comes_later(self):
        self.task(
            'needs = ["3.1", "3.2", "3.3"]', 'needs = ["4.1"]', "needs 4.1, which is no exercise before it"
        )

    def test_a_key_that_is_missing(self):
        self.task("minutes = 20\n", "", "exercise 3.4: minutes is missing")

    def test_a_single_hint(self):
        self.task('  "The part along the normal stays', "#", "3.1", "has 1 hints, not 2")

    def test_a_recap_of_four_lines(self):
        self.task("  \"Snell's law bends a path", "#", "recap has 4 lines, not 5")

    def test_a_formula_in_a_task_that_is_broken(self):
        self.task("$\\\\omega_r = 2", "$\\\\omegar = 2", "exercise 3.1", "omegar")

    def test_a_name_in_a_task_that_is_not_in_the_code(self):
        self.task("Write `reflect`,", "Write `mirrorize`,", "exercise 3.1", "`mirrorize` is not in the code")


class Transcripts(Copy):
    """Commands in prose, and what the prose says that they print."""

    def said(self, old, new, *parts):
        self.change(STAGE3, old, new)
        self.assert_refused("book", f"{STAGE3}:", *parts)

    def test_a_number_that_the_program_does_not_say(self):
        text = (self.root / STAGE3).read_text()
        line = text[: text.index("2.025,")].count("\n") + 1
        self.said(
            "//         weight     (   2.025,",
            "//         weight     (   2.026,",
            f"{STAGE3}:{line} says 'weight ( 2.026, 2.025, 2.025) to vertex 8', the program says "
            "'weight ( 2.025, 2.025, 2.025) to vertex 8'",
        )

    def test_fewer_digits_and_what_is_left_out(self):
        self.change(STAGE3, "(   2.025,    2.025,    2.025)  to vertex 8", "(2.03, 2.0, ...")
        run = self.run_tool("book.build", "--check")
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_a_whole_number_is_not_rounded(self):
        self.said("(   2.025,    2.025,", "(       2,    2.025,", "says 'weight ( 2, 2.025,")

    def test_a_word_that_the_program_does_not_say(self):
        self.said(
            "0.9214)  refraction", "0.9214)  refracted", "0.9214) refracted', the program says 'goes on"
        )

    def test_lines_that_are_left_out_without_a_word(self):
        self.said(
            "//     ...\n//     vertex 0:",
            "//     vertex 0:",
            "the program says 'stage3: pixel 170,200, sample 3",
        )

    def test_an_end_that_is_left_out(self):
        self.said(
            "//     ...\n//     radiance of this sample = (0.06553, 0.05423, 0.05423)\n",
            "",
            "ends there, the program says more: 'sum",
        )

    def test_a_program_that_there_is_not(self):
        self.said("$ build/stage3", "$ build/stage33", "build/stage33 has not been built")

    def test_a_command_that_is_no_program_of_the_build(self):
        self.said("$ build/stage3", "$ rm -r", "'rm' is no program of build/")

    def test_a_command_that_fails(self):
        self.said("> --pixel 170,200", "> --pixel 170,2000", "--pixel 170,2000 --sample 3: ")


class Mistaken(Copy):
    """Figures that show a known mistake."""

    FIGURES = "tools/weave/figures.toml"

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
        """And the mistake is in the picture: without A it is another one."""
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
    """The page of mistakes."""

    GALLERY = "tools/book/gallery.toml"

    def test_every_mistake_has_its_place(self):
        self.assertEqual(self.run_tool("book.build", "--check").returncode, 0)
        page = (self.build / "book-source/mistakes.md").read_text()
        places = re.findall(r'\bid="([\w-]+)"', page) + re.findall(r"^\(([\w-]+)\)=$", page, re.M)
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


class Drawings(Copy):
    """What is drawn, for light pages and dark ones."""

    def draw(self, body):
        """Adds a drawing of these lines to the copy, and draws it."""
        program = (
            "from tools.weave import drawing as d\nimport sys\n"
            "from compare.stages import Failure\n"
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

    def test_a_color_without_counterpart(self):
        run = self.draw("yield d.circle(10, 10, 5, '#123456')")
        self.assert_one_line(run, "drawing", ["'new'", "#123456 has no color on dark pages"])


class Prose(Copy):
    """The counts of tools.weave.prose."""

    def report(self, *added):
        old = "// # Stage 3: perfect mirrors and glass\n//\n"
        self.change(STAGE3, old, old + "".join(f"// {line}".rstrip() + "\n" for line in [*added, ""]))
        run = self.run_tool("weave.prose")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout

    def test_a_sentence_of_31_words(self):
        report = self.report(*["word " * 10] * 3, "end.")
        self.assertIn(f"{STAGE3}:5: 31 words: word word", report)

    def test_a_sentence_of_30_words_with_a_formula_that_is_one(self):
        report = self.report(*["word " * 10] * 2, "word " * 9 + "$a + b +", "c + d = e + f$.")
        self.assertNotIn(f"{STAGE3}:5:", report)

    def test_a_paragraph_of_nine_lines(self):
        self.assertIn(f"{STAGE3}:5: a paragraph of 9 lines", self.report(*["Short."] * 9))

    def test_a_screen_without_figure(self):
        report = self.report(*["Short.", ""] * 46)
        self.assertRegex(report, rf"{STAGE3}:3: \d+ lines of prose without a figure")
        self.assertNotIn(f"{STAGE3}:5: a paragraph", report)


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

    def test_a_line_of_the_course_that_is_empty_is_left_out(self):
        self.change("slides/course.toml", '"Last day" = "fill in slides/course.toml"', '"Last day" = ""')
        self.assertEqual(self.run_tool("slides.build", "--check").returncode, 0)
        deck = (self.build / "slides-source/0_recap.md").read_text()
        self.assertNotIn("Last day", deck)
        self.assertIn("Recommended deadline", deck)

    def test_a_line_of_the_course_that_is_no_text(self):
        self.change("slides/course.toml", '"Last day" = "fill in slides/course.toml"', '"Last day" = 11')
        self.assert_refused("slides", 'slides/course.toml: "Last day" is a text in quotes')

    def test_a_file_of_the_course_that_is_broken(self):
        self.change("slides/course.toml", '"Last day" = ', '"Last day" ')
        self.assert_refused("slides", "slides/course.toml: ", "line")

    def test_a_plan_that_skips_a_slide_that_there_is_not(self):
        self.change("slides/plans.toml", '"Random numbers"', '"Random digits"')
        self.assert_refused("slides", "plans.toml: 'Two sessions', session 1: no slide", "'Random digits'")

    def test_a_session_that_takes_too_long(self):
        self.change("slides/plans.toml", "minutes = 90", "minutes = 60")
        self.assert_refused("slides", "'Five sessions', session 1: takes", "not 60")


class Coverage(Copy):
    def test_a_title_of_the_course_without_a_slide(self):
        self.change("slides/4_russian_roulette.md", "# Material combinations", "# Combinations")
        self.assert_refused("slides", "'Material combinations'", "no slide of 4_russian_roulette")

    def test_a_region_that_there_is_not(self):
        self.change("slides/coverage.toml", 'path_tracer.hpp#refract"', 'path_tracer.hpp#refraction"')
        self.assert_refused("slides", "coverage.toml", "#refraction: no such")

    def test_a_formula_that_the_chapter_has_not(self):
        self.change(STAGE3, r"\qquad p(\omega_t) = 1$$", r"\qquad p(\omega_t)$$")
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
