"""Diagrams that the decks alone show."""

from tools.weave.diagrams import bar
from tools.weave.drawing import (
    COOL,
    GLASS,
    GLOW,
    GREEN,
    INK,
    LAMP,
    SOFT,
    WARM,
    angle,
    arrow,
    circle,
    dashed,
    diagram,
    hatched,
    line,
    polar,
    symbol,
    text,
)


@diagram("mirror-through", 440, 256)
def mirror_through():
    """A direction that points away, and what both formulas make of it."""
    x, y, a, r = 200, 150, 50, 124
    yield from hatched(x - 180, y, x + 190, y)
    yield from arrow(x, y, x, y - 118, "n")
    yield from arrow(x, y, *polar(x, y, -a, r), "w_o", COOL, 2.4)
    yield from arrow(x, y, *polar(x, y, a, r), "", WARM, 2.4)
    yield text(x + 104, y - 78, "its negative", WARM, "start")
    yield line(x, y, *polar(x, y, a - 180, 112), SOFT, 2.2, True, "7 5")
    yield text(x - 96, y + 96, "the slide's formula", INK)
    yield from angle(x, y, -a, 0, 42, "θ")
    yield from angle(x, y, 0, a, 42, "θ")
    yield circle(x, y, 4)


@diagram("four-coefficients", 520, 300)
def four_coefficients():
    """What each coefficient does with light at one surface."""
    x, y = 260, 170
    yield f'<path d="M40 {y} H480 V290 H40z" fill="{GLASS}"/>'
    yield line(40, y, 480, y, INK, 2)
    yield dashed(x, y, x, y - 140)
    yield from arrow(x, y, *polar(x, y, -52, 150), "w_o", COOL, 2.4)
    for a in (-32, -16, 14, 30, 70, 80):
        yield line(x, y, *polar(x, y, a, 84), WARM, 1.4, True)
    yield symbol(x + 24, y - 98, "k_d", WARM)
    yield from arrow(x, y, *polar(x, y, 52, 150), "k_s", GREEN, 2.4)
    yield from arrow(x, y, *polar(x, y, 180 - 31.7, 108), "k_t", GREEN, 2.4)
    yield f'<path d="M70 {y} A54 54 0 0 1 178 {y}z" fill="{GLOW}" stroke="{LAMP}"/>'
    yield symbol(124, y - 14, "k_e", INK)
    yield circle(x, y, 4)


@diagram("events-two", 500, 120)
def two_events():
    """The course's bar of plastic, before anything is absorbed."""
    yield from bar(50, (("diffuse p_d", 0.6, WARM), ("specular p_s", 0.4, COOL)), 1)
    at = 30 + 440 * 0.72
    yield line(at, 20, at, 48, INK, 2, True)
    yield text(at, 16, "ξ = 0.72")
    for x, words in ((30, "0"), (30 + 440 * 0.6, "p_d"), (470, "1")):
        yield text(x, 114, words)


def branches(x, y, width, depth, step=62):
    """Each hit with its two children, as pairs of points."""
    if depth:
        for side in (-1, 1):
            end = x + side * width / 4, y + step
            yield (x, y), end
            yield from branches(*end, width / 2, depth - 1, step)


@diagram("one-of-the-tree", 520, 300)
def one_of_the_tree():
    """The tree of both lobes, and the one path of it that is drawn."""
    for start, end in branches(260, 30, 470, 4):
        yield line(*start, *end, SOFT, 1.2)
        yield circle(*end, 4, SOFT)
    x, y, width = 260, 30, 470
    yield circle(x, y, 6, COOL)
    for side in (1, -1, 1, -1):
        end = x + side * width / 4, y + 62
        yield line(x, y, *end, COOL, 3)
        yield circle(*end, 6, COOL)
        (x, y), width = end, width / 2
    yield text(20, 34, "camera", SOFT, "start")
    yield dashed(100, 30, 250, 30)
