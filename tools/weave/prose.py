"""Counts what makes a chapter hard to read.

    python3 -m tools.weave.prose    a table, and each place that is over

A sentence should have at most 30 words, a paragraph at most 8 lines, and 45
lines of prose, a screen, should not pass without a figure. A formula counts
as one word; tables, transcripts and headings are no sentences, and each item of
a list is a paragraph.
"""

import re
import sys
from dataclasses import dataclass, field

from compare.stages import ROOT, Failure, stage_headers
from tools.weave.figures import REFERENCE
from tools.weave.literate import pieces

WORDS, LINES, SCREEN = 30, 8, 45
NO_SENTENCE = re.compile(r"#|\||    |!\[|```|:::")
ITEM = re.compile(r"\s*([-*]|\d+\.) ")
# A stop that ends a sentence: not that of "e.g." or "Fig. 3".
STOP = re.compile(r"(?<!\be\.g)(?<!\bi\.e)(?<!\bcf)(?<!\bFig)(?<!\bvs)[.?!][\"')*_”]*(?=\s|$)")


@dataclass
class Chapter:
    name: str
    prose: int = 0
    code: int = 0
    sentences: list = field(default_factory=list)  # (words, line, text)
    paragraphs: list = field(default_factory=list)  # (lines, line)
    bare: list = field(default_factory=list)  # (lines, line) without a figure

    def over(self):
        """(line, what is wrong there), in the chapter's order."""
        long = [(at, f"{n} words: {text}") for n, at, text in self.sentences if n > WORDS]
        thick = [(at, f"a paragraph of {n} lines") for n, at in self.paragraphs if n > LINES]
        bare = [(at, f"{n} lines of prose without a figure") for n, at in self.bare if n > SCREEN]
        return sorted(long + thick + bare)


def paragraphs(piece):
    """Runs of (number, line) that are neither empty nor a table, code, ...;
    each item of a list is one."""
    run = []
    for number, line in zip(piece.numbers, piece.lines):
        if ITEM.match(line):
            if run:
                yield run
            run = []
        if line.strip() and not NO_SENTENCE.match(line):
            run.append((number, line))
            continue
        if run:
            yield run
        run = []
    if run:
        yield run


def sentences(paragraph):
    """(words, line, text) of each; a displayed formula that a sentence goes
    through is one word of it."""
    text, lines = "", []
    for number, line in paragraph:
        text += line.strip() + " "
        lines += [number] * (len(line.strip()) + 1)

    def blank(match):  # one word, and as long as before
        return "\x00" * len(match[0])

    plain = re.sub(r"\$\$.+?\$\$|(?<!\\)\$[^$]+?\$|`[^`]+`", blank, text)
    start = 0
    for end in [match.end() for match in STOP.finditer(plain)] + [len(plain)]:
        words = re.findall(r"\x00+|[^\s\x00]*\w[^\s\x00]*", plain[start:end])
        if words:
            first = start + len(plain[start:end]) - len(plain[start:end].lstrip())
            yield len(words), lines[first], " ".join(text[start:end].split())
        start = end


def count(header):
    chapter, run, began = Chapter(header.parent.name), 0, 1
    for piece in pieces(header):
        if piece.kind == "code":
            chapter.code += len(piece.lines)
            continue
        for number, line in zip(piece.numbers, piece.lines):
            if REFERENCE.match(line):
                chapter.bare.append((run, began))
                run = 0
            elif line.strip() and not line.startswith("    "):
                began = began if run else number
                run += 1
                chapter.prose += 1
        for paragraph in paragraphs(piece):
            chapter.paragraphs.append((len(paragraph), paragraph[0][0]))
            chapter.sentences += sentences(paragraph)
    chapter.bare.append((run, began))
    return chapter


def main():
    chapters = [(count(header), header.relative_to(ROOT)) for header in stage_headers()]
    for chapter, path in chapters:
        for line, what in chapter.over():
            print(f"{path}:{line}: {what}")
    print(
        f"\n{'chapter':24}{'prose':>7}{'code':>7}{'sentences':>11}{'words':>7}{'over ' + str(WORDS):>9}"
        f"{'paragraphs':>12}{'over ' + str(LINES):>8}{'bare screens':>14}"
    )
    for one, _ in chapters:
        words = sum(n for n, _, _ in one.sentences) / max(1, len(one.sentences))
        print(
            f"{one.name:24}{one.prose:7}{one.code:7}{len(one.sentences):11}{words:7.1f}"
            f"{sum(n > WORDS for n, _, _ in one.sentences):9}{len(one.paragraphs):12}"
            f"{sum(n > LINES for n, _ in one.paragraphs):8}{sum(n // SCREEN for n, _ in one.bare):14}"
        )


if __name__ == "__main__":
    try:
        main()
    except Failure as error:
        sys.exit(f"prose: {error}")
