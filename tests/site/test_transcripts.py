"""Commands in prose, and what they print: see sources_copy.py."""

from tests.site.sources_copy import STAGE3, Copy


class Transcripts(Copy):
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
