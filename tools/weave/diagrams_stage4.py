"""Diagrams of chapter 4: lots, the bar of events, and what they buy."""

import math
import tomllib
from pathlib import Path

from tools.weave.diagrams import bar, events, random_number
from tools.weave.drawing import (
    COOL,
    GLASS,
    GRAY,
    GREEN,
    INK,
    PAPER,
    RED,
    SAND,
    SOFT,
    WARM,
    arrow,
    boxes,
    circle,
    curve,
    dashed,
    diagram,
    hatched,
    line,
    plot,
    polar,
    text,
)

EQUAL_TIME = Path(__file__).with_name("equal_time.toml")


def lot(x, width, height, name, label, fill, color):
    """An outcome: as wide as its probability, as high as its result."""
    y = 200
    if height:
        yield (
            f'<rect x="{x:.1f}" y="{y - height}" width="{width:.1f}" height="{height}" '
            f'fill="{fill}" stroke="{color}"/>'
        )
        yield text(x + width / 2, y - height / 2 + 6, name, color, style="italic", size=18)
    yield text(x + width / 2, y - height - 8, label, color)


@diagram("mean-is-area", 520, 260)
def mean_is_area():
    """Two lots, drawn so that areas are means."""
    for x, title, second, height, label in (
        (30, "A or B", "B", 75, "B / (1 − p)"),
        (295, "A or nothing", "", 0, "0"),
    ):
        yield from lot(x, 80, 120, "A", "A / p", SAND, WARM)
        yield from lot(x + 80, 120, height, second, label, GLASS, COOL)
        yield line(x, 200, x + 200, 200, INK, 1.6)
        for at in (x, x + 80, x + 200):
            yield line(at, 200, at, 206, INK, 1.4)
        yield text(x + 40, 222, "p", style="italic")
        yield text(x + 140, 222, "1 − p", style="italic")
        yield text(x + 100, 24, title)
        yield text(x + 100, 252, "area: A + B" if second else "area: A", SOFT)


@diagram("event-bar", 500, 120)
def event_bar():
    yield from events(50)
    yield from random_number(50)


@diagram("same-ratios", 520, 250)
def same_ratios():
    """Probabilities in one ratio: what the constant decides."""
    for y, factor, weight in ((26, 4 / 3, "0.75"), (104, 1, "1"), (182, 0.5, "2")):
        x = 16
        for name, share, color in (("p_d", 0.5, WARM), ("p_s", 0.25, COOL), ("", 1 - 0.75 * factor, GRAY)):
            width = 350 * (factor * share if name else share)
            if width < 1:
                continue
            yield (
                f'<rect x="{x:.1f}" y="{y}" width="{width:.1f}" height="38" fill="{color}" stroke="{PAPER}"/>'
            )
            yield text(x + width / 2, y + 24, name or "absorbed", PAPER)
            x += width
        yield text(
            376, y + 16, f"p = {factor:.3g} k" if factor != 1 else "p = k", anchor="start", style="italic"
        )
        yield text(376, y + 36, f"weights of {weight}", anchor="start")
    yield text(16, 242, "k_d = 0.5 and k_s = 0.25", SOFT, "start")


@diagram("overfull", 520, 260)
def overfull_and_scaled():
    """The bar of red paint under a green mirror, as it is and scaled."""
    one = 440 / 1.8
    full = (("diffuse: 0.9", 0.5, RED), ("specular: 0.9", 0.5, GREEN))
    yield from bar(34, full, 1 / 1.8)
    yield text(30 + one - 12, 20, "0.1", GREEN)
    yield line(30 + 220, 26, 30 + one, 26, GREEN, 3)
    yield text(30, 96, "0")
    yield text(30 + one, 96, "1")
    yield text(470, 96, "1.8", SOFT)
    yield text(286, 118, "specular comes with 0.1, divided by 0.9", anchor="middle")
    halves = (("diffuse: 0.5", 0.5 / 1.8, RED), ("specular: 0.5", 0.5 / 1.8, GREEN))
    yield from bar(156, halves, 1 / 1.8)
    yield text(30, 218, "0")
    yield text(30 + one, 218, "1")
    yield text(30 + one + 20, 181, "both times 1 / 1.8", anchor="start")
    yield text(286, 246, "specular comes with 0.5, divided by 0.5", anchor="middle")


@diagram("rest-of-the-number", 520, 240)
def rest_of_the_number():
    """The piece of the bar that was hit, stretched to a bar of its own."""
    yield from bar(40, (("diffuse", 0.4, WARM), ("specular", 0.3, COOL), ("absorbed", 0.3, GRAY)), 1)
    end = 30 + 440 * 0.4
    at = 30 + 440 * 0.4 * 0.7
    yield line(at, 12, at, 38, INK, 2, True)
    yield text(at + 10, 22, "ξ", anchor="start", style="italic", size=17)
    yield dashed(30, 82, 30, 150)
    yield dashed(end, 82, 470, 150)
    yield text(end, 30, "p_d", style="italic")
    yield f'<rect x="30" y="152" width="440" height="34" fill="{SAND}" stroke="{WARM}"/>'
    below = 30 + 440 * 0.7
    yield line(at, 84, below, 150, INK, 2, True)
    yield text(below + 14, 174, "ξ / p_d", anchor="start", style="italic")
    yield circle(below, 169, 4)
    yield text(30, 208, "0")
    yield text(470, 208, "1")
    yield text(250, 232, "uniform again", SOFT)


@diagram("trapped", 520, 290)
def trapped():
    """A path in a ball beyond the critical angle, and what ends it."""
    x, y, r = 125, 120, 100
    yield circle(x, y, r, GLASS, COOL)
    points = [polar(x, y, -20 + 75 * i, r) for i in range(13)]
    yield curve(points, WARM, 1.6)
    yield line(*points[0], *points[1], WARM, 2.2, True)
    yield text(x, 246, "52.5° at every turn,")
    yield text(x, 268, "beyond 41.8°")

    def left(bounce):
        return 1 if bounce <= 16 else 0.95 ** (bounce - 16)

    yield from plot(290, 220, 210, 170, [(left, COOL)], 0, 100)
    yield text(395, 20, "paths that still go on")
    yield text(283, 56, "1", SOFT, "end")
    yield text(283, 225, "0", SOFT, "end")
    for bounce in (16, 50, 100):
        at = 290 + 2.1 * bounce
        yield line(at, 220, at, 225, INK, 1.2)
        yield text(at, 244, str(bounce), SOFT)
    yield text(395, 268, "bounces")


@diagram("both-lobes", 520, 260)
def both_lobes():
    """A lamp that is asked for one lobe, and hit by the other."""
    x, y = 230, 200
    yield from hatched(60, y, 430, y)
    yield line(190, 40, 430, 40, WARM, 6)
    yield text(310, 26, "lamp", WARM)
    mirrored = 40.0
    hit = x + 160 * math.tan(math.radians(mirrored)), 44
    yield from arrow(x, y, *polar(x, y, -mirrored, 112), "w_o", COOL)
    yield line(x, y, *hit, WARM, 2.2, True)
    yield line(x, y, 222, 46, GREEN, 2, True, "6 4")
    yield text(212, 82, "asked, by k_d / π", GREEN, "end")
    yield text(330, 128, "hit, by k_s", WARM, "start")
    yield circle(x, y, 4)
    yield text(x, 236, "plastic", SOFT)


@diagram("equal-time", 540, 244)
def equal_time():
    """The table that tools/bench/equal_time.py has measured."""
    rows = [("bounces", "rays, 3", "rays, 4", "time", "variance", "gain", "light cut")]
    fills = []
    for number, row in enumerate(tomllib.loads(EQUAL_TIME.read_text())["row"], 1):
        time = row["microseconds3"] / row["microseconds4"]
        noise = row["variance4"] / row["variance3"]
        rows.append(
            (
                str(row["bounces"]),
                f"{row['rays3']:.0f}",
                f"{row['rays4']:.1f}",
                one_digit(time),
                one_digit(noise),
                one_digit(row["times"]),
                f"{row['missing']:.0%}",
            )
        )
        fills.append((number, 5, SAND if row["times"] > 1 else GLASS))
    yield from boxes(4, 4, rows, (76, 70, 70, 70, 84, 72, 90), 39, fills)


def one_digit(x):
    """A measured ratio, as precise as it is."""
    return f"{x:.1g}" if x < 10 else f"{round(x, 1 - len(str(int(x)))):.0f}"
