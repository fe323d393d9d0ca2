"""What diagrams are drawn with, as SVG."""

import math

from compare.stages import Failure

INK, SOFT, WARM, COOL, GREEN = "#222", "#888", "#b4491a", "#1f5fa8", "#3c7a3c"
DRAWN = {}


def diagram(name, width, height):
    """Registers a function that returns a diagram's shapes."""

    def register(function):
        DRAWN[name] = (function, width, height)
        return function

    return register


def draw(name):
    if name not in DRAWN:
        raise Failure(f"nobody draws '{name}'")
    function, width, height = DRAWN[name]
    return svg(function(), width, height)


def svg(shapes, width, height):
    heads = "".join(
        f'<marker id="{color[1:]}" viewBox="0 0 8 8" refX="7" refY="4" '
        'markerWidth="7" markerHeight="7" orient="auto-start-reverse">'
        f'<path d="M0 0.8 8 4 0 7.2z" fill="{color}"/></marker>'
        for color in (INK, SOFT, WARM, COOL, GREEN)
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" font-family="Georgia, DejaVu Serif, serif" font-size="15" fill="{INK}">'
        f"<defs>{heads}</defs>{''.join(shapes)}</svg>\n"
    )


def line(x1, y1, x2, y2, color=INK, width=1.6, arrow=False, dash=""):
    end = f' marker-end="url(#{color[1:]})"' if arrow else ""
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
    """Words; `w_o` in them becomes an omega with a lower o, and so on."""
    for letter, sign in (("w", "ω"), ("t", "θ"), ("p", "p"), ("e", "η"), ("k", "k"), ("r", "r")):
        for index in "oidsptr":
            words = words.replace(
                f"{letter}_{index}",
                f'{sign}<tspan dy="4" font-size="11">{index}</tspan><tspan dy="-4">​</tspan>',
            )
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" fill="{color}" '
        f'font-size="{size}" text-anchor="{anchor}" '
        f'font-style="{style or "normal"}">{words}</text>'
    )


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
