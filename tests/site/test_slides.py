"""What the slides refuse: see sources_copy.py."""

from tests.site.sources_copy import Copy


class Slides(Copy):
    def test_the_sources_as_they_are_pass(self):
        run = self.run_tool("slides.build", "--check")
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_a_region_that_there_is_not(self):
        self.change("slides/2_next_event.md", "#rectangle-light", "#rectangle-lights")
        self.assert_refused(
            "slides", "slides/2_next_event.md:", "path_tracer.hpp#rectangle-lights: no such region"
        )

    def test_a_step_that_there_is_not(self):
        self.change("slides/5_fresnel_textures.md", "Draw an event", "Draw two events")
        self.assert_refused("slides", "slides/5_fresnel_textures.md:", "no step begins 'Draw two events'")

    def test_code_that_does_not_fit(self):
        self.change("slides/2_next_event.md", "#light-sample", "#sphere-light")
        self.assert_refused("slides", "do not fit a slide")

    def test_a_marked_line_that_there_is_not(self):
        self.change(
            "slides/1_diffuse.md",
            'steps="inline Vec3 sample_uniform; inline float uniform" marks="',
            'marks="const int theta; ',
        )
        self.assert_refused("slides", "slides/1_diffuse.md:", "no line begins 'const int theta'")

    def test_a_figure_that_nobody_makes(self):
        self.change("slides/2_next_event.md", "{figure} next-event", "{figure} last-event")
        self.assert_refused("slides", "figure 'last-event' is in no figures.toml")

    def test_a_formula_that_is_broken(self):
        self.change("slides/2_next_event.md", r"$$\frac{I}{d^2}$$", r"$$\frac{I}{d^2$$")
        self.assert_refused("slides", "slides/2_next_event.md:", "Missing close brace")

    def test_a_name_that_is_not_in_the_code(self):
        self.change("slides/2_next_event.md", "We call it `intensity`", "We call it `wattage`")
        self.assert_refused("slides", "`wattage` is not in the code")

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
        self.change("slides/plans.toml", "minutes = 90\nfrom_the_start", "minutes = 60\nfrom_the_start")
        self.assert_refused("slides", "'Five sessions', session 1: takes", "not 60")

    def test_a_link_to_a_region_that_there_is_not(self):
        self.change(
            "slides/4_russian_roulette.md",
            "_book: common/geometry/plane.hpp#plane-",
            "_book: common/geometry/plane.hpp#line-",
        )
        self.assert_refused(
            "slides", "slides/4_russian_roulette.md:", "plane.hpp#line-intersection: no such region"
        )
