"""All mutants of a header in one text; one of them is chosen at run time.

    (a - b)     becomes   (LIGHTWALK_MUTANT(7) ? (a + b) : (a - b))
    sum += x;   becomes   { if (LIGHTWALK_MUTANT(8)) { ; } else { sum += x; } }

So a suite is compiled once, and each mutant costs one run of it. The
environment variable LIGHTWALK_MUTANT has the number; 0, or nothing, is the
header as it is. Numbers count from 1, and each stands at the beginning of a
line, so that a compiler error shows which mutant does not compile.
"""

import re

CHOICE = """
#include <cstdlib>
namespace lightwalk_mutants {
inline const int chosen = [] {
  const char* const number = std::getenv("LIGHTWALK_MUTANT");
  return number ? std::atoi(number) : 0;
}();
}  // namespace lightwalk_mutants
#define LIGHTWALK_MUTANT(number) (lightwalk_mutants::chosen == number)
"""


class Place:
    """A range of the source, what may stand there, and the places within."""

    def __init__(self, start, end, statement, before=""):
        self.start, self.end, self.statement, self.before = start, end, statement, before
        self.choices = []  # (number, text)
        self.inner = []

    def text(self, source):
        text, at = self.before, self.start
        for one in sorted(self.inner, key=lambda place: place.start):
            text += source[at : one.start].decode() + one.text(source)
            at = one.end
        text += source[at : self.end].decode()
        if not self.choices:
            return text
        if self.statement:
            lines = "".join(f"\nif (LIGHTWALK_MUTANT({n})) {{ {new} }} else" for n, new in self.choices)
            return f"{{{lines} {{ {text}\n}}\n}}"
        lines = "".join(f"\nLIGHTWALK_MUTANT({n}) ? ({new}) :" for n, new in self.choices)
        return f"({lines}\n({text}))"


def with_choices(source, mutants, functions):
    """The header's text with these mutants in it, {number: Mutant}.

    Its functions, which begin at `functions`, are not inlined: that many
    branches in each test that calls them take minutes to compile.
    """
    places = {}
    for number, mutant in mutants.items():
        for start, end, new in mutant.edits:
            key = (start, -end, not mutant.statement)
            place = places.setdefault(key, Place(start, end, mutant.statement))
            place.choices.append((number, " ".join(re.sub(r"//.*", "", new).split())))
    root = Place(0, len(source), False)
    root.inner = [Place(start, start, False, "[[gnu::noinline]] ") for start in functions]
    stack = [root]
    for key in sorted(places):
        place = places[key]
        while place.start >= stack[-1].end or place.end > stack[-1].end:
            stack.pop()
        stack[-1].inner.append(place)
        stack.append(place)
    text = root.text(source)
    # What may be another number at run time is no constant of the compiler.
    text = text.replace("inline constexpr ", "inline const ")
    return text.replace("#pragma once\n", "#pragma once\n" + CHOICE, 1)


def numbers_on(text, line):
    """The mutants that begin on this line of a text, counted from 1."""
    lines = text.split("\n")
    return (
        [int(n) for n in re.findall(r"LIGHTWALK_MUTANT\((\d+)\)", lines[line - 1])]
        if line <= len(lines)
        else []
    )
