"""The drawings of chapter 2."""

import math

from tools.weave.drawing import (
    COOL,
    GLASS,
    GLOW,
    INK,
    LAMP,
    SAND,
    SOFT,
    WARM,
    angle,
    arrow,
    boxes,
    circle,
    dashed,
    diagram,
    hatched,
    line,
    polar,
    symbol,
    text,
)


@diagram("split", 520, 320)
def split():
    """The hemisphere at x: directions to the lamp, and all others."""
    x, y, r = 240, 270, 120
    yield from hatched(40, y, 480, y)
    yield from hatched(480, y, 480, 50)
    yield line(290, 50, 380, 50, LAMP, 8)
    yield text(335, 34, "lamp: L_e", WARM)
    first, last = (math.degrees(math.atan2(end - x, y - 50)) for end in (290, 380))
    yield f'<path d="M{x} {y} L290 54 L380 54z" fill="{GLOW}"/>'
    a, b = polar(x, y, first, r), polar(x, y, last, r)
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {a[0]:.1f} {a[1]:.1f}" fill="none" stroke="{COOL}" stroke-width="4"/>'
    yield f'<path d="M{a[0]:.1f} {a[1]:.1f} A{r} {r} 0 0 1 {b[0]:.1f} {b[1]:.1f}" fill="none" stroke="{WARM}" stroke-width="6"/>'
    yield f'<path d="M{b[0]:.1f} {b[1]:.1f} A{r} {r} 0 0 1 {x + r} {y}" fill="none" stroke="{COOL}" stroke-width="4"/>'
    yield from arrow(x, y, *polar(x, y, (first + last) / 2, 190), "", WARM)
    yield from arrow(x, y, *polar(x, y, 66, 200), "", COOL)
    yield circle(480, y - 240 / math.tan(math.radians(66)), 4, COOL)
    yield text(470, 236, "wall: L_s", COOL, "end")
    yield text(52, 110, "direct: to the lamp", WARM, "start")
    yield text(52, 136, "indirect: all others", COOL, "start")
    yield circle(x, y, 4.5)
    yield symbol(x, y + 32, "x")


@diagram("shrinking-lamp", 520, 230)
def shrinking_lamp():
    """A lamp that becomes smaller and brighter."""
    for x, half, name in ((90, 44, "A, L_e"), (260, 18, "A/6, 6 L_e"), (430, 0, "a point, I")):
        y = 180
        yield from hatched(x - 70, y, x + 70, y)
        if half:
            yield f'<path d="M{x} {y} L{x - half} 54 L{x + half} 54z" fill="{GLOW}"/>'
            yield line(x - half, 52, x + half, 52, LAMP, 7)
        else:
            yield circle(x, 52, 6, LAMP, WARM)
        yield dashed(x, y, x, 60, WARM)
        yield symbol(x + 14, 128, "d", INK, "start")
        yield text(x, 34, name, WARM)
        yield circle(x, y, 4)
        yield text(x, y + 36, "L_e A/d²" if half == 44 else "the same" if half else "I/d²")


@diagram("lamp-cone", 520, 280)
def lamp_cone():
    """The cone that a sphere fills, and the chord of one direction."""
    x, y = 70, 150
    cx, r = 360, 96
    d = cx - x
    edge = math.degrees(math.asin(r / d))
    yield circle(cx, y, r, SAND, SOFT)
    for side in (-1, 1):
        a = math.radians(edge) * side
        reach = math.sqrt(d * d - r * r)
        yield line(x, y, x + reach * math.cos(a), y - reach * math.sin(a), SOFT, 1.4)
    yield line(x + d * math.cos(math.radians(edge)) ** 2, y - d * math.cos(math.radians(edge)) * math.sin(math.radians(edge)), cx, y, INK, 1.4)
    yield symbol(cx + 4, y - 46, "r", INK, "start")
    yield dashed(x, y, cx, y)
    yield symbol((x + cx) / 2 + 10, y + 26, "d")
    a = math.radians(9.5)
    near = d * math.cos(a) - math.sqrt(r * r - (d * math.sin(a)) ** 2)
    far = d * math.cos(a) + math.sqrt(r * r - (d * math.sin(a)) ** 2)
    yield line(x, y, x + near * math.cos(a), y - near * math.sin(a), WARM, 2.4, True)
    yield dashed(x + near * math.cos(a), y - near * math.sin(a), x + far * math.cos(a), y - far * math.sin(a), WARM)
    yield from angle(x, y, 90 - edge, 90, 150, "", SOFT)
    yield symbol(x + 176, y - 62, "θ_m", SOFT)
    yield from angle(x, y, 80.5, 90, 96, "", WARM)
    yield symbol(x + 112, y - 4, "θ", WARM)
    foot = d * math.cos(a)
    yield line(cx, y, x + foot * math.cos(a), y - foot * math.sin(a), COOL, 1.6)
    yield text(cx + 40, y + 34, "d sin θ", COOL, "middle", "italic")
    yield line(cx + 16, y + 20, cx - 2, y - 18, COOL, 1, True)
    yield circle(x, y, 4.5)
    yield symbol(x - 20, y + 6, "x")
    yield circle(cx, y, 3.5)
    yield text(260, 272, "sin θ_m = r/d", SOFT)


@diagram("who-counts", 540, 190)
def who_counts():
    """Whether a lamp that is hit counts."""
    rows = (
        ("the path comes from", "a lamp that is asked", "a lamp that is not"),
        ("the camera", "counts", "counts"),
        ("a wall: lights asked", "counted already", "counts"),
        ("a mirror (stage 3)", "counts", "counts"),
    )
    fills = [(i, j, GLASS) for i in (1, 2, 3) for j in (1, 2) if rows[i][j] == "counts"] + [(2, 1, GLOW)]
    yield from boxes(6, 10, rows, (190, 174, 164), 42, fills)
