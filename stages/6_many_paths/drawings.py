"""Drawings of chapter 6 and its deck."""

import functools
import re
import subprocess

from tools.tree import BUILD, ROOT
from tools.weave import drawing as d

LANES = 16
STEPS = 40


def cell(x, y, width, height, fill, edge=d.SOFT):
    return f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="{fill}" stroke="{edge}"/>'


def row(x, y, words, fill, width=26, height=28):
    for i, word in enumerate(words):
        yield cell(x + i * width, y, width, height, fill)
        if word:
            yield d.text(x + (i + 0.5) * width, y + 20, word)


@d.diagram("one-and-sixteen", 520, 190)
def one_and_sixteen():
    """An addition of two numbers, and one of two rows."""
    for y, fill, sign in ((14, d.GLASS, ""), (54, d.SAND, "+"), (108, d.GLOW, "=")):
        yield from row(30, y, [""], fill)
        yield from row(96, y, [""] * LANES, fill)
        for x in (16, 82):
            yield d.text(x, y + 20, sign)
    yield d.line(24, 95, 62, 95)
    yield d.line(90, 95, 516, 95)
    yield d.text(43, 166, "one path", d.INK)
    yield d.text(304, 166, "sixteen paths, in the same time")


@d.diagram("both-branches", 520, 250)
def both_branches():
    """Eight lanes at an if: both branches are worked out, and a mask chooses."""
    glass = [True, False, False, True, False, False, False, True]
    left, width = 190, 40
    rows = (
        ("is it glass?", ["yes" if g else "no" for g in glass], lambda g: d.GLOW if g else d.FAINT, 10),
        ("refracted", ["r"] * 8, lambda g: d.GLASS, 66),
        ("reflected", ["m"] * 8, lambda g: d.SAND, 106),
        ("select", ["r" if g else "m" for g in glass], lambda g: d.GLASS if g else d.SAND, 176),
    )
    for name, words, fill, y in rows:
        yield d.text(left - 14, y + 22, name, d.INK, "end")
        for i, (word, g) in enumerate(zip(words, glass)):
            yield cell(left + i * width, y, width, 32, fill(g))
            yield d.text(left + (i + 0.5) * width, y + 22, word)
    for i, g in enumerate(glass):  # beside the letters
        x = left + (i + 0.82) * width
        yield d.line(x, 98 if g else 138, x, 172, d.COOL if g else d.WARM, 1.6, True)
    yield d.text(left + 4 * width, 240, "half of the work is thrown away")


@d.diagram("masks", 541, 372)
def masks():
    """One step of eight lanes, from the top downwards: which are on."""
    rows = (
        ("on", "11111111", d.GLASS),
        ("on &amp; hit.found", "11011111", d.GLASS),
        ("on &amp; !emits", "11011011", d.GLASS),
        ("asking", "10011010", d.GLOW),
        ("lobe.diffuse", "10001010", d.SAND),
        ("lobe.specular", "00000001", d.SAND),
        ("lobe.refraction", "00010000", d.SAND),
        ("on, returned", "10011011", d.GLASS),
        ("on, refilled", "11111111", d.GLASS),
    )
    left, width, height = 190, 42, 34
    for lane in range(8):
        yield d.text(left + (lane + 0.5) * width, 22, str(lane + 1), d.SOFT)
    for i, (name, bits, fill) in enumerate(rows):
        y = 32 + 37 * i
        yield d.text(left - 14, y + 23, name, d.INK, "end")
        for lane, bit in enumerate(bits):
            yield cell(left + lane * width, y, width, height, fill if bit == "1" else "none", d.SOFT)
            lost = i in (1, 2, 7) and bit == "0" and rows[i - 1 if i < 7 else 2][1][lane] == "1"
            if lost:
                yield d.text(left + (lane + 0.5) * width, y + 23, "lost", d.WARM)
            if i == 8 and rows[7][1][lane] == "0":
                yield d.text(left + (lane + 0.5) * width, y + 23, "new", d.GREEN)


@d.diagram("lookup", 520, 230)
def lookup():
    """Eight lanes pick from a table that a register holds."""
    table = [".8", ".2", ".8", ".8", ".8", ".3", ".1"]
    asked = [4, 0, 4, 6, 2, 4, 5, 1]
    left, width = 150, 44
    for i, value in enumerate(table):
        x = left + (i + 0.5) * width
        yield d.text(x, 18, str(i), d.SOFT)
        yield cell(left + i * width, 26, width, 32, d.GLASS)
        yield d.text(x, 48, value)
    yield d.text(left - 14, 48, "table", d.INK, "end")
    for y, name, words, fill in (
        (104, "number", [str(i) for i in asked], d.FAINT),
        (176, "found", [table[i] for i in asked], d.GLOW),
    ):
        yield d.text(left - 14, y + 22, name, d.INK, "end")
        for i, word in enumerate(words):
            yield cell(left + i * width, y, width, 32, fill)
            yield d.text(left + (i + 0.5) * width, y + 22, word)
    for i in range(len(asked)):
        x = left + (i + 0.5) * width
        yield d.line(x, 138, x, 172, d.COOL, 1.6, True)


@d.diagram("in-their-places", 520, 200)
def in_their_places():
    """Samples end in one order, and stand in a list in another."""
    ended = [2, 1, 5, 3, 4, 8, 6, 7]
    left, width = 150, 44
    yield d.text(left - 14, 34, "as they end", d.INK, "end")
    yield d.text(left - 14, 154, "the list", d.INK, "end")
    for i, sample in enumerate(ended):
        yield cell(left + i * width, 12, width, 32, d.SAND)
        yield d.text(left + (i + 0.5) * width, 34, str(sample))
        yield d.line(left + (i + 0.5) * width, 48, left + (sample - 0.5) * width, 127, d.COOL, 1.6, True)
        yield cell(left + i * width, 132, width, 32, d.GLOW)
        yield d.text(left + (i + 0.5) * width, 154, str(i + 1))
    yield d.text(left + 4 * width, 194, "added to the film from left to right")


@functools.cache
def path_lengths():
    """How many steps paths of the lab's box take, one for each of some pixels."""
    lengths = []
    for i in range(6 * LANES):
        column, line_ = (37 * i) % 256, (101 * i) % 256
        told = subprocess.run(
            [
                BUILD / "stage5",
                ROOT / "scenes/cornell_box_point.toml",
                "--pixel",
                f"{column},{line_}",
                "--sample",
                "1",
            ],
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        lengths.append(len(re.findall(r"^vertex \d+:", told, re.M)))
    return lengths


def without_refill(lengths):
    """(lane, first step, steps) of each path: the next sixteen wait for all."""
    start = 0
    for first in range(0, len(lengths), LANES):
        group = lengths[first : first + LANES]
        yield from ((lane, start, length) for lane, length in enumerate(group))
        start += max(group)


def with_refill(lengths):
    free = [0] * LANES
    for length in lengths:
        lane = free.index(min(free))
        yield lane, free[lane], length
        free[lane] += length


def busy(blocks):
    """The share of lanes that have a path, in the steps that are shown."""
    return sum(max(0, min(start + n, STEPS) - start) for _, start, n in blocks) / (STEPS * LANES)


@d.diagram("idle-lanes", 520, 330)
def idle_lanes():
    """Lanes over time: each block is a path, and what is empty waits."""
    colors = (d.GLASS, d.SAND, d.GLOW)
    for top, name, place in (
        (0, "all wait for the longest", without_refill),
        (165, "refilled at once", with_refill),
    ):
        blocks = list(place(path_lengths() * 3))
        for lane in range(LANES):
            yield cell(8, top + 26 + 7 * lane, 504, 7, "none", d.FAINT)
        for number, (lane, start, length) in enumerate(blocks):
            if start < STEPS:
                shown = min(length, STEPS - start)
                yield cell(
                    8 + 504 / STEPS * start, top + 26 + 7 * lane, 504 / STEPS * shown, 7, colors[number % 3]
                )
        yield d.text(8, top + 18, name, d.INK, "start")
        yield d.text(512, top + 18, f"{100 * busy(blocks):.0f} % of the lanes work", d.GREEN, "end")
    yield d.text(260, 324, "one step after the other", d.SOFT)
