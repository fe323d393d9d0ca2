"""Drawings of chapter 1 and its deck."""

import math
import random
from itertools import pairwise

from tools.weave import drawing as d


@d.diagram("wall-and-lamp", 520, 330)
def wall_and_lamp():
    """A point x of a floor, seen by the camera, with another wall and a lamp."""
    x, y, slope = 250, 280, 58
    there = 490, y - 240 / math.tan(math.radians(slope))
    yield from d.hatched(40, y, 490, y)
    yield from d.hatched(490, y, 490, 40)
    yield d.line(300, 40, 400, 40, d.LAMP, 8)
    yield d.text(350, 26, "lamp", d.WARM)
    yield f'<path d="M{x - 110} {y} A110 110 0 0 1 {x + 110} {y}" fill="{d.SAND}" stroke="{d.SOFT}" stroke-dasharray="4 3"/>'
    yield d.symbol(x - 124, y - 20, "Ω", d.SOFT)
    yield from d.arrow(x, y, x, y - 150, "n")
    yield d.dashed(*d.polar(x, y, -56, 150), 74, 160, d.COOL)
    yield from d.arrow(x, y, *d.polar(x, y, -56, 150), "", d.COOL)
    yield d.symbol(*d.polar(x + 14, y - 18, -56, 136), "w_o", d.COOL)
    yield d.dashed(*d.polar(x, y, slope, 150), *there, d.WARM)
    yield from d.arrow(x, y, *d.polar(x, y, slope, 150), "", d.WARM)
    yield d.symbol(*d.polar(x - 10, y - 18, slope, 138), "w_i", d.WARM)
    yield from d.angle(x, y, 0, slope, 56, "θ")
    yield d.text(40, 148, "camera", d.COOL, "start")
    yield d.circle(x, y, 4.5)
    yield d.symbol(x, y + 34, "x")
    yield d.circle(*there, 4.5)
    yield d.symbol(there[0] - 16, there[1] + 26, "y")
    yield d.dashed(*there, 372, 46, d.SOFT)


@d.diagram("grid-or-path", 520, 290)
def grid_or_path():
    """Five directions at each point, twice; and one at each."""
    yield d.text(130, 26, "5 directions at each point")
    first = [(x, 150) for x in (30, 80, 130, 180, 230)]
    for x, y in first:
        yield d.line(130, 230, x, y, d.WARM, 1.6)
        for i in range(5):
            yield d.line(x, y, x - 18 + 9 * i, 76, d.WARM, 0.9)
            yield d.circle(x - 18 + 9 * i, 76, 1.8, d.WARM)
        yield d.circle(x, y, 3.5, d.WARM)
    yield d.circle(130, 230, 4.5)
    yield d.text(130, 272, "5, then 25, then 125 …", d.WARM)
    yield d.text(390, 26, "1 direction at each point")
    chain = ((390, 230), (440, 150), (350, 76))
    for a, b in pairwise(chain):
        yield d.line(*a, *b, d.COOL, 2.4)
        yield d.circle(*b, 3.5, d.COOL)
    yield d.circle(390, 230, 4.5)
    yield d.text(390, 272, "1, then 1, then 1 …", d.COOL)


@d.diagram("disk", 520, 320)
def disk():
    """A patch of the unit hemisphere, and its shadow straight below."""
    x, y, r, first, last = 250, 240, 190, 42, 56
    a, b = d.polar(x, y, first, r), d.polar(x, y, last, r)
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{d.SAND}" stroke="{d.SOFT}"/>'
    yield from d.arrow(x, y, x, y - r - 20, "n")
    yield f'<path d="M{x} {y} L{a[0]:.1f} {a[1]:.1f} L{b[0]:.1f} {b[1]:.1f}z" fill="{d.GLOW}"/>'
    yield d.line(x, y, *d.polar(x, y, (first + last) / 2, r), d.WARM, 1.2, False, "5 4")
    yield d.curve([d.polar(x, y, first + i, r) for i in range(last - first + 1)], d.WARM, 6)
    yield d.symbol(*d.polar(x, y, 49, r + 26), "dω", d.WARM)
    for tip in (a, b):
        yield d.dashed(*tip, tip[0], y)
    yield d.line(x - r, y, x + r, y, d.INK, 2.2)
    yield d.line(a[0], y, b[0], y, d.COOL, 6)
    yield d.symbol((a[0] + b[0]) / 2, y + 30, "cosθ dω", d.COOL)
    yield from d.angle(x, y, 0, 49, 60, "θ")
    yield d.dashed(x - r, y + 46, x + r, y + 46)
    yield d.circle(x, y, 4.5)
    yield d.symbol(x, y + 30, "x")
    yield d.text(x, y + 70, "a disk of radius 1: its area is π", d.SOFT)


@d.diagram("four-numbers", 520, 290)
def four_numbers():
    """Four samples of 2x, drawn uniformly, and drawn in proportion to 2x."""
    drawn = (0.1, 0.3, 0.6, 0.9)
    for x0, name, places, values in (
        (50, "p = 1", drawn, [2 * x for x in drawn]),
        (310, "p = 2x", [math.sqrt(x) for x in drawn], [1] * 4),
    ):
        y0, width, height = 220, 180, 180
        yield from d.plot(x0, y0, width, height, ((lambda x: 2 * x, d.INK),), top=2)
        yield d.dashed(x0, y0 - height / 2, x0 + width, y0 - height / 2, d.COOL)
        for place, value in zip(places, values):
            yield d.line(x0 + width * place, y0, x0 + width * place, y0 - height / 2 * value, d.WARM, 2)
            yield d.circle(x0 + width * place, y0 - height / 2 * value, 5, d.WARM)
            if value != 1:
                aside = (0, -12, "middle") if value < 0.5 else (10, 8, "start")
                at = x0 + width * place + aside[0], y0 - height / 2 * value + aside[1]
                yield d.text(*at, f"{value:.1f}", d.WARM, aside[2])
        yield d.text(x0 - 8, y0 - height / 2 + 5, "1", d.COOL, "end")
        yield d.text(x0 - 8, y0 - height + 8, "2", d.SOFT, "end")
        yield d.text(x0 + width, y0 + 20, "1", d.SOFT)
        yield d.text(x0 + width / 2, y0 + 44, name, d.INK)
        yield d.text(x0 + 14, y0 - height + 8, "f(x) = 2x", d.INK, "start")
    yield d.text(260, 284, "dots: f/p of each sample", d.WARM)


@d.diagram("inversion", 520, 320)
def inversion():
    """Equal steps of height on the distribution, and where their angles lie."""
    x0, y0, width, height = 60, 260, 400, 220
    right = math.pi / 2
    yield from d.plot(x0, y0, width, height, ((lambda t: 1 - math.cos(t), d.INK),), last=right)
    for i in range(10):
        xi = (i + 0.5) / 10
        at = x0 + width * math.acos(1 - xi) / right
        color = d.WARM if i == 6 else d.FAINT
        yield d.line(x0, y0 - height * xi, at, y0 - height * xi, color, 2 if i == 6 else 1.2)
        yield d.line(at, y0 - height * xi, at, y0, color, 2 if i == 6 else 1.2, i == 6)
        yield d.circle(at, y0, 3.5, d.WARM)
        yield d.circle(x0, y0 - height * xi, 3.5, d.COOL)
    yield d.symbol(x0 - 20, y0 - height * 0.65 + 5, "ξ", d.COOL)
    yield d.symbol(x0 + width * math.acos(0.35) / right, y0 + 30, "θ", d.WARM)
    yield d.text(x0, y0 + 24, "0", d.SOFT)
    yield d.text(x0 + width, y0 + 24, "90°", d.SOFT)
    yield d.text(x0 - 10, y0 - height + 5, "1", d.SOFT, "end")
    yield d.text(x0 + 14, y0 - height - 10, "P(θ) = 1 − cos θ", d.INK, "start")
    yield d.text(260, 314, "equal steps of ξ: steep curve, dense angles", d.INK)


def lifted(x, y, r, sine, phi, tilt):
    """The place on the page of a direction of a hemisphere of radius r, seen from
    so many degrees above its rim; 90 is from above."""
    cosine, lift = math.sqrt(max(0, 1 - sine * sine)), math.radians(tilt)
    return x + r * sine * math.cos(phi), y + r * (
        sine * math.sin(phi) * math.sin(lift) - cosine * math.cos(lift)
    )


@d.diagram("three-hemispheres", 520, 400)
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
        yield d.text(x, 24, name, d.RED if "wrong" in name else d.INK)
        yield f'<path d="M{x - r} 130 A{r} {r} 0 0 1 {x + r} 130" fill="{d.SAND}" stroke="{d.SOFT}"/>'
        flat = r * math.sin(math.radians(tilt))
        yield f'<ellipse cx="{x}" cy="130" rx="{r}" ry="{flat:.1f}" fill="{d.SAND}" stroke="{d.SOFT}"/>'
        yield d.circle(x, 264, r, d.SAND, d.SOFT)
        directions = [(sine_of(u), 2 * math.pi * v) for u, v in pairs]
        yield from d.dots(
            [lifted(x, 130, r, s, phi, tilt) for s, phi in directions if math.sin(phi) > -0.2], d.WARM, 1.7
        )
        yield from d.dots([lifted(x, 264, r, s, phi, 90) for s, phi in directions], d.WARM, 1.7)
        yield d.text(x, 372, f"{sum(s < 0.5 for s, _ in directions) / len(directions):.0%}")
    yield d.text(260, 394, "of the directions are within 30° of the normal", d.SOFT)


@d.diagram("malley", 520, 300)
def malley():
    """Uniform points on the disk from above, and lifted onto the hemisphere."""
    drawn = random.Random(5)
    pairs = [(drawn.random(), drawn.random()) for _ in range(240)]
    x, y, r = 112, 142, 100
    yield d.circle(x, y, r, d.SAND, d.SOFT)
    yield from d.dots([lifted(x, y, r, math.sqrt(u), 2 * math.pi * v, 90) for u, v in pairs])
    yield d.circle(x, y, f"{r * 0.7071:.1f}", "none", d.COOL)
    yield d.line(x, y, *d.polar(x, y, 60, r * 0.7071), d.COOL, 2, True)
    yield d.symbol(x + 34, y + 2, "r", d.COOL)
    yield d.text(x, 272, "r = 0.71: half of the dots", d.COOL)
    x, y, r, tilt = 376, 192, 130, 16
    flat = r * math.sin(math.radians(tilt))
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{d.SAND}" stroke="{d.SOFT}"/>'
    yield f'<ellipse cx="{x}" cy="{y}" rx="{r}" ry="{flat:.1f}" fill="{d.GLOW}" stroke="{d.SOFT}"/>'
    for u, v in pairs[100:140]:
        sine, phi = math.sqrt(u), 2 * math.pi * v
        foot = x + r * sine * math.cos(phi), y + flat * sine * math.sin(phi)
        tip = lifted(x, y, r, sine, phi, tilt)
        yield d.line(*foot, *tip, d.SOFT, 0.8)
        yield from d.dots([foot], d.COOL, 2.4)
        yield from d.dots([tip], d.WARM, 2.8)
    yield d.text(x, 272, "lifted onto the hemisphere", d.WARM)


@d.diagram("acne", 520, 200)
def acne():
    """A ray whose origin was rounded to below the surface."""
    for x, depth, name in ((130, 0, "on the surface"), (390, 26, "rounded to below it")):
        y = 112
        yield from d.hatched(x - 110, y, x + 110, y)
        yield d.dashed(x - 104, 12, x - 30, y + depth - 4, d.COOL)
        yield from d.arrow(
            x - 30, y + depth, *d.polar(x - 30, y + depth, 62, 64 if depth else 120), "", d.WARM
        )
        yield d.circle(x - 30, y + depth, 4.5)
        if depth:
            yield d.circle(x - 30 + depth * math.tan(math.radians(62)), y, 6, "none", d.RED)
            yield d.text(x + 34, y - 16, "hit again", d.RED, "start")
        yield d.text(x, 186, name)


@d.diagram("lamp-front", 520, 240)
def lamp_front():
    """A lamp, seen from the side of its normal and from the other."""
    y = 100
    for x, front in ((130, True), (390, False)):
        yield d.text(x, 24, "seen from the front" if front else "seen from the back")
        yield d.line(x - 80, y, x + 80, y, d.LAMP if front else d.INK, 8)
        yield from d.arrow(x, y, x, y + (66 if front else -44), "n")
        tip = d.polar(x, y, 135, 92)
        yield d.line(x, y, *tip, d.COOL, 2.4, True)
        yield d.symbol(tip[0] + 22, tip[1] + 6, "w_o", d.COOL)
    for degrees in (-110, -140, 110):
        yield d.line(*d.polar(130, y, degrees, 12), *d.polar(130, y, degrees, 76), d.WARM, 1.6, True)
    yield d.symbol(130, 226, "n · w_o &gt; 0: radiance k_e", d.WARM)
    yield d.symbol(390, 226, "n · w_o &lt; 0: black")


# What `build/stage1 scenes/cornell_box_ceiling_diffuse.toml --pixel 70,240
# --sample 8` prints of its path: x and y of each vertex, and their throughputs.
VERTICES = ((-0.5066, -1.0), (-1.0, 0.0355), (0.8006, 1.0))


@d.diagram("followed-path", 520, 430)
def followed_path():
    """The path that the chapter follows, seen from the front."""
    size, left, top, far = 165, 255, 205, 0.53

    def place(x, y):
        return left + size * x, top - size * y

    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))
    for x, y in corners[:4]:
        yield d.line(*place(x, y), *place(far * x, far * y), d.SOFT, 1)
    yield d.curve([place(far * x, far * y) for x, y in corners], d.SOFT, 1)
    for a, b, color, width in zip(corners, corners[1:], (d.INK, d.GREEN, d.LAMP, d.RED), (4, 4, 8, 4)):
        yield d.line(*place(*a), *place(*b), color, width)
    a, b, c = [place(*vertex) for vertex in VERTICES]
    yield d.line(252, 408, a[0] + 13, a[1] + 5, d.COOL, 2, True)
    yield d.text(262, 416, "from the camera: 1, 1, 1", d.COOL, "start")
    yield d.line(*a, b[0] + 5, b[1] + 11, d.COOL, 2.4, True)
    yield d.text((a[0] + b[0]) / 2 + 34, (a[1] + b[1]) / 2 + 34, "0.8, 0.8, 0.8", d.COOL, "start")
    yield d.line(*b, c[0] - 11, c[1] + 6, d.COOL, 2.4, True)
    yield d.text(262, (b[1] + c[1]) / 2 + 50, "0.64, 0.16, 0.16", d.COOL)
    for number, (x, y) in enumerate((a, b, c)):
        yield d.circle(x, y, 12, d.SAND, d.INK)
        yield d.text(x, y + 6, str(number))
    yield d.text(left, 24, "ceiling: emits 1, 1, 1", d.WARM)
    yield d.text(left + 20, top + size - 14, "white floor", d.INK, "start")
    yield d.text(18, top - 30, "red", d.RED, "start")
    yield d.text(18, top - 8, "wall", d.RED, "start")


@d.diagram("hemisphere", 440, 270)
def hemisphere():
    x, y, r = 220, 220, 150
    yield d.line(30, y, 410, y, d.INK, 2)
    yield (
        f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" '
        f'fill="#f3e9df" stroke="{d.SOFT}" stroke-dasharray="4 3"/>'
    )
    for angle in (-72, -50, -12, 20, 62):
        yield d.line(*d.polar(x, y, angle, r + 34), *d.polar(x, y, angle, r + 8), d.WARM, 1.2, True)
    yield d.ray(x, y, 0, r + 30, d.INK)
    yield d.text(x + 14, y - r - 24, "n", style="italic")
    yield d.ray(x, y, 42, r, d.WARM)
    yield d.text(*d.polar(x + 12, y - 2, 42, r + 14), "w_i", d.WARM)
    yield d.ray(x, y, -34, r, d.COOL)
    yield d.text(*d.polar(x - 10, y - 4, -34, r + 14), "w_o", d.COOL)
    yield d.arc(x, y, 0, 42, 52)
    yield d.text(*d.polar(x, y + 4, 21, 68), "θ", style="italic")
    yield d.circle(x, y, 4)
    yield d.text(x, y + 24, "x", style="italic")
    yield d.text(x + r + 12, y - 22, "Ω", d.SOFT)


@d.diagram("pinhole", 600, 270)
def pinhole():
    origin = (60, 150)
    corners = [(380, 60), (450, 20), (450, 200), (380, 250)]
    path = " ".join(f"{x},{y}" for x, y in corners)
    yield f'<polygon points="{path}" fill="#f3e9df" stroke="{d.SOFT}"/>'
    center = (415, 133)
    yield d.line(*origin, *center, d.INK, 2, True)
    yield d.text(236, 130, "F", style="italic")
    yield d.line(*center, 380, 155, d.WARM, 2, True)
    yield d.text(370, 152, "L", d.WARM, "end", "italic")
    yield d.line(*center, 415, 40, d.GREEN, 2, True)
    yield d.text(430, 64, "U", d.GREEN, style="italic")
    yield d.circle(*origin, 5)
    yield d.text(60, 176, "O", style="italic")
    yield d.line(*origin, 570, 196, d.COOL, 1.6, True)
    yield d.text(572, 214, "a ray", d.COOL, "end", size=14)
    yield d.text(462, 22, "column 0 at L,", d.SOFT, "start", size=13)
    yield d.text(462, 44, "row 0 at U", d.SOFT, "start", size=13)
