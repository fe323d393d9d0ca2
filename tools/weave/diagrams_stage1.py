"""Diagrams of chapter 1: light at a point, averages, directions, a path."""

import math
import random
from itertools import pairwise

from tools.weave.drawing import (
    COOL,
    FAINT,
    GLOW,
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
    x, y, slope = 250, 280, 58
    there = 490, y - 240 / math.tan(math.radians(slope))
    yield from hatched(40, y, 490, y)
    yield from hatched(490, y, 490, 40)
    yield line(300, 40, 400, 40, LAMP, 8)
    yield text(350, 26, "lamp", WARM)
    yield f'<path d="M{x - 110} {y} A110 110 0 0 1 {x + 110} {y}" fill="{SAND}" stroke="{SOFT}" stroke-dasharray="4 3"/>'
    yield symbol(x - 124, y - 20, "Ω", SOFT)
    yield from arrow(x, y, x, y - 150, "n")
    yield dashed(*polar(x, y, -56, 150), 74, 160, COOL)
    yield from arrow(x, y, *polar(x, y, -56, 150), "", COOL)
    yield symbol(*polar(x + 14, y - 18, -56, 136), "w_o", COOL)
    yield dashed(*polar(x, y, slope, 150), *there, WARM)
    yield from arrow(x, y, *polar(x, y, slope, 150), "", WARM)
    yield symbol(*polar(x - 10, y - 18, slope, 138), "w_i", WARM)
    yield from angle(x, y, 0, slope, 56, "θ")
    yield text(40, 148, "camera", COOL, "start")
    yield circle(x, y, 4.5)
    yield symbol(x, y + 34, "x")
    yield circle(*there, 4.5)
    yield symbol(there[0] - 16, there[1] + 26, "y")
    yield dashed(*there, 372, 46, SOFT)


@diagram("grid-or-path", 520, 290)
def grid_or_path():
    """Five directions at each point, twice; and one at each."""
    yield text(130, 26, "5 directions at each point")
    first = [(x, 150) for x in (30, 80, 130, 180, 230)]
    for x, y in first:
        yield line(130, 230, x, y, WARM, 1.6)
        for i in range(5):
            yield line(x, y, x - 18 + 9 * i, 76, WARM, 0.9)
            yield circle(x - 18 + 9 * i, 76, 1.8, WARM)
        yield circle(x, y, 3.5, WARM)
    yield circle(130, 230, 4.5)
    yield text(130, 272, "5, then 25, then 125 …", WARM)
    yield text(390, 26, "1 direction at each point")
    chain = ((390, 230), (440, 150), (350, 76))
    for a, b in pairwise(chain):
        yield line(*a, *b, COOL, 2.4)
        yield circle(*b, 3.5, COOL)
    yield circle(390, 230, 4.5)
    yield text(390, 272, "1, then 1, then 1 …", COOL)


@diagram("disk", 520, 320)
def disk():
    """A patch of the unit hemisphere, and its shadow straight below."""
    x, y, r, first, last = 250, 240, 190, 42, 56
    a, b = polar(x, y, first, r), polar(x, y, last, r)
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{SAND}" stroke="{SOFT}"/>'
    yield from arrow(x, y, x, y - r - 20, "n")
    yield f'<path d="M{x} {y} L{a[0]:.1f} {a[1]:.1f} L{b[0]:.1f} {b[1]:.1f}z" fill="{GLOW}"/>'
    yield line(x, y, *polar(x, y, (first + last) / 2, r), WARM, 1.2, False, "5 4")
    yield curve([polar(x, y, first + i, r) for i in range(last - first + 1)], WARM, 6)
    yield symbol(*polar(x, y, 49, r + 26), "dω", WARM)
    for tip in (a, b):
        yield dashed(*tip, tip[0], y)
    yield line(x - r, y, x + r, y, INK, 2.2)
    yield line(a[0], y, b[0], y, COOL, 6)
    yield symbol((a[0] + b[0]) / 2, y + 30, "cosθ dω", COOL)
    yield from angle(x, y, 0, 49, 60, "θ")
    yield dashed(x - r, y + 46, x + r, y + 46)
    yield circle(x, y, 4.5)
    yield symbol(x, y + 30, "x")
    yield text(x, y + 70, "a disk of radius 1: its area is π", SOFT)


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
            if value != 1:
                aside = (0, -12, "middle") if value < 0.5 else (10, 8, "start")
                at = x0 + width * place + aside[0], y0 - height / 2 * value + aside[1]
                yield text(*at, f"{value:.1f}", WARM, aside[2])
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
    yield text(x0 + 14, y0 - height - 10, "P(θ) = 1 − cos θ", INK, "start")
    yield text(260, 314, "equal steps of ξ: steep curve, dense angles", INK)


def lifted(x, y, r, sine, phi, tilt):
    """Where a direction of a hemisphere of radius r is seen, from so many
    degrees above its rim; 90 is from above."""
    cosine, lift = math.sqrt(max(0, 1 - sine * sine)), math.radians(tilt)
    return x + r * sine * math.cos(phi), y + r * (
        sine * math.sin(phi) * math.sin(lift) - cosine * math.cos(lift)
    )


@diagram("three-hemispheres", 520, 400)
def three_hemispheres():
    """Directions: theta uniform, solid angle uniform, cosine; from the side,
    only those in front, and from above."""
    drawn = random.Random(1)
    pairs = [(drawn.random(), drawn.random()) for _ in range(400)]
    ways = (
        ("θ uniform: wrong", lambda u: math.sin(u * math.pi / 2)),
        ("solid angle", lambda u: math.sqrt(1 - u * u)),
        ("cosine", math.sqrt),
    )
    for x, (name, sine_of) in zip((90, 260, 430), ways):
        r, tilt = 78, 14
        yield text(x, 24, name, RED if "wrong" in name else INK)
        yield f'<path d="M{x - r} 130 A{r} {r} 0 0 1 {x + r} 130" fill="{SAND}" stroke="{SOFT}"/>'
        flat = r * math.sin(math.radians(tilt))
        yield f'<ellipse cx="{x}" cy="130" rx="{r}" ry="{flat:.1f}" fill="{SAND}" stroke="{SOFT}"/>'
        yield circle(x, 264, r, SAND, SOFT)
        directions = [(sine_of(u), 2 * math.pi * v) for u, v in pairs]
        yield from dots(
            [lifted(x, 130, r, s, phi, tilt) for s, phi in directions if math.sin(phi) > -0.2], WARM, 1.7
        )
        yield from dots([lifted(x, 264, r, s, phi, 90) for s, phi in directions], WARM, 1.7)
        yield text(x, 372, f"{sum(s < 0.5 for s, _ in directions) / len(directions):.0%}")
    yield text(260, 394, "of the directions are within 30° of the normal", SOFT)


@diagram("malley", 520, 300)
def malley():
    """Uniform points on the disk from above, and lifted onto the hemisphere."""
    drawn = random.Random(5)
    pairs = [(drawn.random(), drawn.random()) for _ in range(240)]
    x, y, r = 112, 142, 100
    yield circle(x, y, r, SAND, SOFT)
    yield from dots([lifted(x, y, r, math.sqrt(u), 2 * math.pi * v, 90) for u, v in pairs])
    yield circle(x, y, f"{r * 0.7071:.1f}", "none", COOL)
    yield line(x, y, *polar(x, y, 60, r * 0.7071), COOL, 2, True)
    yield symbol(x + 34, y + 2, "r", COOL)
    yield text(x, 272, "r = 0.71: half of the dots", COOL)
    x, y, r, tilt = 376, 192, 130, 16
    flat = r * math.sin(math.radians(tilt))
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{SAND}" stroke="{SOFT}"/>'
    yield f'<ellipse cx="{x}" cy="{y}" rx="{r}" ry="{flat:.1f}" fill="{GLOW}" stroke="{SOFT}"/>'
    for u, v in pairs[100:140]:
        sine, phi = math.sqrt(u), 2 * math.pi * v
        foot = x + r * sine * math.cos(phi), y + flat * sine * math.sin(phi)
        tip = lifted(x, y, r, sine, phi, tilt)
        yield line(*foot, *tip, SOFT, 0.8)
        yield from dots([foot], COOL, 2.4)
        yield from dots([tip], WARM, 2.8)
    yield text(x, 272, "lifted onto the hemisphere", WARM)


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


@diagram("lamp-front", 520, 240)
def lamp_front():
    """A lamp, seen from the side of its normal and from the other."""
    y = 100
    for x, front in ((130, True), (390, False)):
        yield text(x, 24, "seen from the front" if front else "seen from the back")
        yield line(x - 80, y, x + 80, y, LAMP if front else INK, 8)
        yield from arrow(x, y, x, y + (66 if front else -44), "n")
        tip = polar(x, y, 135, 92)
        yield line(x, y, *tip, COOL, 2.4, True)
        yield symbol(tip[0] + 22, tip[1] + 6, "w_o", COOL)
    for degrees in (-110, -140, 110):
        yield line(*polar(130, y, degrees, 12), *polar(130, y, degrees, 76), WARM, 1.6, True)
    yield symbol(130, 226, "n · w_o &gt; 0: radiance k_e", WARM)
    yield symbol(390, 226, "n · w_o &lt; 0: black")


# What `build/stage1 scenes/cornell_box_ceiling_diffuse.toml --pixel 70,240
# --sample 8` tells of its path: x and y of each vertex, and their throughputs.
VERTICES = ((-0.5066, -1.0), (-1.0, 0.0355), (0.8006, 1.0))


@diagram("followed-path", 520, 430)
def followed_path():
    """The path that the chapter follows, seen from the front."""
    size, left, top, far = 165, 255, 205, 0.53

    def place(x, y):
        return left + size * x, top - size * y

    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))
    for x, y in corners[:4]:
        yield line(*place(x, y), *place(far * x, far * y), SOFT, 1)
    yield curve([place(far * x, far * y) for x, y in corners], SOFT, 1)
    for a, b, color, width in zip(corners, corners[1:], (INK, GREEN, LAMP, RED), (4, 4, 8, 4)):
        yield line(*place(*a), *place(*b), color, width)
    a, b, c = [place(*vertex) for vertex in VERTICES]
    yield line(252, 408, a[0] + 13, a[1] + 5, COOL, 2, True)
    yield text(262, 416, "from the camera: 1, 1, 1", COOL, "start")
    yield line(*a, b[0] + 5, b[1] + 11, COOL, 2.4, True)
    yield text((a[0] + b[0]) / 2 + 34, (a[1] + b[1]) / 2 + 34, "0.8, 0.8, 0.8", COOL, "start")
    yield line(*b, c[0] - 11, c[1] + 6, COOL, 2.4, True)
    yield text(262, (b[1] + c[1]) / 2 + 50, "0.64, 0.16, 0.16", COOL)
    for number, (x, y) in enumerate((a, b, c)):
        yield circle(x, y, 12, SAND, INK)
        yield text(x, y + 6, str(number))
    yield text(left, 24, "ceiling: emits 1, 1, 1", WARM)
    yield text(left + 20, top + size - 14, "white floor", INK, "start")
    yield text(18, top - 30, "red", RED, "start")
    yield text(18, top - 8, "wall", RED, "start")
