"""Functions that draw diagrams as SVG: a chapter's drawings.py calls it `d`.

Angles are in degrees from straight up, to the right if positive. Use only the
colors named here, since each has its counterpart for dark pages. Labels are
never smaller than the text of a page: smaller sizes are raised.
"""

import math
import re

from tools.tree import Failure
from tools.weave.fonts import SERIF

INK, SOFT, PAPER = "#222", "#606060", "#fff"
WARM, COOL, GREEN, RED, LAMP, GRAY = "#a54118", "#1f5fa8", "#2f6f2f", "#a82c2c", "#e8b400", "#444"
# Fills: text in the colors above has a contrast of 4.5 to 1 on them.
SAND, GLASS, GLOW, FAINT = "#f3e9df", "#d9e4ef", "#fdf0c8", "#ddd"
ON_DARK = {
    INK: "#dddddd",
    SOFT: "#a8a8a8",
    PAPER: "#131416",
    WARM: "#f0a878",
    COOL: "#82b4ee",
    GREEN: "#86c586",
    RED: "#ec8a8a",
    LAMP: "#f0c83c",
    GRAY: "#b4b4b4",
    SAND: "#33291f",
    GLASS: "#1d2e40",
    GLOW: "#453b14",
    FAINT: "#383838",
}
# The width of a drawing on a page, and the height of the page's text.
SHOWN, TEXT = 541, 16
GREEK = {"w": "ω", "t": "θ", "e": "η"}
DRAWN = {}


def diagram(name, width, height):
    """Registers a function that returns a diagram's shapes."""

    def register(function):
        DRAWN[name] = (function, width, height)
        return function

    return register


def draw(name):
    """The drawings for light and for dark pages."""
    if name not in DRAWN:
        raise Failure(f"no drawings.py draws '{name}'")
    function, width, height = DRAWN[name]
    light = svg(function(), width, height)
    return light, darkened(light, name)


def darkened(light, name):
    def other(match):
        if match[0] not in ON_DARK:
            raise Failure(f"drawing '{name}': {match[0]} has no color on dark pages; use one of drawing.py")
        return ON_DARK[match[0]]

    return re.sub(r"#[0-9a-fA-F]{3,8}\b", other, light)


def svg(shapes, width, height):
    heads = "".join(
        f'<marker id="to-{color[1:]}" viewBox="0 0 8 8" refX="7" refY="4" '
        'markerWidth="7" markerHeight="7" orient="auto-start-reverse">'
        f'<path d="M0 0.8 8 4 0 7.2z" fill="{color}"/></marker>'
        for color in (INK, SOFT, WARM, COOL, GREEN)
    )
    smallest = math.ceil(10 * TEXT * width / SHOWN) / 10
    drawn = re.sub(
        r'(<text [^>]*font-size=")([\d.]+)',
        lambda match: match[1] + f"{max(float(match[2]), smallest):g}",
        "".join(shapes),
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" font-family="{SERIF}" font-size="15" fill="{INK}">'
        f"<defs>{heads}</defs>{drawn}</svg>\n"
    )


def line(x1, y1, x2, y2, color=INK, width=1.6, arrow=False, dash=""):
    end = f' marker-end="url(#to-{color[1:]})"' if arrow else ""
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return (
        f'<path d="M{x1:.1f} {y1:.1f} L{x2:.1f} {y2:.1f}" fill="none" '
        f'stroke="{color}" stroke-width="{width}"{dashes}{end}/>'
    )


def curve(points, color=INK, width=1.8, dash=""):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"{dashes}/>'


def text(x, y, words, color=INK, anchor="middle", style="", size=15):
    """Words; `w_o` in them becomes an omega with the subscript o, and so on: w, t
    and e are omega, theta and eta, other letters stay. An index is one letter, or
    max."""
    words = re.sub(
        r"\b([A-Za-z])_(max|[A-Za-z0-9])",
        lambda m: (
            f'{GREEK.get(m[1], m[1])}<tspan dy="0.36em" font-size="73%">{m[2]}</tspan>'
            '<tspan dy="-0.27em">\u200b</tspan>'
        ),
        words,
    )
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" fill="{color}" '
        f'font-size="{size}" text-anchor="{anchor}" '
        f'font-style="{style or "normal"}">{words}</text>'
    )


def symbol(x, y, words, color=INK, anchor="middle", size=17):
    """A formula's letters, in italics: `n`, `w_o`, `θ`."""
    return text(x, y, words, color, anchor, "italic", size)


def circle(x, y, r, fill=INK, stroke="none"):
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" fill="{fill}" stroke="{stroke}"/>'


def polar(x, y, degrees, r):
    """A point at an angle from straight up, to the right if positive."""
    a = math.radians(degrees)
    return x + r * math.sin(a), y - r * math.cos(a)


def arc(x, y, first, last, r, color=INK):
    steps = [first + (last - first) * i / 24 for i in range(25)]
    return curve([polar(x, y, a, r) for a in steps], color, 1.2)


def ray(x, y, degrees, r, color, width=2):
    return line(x, y, *polar(x, y, degrees, r), color, width, True)


def axes(x, y, width, height):
    yield line(x, y, x + width, y, INK, 1.4)
    yield line(x, y, x, y - height, INK, 1.4)


def arrow(x1, y1, x2, y2, label="", color=INK, width=2, gap=14):
    """An arrow with its symbol beyond the tip."""
    yield line(x1, y1, x2, y2, color, width, True)
    length = math.hypot(x2 - x1, y2 - y1)
    if label:
        yield symbol(x2 + gap * (x2 - x1) / length, y2 + gap * (y2 - y1) / length + 5, label, color)


def angle(x, y, first, last, r, label, color=INK):
    """An arc between two directions, with its symbol outside."""
    yield arc(x, y, first, last, r, color)
    px, py = polar(x, y, (first + last) / 2, r + 14)
    yield symbol(px, py + 5, label, color)


def dashed(x1, y1, x2, y2, color=SOFT, width=1.2):
    return line(x1, y1, x2, y2, color, width, False, "5 4")


def hatched(x1, y1, x2, y2, color=INK, depth=9, step=10):
    """A surface, hatched on the right of the direction from 1 to 2; so draw a
    floor from left to right."""
    yield line(x1, y1, x2, y2, color, 2.2)
    length = math.hypot(x2 - x1, y2 - y1)
    ux, uy = (x2 - x1) / length, (y2 - y1) / length
    for i in range(1, int(length / step) + 1):
        px, py = x1 + i * step * ux, y1 + i * step * uy
        yield line(px, py, px - depth * (ux + uy), py + depth * (ux - uy), SOFT, 1)


def plot(x, y, width, height, functions, first=0, last=1, top=1):
    """Axes with a curve for each (function, color) over [first, last]; `top`
    is the value at the upper end, and x, y the corner of the axes."""
    yield from axes(x, y, width, height)
    for function, color in functions:
        values = [(i / 80, function(first + (last - first) * i / 80)) for i in range(81)]
        yield curve([(x + width * u, y - height * value / top) for u, value in values], color, 2.2)


def dots(points, color=WARM, r=1.8):
    """Samples, scattered."""
    for x, y in points:
        yield circle(x, y, r, color)


def boxes(x, y, rows, widths, height=34, fills=()):
    """A small table: rows of words, in columns of these widths. `fills` are
    (row, column, color); the first row is its head."""
    chosen = {(row, column): color for row, column, color in fills}
    for i, row in enumerate(rows):
        left = x
        for j, (words, width) in enumerate(zip(row, widths)):
            fill = chosen.get((i, j), PAPER if i else SAND)
            yield (
                f'<rect x="{left:.1f}" y="{y + i * height:.1f}" width="{width}" height="{height}" '
                f'fill="{fill}" stroke="{SOFT}"/>'
            )
            yield text(left + width / 2, y + i * height + height / 2 + 5, words)
            left += width


def tree(x, y, width, node, step=64, color=INK):
    """A tree with its root at the top: node is (label, [nodes]). A child's width is
    proportional to its leaves."""
    label, children = node
    total = leaves(node)
    left = x - width / 2
    for child in children:
        share = width * leaves(child) / total
        yield line(x, y, left + share / 2, y + step, SOFT, 1.4)
        yield from tree(left + share / 2, y + step, share, child, step, color)
        left += share
    yield circle(x, y, 13, PAPER, color)
    yield symbol(x, y + 5, label, color, size=15)


def leaves(node):
    return sum(map(leaves, node[1])) or 1
