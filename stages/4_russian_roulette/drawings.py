"""Drawings of chapter 4 and its deck."""

import math
import tomllib

from tools.tree import ROOT
from tools.weave import drawing as d
from tools.weave import measured
from tools.weave.renders import Render


def lot(x, width, height, name, label, fill, color):
    """An outcome: as wide as its probability, as high as its result."""
    y = 200
    if height:
        yield (
            f'<rect x="{x:.1f}" y="{y - height}" width="{width:.1f}" height="{height}" '
            f'fill="{fill}" stroke="{color}"/>'
        )
        yield d.text(x + width / 2, y - height / 2 + 6, name, color, style="italic", size=18)
    yield d.text(x + width / 2, y - height - 8, label, color)


@d.diagram("mean-is-area", 520, 260)
def mean_is_area():
    """Two random choices, drawn so that areas are means."""
    for x, title, second, height, label in (
        (30, "A or B", "B", 75, "B / (1 − p)"),
        (295, "A or nothing", "", 0, "0"),
    ):
        yield from lot(x, 80, 120, "A", "A / p", d.SAND, d.WARM)
        yield from lot(x + 80, 120, height, second, label, d.GLASS, d.COOL)
        yield d.line(x, 200, x + 200, 200, d.INK, 1.6)
        for at in (x, x + 80, x + 200):
            yield d.line(at, 200, at, 206, d.INK, 1.4)
        yield d.text(x + 40, 222, "p", style="italic")
        yield d.text(x + 140, 222, "1 − p", style="italic")
        yield d.text(x + 100, 24, title)
        yield d.text(x + 100, 252, "area: A + B" if second else "area: A", d.SOFT)


@d.diagram("event-bar", 500, 120)
def event_bar():
    yield from events(50)
    yield from random_number(50)


@d.diagram("same-ratios", 520, 250)
def same_ratios():
    """Probabilities in one ratio: what the constant decides."""
    for y, factor, weight in ((26, 4 / 3, "0.75"), (104, 1, "1"), (182, 0.5, "2")):
        x = 16
        for name, share, color in (
            ("p_d", 0.5, d.WARM),
            ("p_s", 0.25, d.COOL),
            ("", 1 - 0.75 * factor, d.GRAY),
        ):
            width = 350 * (factor * share if name else share)
            if width < 1:
                continue
            yield (
                f'<rect x="{x:.1f}" y="{y}" width="{width:.1f}" height="38" fill="{color}" stroke="{d.PAPER}"/>'
            )
            yield d.text(x + width / 2, y + 24, name or "absorbed", d.PAPER)
            x += width
        yield d.text(
            376, y + 16, f"p = {factor:.3g} k" if factor != 1 else "p = k", anchor="start", style="italic"
        )
        yield d.text(376, y + 36, f"weights of {weight}", anchor="start")
    yield d.text(16, 237, "k_d = 0.5 and k_s = 0.25", d.SOFT, "start")


@d.diagram("overfull", 520, 260)
def overfull_and_scaled():
    """The bar of red paint under a green mirror, as it is and scaled."""
    one = 440 / 1.8
    full = (("diffuse: 0.9", 0.5, d.RED), ("specular: 0.9", 0.5, d.GREEN))
    yield from bar(34, full, 1 / 1.8)
    yield d.text(30 + one - 12, 20, "0.1", d.GREEN)
    yield d.line(30 + 220, 26, 30 + one, 26, d.GREEN, 3)
    yield d.text(30, 96, "0")
    yield d.text(30 + one, 96, "1")
    yield d.text(470, 96, "1.8", d.SOFT)
    yield d.text(286, 118, "specular comes with 0.1, divided by 0.9", anchor="middle")
    halves = (("diffuse: 0.5", 0.5 / 1.8, d.RED), ("specular: 0.5", 0.5 / 1.8, d.GREEN))
    yield from bar(156, halves, 1 / 1.8)
    yield d.text(30, 218, "0")
    yield d.text(30 + one, 218, "1")
    yield d.text(30 + one + 20, 181, "both times 1 / 1.8", anchor="start")
    yield d.text(286, 246, "specular comes with 0.5, divided by 0.5", anchor="middle")


@d.diagram("rest-of-the-number", 520, 240)
def rest_of_the_number():
    """The piece of the bar that was hit, stretched to a bar of its own."""
    yield from bar(40, (("diffuse", 0.4, d.WARM), ("specular", 0.3, d.COOL), ("absorbed", 0.3, d.GRAY)), 1)
    end = 30 + 440 * 0.4
    at = 30 + 440 * 0.4 * 0.7
    yield d.line(at, 12, at, 38, d.INK, 2, True)
    yield d.text(at + 10, 22, "ξ", anchor="start", style="italic", size=17)
    yield d.dashed(30, 82, 30, 150)
    yield d.dashed(end, 82, 470, 150)
    yield d.text(end, 30, "p_d", style="italic")
    yield f'<rect x="30" y="152" width="440" height="34" fill="{d.SAND}" stroke="{d.WARM}"/>'
    below = 30 + 440 * 0.7
    yield d.line(at, 84, below, 150, d.INK, 2, True)
    yield d.text(below + 14, 174, "ξ / p_d", anchor="start", style="italic")
    yield d.circle(below, 169, 4)
    yield d.text(30, 208, "0")
    yield d.text(470, 208, "1")
    yield d.text(250, 232, "uniform again", d.SOFT)


@d.diagram("trapped", 520, 290)
def trapped():
    """A path in a ball beyond the critical angle, and what ends it."""
    x, y, r = 125, 120, 100
    yield d.circle(x, y, r, d.GLASS, d.COOL)
    points = [d.polar(x, y, -20 + 75 * i, r) for i in range(13)]
    yield d.curve(points, d.WARM, 1.6)
    yield d.line(*points[0], *points[1], d.WARM, 2.2, True)
    yield d.text(x, 246, "52.5° at every turn,")
    yield d.text(x, 268, "beyond 41.8°")

    def left(bounce):
        return 1 if bounce <= 16 else 0.95 ** (bounce - 16)

    yield from d.plot(290, 220, 210, 170, [(left, d.COOL)], 0, 100)
    yield d.text(395, 20, "paths that still go on")
    yield d.text(283, 56, "1", d.SOFT, "end")
    yield d.text(283, 225, "0", d.SOFT, "end")
    for bounce in (16, 50, 100):
        at = 290 + 2.1 * bounce
        yield d.line(at, 220, at, 225, d.INK, 1.2)
        yield d.text(at, 244, str(bounce), d.SOFT)
    yield d.text(395, 268, "bounces")


@d.diagram("both-lobes", 520, 260)
def both_lobes():
    """A lamp that is asked for one lobe, and hit by the other."""
    x, y = 230, 200
    yield from d.hatched(60, y, 430, y)
    yield d.line(190, 40, 430, 40, d.WARM, 6)
    yield d.text(310, 26, "lamp", d.WARM)
    mirrored = 40.0
    hit = x + 160 * math.tan(math.radians(mirrored)), 44
    yield from d.arrow(x, y, *d.polar(x, y, -mirrored, 112), "w_o", d.COOL)
    yield d.line(x, y, *hit, d.WARM, 2.2, True)
    yield d.line(x, y, 222, 46, d.GREEN, 2, True, "6 4")
    yield d.text(212, 82, "asked, by k_d / π", d.GREEN, "end")
    yield d.text(330, 128, "hit, by k_s", d.WARM, "start")
    yield d.circle(x, y, 4)
    yield d.text(x, 236, "plastic", d.SOFT)


@d.diagram("equal-time", 540, 244)
def equal_time():
    """The table that tools/bench/equal_time.py has measured."""
    rows = [("bounces", "rays, 3", "rays, 4", "time", "variance", "gain", "light cut")]
    fills = []
    for number, row in enumerate(tomllib.loads(measured.stored("equal_time.toml"))["row"], 1):
        time = row["microseconds3"] / row["microseconds4"]
        noise = row["variance4"] / row["variance3"]
        rows.append(
            (
                str(row["bounces"]),
                f"{row['rays3']:.0f}",
                f"{row['rays4']:.1f}",
                measured.two_digits(time),
                measured.two_digits(noise),
                measured.two_digits(row["times"]),
                f"{row['missing']:.0%}",
            )
        )
        fills.append((number, 5, d.SAND if row["times"] > 1 else d.GLASS))
    yield from d.boxes(4, 4, rows, (76, 70, 70, 70, 84, 72, 90), 39, fills)


def bar(y, parts, end):
    x = 30
    for name, share, color in parts:
        width = 440 * share
        yield (
            f'<rect x="{x:.1f}" y="{y}" width="{width:.1f}" height="40" fill="{color}" stroke="{d.PAPER}"/>'
        )
        yield d.text(x + width / 2, y + 25, name, d.PAPER, size=13)
        x += width
    yield d.line(30 + 440 * end, y - 8, 30 + 440 * end, y + 44, d.INK, 1.5)


def events(y, last="absorbed"):
    yield from bar(
        y,
        (
            ("diffuse p_d", 0.33, d.WARM),
            ("specular p_s", 0.23, d.COOL),
            ("refraction p_t", 0.25, d.GREEN),
            (last, 0.19, d.GRAY),
        ),
        1,
    )
    yield d.text(30, y + 64, "0", anchor="middle")
    yield d.text(470, y + 64, "1", anchor="middle")


def overfull(y):
    scale = 1 / 1.8
    yield from bar(y, (("red k_d: 0.9", 0.9 * scale, d.RED), ("green k_s: 0.9", 0.9 * scale, d.GREEN)), scale)
    yield d.text(30, y + 60, "0")
    yield d.text(30 + 440 * scale, y + 60, "1: ξ never comes here", anchor="start", size=14)
    yield d.text(470, y - 10, "1.8", d.SOFT)


def random_number(y, xi=0.52):
    yield d.line(30 + 440 * xi, y - 30, 30 + 440 * xi, y - 2, d.INK, 2, True)
    yield d.text(30 + 440 * xi, y - 34, f"ξ = {xi}", size=13)


@d.diagram("events", 500, 120)
def event_bar_alone():
    yield from events(50)
    yield from random_number(50, 0.88)


@d.diagram("events-open", 500, 80)
def event_bar_open():
    yield from events(12, "?")


@d.diagram("overfull-bar", 500, 90)
def overfull_bar():
    yield from overfull(25)


@d.diagram("ray-counts", 560, 340)
def ray_counts():
    bounds = range(1, 11)
    x0, y0, dx, dy = 70, 290, 46, 68
    yield from d.axes(x0, y0, 480, 270)
    for power in range(4):
        y = y0 - dy * power
        yield d.line(x0, y, x0 + 480, y, d.FAINT, 1)
        yield d.text(x0 - 10, y + 5, f"{10**power:,}", d.SOFT, "end", size=13)
    lines = ((3, d.WARM, "stage 3: every lobe", 6, -14), (4, d.COOL, "stage 4: one at random", 9, 26))
    for stage, color, name, at, below in lines:
        points = []
        for bound in bounds:
            options = (f"--size 16x16 --spp 16 --max-bounces {bound}").split()
            count = Render(stage, "scenes/plastic.toml", options).rays_per_sample()
            points.append((x0 + dx * bound, y0 - dy * math.log10(count)))
        yield d.curve(points, color, 2.2)
        for px, py in points:
            yield d.circle(px, py, 3.5, color)
        yield d.text(points[at][0] - 12, points[at][1] + below, name, color, "end")
    for bound in bounds:
        yield d.text(x0 + dx * bound, y0 + 20, str(bound), d.SOFT, size=13)
    yield d.text(x0 + 240, y0 + 42, "bounces at most", size=14)
    yield d.text(x0 + 4, y0 - 272, "rays per sample", anchor="start", size=14)


def tree(x, y, angle, length, depth):
    """Branches of a path: two at every end."""
    end = d.polar(x, y, angle, length)
    yield d.line(x, y, *end, d.WARM, 0.7 + depth * 0.35)
    if depth:
        spread = 9 + 7 * depth
        for side in (-spread, spread):
            yield from tree(*end, angle + side, length * 0.8, depth - 1)
    else:
        yield d.circle(*end, 2, d.WARM)


@d.diagram("branching", 600, 300)
def branching():
    yield from tree(150, 262, 0, 56, 5)
    yield d.text(150, 288, "every lobe: 2, 4, 8, 16, 32")
    x, y = 450, 262
    for angle, length in ((0, 56), (30, 45), (-14, 38), (16, 32), (-30, 27), (8, 24)):
        end = d.polar(x, y, angle, length)
        yield d.line(x, y, *end, d.COOL, 2.2)
        x, y = end
        yield d.circle(x, y, 3, d.COOL)
    yield d.text(450, 288, "one at random: 1, 1, 1, 1, 1")


@d.diagram("events-two", 500, 120)
def two_events():
    """The course's bar of plastic, before anything is absorbed."""
    yield from bar(50, (("diffuse p_d", 0.6, d.WARM), ("specular p_s", 0.4, d.COOL)), 1)
    at = 30 + 440 * 0.72
    yield d.line(at, 20, at, 48, d.INK, 2, True)
    yield d.text(at, 16, "ξ = 0.72")
    for x, words in ((30, "0"), (30 + 440 * 0.6, "p_d"), (470, "1")):
        yield d.text(x, 114, words)


def branches(x, y, width, depth, step=62):
    """Each hit with its two children, as pairs of points."""
    if depth:
        for side in (-1, 1):
            end = x + side * width / 4, y + step
            yield (x, y), end
            yield from branches(*end, width / 2, depth - 1, step)


@d.diagram("one-of-the-tree", 520, 300)
def one_of_the_tree():
    """The tree of both lobes, and the one path of it that is drawn."""
    for start, end in branches(260, 30, 470, 4):
        yield d.line(*start, *end, d.SOFT, 1.2)
        yield d.circle(*end, 4, d.SOFT)
    x, y, width = 260, 30, 470
    yield d.circle(x, y, 6, d.COOL)
    for side in (1, -1, 1, -1):
        end = x + side * width / 4, y + 62
        yield d.line(x, y, *end, d.COOL, 3)
        yield d.circle(*end, 6, d.COOL)
        (x, y), width = end, width / 2
    yield d.text(20, 34, "camera", d.SOFT, "start")
    yield d.dashed(100, 30, 250, 30)
