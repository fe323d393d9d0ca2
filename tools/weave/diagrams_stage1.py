"""The drawings of chapter 1."""

import math
import random

from tools.weave.drawing import (
    COOL,
    FAINT,
    GREEN,
    INK,
    LAMP,
    RED,
    SAND,
    SOFT,
    WARM,
    angle,
    arrow,
    circle,
    curve,
    dashed,
    diagram,
    dots,
    hatched,
    line,
    plot,
    polar,
    symbol,
    text,
)


@diagram("wall-and-lamp", 520, 330)
def wall_and_lamp():
    """A point x of a floor, seen by the camera, with another wall and a lamp."""
    x, y = 250, 280
    yield from hatched(40, y, 490, y)
    yield from hatched(490, y, 490, 40)
    yield line(300, 40, 400, 40, LAMP, 8)
    yield text(350, 28, "lamp", WARM)
    yield f'<path d="M{x - 110} {y} A110 110 0 0 1 {x + 110} {y}" fill="{SAND}" stroke="{SOFT}" stroke-dasharray="4 3"/>'
    yield symbol(x - 124, y - 20, "Ω", SOFT)
    yield from arrow(x, y, x, y - 150, "n")
    yield from arrow(x, y, *polar(x, y, -56, 150), "w_o", COOL)
    yield from arrow(x, y, *polar(x, y, 58, 150), "w_i", WARM)
    yield dashed(*polar(x, y, 58, 170), 490, y - 240 / math.tan(math.radians(58)), WARM)
    yield from angle(x, y, 0, 58, 56, "θ")
    yield text(58, 128, "camera", COOL, "start")
    yield dashed(*polar(x, y, -56, 176), 70, 140, COOL)
    yield circle(x, y, 4.5)
    yield symbol(x, y + 30, "x")
    yield circle(490, y - 240 / math.tan(math.radians(58)), 4.5)
    yield symbol(474, y - 240 / math.tan(math.radians(58)) - 10, "y")
    yield dashed(490, y - 150, 372, 46, SOFT)


@diagram("disk", 520, 300)
def disk():
    """A patch of the hemisphere, and the smaller one below it on the ground."""
    x, y, r = 260, 220, 170
    yield f'<ellipse cx="{x}" cy="{y}" rx="{r}" ry="48" fill="{SAND}" stroke="{SOFT}"/>'
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="none" stroke="{INK}" stroke-width="1.6"/>'
    yield from arrow(x, y, x, y - r - 26, "n")
    for first, last, color in ((44, 58, WARM), (6, 20, GREEN)):
        a, b = polar(x, y, first, r), polar(x, y, last, r)
        yield f'<path d="M{a[0]:.1f} {a[1]:.1f} A{r} {r} 0 0 1 {b[0]:.1f} {b[1]:.1f}" fill="none" stroke="{color}" stroke-width="7"/>'
        yield dashed(a[0], a[1], a[0], y, color)
        yield dashed(b[0], b[1], b[0], y, color)
        yield line(a[0], y, b[0], y, color, 7)
    yield text(*polar(x, y - 4, 53, r + 12), "dω", WARM, "start", "italic")
    yield text(x + 128, y + 66, "cos θ dω", WARM, "middle", "italic")
    yield line(x + 132, y + 48, x + 132, y + 8, WARM, 1.2, True)
    yield text(x - 96, y + 74, "all of the disk: π", INK)
    yield text(x + 52, y - r - 12, "nearly dω", GREEN, "start")


@diagram("four-numbers", 520, 290)
def four_numbers():
    """Four samples of 2x, drawn uniformly, and drawn in proportion to 2x."""
    drawn = (0.1, 0.3, 0.6, 0.9)
    for x0, name, places, values in (
        (50, "p = 1", drawn, [2 * x for x in drawn]),
        (310, "p = 2x", [math.sqrt(x) for x in drawn], [1] * 4),
    ):
        y0, width, height = 220, 180, 180
        yield from plot(x0, y0, width, height, ((lambda x: 2 * x, INK),), top=2)
        yield dashed(x0, y0 - height / 2, x0 + width, y0 - height / 2, COOL)
        for place, value in zip(places, values):
            yield line(x0 + width * place, y0, x0 + width * place, y0 - height / 2 * value, WARM, 2)
            yield circle(x0 + width * place, y0 - height / 2 * value, 5, WARM)
        yield text(x0 - 8, y0 - height / 2 + 5, "1", COOL, "end")
        yield text(x0 - 8, y0 - height + 8, "2", SOFT, "end")
        yield text(x0 + width, y0 + 20, "1", SOFT)
        yield text(x0 + width / 2, y0 + 44, name, INK)
        yield text(x0 + 14, y0 - height + 8, "f(x) = 2x", INK, "start")
    yield text(260, 284, "dots: f/p of each sample", WARM)


@diagram("inversion", 520, 320)
def inversion():
    """Equal steps of height on the distribution, and where their angles lie."""
    x0, y0, width, height = 60, 260, 400, 220
    right = math.pi / 2
    yield from plot(x0, y0, width, height, ((lambda t: 1 - math.cos(t), INK),), last=right)
    for i in range(10):
        xi = (i + 0.5) / 10
        at = x0 + width * math.acos(1 - xi) / right
        color = WARM if i == 6 else FAINT
        yield line(x0, y0 - height * xi, at, y0 - height * xi, color, 2 if i == 6 else 1.2)
        yield line(at, y0 - height * xi, at, y0, color, 2 if i == 6 else 1.2, i == 6)
        yield circle(at, y0, 3.5, WARM)
        yield circle(x0, y0 - height * xi, 3.5, COOL)
    yield symbol(x0 - 20, y0 - height * 0.65 + 5, "ξ", COOL)
    yield symbol(x0 + width * math.acos(0.35) / right, y0 + 30, "θ", WARM)
    yield text(x0, y0 + 24, "0", SOFT)
    yield text(x0 + width, y0 + 24, "90°", SOFT)
    yield text(x0 - 10, y0 - height + 5, "1", SOFT, "end")
    yield text(x0 + 70, y0 - height + 20, "P(θ) = 1 - cos θ", INK, "start")
    yield text(260, 314, "equal steps of ξ: steep curve, dense angles", INK)


@diagram("three-hemispheres", 560, 190)
def three_hemispheres():
    """Directions from the side: theta uniform, solid angle uniform, cosine."""
    drawn = random.Random(3)
    pairs = [(drawn.random(), drawn.random()) for _ in range(500)]
    ways = (
        ("θ uniform: wrong", lambda u: math.cos(u * math.pi / 2)),
        ("solid angle", lambda u: u),
        ("cosine", lambda u: math.sqrt(1 - u)),
    )
    for i, (name, cosine) in enumerate(ways):
        x, y, r = 95 + 185 * i, 116, 84
        yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{SAND}" stroke="{SOFT}"/>'
        yield f'<ellipse cx="{x}" cy="{y}" rx="{r}" ry="24" fill="{SAND}" stroke="{SOFT}"/>'
        points = []
        for u, v in pairs:
            c = cosine(u)
            s, phi = math.sqrt(1 - c * c), 2 * math.pi * v
            points.append((x + r * s * math.cos(phi), y - r * c * 0.96 + 24 * s * math.sin(phi)))
        yield from dots(points, WARM, 1.6)
        yield text(x, y + 50, name)


@diagram("malley", 520, 290)
def malley():
    """Uniform dots on the disk, lifted onto the hemisphere."""
    drawn = random.Random(5)
    pairs = [(drawn.random(), drawn.random()) for _ in range(260)]
    x, y, r = 130, 140, 100
    yield circle(x, y, r, SAND, SOFT)
    yield from dots(
        [(x + r * math.sqrt(u) * math.cos(2 * math.pi * v), y + r * math.sqrt(u) * math.sin(2 * math.pi * v)) for u, v in pairs]
    )
    yield line(x, y, *polar(x, y, 60, r * 0.7), COOL, 2, True)
    yield symbol(x + 22, y - 26, "√ξ", COOL)
    yield text(x, 274, "uniform on the disk")
    x, y = 385, 220
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{SAND}" stroke="{SOFT}"/>'
    yield line(x - r, y, x + r, y, SOFT)
    for i in range(-7, 8):
        s = math.copysign(math.sqrt((abs(i) + 0.3) / 7.6), i)
        yield line(x + r * s, y, x + r * s, y - r * math.sqrt(1 - s * s), FAINT, 1.4)
        yield circle(x + r * s, y, 2.5, WARM)
        yield circle(x + r * s, y - r * math.sqrt(1 - s * s), 2.5, WARM)
    yield text(x, 274, "lifted to the hemisphere")


@diagram("acne", 520, 230)
def acne():
    """A ray whose origin was rounded to below the surface."""
    for x, depth, name in ((130, 0, "on the surface"), (390, 26, "rounded to below it")):
        y = 140
        yield from hatched(x - 110, y, x + 110, y)
        yield dashed(x - 104, 40, x - 30, y + depth - 4, COOL)
        yield from arrow(x - 30, y + depth, *polar(x - 30, y + depth, 62, 64 if depth else 120), "", WARM)
        yield circle(x - 30, y + depth, 4.5)
        if depth:
            yield circle(x - 30 + depth * math.tan(math.radians(62)), y, 6, "none", RED)
            yield text(x + 34, y - 16, "hit again", RED, "start")
        yield text(x, 214, name)
