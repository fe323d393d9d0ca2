"""The drawings of chapter 3."""

import math

from tools.weave.drawing import (
    COOL,
    GLASS,
    GREEN,
    INK,
    SAND,
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
    text,
    tree,
)


@diagram("mirror-parts", 520, 260)
def mirror_parts():
    """wo and its mirror image, each as a sum of two parts."""
    x, y, a, r = 260, 220, 48, 165
    left, right = polar(x, y, -a, r), polar(x, y, a, r)
    yield from hatched(x - 220, y, x + 220, y)
    yield from arrow(x, y, *left, "w_o", COOL, 2.4)
    yield from arrow(x, y, *right, "w_r", WARM, 2.4)
    yield line(x, y, x, left[1], GREEN, 2.4, True)
    yield line(x, left[1], left[0] + 4, left[1], COOL, 1.6, True)
    yield line(x, left[1], right[0] - 4, right[1], WARM, 1.6, True)
    yield text(x, 30, "along the normal: kept", GREEN)
    yield dashed(x, 40, x, left[1] - 6, GREEN)
    yield text(x - 66, left[1] - 12, "the rest", COOL)
    yield text(x + 66, left[1] - 12, "turned", WARM)
    yield from angle(x, y, -a, 0, 46, "θ")
    yield from angle(x, y, 0, a, 46, "θ")
    yield circle(x, y, 4)


@diagram("refraction-parts", 520, 330)
def refraction_parts():
    """The refracted direction, and its parts."""
    x, y, a, r = 250, 170, 52, 140
    b = math.degrees(math.asin(math.sin(math.radians(a)) / 1.5))
    yield f'<path d="M60 {y} H460 V320 H60z" fill="{GLASS}"/>'
    yield line(60, y, 460, y, COOL, 2)
    yield dashed(x, y, x, y + 146)
    yield from arrow(x, y, x, y - 118, "n")
    up, down = polar(x, y, -a, r), polar(x, y, 180 - b, r)
    yield from arrow(x, y, *up, "w_o", COOL, 2.4)
    yield from arrow(x, y, *down, "w_t", WARM, 2.4)
    yield line(up[0], up[1], x, up[1], SOFT, 1.4)
    yield text((up[0] + x) / 2 + 4, up[1] - 10, "sin t_o", COOL)
    yield line(x, down[1], down[0], down[1], SOFT, 1.4)
    yield text(down[0] + 20, down[1] - 2, "sin t_i", WARM, "start")
    yield text(x - 12, y + 96, "cos t_i", WARM, "end")
    yield from angle(x, y, -a, 0, 44, "t_o")
    yield from angle(x, y, 180, 180 - b, 52, "t_i")
    yield text(452, y - 12, "e_o", SOFT, "end")
    yield text(452, y + 30, "e_i", SOFT, "end")
    yield circle(x, y, 4)


@diagram("critical-cone", 520, 320)
def critical_cone():
    """The hemisphere outside, and the cone inside that it is squeezed into."""
    x, y, r = 260, 170, 120
    critical = math.degrees(math.asin(1 / 1.5))
    yield f'<path d="M70 {y} H450 V312 H70z" fill="{GLASS}"/>'
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{SAND}" stroke="{SOFT}"/>'
    yield line(70, y, 450, y, COOL, 2)
    a, b = polar(x, y, 180 + critical, r), polar(x, y, 180 - critical, r)
    yield f'<path d="M{x} {y} L{a[0]:.1f} {a[1]:.1f} A{r} {r} 0 0 0 {b[0]:.1f} {b[1]:.1f}z" fill="{SAND}" stroke="{WARM}"/>'
    for out in (-75, -45, -20, 20, 45, 75):
        within = math.degrees(math.asin(math.sin(math.radians(out)) / 1.5))
        yield line(*polar(x, y, out, r + 24), *polar(x, y, out, 6), WARM, 1.4)
        yield line(x, y, *polar(x, y, 180 + within, r - 8), WARM, 1.4, True)
    yield from angle(x, y, 180, 180 - critical, 72, "", INK)
    yield text(x + 128, y + 84, "41.8°")
    yield text(x + 140, 80, "π", INK, "start")
    yield text(x + 128, y + 122, "π/2.25", INK, "start")
    yield text(78, y - 12, "air", SOFT, "start")
    yield text(78, y + 28, "glass", SOFT, "start")


@diagram("tree", 520, 290)
def tree_of_rays():
    """Two lobes at every hit: one, two, four, eight rays."""
    leaf = ("", [])
    node = ("", [("", [leaf, leaf]), ("", [leaf, leaf])])
    yield from tree(250, 40, 400, ("", [node, node]), 66)
    for level in range(4):
        yield text(500, 45 + 66 * level, str(2**level), WARM, "end")
    yield text(500, 20, "rays", SOFT, "end")
    yield text(250, 282, "all but the last row send a shadow ray, too", INK)
