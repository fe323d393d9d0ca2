"""Marks of exercises and their tasks: see sources_copy.py."""

import subprocess
import sys

from tests.site.sources_copy import STAGE3, Copy

TASKS3 = "stages/3_specular_refraction/exercises.toml"
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
        # The line number is that in the header, marks included.
        header = (self.root / STAGE3).read_text()
        line = header[: header.index("return 2 * dot(wo")].count("\n") + 1
        self.assertIn(f":lineno-start: {line}\n  return 2 * dot(wo", page)
        self.assertIn("[exercise 3.1](#exercise-3-1)", page)
        self.assertIn("3_specular_refraction.html#exercise-3-1", slide)
        self.assertIn('<span class="exercise">', slide)
        task, code = page.index(":name: exercise-3-1"), page.index("inline Vec3 reflect")
        self.assertLess(task, code)

    def test_a_mark_changes_nothing_beside_the_next_stage(self):
        """A region that a later stage repeats without marks counts as unchanged."""
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
            "from tools.tree import stage_headers; path = stage_headers()[3]; "
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
            '"mirroring twice',
            '"mirroring thrice',
            "3.1",
            'no test case of its stage begins "mirroring thrice',
        )

    def test_a_need_that_comes_later(self):
        self.task(
            'needs = ["3.1", "3.2", "3.3"]', 'needs = ["4.1"]', "needs 4.1, which is no exercise before it"
        )

    def test_a_key_that_is_missing(self):
        self.task("minutes = 20\n", "", "exercise 3.4: minutes is missing")

    def test_two_hints(self):
        self.task('  "The part along the normal stays', "#", "3.1", "has 2 hints, not 3")

    def test_a_recap_of_four_lines(self):
        self.task("  \"Snell's law bends a path", "#", "recap has 4 lines, not 5")

    def test_a_formula_in_a_task_that_is_broken(self):
        self.task("$\\\\omega_r = 2", "$\\\\omegar = 2", "exercise 3.1", "omegar")

    def test_a_name_in_a_task_that_is_not_in_the_code(self):
        self.task("Write `reflect`,", "Write `mirrorize`,", "exercise 3.1", "`mirrorize` is not in the code")
