"""What is made of decks: those of sessions, and those for students."""

import unittest

from tools.slides.deck import decks, for_students
from tools.slides.plans import plans


class Decks(unittest.TestCase):
    def test_students_get_the_questions_without_answers_and_notes(self):
        asked = 0
        for deck in decks():
            for slide in deck.slides:
                handed = for_students(slide)
                self.assertEqual(handed.notes, "", slide.where)
                self.assertEqual(handed.heading, slide.heading, slide.where)
                if "trap" in slide.kinds:
                    asked += 1
                    self.assertRegex(handed.text.rstrip(), r"(?m)^## .*\Z", slide.where)
                else:
                    self.assertEqual(handed.shown.strip(), slide.shown.strip(), slide.where)
        self.assertGreater(asked, 20)

    def test_a_session_opens_with_its_own_class(self):
        for plan, sessions in plans(decks()):
            for one in sessions:
                headings = [slide.heading for slide in one.slides]
                self.assertEqual(headings[:2], [one.title, "Before we begin..."], one.name)
                skipped = {slide.heading for part in one.parts for slide in part.skipped}
                self.assertEqual(skipped & set(headings), set(), one.name)
                recaps = [heading for heading in headings if heading.startswith("Recap: ")]
                self.assertTrue(not recaps or not plan.get("from_the_start"), (one.name, recaps))
