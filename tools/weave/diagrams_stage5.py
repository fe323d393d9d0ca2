"""The drawings of chapter 5."""

import math

from tools.weave.diagrams import fresnel
from tools.weave.drawing import (
    COOL,
    FAINT,
    GLASS,
    GLOW,
    INK,
    PAPER,
    SAND,
    SOFT,
    WARM,
    arrow,
    axes,
    circle,
    curve,
    dashed,
    diagram,
    line,
    plot,
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


def corner(x, y, u, v):
    """Both arrows from one corner; u and v are (dx, dy)."""
    yield from arrow(x, y, x + u[0], y + u[1], "u", WARM, 2.4)
    yield from arrow(x, y, x + v[0], y + v[1], "v", COOL, 2.4)


def globe(x, y, r):
    yield circle(x, y, r, SAND, INK)
    for share in (-0.5, 0, 0.5):
        half = r * math.sqrt(1 - share * share)
        yield (
            f'<ellipse cx="{x}" cy="{y - r * share:.1f}" rx="{half:.1f}" ry="{half * 0.18:.1f}" '
            f'fill="none" stroke="{SOFT}"/>'
        )
    yield f'<ellipse cx="{x}" cy="{y}" rx="{r * 0.5}" ry="{r}" fill="none" stroke="{SOFT}"/>'
    yield from arrow(x, y + r, x, y - r - 6, "v", COOL, 2.4)
    yield from arrow(x - r, y, x + r + 6, y, "u", WARM, 2.4)
    yield circle(x, y, 4.5, INK)


@diagram("uv", 540, 476)
def uv():
    """Where u and v run on each kind of shape."""
    yield f'<path d="M40 150 H150 V60 H40z" fill="{SAND}" stroke="{SOFT}"/>'
    yield from corner(40, 150, (110, 0), (0, -90))
    yield text(96, 190, "rectangle")
    yield f'<path d="M215 150 L325 150 L265 60z" fill="{SAND}" stroke="{SOFT}"/>'
    yield from corner(215, 150, (110, 0), (50, -90))
    yield text(270, 190, "triangle")
    yield from globe(440, 100, 62)
    yield text(440, 190, "sphere")
    far, near = (
        ((190, 276), (350, 276), (350, 350), (190, 350)),
        ((90, 224), (450, 224), (450, 440), (90, 440)),
    )
    for first, second, fill in ((3, 0, GLASS), (2, 3, SAND), (1, 2, GLASS)):
        points = (near[first], near[second], far[second], far[first])
        path = " ".join(f"{a},{b}" for a, b in points)
        yield f'<polygon points="{path}" fill="{fill}" stroke="{SOFT}"/>'
    yield f'<path d="M190 276 H350 V350 H190z" fill="{PAPER}" stroke="{SOFT}"/>'
    yield from corner(232, 340, (62, 0), (0, -36))
    yield from corner(112, 390, (40, -26), (0, -72))
    yield from corner(388, 352, (36, 24), (0, -50))
    yield from corner(206, 428, (84, 0), (22, -46))
    yield text(270, 466, "planes")


@diagram("bilinear", 520, 290)
def bilinear():
    """Four texels, their centers with their weights, and a point between them."""
    x0, y0, size = 24, 20, 125
    colors = ((SAND, GLASS), (GLOW, FAINT))
    for row in range(2):
        for column in range(2):
            yield (
                f'<rect x="{x0 + size * column}" y="{y0 + size * row}" width="{size}" height="{size}" '
                f'fill="{colors[row][column]}" stroke="{SOFT}"/>'
            )
    left, top = x0 + size / 2, y0 + size / 2
    px, py = left + size * 0.3, top + size * 0.6
    for row in range(2):
        yield dashed(left, top + size * row, left + size, top + size * row)
        yield dashed(left + size * row, top, left + size * row, top + size)
    yield line(px, top, px, top + size, WARM, 1.6)
    for place, weight in enumerate(("0.28", "0.12", "0.42", "0.18")):
        row, column = divmod(place, 2)
        x, y = left + size * column, top + size * row
        yield circle(x, y, 4)
        yield text(x + (14 if column else -14), y + (24 if row else -14), weight, WARM)
    yield circle(px, py, 5.5, WARM)
    yield text((left + px) / 2, top + 20, "0.3", SOFT)
    yield text((left + size + px) / 2, top + 20, "0.7", SOFT)
    yield dashed(px, py, left + size, py, WARM)
    yield text(left + size + 8, (top + py) / 2 + 5, "0.6", SOFT, "start")
    yield text(left + size + 8, (top + size + py) / 2 + 5, "0.4", SOFT, "start")
    for place, sum_ in enumerate(
        ("0.7 · 0.4 = 0.28", "0.3 · 0.4 = 0.12", "0.7 · 0.6 = 0.42", "0.3 · 0.6 = 0.18")
    ):
        yield text(312, 96 + 30 * place, sum_, WARM, "start")


@diagram("srgb-curve", 520, 300)
def srgb_curve():
    """What a byte stands for, and what it is taken for."""
    x, y, width, height = 60, 250, 400, 215

    def decoded(b):
        return b / 12.92 if b <= 0.04045 else ((b + 0.055) / 1.055) ** 2.4

    byte = 188 / 255
    at = x + width * byte
    yield dashed(x, y, x + width, y - height)
    yield from plot(x, y, width, height, [(decoded, INK)])
    yield dashed(at, y, at, y - height * byte)
    for value, color in ((decoded(byte), WARM), (byte, SOFT)):
        yield dashed(x, y - height * value, at, y - height * value, color)
        yield circle(at, y - height * value, 4.5, color)
        yield text(x - 8, y - height * value + 5, f"{value:.2f}", color, "end")
    yield text(x - 8, y - height + 5, "1", SOFT, "end")
    yield text(at, y + 22, "188", WARM)
    yield text(x + width, y + 22, "255", SOFT)
    yield text(x, y + 22, "0", SOFT)
    yield text(x + width / 2 - 20, y + 40, "byte in the file")
    yield text(x + 10, y - height - 10, "light", anchor="start")


def schlick(degrees):
    return 0.04 + 0.96 * (1 - math.cos(math.radians(degrees))) ** 5


@diagram("schlick-curves", 520, 290)
def schlick_curves():
    """Schlick's approximation beside Fresnel's F, from both sides."""
    for x, ratio, name in ((44, 1 / 1.5, "from outside"), (294, 1.5, "from inside")):
        y, width, height = 235, 200, 190
        yield from axes(x, y, width, height)
        for function, color, dash in ((lambda a: fresnel(a, ratio)[0], INK, ""), (schlick, WARM, "6 3")):
            points = [(x + width * a / 360, y - height * function(a / 4)) for a in range(361)]
            yield curve(points, color, 2, dash)
        if ratio > 1:
            for value, color in ((fresnel(41, ratio)[0], INK), (schlick(41), WARM)):
                yield circle(x + width * 41 / 90, y - height * value, 4.5, color)
        yield text(x + width, y + 20, "90°", SOFT)
        yield text(x - 6, y + 5, "0", SOFT, "end")
        yield text(x - 6, y - height + 8, "1", SOFT, "end")
        yield text(x + width / 2, 26, name)
    yield text(294 + 200 * 41 / 90, 255, "41°", SOFT)
    yield text(200, 282, "F", INK)
    yield text(290, 282, "Schlick", WARM)
