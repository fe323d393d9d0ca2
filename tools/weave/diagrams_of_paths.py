"""Diagrams of light at surfaces and of paths, most of them for the slides."""

import math

from tools.weave.drawing import (
    COOL,
    GREEN,
    INK,
    SAND,
    SOFT,
    WARM,
    angle,
    arc,
    arrow,
    circle,
    curve,
    dashed,
    diagram,
    hatched,
    line,
    polar,
    ray,
    text,
)


def surface(x, y, half):
    yield line(x - half, y, x + half, y, INK, 2.2)
    yield line(x, y, x, y - 112, SOFT, 1, False, "4 4")


def lobe(x, y, name):
    yield from surface(x, y, 90)
    yield ray(x, y, -42, 96, COOL)
    yield text(*polar(x - 10, y - 2, -42, 106), "w_o", COOL)
    if name == "diffuse":
        for angle in (-64, -20, 0, 22, 44, 66):
            yield ray(x, y, angle, 70, WARM, 1.6)
    elif name == "specular":
        yield ray(x, y, 42, 96, WARM, 2.4)
        yield text(*polar(x + 12, y - 2, 42, 106), "w_r", WARM)
    else:
        yield ray(x, y, 180 - 26.5, 76, WARM, 2.4)
        yield text(*polar(x + 20, y + 4, 180 - 26.5, 72), "w_t", WARM, "start")


@diagram("diffuse-lobe", 220, 150)
def diffuse_lobe():
    yield from lobe(110, 130, "diffuse")


@diagram("specular-lobe", 220, 150)
def specular_lobe():
    yield from lobe(110, 130, "specular")


@diagram("refraction-lobe", 220, 220)
def refraction_lobe():
    yield from lobe(110, 130, "refraction")


@diagram("mirror", 280, 190)
def mirror_of_the_slide():
    """With wo as the course's slide has it: it points at the surface."""
    x, y = 140, 170
    yield line(x - 115, y, x + 115, y, INK, 2.2)
    yield ray(x, y, 0, 140, INK)
    yield text(x + 13, y - 130, "n", style="italic")
    yield ray(x, y, 48, 124, WARM, 2.4)
    yield text(*polar(x + 14, y, 48, 132), "w_r", WARM)
    yield arc(x, y, 0, 48, 40)
    yield arc(x, y, -48, 0, 40)
    tip = polar(x, y, -48, 124)
    yield line(*tip, *polar(x, y, -48, 5), COOL, 2.4, True)
    yield text(tip[0] - 14, tip[1] + 2, "w_o", COOL)


@diagram("mirror-cone", 520, 200)
def mirror_cone():
    """A mirror as the limit of ever thinner cones around one direction."""
    for x, half, name in ((90, 16, "a glossy surface"), (260, 8, "a glossier one"), (430, 0, "a mirror")):
        y = 140
        tip = polar(x, y, 42 - half, 104), polar(x, y, 42 + half, 104)
        if half:
            path = " ".join(f"{a:.1f},{b:.1f}" for a, b in ((x, y), *tip))
            yield f'<polygon points="{path}" fill="{SAND}"/>'
            for end in tip:
                yield dashed(x, y, *end, WARM)
            yield from angle(x, y, 42 - half, 42 + half, 90, "ε", WARM)
        yield from hatched(x - 76, y, x + 76, y)
        yield dashed(x, y, x, y - 104)
        yield from arrow(x, y, *polar(x, y, 42, 72), "" if half else "w_r", WARM)
        yield from arrow(x, y, *polar(x, y, -42, 72), "w_o", COOL)
        yield text(x, 186, name)


@diagram("one-path", 560, 300)
def one_path():
    yield f'<path d="M40 30 H530 V270 H40" fill="none" stroke="{INK}" stroke-width="2.4"/>'
    yield line(220, 30, 360, 30, WARM, 7)
    yield text(290, 20, "lamp", WARM)
    points = [(40, 160), (250, 270), (530, 140), (150, 30), (180, 270), (300, 30)]
    for number, (a, b) in enumerate(zip(points, points[1:])):
        yield line(*a, *b, COOL, 2, True)
        if 0 < number:
            yield circle(*a, 5)
            yield text(
                a[0] + (18 if a[0] < 500 else -16), a[1] + (20 if a[1] < 200 else -10), str(number), size=14
            )
    yield text(50, 146, "camera", SOFT, "start", size=14)
    yield text(298, 54, "its emission, times", WARM, "start", size=13)
    yield text(298, 74, "the product of the weights", WARM, "start", size=13)


def tree(x, y, angle, length, depth):
    """Branches of a path: two at every end."""
    end = polar(x, y, angle, length)
    yield line(x, y, *end, WARM, 0.7 + depth * 0.35)
    if depth:
        spread = 9 + 7 * depth
        for side in (-spread, spread):
            yield from tree(*end, angle + side, length * 0.8, depth - 1)
    else:
        yield circle(*end, 2, WARM)


@diagram("branching", 600, 300)
def branching():
    yield from tree(150, 262, 0, 56, 5)
    yield text(150, 288, "every lobe: 2, 4, 8, 16, 32")
    x, y = 450, 262
    for angle, length in ((0, 56), (30, 45), (-14, 38), (16, 32), (-30, 27), (8, 24)):
        end = polar(x, y, angle, length)
        yield line(x, y, *end, COOL, 2.2)
        x, y = end
        yield circle(x, y, 3, COOL)
    yield text(450, 288, "one at random: 1, 1, 1, 1, 1")


@diagram("pinhole", 600, 270)
def pinhole():
    origin = (60, 150)
    corners = [(380, 60), (450, 20), (450, 200), (380, 250)]
    path = " ".join(f"{x},{y}" for x, y in corners)
    yield f'<polygon points="{path}" fill="#f3e9df" stroke="{SOFT}"/>'
    center = (415, 133)
    yield line(*origin, *center, INK, 2, True)
    yield text(236, 130, "F", style="italic")
    yield line(*center, 380, 155, WARM, 2, True)
    yield text(370, 152, "L", WARM, "end", "italic")
    yield line(*center, 415, 40, GREEN, 2, True)
    yield text(430, 64, "U", GREEN, style="italic")
    yield circle(*origin, 5)
    yield text(60, 176, "O", style="italic")
    yield line(*origin, 570, 196, COOL, 1.6, True)
    yield text(572, 214, "a ray", COOL, "end", size=14)
    yield text(462, 22, "column 0 at L,", SOFT, "start", size=13)
    yield text(462, 44, "row 0 at U", SOFT, "start", size=13)


@diagram("densities", 580, 245)
def densities():
    """Both densities of theta, and their distributions."""
    for x0, name, functions in (
        (40, "density of θ", ((math.sin, WARM), (lambda t: math.sin(2 * t), COOL))),
        (346, "its distribution", ((lambda t: 1 - math.cos(t), WARM), (lambda t: math.sin(t) ** 2, COOL))),
    ):
        y0, width, height = 215, 200, 165
        yield line(x0, y0, x0 + width, y0)
        yield line(x0, y0, x0, y0 - height - 8)
        for function, color in functions:
            yield curve(
                [(x0 + width * i / 60, y0 - height * function(math.pi / 2 * i / 60)) for i in range(61)],
                color,
                2.4,
            )
        yield text(x0 + width, y0 + 18, "90°", SOFT, size=13)
        yield text(x0 - 7, y0 - height + 5, "1", SOFT, "end", size=13)
        yield text(x0 - 7, y0 + 5, "0", SOFT, "end", size=13)
        yield text(x0 + width / 2, 24, name)
    for x, y, words, color, anchor in (
        (248, 58, "uniform", WARM, "start"),
        (99, 64, "cosine", COOL, "end"),
        (476, 185, "uniform", WARM, "start"),
        (416, 105, "cosine", COOL, "end"),
    ):
        yield text(x, y, words, color, anchor)
