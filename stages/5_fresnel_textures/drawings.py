"""Drawings of chapter 5 and its deck."""

import math

from tools.weave import drawing as d


@d.diagram("polarization", 520, 290)
def polarization():
    """Light of both polarizations at a surface, seen within the plane."""
    for x, name, across in ((130, "s: square to the plane", True), (390, "p: within the plane", False)):
        y = 190
        yield f'<path d="M{x - 110} {y} H{x + 110} V240 H{x - 110}z" fill="{d.GLASS}"/>'
        yield d.line(x - 110, y, x + 110, y, d.COOL, 2)
        yield d.dashed(x, y, x, y - 140)
        yield d.symbol(x + 14, y - 130, "n")
        for degrees, color in ((-50, d.WARM), (50, d.COOL)):
            end = d.polar(x, y, degrees, 150)
            yield d.line(*(end if degrees < 0 else (x, y)), *((x, y) if degrees < 0 else end), color, 2, True)
            for step in (0.35, 0.6, 0.85):
                px, py = d.polar(x, y, degrees, 150 * step)
                if across:
                    yield d.circle(px, py, 6, "none", color)
                    yield d.circle(px, py, 2, color)
                else:
                    a = d.polar(px, py, degrees + 90, 15)
                    b = d.polar(px, py, degrees - 90, 15)
                    yield d.line(*a, *b, color, 2)
        yield d.text(x, 270, name)


def corner(x, y, u, v):
    """Both arrows from one corner; u and v are (dx, dy)."""
    yield from d.arrow(x, y, x + u[0], y + u[1], "u", d.WARM, 2.4)
    yield from d.arrow(x, y, x + v[0], y + v[1], "v", d.COOL, 2.4)


def globe(x, y, r):
    yield d.circle(x, y, r, d.SAND, d.INK)
    for share in (-0.5, 0, 0.5):
        half = r * math.sqrt(1 - share * share)
        yield (
            f'<ellipse cx="{x}" cy="{y - r * share:.1f}" rx="{half:.1f}" ry="{half * 0.18:.1f}" '
            f'fill="none" stroke="{d.SOFT}"/>'
        )
    yield f'<ellipse cx="{x}" cy="{y}" rx="{r * 0.5}" ry="{r}" fill="none" stroke="{d.SOFT}"/>'
    yield from d.arrow(x, y + r, x, y - r - 6, "v", d.COOL, 2.4)
    yield from d.arrow(x - r, y, x + r + 6, y, "u", d.WARM, 2.4)
    yield d.circle(x, y, 4.5, d.INK)


@d.diagram("uv", 540, 476)
def uv():
    """Where u and v run on each kind of shape."""
    yield f'<path d="M40 150 H150 V60 H40z" fill="{d.SAND}" stroke="{d.SOFT}"/>'
    yield from corner(40, 150, (110, 0), (0, -90))
    yield d.text(96, 190, "rectangle")
    yield f'<path d="M215 150 L325 150 L265 60z" fill="{d.SAND}" stroke="{d.SOFT}"/>'
    yield from corner(215, 150, (110, 0), (50, -90))
    yield d.text(270, 190, "triangle")
    yield from globe(440, 100, 62)
    yield d.text(440, 190, "sphere")
    far, near = (
        ((190, 276), (350, 276), (350, 350), (190, 350)),
        ((90, 224), (450, 224), (450, 440), (90, 440)),
    )
    for first, second, fill in ((3, 0, d.GLASS), (2, 3, d.SAND), (1, 2, d.GLASS)):
        points = (near[first], near[second], far[second], far[first])
        path = " ".join(f"{a},{b}" for a, b in points)
        yield f'<polygon points="{path}" fill="{fill}" stroke="{d.SOFT}"/>'
    yield f'<path d="M190 276 H350 V350 H190z" fill="{d.PAPER}" stroke="{d.SOFT}"/>'
    yield from corner(232, 340, (62, 0), (0, -36))
    yield from corner(112, 390, (40, -26), (0, -72))
    yield from corner(388, 352, (36, 24), (0, -50))
    yield from corner(206, 428, (84, 0), (22, -46))
    yield d.text(270, 466, "planes")


@d.diagram("bilinear", 520, 290)
def bilinear():
    """Four texels, their centers with their weights, and a point between them."""
    x0, y0, size = 24, 20, 125
    colors = ((d.SAND, d.GLASS), (d.GLOW, d.FAINT))
    for row in range(2):
        for column in range(2):
            yield (
                f'<rect x="{x0 + size * column}" y="{y0 + size * row}" width="{size}" height="{size}" '
                f'fill="{colors[row][column]}" stroke="{d.SOFT}"/>'
            )
    left, top = x0 + size / 2, y0 + size / 2
    px, py = left + size * 0.3, top + size * 0.6
    for row in range(2):
        yield d.dashed(left, top + size * row, left + size, top + size * row)
        yield d.dashed(left + size * row, top, left + size * row, top + size)
    yield d.line(px, top, px, top + size, d.WARM, 1.6)
    for place, weight in enumerate(("0.28", "0.12", "0.42", "0.18")):
        row, column = divmod(place, 2)
        x, y = left + size * column, top + size * row
        yield d.circle(x, y, 4)
        yield d.text(x + (14 if column else -14), y + (24 if row else -14), weight, d.WARM)
    yield d.circle(px, py, 5.5, d.WARM)
    yield d.text((left + px) / 2, top + 20, "0.3", d.SOFT)
    yield d.text((left + size + px) / 2, top + 20, "0.7", d.SOFT)
    yield d.dashed(px, py, left + size, py, d.WARM)
    yield d.text(left + size + 8, (top + py) / 2 + 5, "0.6", d.SOFT, "start")
    yield d.text(left + size + 8, (top + size + py) / 2 + 5, "0.4", d.SOFT, "start")
    for place, sum_ in enumerate(
        ("0.7 · 0.4 = 0.28", "0.3 · 0.4 = 0.12", "0.7 · 0.6 = 0.42", "0.3 · 0.6 = 0.18")
    ):
        yield d.text(312, 96 + 30 * place, sum_, d.WARM, "start")


@d.diagram("srgb-curve", 520, 300)
def srgb_curve():
    """What a byte stands for, and what it is taken for."""
    x, y, width, height = 60, 250, 400, 215

    def decoded(b):
        return b / 12.92 if b <= 0.04045 else ((b + 0.055) / 1.055) ** 2.4

    byte = 188 / 255
    at = x + width * byte
    yield d.dashed(x, y, x + width, y - height)
    yield from d.plot(x, y, width, height, [(decoded, d.INK)])
    yield d.dashed(at, y, at, y - height * byte)
    for value, color in ((decoded(byte), d.WARM), (byte, d.SOFT)):
        yield d.dashed(x, y - height * value, at, y - height * value, color)
        yield d.circle(at, y - height * value, 4.5, color)
        yield d.text(x - 8, y - height * value + 5, f"{value:.2f}", color, "end")
    yield d.text(x - 8, y - height + 5, "1", d.SOFT, "end")
    yield d.text(at, y + 22, "188", d.WARM)
    yield d.text(x + width, y + 22, "255", d.SOFT)
    yield d.text(x, y + 22, "0", d.SOFT)
    yield d.text(x + width / 2 - 20, y + 40, "byte in the file")
    yield d.text(x + 10, y - height - 10, "light", anchor="start")


def schlick(degrees):
    return 0.04 + 0.96 * (1 - math.cos(math.radians(degrees))) ** 5


@d.diagram("schlick-curves", 520, 290)
def schlick_curves():
    """Schlick's approximation beside Fresnel's F, from both sides."""
    for x, ratio, name in ((44, 1 / 1.5, "from outside"), (294, 1.5, "from inside")):
        y, width, height = 235, 200, 190
        yield from d.axes(x, y, width, height)
        for function, color, dash in ((lambda a: fresnel(a, ratio)[0], d.INK, ""), (schlick, d.WARM, "6 3")):
            points = [(x + width * a / 360, y - height * function(a / 4)) for a in range(361)]
            yield d.curve(points, color, 2, dash)
        if ratio > 1:
            for value, color in ((fresnel(41, ratio)[0], d.INK), (schlick(41), d.WARM)):
                yield d.circle(x + width * 41 / 90, y - height * value, 4.5, color)
        yield d.text(x + width, y + 20, "90°", d.SOFT)
        yield d.text(x - 6, y + 5, "0", d.SOFT, "end")
        yield d.text(x - 6, y - height + 8, "1", d.SOFT, "end")
        yield d.text(x + width / 2, 26, name)
    yield d.text(294 + 200 * 41 / 90, 255, "41°", d.SOFT)
    yield d.text(200, 282, "F", d.INK)
    yield d.text(290, 282, "Schlick", d.WARM)


def fresnel(degrees, ratio):
    """(F, r_s squared, r_p squared) for eta_o / eta_i = ratio."""
    cos_o = math.cos(math.radians(degrees))
    sine = ratio * ratio * (1 - cos_o * cos_o)
    if sine >= 1:
        return 1, 1, 1
    cos_i = math.sqrt(1 - sine)
    s = (ratio * cos_o - cos_i) / (ratio * cos_o + cos_i)
    p = (cos_o - ratio * cos_i) / (cos_o + ratio * cos_i)
    return (s * s + p * p) / 2, s * s, p * p


@d.diagram("fresnel-curves", 520, 290)
def fresnel_curves():
    for x0, ratio, name, mark in ((44, 1 / 1.5, "from outside", 56.31), (294, 1.5, "from inside", 41.81)):
        y0, width, height = 235, 200, 190
        yield from d.axes(x0, y0, width, height)
        for i, (color, dash) in enumerate(((d.INK, ""), (d.WARM, "6 3"), (d.COOL, "2 3"))):
            yield d.curve(
                [(x0 + width * a / 180, y0 - height * fresnel(a / 2, ratio)[i]) for a in range(181)],
                color,
                2 if not i else 1.6,
                dash,
            )
        at = x0 + width * mark / 90
        yield d.line(at, y0, at, y0 - height, d.SOFT, 1, False, "3 3")
        yield d.text(at, y0 + 18, f"{mark:.1f}°", d.SOFT, size=13)
        if ratio > 1:
            brewster = x0 + width * 33.69 / 90
            yield d.line(brewster, y0, brewster, y0 - height * 0.4, d.SOFT, 1, False, "3 3")
            yield d.text(brewster - 5, y0 - height * 0.4 + 14, "33.7°", d.SOFT, "end", size=13)
        yield d.text(x0 + width, y0 + 18, "90°", d.SOFT, size=13)
        yield d.text(x0 - 6, y0 + 5, "0", d.SOFT, "end", size=13)
        yield d.text(x0 - 6, y0 - height + 8, "1", d.SOFT, "end", size=13)
        yield d.text(x0 + width / 2, 26, name)
    for x, color, name in ((150, d.INK, "F"), (250, d.WARM, "r_s squared"), (380, d.COOL, "r_p squared")):
        yield d.text(x, 280, name, color, size=14)
