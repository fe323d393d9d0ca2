"""Drawings outside the chapters: the recap's, and the lab's box."""

import math
import random
import tomllib

from tools.tree import ROOT
from tools.weave import drawing as d
from tools.weave import measured

BOX = "scenes/cornell_box_point.toml"
OPENING = -1  # the box is open toward -z; it is drawn up to here


@d.diagram("two-densities", 520, 300)
def two_densities():
    drawn = random.Random(1)
    pairs = [(drawn.random(), drawn.random()) for _ in range(400)]
    for x, name, cosine in (
        (130, "uniform in solid angle", False),
        (390, "in proportion to the cosine", True),
    ):
        yield d.circle(x, 130, 100, d.SAND, d.SOFT)
        for u, v in pairs:
            sine = math.sqrt(u) if cosine else math.sqrt(1 - u * u)
            phi = 2 * math.pi * v
            yield d.circle(x + 100 * sine * math.cos(phi), 130 + 100 * sine * math.sin(phi), 1.7, d.WARM)
        yield d.text(x, 262, name)
        share = sum((math.sqrt(1 - u) if cosine else u) > math.cos(math.radians(60)) for u, _ in pairs) / len(
            pairs
        )
        yield d.text(x, 284, f"{share:.0%} within 60° of the normal", d.SOFT, size=13)


@d.diagram("one-path", 560, 300)
def one_path():
    yield f'<path d="M40 30 H530 V270 H40" fill="none" stroke="{d.INK}" stroke-width="2.4"/>'
    yield d.line(220, 30, 360, 30, d.WARM, 7)
    yield d.text(290, 20, "lamp: its emission, times the product of the weights", d.WARM)
    points = [(40, 160), (250, 270), (530, 140), (150, 30), (180, 270), (300, 30)]
    for number, (a, b) in enumerate(zip(points, points[1:])):
        yield d.line(*a, *b, d.COOL, 2, True)
        if 0 < number:
            yield d.circle(*a, 5)
            yield d.text(
                a[0] + (18 if a[0] < 500 else -16), a[1] + (20 if a[1] < 200 else -10), str(number), size=14
            )
    yield d.text(50, 146, "camera", d.SOFT, "start", size=14)


@d.diagram("densities", 580, 245)
def densities():
    """Both densities of theta, and their distributions."""
    for x0, name, functions in (
        (40, "density of θ", ((math.sin, d.WARM), (lambda t: math.sin(2 * t), d.COOL))),
        (
            346,
            "its distribution",
            ((lambda t: 1 - math.cos(t), d.WARM), (lambda t: math.sin(t) ** 2, d.COOL)),
        ),
    ):
        y0, width, height = 215, 200, 165
        yield d.line(x0, y0, x0 + width, y0)
        yield d.line(x0, y0, x0, y0 - height - 8)
        for function, color in functions:
            yield d.curve(
                [(x0 + width * i / 60, y0 - height * function(math.pi / 2 * i / 60)) for i in range(61)],
                color,
                2.4,
            )
        yield d.text(x0 + width, y0 + 18, "90°", d.SOFT, size=13)
        yield d.text(x0 - 7, y0 - height + 5, "1", d.SOFT, "end", size=13)
        yield d.text(x0 - 7, y0 + 5, "0", d.SOFT, "end", size=13)
        yield d.text(x0 + width / 2, 24, name)
    for x, y, words, color, anchor in (
        (248, 58, "uniform", d.WARM, "start"),
        (99, 64, "cosine", d.COOL, "end"),
        (476, 185, "uniform", d.WARM, "start"),
        (416, 105, "cosine", d.COOL, "end"),
    ):
        yield d.text(x, y, words, color, anchor)


def scene():
    return tomllib.loads((ROOT / BOX).read_text())


def numbers(values):
    return "(" + ", ".join(f"{value:g}".replace("-", "−") for value in values) + ")"


def face(project, corners, color, opacity=1.0):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (project(*corner) for corner in corners))
    return f'<polygon points="{path}" fill="{color}" fill-opacity="{opacity}" stroke="{d.SOFT}"/>'


def balls(box):
    """Left and right, as the scene has them."""
    return [shape for shape in box["shapes"] if shape["type"] == "sphere"]


def walls(project):
    """The five planes, the farthest first."""
    near, far = OPENING, 1
    yield face(project, [(-1, -1, far), (1, -1, far), (1, 1, far), (-1, 1, far)], d.FAINT, 0.35)
    for y in (-1, 1):
        yield face(project, [(-1, y, near), (1, y, near), (1, y, far), (-1, y, far)], d.FAINT, 0.2)
    for x, color in ((-1, d.RED), (1, d.GREEN)):
        yield face(project, [(x, -1, near), (x, -1, far), (x, 1, far), (x, 1, near)], color, 0.2)


@d.diagram("box-axes", 680, 484)
def box_with_axes():
    """Seen from in front of the box, a little to the right and above."""
    box = scene()

    def scale(z):
        return 480 / (z + 3.2)

    def project(x, y, z):
        return 366 + scale(z) * (x - 0.5), 132 - scale(z) * (y - 0.45)

    def put(at, words, color, dx=0, dy=0, anchor="middle"):
        x, y = project(*at)
        return d.text(x + dx, y + dy, words, color, anchor)

    def pointed(start, end, color, width=2):
        return d.line(*project(*start), *project(*end), color, width, True)

    yield from walls(project)
    for start, end in (
        ((-1, 0.3, -0.2), (-0.62, 0.3, -0.2)),
        ((1, 0.3, -0.2), (0.62, 0.3, -0.2)),
        ((0, -1, -0.2), (0, -0.6, -0.2)),
        ((0.5, 1, -0.2), (0.5, 0.62, -0.2)),
    ):
        yield pointed(start, end, d.SOFT)
        x, y = project(*end)
        yield d.symbol(x + 16, y - 8, "n", d.SOFT)
    yield put((-1, -0.3, OPENING), "x = −1", d.RED, 8, 0, "start")
    yield put((1, -0.3, OPENING), "x = 1", d.GREEN, 8, 0, "start")
    yield put((-0.2, 1, OPENING), "y = 1", d.INK, 0, 34)
    yield put((0, -1, OPENING), "y = −1", d.INK, 0, -12)
    yield put((-1, 1, 1), "z = 1", d.INK, 8, 26, "start")
    for end, name, dx, dy in (
        ((0.45, 0, 0), "x", 14, 6),
        ((0, 0.36, 0), "y", -14, 8),
        ((0, 0, 1), "z", 16, 0),
    ):
        yield pointed((0, 0, 0), end, d.INK, 2.4)
        x, y = project(*end)
        yield d.symbol(x + dx, y + dy, name)
    yield d.circle(*project(0, 0, 0), 4)
    yield put((0, 0, 0), "0", d.INK, -14, 14)
    for ball, color, fill, label in zip(balls(box), (d.COOL, d.WARM), (d.GLASS, d.SAND), (190, 500)):
        x, y = project(*ball["center"])
        r = scale(ball["center"][2]) * ball["radius"]
        yield d.circle(x, y, round(r, 1), fill, color)
        yield d.dashed(label, 456, x, y, color)
        yield d.circle(x, y, 3.5, color)
        yield d.line(x, y, x + r, y, color, 1.4)
        yield d.symbol(x + r / 2, y - 6, "r", color)
        yield d.text(label, 476, numbers(ball["center"]), color)
    yield d.text(345, 476, f"r = {ball['radius']:g}", d.INK)
    light = box["lights"][0]["center"]
    x, y = project(*light)
    yield d.circle(x, y, 7, d.LAMP, d.WARM)
    yield d.text(x + 14, y + 7, numbers(light), d.WARM, "start")


@d.diagram("box-camera", 680, 390)
def box_with_camera():
    """From the left: z runs to the right, and nearer things have a smaller x. The
    walls on this side are transparent."""
    box = scene()
    camera = box["camera"]
    size = 112

    def project(x, y, z):
        return 470 + size * (z + 0.42 * x), 190 - size * (y + 0.34 * x)

    def put(at, words, color, dx, dy, anchor="middle"):
        x, y = project(*at)
        return d.text(x + dx, y + dy, words.replace("-", "−"), color, anchor)

    def moved(point, vector, of=1.0):
        return [a + of * b for a, b in zip(point, vector)]

    origin, forward = camera["origin"], camera["forward"]
    center = moved(origin, forward)
    left, up = moved(center, camera["left"]), moved(center, camera["up"])
    z = center[2]
    yield from walls(project)
    for ball, color, fill in zip(balls(box)[::-1], (d.WARM, d.COOL), (d.SAND, d.GLASS)):
        yield d.circle(*project(*ball["center"]), round(size * ball["radius"], 1), fill, color)
    yield face(project, [(-1, -1, z), (1, -1, z), (1, 1, z), (-1, 1, z)], d.SAND, 0.8)
    for y in (-1, 1):
        yield d.dashed(*project(*origin), *project(-1, y, z))
    way = [a - b for a, b in zip(ball["center"], origin)]
    hit = moved(ball["center"], way, -ball["radius"] / math.hypot(*way))
    yield d.line(*project(*origin), *project(*hit), d.COOL, 2, True)
    yield d.circle(*project(*moved(origin, way, (z - origin[2]) / way[2])), 4.5, d.COOL)
    yield d.line(*project(*origin), *project(*center), d.INK, 2.4, True)
    yield d.line(*project(*center), *project(*left), d.WARM, 2.4, True)
    yield d.line(*project(*center), *project(*up), d.GREEN, 2.4, True)
    yield d.circle(*project(*origin), 5)
    yield put(origin, f"O = {numbers(origin)}", d.INK, -36, -64, "start")
    yield put(center, f"F = {numbers(forward)}", d.INK, -122, -10)
    yield put(left, f"L = {numbers(camera['left'])}", d.WARM, -8, -6, "end")
    yield put(up, f"U = {numbers(camera['up'])}", d.GREEN, -60, -14, "end")
    yield put((-1, -1, z), f"image plane, z = {z:g}", d.INK, -6, 32)
    yield put((-1, -1, 1), "z = 1", d.INK, 0, 32)
    x, y = 54, 84
    for name, dx, dy in (("z", 46, 0), ("y", 0, -46), ("x", 26, -20)):
        yield from d.arrow(x, y, x + dx, y + dy, name, d.INK, 1.8)


def bars(groups, most, unit, left=200, top=14):
    """Horizontal bars: groups are (name, [(label, value, color)])."""
    y, scale = top, (520 - left - 70) / most
    for name, rows in groups:
        yield d.text(8, y + 15, name, d.INK, "start")
        y += 24
        for label, value, color in rows:
            yield d.text(left - 12, y + 17, label, d.INK, "end")
            yield f'<rect x="{left}" y="{y}" width="{scale * value:.1f}" height="24" fill="{color}"/>'
            yield d.text(left + scale * value + 8, y + 17, measured.two_digits(value) + unit, d.INK, "start")
            y += 30
        y += 12


@d.diagram("efficiency-bars", 541, 322)
def efficiency_bars():
    """The efficiency of the second estimator of each pair, by that of the first."""
    names = {"stage 1": "find the lamp", "stage 2": "ask it", "stage 3": "follow all", "stage 4": "draw one"}
    groups = []
    for question, pair in measured.pairs().items():
        rows = [
            (names.get(row["estimator"], row["estimator"]), float(row["efficiency"]), color)
            for row, color in zip(pair, (d.FAINT, d.GLOW))
        ]
        groups.append((question, rows))
    most = max(value for _, rows in groups for _, value, _ in rows)
    yield from bars(groups, most, "")


@d.diagram("peers-bars", 541, 504)
def peers_bars():
    """How many times as long Mitsuba takes, by box and program."""
    boxes = {
        "cornell_box_point_diffuse": "point light, diffuse",
        "cornell_box_ceiling_diffuse": "shining ceiling, diffuse",
        "cornell_box_point": "point light, all materials",
        "cornell_box_ceiling": "shining ceiling, all materials",
    }
    programs = {
        "stage5, avx2": ("stage 5", d.FAINT),
        "stage6, avx2": ("stage 6, AVX2", d.GLOW),
        "stage6, avx512": ("stage 6, AVX-512", d.GLASS),
    }
    groups = {name: [] for name in boxes.values()}
    for row in measured.rows("peers.md"):
        if row["program"] in programs:
            label, color = programs[row["program"]]
            times = float(row["Mitsuba takes"].split()[0])
            groups[boxes[row["box"]]].append((label, times, color))
    most = max(value for rows in groups.values() for _, value, _ in rows)
    yield from bars(groups.items(), most, " times")


@d.diagram("shapes-bars", 541, 236)
def shapes_bars():
    """Samples in a second by stage 5, by the number of spheres."""
    rows = []
    for row in measured.rows("benchmarks.md"):
        if row["benchmark"].startswith("cost_of_shapes/spheres/"):
            number, prefix = row["in a second"].split(" ")
            thousands = float(number) * {"k/s": 1, "M/s": 1000}[prefix]
            count = int(row["benchmark"].rpartition("/")[2])
            rows.append((f"{count:,} spheres", thousands, d.GLOW))
    yield from bars([("thousand samples in a second", rows)], rows[0][1], "")
