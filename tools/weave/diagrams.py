"""The figures that are drawn: diagrams, curves, and one chart."""

import math
import random

from tools.weave.drawing import (
    COOL,
    FAINT,
    GLASS,
    GRAY,
    GREEN,
    INK,
    LAMP,
    PAPER,
    RED,
    SAND,
    SOFT,
    WARM,
    arc,
    axes,
    circle,
    curve,
    diagram,
    line,
    polar,
    ray,
    text,
)
from tools.weave.renders import Render


@diagram("hemisphere", 440, 270)
def hemisphere():
    x, y, r = 220, 220, 150
    yield line(30, y, 410, y, INK, 2)
    yield (
        f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" '
        f'fill="#f3e9df" stroke="{SOFT}" stroke-dasharray="4 3"/>'
    )
    for angle in (-72, -50, -12, 20, 62):
        yield line(*polar(x, y, angle, r + 34), *polar(x, y, angle, r + 8), WARM, 1.2, True)
    yield ray(x, y, 0, r + 30, INK)
    yield text(x + 14, y - r - 24, "n", style="italic")
    yield ray(x, y, 42, r, WARM)
    yield text(*polar(x + 12, y - 2, 42, r + 14), "w_i", WARM)
    yield ray(x, y, -34, r, COOL)
    yield text(*polar(x - 10, y - 4, -34, r + 14), "w_o", COOL)
    yield arc(x, y, 0, 42, 52)
    yield text(*polar(x, y + 4, 21, 68), "θ", style="italic")
    yield circle(x, y, 4)
    yield text(x, y + 24, "x", style="italic")
    yield text(x + r + 12, y - 22, "Ω", SOFT)


@diagram("two-densities", 520, 300)
def two_densities():
    drawn = random.Random(1)
    pairs = [(drawn.random(), drawn.random()) for _ in range(400)]
    for x, name, cosine in (
        (130, "uniform in solid angle", False),
        (390, "in proportion to the cosine", True),
    ):
        yield circle(x, 130, 100, SAND, SOFT)
        for u, v in pairs:
            sine = math.sqrt(u) if cosine else math.sqrt(1 - u * u)
            phi = 2 * math.pi * v
            yield circle(x + 100 * sine * math.cos(phi), 130 + 100 * sine * math.sin(phi), 1.7, WARM)
        yield text(x, 262, name)
        share = sum((math.sqrt(1 - u) if cosine else u) > math.cos(math.radians(60)) for u, _ in pairs) / len(
            pairs
        )
        yield text(x, 284, f"{share:.0%} within 60° of the normal", SOFT, size=13)


@diagram("next-event", 520, 300)
def next_event():
    yield f'<path d="M30 30 H490 V270 H30" fill="none" stroke="{INK}" stroke-width="2"/>'
    yield circle(365, 150, 36, GLASS, COOL)
    yield circle(250, 80, 6, LAMP, WARM)
    yield text(250, 62, "light", WARM)
    a = (170, 270)
    yield line(30, 190, a[0], a[1], INK, 2.2, True)
    yield text(40, 182, "camera", SOFT, "start", size=13)
    yield line(*a, 130, 30, INK, 2.2, True)
    yield line(130, 30, 440, 270, INK, 2.2, True, "")
    yield line(*a, 248, 87, GREEN, 1.6, False, "6 4")
    yield line(130, 30, 244, 77, GREEN, 1.6, False, "6 4")
    yield line(440, 270, 354, 184, WARM, 1.6, False, "6 4")
    yield line(354, 184, 256, 87, SOFT, 1, False, "2 4")
    yield text(190, 190, "lit", GREEN, "end")
    yield text(196, 46, "lit", GREEN)
    yield text(408, 222, "in shadow", WARM, "start", size=12)
    for number, (x, y) in enumerate((a, (130, 30), (440, 270)), 1):
        yield circle(x, y, 4.5)
    yield text(a[0], a[1] + 20, "1")
    yield text(130, 22, "2")
    yield text(440, 290, "3")


@diagram("snell", 520, 270)
def snell():
    for x, angle in ((95, 25), (260, 41.81), (425, 60)):
        y = 120
        yield (f'<path d="M{x - 75} {y} H{x + 75} V250 H{x - 75}z" fill="#d9e4ef"/>')
        yield line(x - 75, y, x + 75, y, COOL, 2)
        yield line(x, y - 92, x, y + 108, SOFT, 1, False, "4 4")
        length = min(116, 74 / math.sin(math.radians(angle)))
        yield line(x, y, *polar(x, y, 180 + angle, length), COOL, 2, True)
        sine = 1.5 * math.sin(math.radians(angle))
        yield (
            line(x, y, *polar(x, y, 180 - angle, 100), SOFT, 1.2, True)
            if sine < 1
            else line(x, y, *polar(x, y, 180 - angle, length), WARM, 2.2, True)
        )
        if sine < 1.0005:
            out = math.degrees(math.asin(min(sine, 1)))
            yield ray(x, y, out if out < 89 else 90, 80, WARM)
            yield text(
                *polar(x + 6, y - 10 if out > 89 else y, min(out, 84), 64 if out > 89 else 88), "w_t", WARM
            )
        else:
            yield text(x + 36, y - 40, "none", WARM)
        yield text(*polar(x - 12, y - 6, 180 + angle, length - 34), "w_o", COOL)
        yield text(x, 24, f"{angle:.1f}°")
        yield circle(x, y, 3)
    yield text(12, 112, "air, η = 1", SOFT, "start", size=12)
    yield text(22, 264, "glass, η = 1.5", SOFT, "start", size=12)


def bar(y, parts, end):
    x = 30
    for name, share, color in parts:
        width = 440 * share
        yield (f'<rect x="{x:.1f}" y="{y}" width="{width:.1f}" height="40" fill="{color}" stroke="{PAPER}"/>')
        yield text(x + width / 2, y + 25, name, PAPER, size=13)
        x += width
    yield line(30 + 440 * end, y - 8, 30 + 440 * end, y + 44, INK, 1.5)


def events(y, last="absorbed"):
    yield from bar(
        y,
        (
            ("diffuse p_d", 0.33, WARM),
            ("specular p_s", 0.23, COOL),
            ("refraction p_t", 0.25, GREEN),
            (last, 0.19, GRAY),
        ),
        1,
    )
    yield text(30, y + 64, "0", anchor="middle")
    yield text(470, y + 64, "1", anchor="middle")


def overfull(y):
    scale = 1 / 1.8
    yield from bar(y, (("red k_d: 0.9", 0.9 * scale, RED), ("green k_s: 0.9", 0.9 * scale, GREEN)), scale)
    yield text(30, y + 60, "0")
    yield text(30 + 440 * scale, y + 60, "1: ξ never comes here", anchor="start", size=14)
    yield text(470, y - 10, "1.8", SOFT)


def random_number(y, xi=0.52):
    yield line(30 + 440 * xi, y - 30, 30 + 440 * xi, y - 2, INK, 2, True)
    yield text(30 + 440 * xi, y - 34, f"ξ = {xi}", size=13)


@diagram("events", 500, 120)
def event_bar_alone():
    yield from events(50)
    yield from random_number(50, 0.88)


@diagram("events-open", 500, 80)
def event_bar_open():
    yield from events(12, "?")


@diagram("overfull-bar", 500, 90)
def overfull_bar():
    yield from overfull(25)


@diagram("ray-counts", 560, 340)
def ray_counts():
    bounds = range(1, 11)
    x0, y0, dx, dy = 70, 290, 46, 68
    yield from axes(x0, y0, 480, 270)
    for power in range(4):
        y = y0 - dy * power
        yield line(x0, y, x0 + 480, y, FAINT, 1)
        yield text(x0 - 10, y + 5, f"{10**power:,}", SOFT, "end", size=13)
    lines = ((3, WARM, "stage 3: every lobe", 6, -14), (4, COOL, "stage 4: one at random", 9, 26))
    for stage, color, name, at, below in lines:
        points = []
        for bound in bounds:
            options = (f"--size 16x16 --spp 16 --max-bounces {bound}").split()
            count = Render(stage, "scenes/plastic.toml", options).rays_per_sample()
            points.append((x0 + dx * bound, y0 - dy * math.log10(count)))
        yield curve(points, color, 2.2)
        for px, py in points:
            yield circle(px, py, 3.5, color)
        yield text(points[at][0] - 12, points[at][1] + below, name, color, "end")
    for bound in bounds:
        yield text(x0 + dx * bound, y0 + 20, str(bound), SOFT, size=13)
    yield text(x0 + 240, y0 + 42, "bounces at most", size=14)
    yield text(x0 + 4, y0 - 272, "rays per sample", anchor="start", size=14)


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


@diagram("fresnel-curves", 520, 290)
def fresnel_curves():
    for x0, ratio, name, mark in ((44, 1 / 1.5, "from outside", 56.31), (294, 1.5, "from inside", 41.81)):
        y0, width, height = 235, 200, 190
        yield from axes(x0, y0, width, height)
        for i, (color, dash) in enumerate(((INK, ""), (WARM, "6 3"), (COOL, "2 3"))):
            yield curve(
                [(x0 + width * a / 180, y0 - height * fresnel(a / 2, ratio)[i]) for a in range(181)],
                color,
                2 if not i else 1.6,
                dash,
            )
        at = x0 + width * mark / 90
        yield line(at, y0, at, y0 - height, SOFT, 1, False, "3 3")
        yield text(at, y0 + 18, f"{mark:.1f}°", SOFT, size=13)
        if ratio > 1:
            brewster = x0 + width * 33.69 / 90
            yield line(brewster, y0, brewster, y0 - height * 0.4, SOFT, 1, False, "3 3")
            yield text(brewster - 5, y0 - height * 0.4 + 14, "33.7°", SOFT, "end", size=13)
        yield text(x0 + width, y0 + 18, "90°", SOFT, size=13)
        yield text(x0 - 6, y0 + 5, "0", SOFT, "end", size=13)
        yield text(x0 - 6, y0 - height + 8, "1", SOFT, "end", size=13)
        yield text(x0 + width / 2, 26, name)
    for x, color, name in ((150, INK, "F"), (250, WARM, "r_s squared"), (380, COOL, "r_p squared")):
        yield text(x, 280, name, color, size=14)
