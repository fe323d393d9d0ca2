"""The drawings of chapter 5."""

import math

from tools.weave.drawing import (
    COOL,
    FAINT,
    GLASS,
    GLOW,
    INK,
    SAND,
    SOFT,
    WARM,
    arrow,
    circle,
    dashed,
    diagram,
    line,
    polar,
    symbol,
    text,
)


@diagram("polarization", 520, 290)
def polarization():
    """Light of both polarizations at a surface, seen within the plane."""
    for x, name, across in ((130, "s: square to the plane", True), (390, "p: within the plane", False)):
        y = 190
        yield f'<path d="M{x - 110} {y} H{x + 110} V240 H{x - 110}z" fill="{GLASS}"/>'
        yield line(x - 110, y, x + 110, y, COOL, 2)
        yield dashed(x, y, x, y - 140)
        yield symbol(x + 14, y - 130, "n")
        for degrees, color in ((-50, WARM), (50, COOL)):
            end = polar(x, y, degrees, 150)
            yield line(*(end if degrees < 0 else (x, y)), *((x, y) if degrees < 0 else end), color, 2, True)
            for step in (0.35, 0.6, 0.85):
                px, py = polar(x, y, degrees, 150 * step)
                if across:
                    yield circle(px, py, 6, "none", color)
                    yield circle(px, py, 2, color)
                else:
                    a = polar(px, py, degrees + 90, 15)
                    b = polar(px, py, degrees - 90, 15)
                    yield line(*a, *b, color, 2)
        yield text(x, 270, name)


@diagram("uv", 540, 300)
def uv():
    """Where u and v run on each kind of shape."""
    yield f'<path d="M40 210 L150 210 L150 110 L40 110z" fill="{SAND}" stroke="{INK}"/>'
    yield from arrow(40, 210, 128, 210, "u", WARM, 2.4)
    yield from arrow(40, 210, 40, 134, "v", COOL, 2.4)
    yield text(96, 268, "rectangle")
    yield f'<path d="M200 60 L290 30 L290 170 L200 210z" fill="{SAND}" stroke="{SOFT}"/>'
    yield f'<path d="M200 210 L290 170 L350 205 L250 250z" fill="{GLASS}" stroke="{SOFT}"/>'
    yield line(200, 190, 200, 110, COOL, 2.4, True)
    yield symbol(186, 116, "v", COOL)
    yield line(204, 196, 258, 172, WARM, 2.4, True)
    yield symbol(244, 160, "u", WARM)
    yield text(276, 284, "planes: v is up, +y or +z")
    x, y, r = 440, 150, 78
    yield circle(x, y, r, SAND, INK)
    for share in (-0.5, 0, 0.5):
        half = r * math.sqrt(1 - share * share)
        yield f'<ellipse cx="{x}" cy="{y - r * share:.1f}" rx="{half:.1f}" ry="{half * 0.18:.1f}" fill="none" stroke="{SOFT}"/>'
    yield f'<ellipse cx="{x}" cy="{y}" rx="30" ry="{r}" fill="none" stroke="{SOFT}"/>'
    yield line(x, y + r * 0.99, x, y - r * 0.8, COOL, 2.4, True)
    yield symbol(x + 14, y - 44, "v", COOL)
    yield line(x - 62, y + 14, x + 52, y + 14, WARM, 2.4, True)
    yield symbol(x + 42, y + 34, "u", WARM)
    yield text(x, y - r - 12, "v = 1", SOFT)
    yield text(x, y + r + 24, "v = 0", SOFT)


@diagram("bilinear", 520, 300)
def bilinear():
    """Four texels, their centers, and a point between them."""
    x0, y0, size = 60, 30, 110
    colors = ((SAND, GLASS), (GLOW, FAINT))
    for row in range(2):
        for column in range(2):
            yield (
                f'<rect x="{x0 + size * column}" y="{y0 + size * row}" width="{size}" height="{size}" '
                f'fill="{colors[row][column]}" stroke="{SOFT}"/>'
            )
    left, top = x0 + size / 2, y0 + size / 2
    px, py = left + size * 0.3, top + size * 0.6
    yield dashed(left, top, left + size, top)
    yield dashed(left, top + size, left + size, top + size)
    yield dashed(left, top, left, top + size)
    yield dashed(left + size, top, left + size, top + size)
    yield line(px, top, px, top + size, WARM, 1.6)
    for column in range(2):
        for row in range(2):
            yield circle(left + size * column, top + size * row, 4)
    yield circle(px, py, 5.5, WARM)
    yield text(310, 66, "0.3 to the right, 0.6 down:", INK, "start")
    weights = ("0.7 · 0.4 = 0.28", "0.3 · 0.4 = 0.12", "0.7 · 0.6 = 0.42", "0.3 · 0.6 = 0.18")
    for place, weight in enumerate(weights):
        yield text(310, 130 + 26 * place, weight, WARM, "start")
    yield text(170, 284, "two columns, two rows", SOFT)
