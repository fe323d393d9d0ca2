"""Drawings of chapter 7 and its deck."""

import functools
import math
import random

from tools.tree import ROOT, read_pfm
from tools.weave import drawing as d
from tools.weave.renders import Render

LAMP, BALL, RADIUS, FLOOR = (262, 70), (372, 186), 50, 276


def refracted(direction, normal, ratio):
    """Snell's law in the plane: the normal is on the side that light comes from."""
    cosine = -(direction[0] * normal[0] + direction[1] * normal[1])
    k = ratio * cosine - math.sqrt(1 - ratio * ratio * (1 - cosine * cosine))
    return tuple(ratio * a + k * n for a, n in zip(direction, normal))


def through_the_ball(degrees):
    """A photon's corners from the lamp through the ball of glass to the floor."""
    start, way = LAMP, (math.sin(math.radians(degrees)), math.cos(math.radians(degrees)))
    corners = [start]
    for ratio, sign in ((1 / 1.5, 1), (1.5, -1)):
        to = [c - s for c, s in zip(BALL, start)]
        middle = to[0] * way[0] + to[1] * way[1]
        half = math.sqrt(RADIUS**2 - (to[0] ** 2 + to[1] ** 2 - middle**2))
        at = middle - half if sign == 1 else 2 * middle
        start = (start[0] + at * way[0], start[1] + at * way[1])
        normal = [sign * (s - c) / RADIUS for s, c in zip(start, BALL)]
        way = refracted(way, normal, ratio)
        corners.append(start)
    at = (FLOOR - start[1]) / way[1]
    return [*corners, (start[0] + at * way[0], FLOOR)]


@d.diagram("two-walks", 520, 330)
def two_walks():
    """Photons from the lamp, and a path from the camera that finds them."""
    yield f'<path d="M90 30 H505 V{FLOOR} H90" fill="none" stroke="{d.INK}" stroke-width="2.4"/>'
    yield d.circle(*BALL, RADIUS, d.GLASS, d.COOL)
    stored = [through_the_ball(degrees) for degrees in (30, 36, 42, 48, 54)]
    stored += [[LAMP, (505, 96), (466, FLOOR)], [LAMP, (90, 150), (164, FLOOR)]]
    for corners in stored:
        for a, b in zip(corners, corners[1:]):
            yield d.line(*a, *b, d.WARM, 1.5, b == corners[-1])
    spot = (stored[2][-1][0] - 3, FLOOR)
    for corners in stored:
        yield d.circle(*corners[-1], 4.5, d.WARM)
    yield f'<ellipse cx="{spot[0]:.1f}" cy="{FLOOR}" rx="36" ry="9" fill="none" stroke="{d.COOL}" stroke-width="2"/>'
    yield d.line(26, 160, spot[0] - 8, FLOOR - 2, d.COOL, 2.2, True)
    yield d.circle(26, 160, 5)
    yield d.circle(*LAMP, 8, d.LAMP, d.WARM)
    yield d.text(10, 146, "camera", d.INK, "start")
    yield d.text(LAMP[0] + 14, LAMP[1] - 12, "lamp", d.WARM, "start")
    yield d.text(106, 70, "1. photons walk", d.WARM, "start")
    yield d.text(190, 262, "2. a path asks", d.COOL, "start")
    yield d.text(512, FLOOR + 34, "the photons near its hit", d.COOL, "end")


@d.diagram("photon-start", 520, 270)
def photon_start():
    """Directions of photons in one plane: of a point, and of a lamp with a surface."""
    for i in range(24):
        yield d.line(*d.polar(130, 125, 15 * i, 9), *d.polar(130, 125, 15 * i, 100), d.WARM, 1.6, True)
    yield d.circle(130, 125, 8, d.LAMP, d.WARM)
    yield d.text(130, 260, "a point: evenly")
    x, y = 390, 100
    yield f'<rect x="{x - 100}" y="{y - 10}" width="200" height="10" fill="{d.LAMP}"/>'
    yield d.dashed(x, y, x, y + 130)
    yield d.symbol(x + 14, y + 128, "n")
    for i in range(12):
        degrees = 180 - math.degrees(math.asin((2 * i + 1) / 12 - 1))
        yield d.line(x, y, *d.polar(x, y, degrees, 100), d.WARM, 1.6, True)
    yield d.text(x, 260, "a surface: by the cosine")


@d.diagram("squeezed-light", 520, 262)
def squeezed_light():
    """Light of a wide cone in air fills a narrow one in glass."""
    x, y, reach = 200, 131, 108
    yield f'<rect x="20" y="{y}" width="480" height="125" fill="{d.GLASS}"/>'
    yield d.line(20, y, 500, y, d.COOL, 2)
    yield d.dashed(x, y - reach - 12, x, y + reach + 12)
    edge = math.degrees(math.asin(0.9))
    for i in range(9):
        sine = 0.9 * (i / 4 - 1)
        above, below = math.degrees(math.asin(sine)), math.degrees(math.asin(sine / 1.5))
        yield d.line(*d.polar(x, y, above, reach), x, y, d.WARM, 1.8)
        yield d.ray(x, y, 180 + below, reach, d.WARM, 1.8)
    inner = math.degrees(math.asin(0.6))
    yield d.arc(x, y, -edge, edge, 40, d.INK)
    yield d.arc(x, y, 180 - inner, 180 + inner, 40, d.INK)
    for top, words in (
        (40, ("air", "100 W", "radiance L")),
        (y + 42, ("glass, η = 1.5", "100 k_t W", "radiance 2.25 k_t L")),
    ):
        for i, line in enumerate(words):
            yield d.text(350, top + 26 * i, line, d.SOFT if i == 0 else d.INK, "start")


def scattered(columns, rows, seed):
    """One point in each cell of a grid over [-1, 1]^2, the farthest first."""
    drawn = random.Random(seed)
    cells = [(i, j) for i in range(columns) for j in range(rows)]
    points = [((i + drawn.random()) / columns, (j + drawn.random()) / rows) for i, j in cells]
    return sorted(((2 * u - 1, 2 * v - 1) for u, v in points), key=lambda one: -one[1])


def face(points, fill, color, width=1):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polygon points="{path}" fill="{fill}" stroke="{color}" stroke-width="{width}"/>'


@d.diagram("photon-disk", 520, 300)
def photon_disk():
    """A disk on the surface, around x, and the photons on it."""
    x, y, r = 260, 200, 0.5

    def project(u, v):
        return x + 178 * u + 66 * v, y - 86 * v

    yield face([project(*corner) for corner in ((-1, -1), (1, -1), (1, 1), (-1, 1))], d.SAND, d.SOFT)
    yield face([project(*d.polar(0, 0, 5 * i, r)) for i in range(72)], d.GLOW, d.COOL, 2)
    yield d.line(x, y, *project(r, 0), d.INK, 2)
    count = 0
    for u, v in scattered(9, 5, 3049):
        px, py = project(u, v)
        inside = math.hypot(u, v) < r
        count += inside
        if inside:
            yield d.line(px - 26 * math.sin(9 * u + 5 * v), py - 44, px, py - 4, d.WARM, 1.5, True)
        yield d.circle(px, py, 4, d.WARM if inside else d.SOFT)
    yield d.ray(x, y, -58, 200, d.COOL, 2.2)
    yield d.symbol(*d.polar(x, y + 4, -58, 218), "w_o", d.COOL)
    yield d.circle(x, y, 5)
    yield d.symbol(x - 4, y + 22, "x")
    yield d.symbol(x + 46, y - 8, "r")
    yield d.text(x + 10, 56, f"{count} photons arrive in the disk", d.WARM, "start")


def uniform(number):
    """The numbers of tools/book/live/: in [0, 1), always the same for its number."""
    bits = (number + 1) * 0x9E3779B1 & 0xFFFFFFFF
    bits = (bits ^ bits >> 15) * 0x85EBCA6B & 0xFFFFFFFF
    bits = (bits ^ bits >> 13) * 0xC2B2AE35 & 0xFFFFFFFF
    return (bits ^ bits >> 16) / 2**32


def irradiance(u):
    return 0.5 + 2 * math.exp(-(((u - 1.2) / 0.15) ** 2))


def lit_floor(density):
    """Photons of the live figure of the same light: (u, v) in meters."""
    for i in range(int(density * 2.5 * 3.6 * 1.8)):
        u = 3.6 * uniform(3 * i) - 0.8
        if 2.5 * uniform(3 * i + 1) < irradiance(u):
            yield u, 1.8 * uniform(3 * i + 2) - 0.4


@d.diagram("density-estimate", 520, 350)
def density_estimate():
    """The live figure as it begins: the disk up to the 20th of 400 photons per m²."""
    x, meter, floor, watt, k, density = 10, 250, 338, 26, 20, 400
    photons = list(lit_floor(density))

    def radius(u):
        return sorted(math.dist(one, (u, 0.5)) for one in photons)[k - 1]

    rim = radius(0.5)
    for u, v in photons:
        if 0 <= u <= 2 and 0 <= v <= 0.88:
            inside = math.dist((u, v), (0.5, 0.5)) < rim
            yield d.circle(x + meter * u, meter * v, 2.4 if inside else 1.6, d.WARM if inside else d.SOFT)
    yield d.dashed(x, meter / 2, x + 2 * meter, meter / 2)
    yield d.circle(x + meter / 2, meter / 2, round(meter * rim, 1), "none", d.COOL)
    yield d.circle(x + meter / 2, meter / 2, 4, d.COOL)
    yield d.line(x, floor, x + 2 * meter, floor, d.SOFT, 1.2)
    places = [0.1 + 0.02 * i for i in range(91)]
    says = [(k - 1) / density / (math.pi * radius(u) ** 2) for u in places]
    yield d.curve([(x + meter * u, floor - watt * e) for u, e in zip(places, says)], d.WARM)
    yield d.curve([(x + meter * u, floor - watt * irradiance(u)) for u in places], d.INK, 1.8, "7 4")
    yield d.text(x + 8, 250, "truth (dashed)", d.INK, "start")
    yield d.text(x + 132, 250, "estimate", d.WARM, "start")


def cuts(points, box, depth):
    """The cuts of a k-d tree in the plane: (first end, second end, depth) each."""
    if len(points) <= 2:
        return
    axis = 0 if box[2] - box[0] >= box[3] - box[1] else 1
    points = sorted(points, key=lambda one: one[axis])
    middle = len(points) // 2
    at = points[middle][axis]
    lower, upper = list(box), list(box)
    lower[axis + 2] = upper[axis] = at
    ends = ((at, box[1]), (at, box[3])) if axis == 0 else ((box[0], at), (box[2], at))
    yield *ends, depth
    yield from cuts(points[:middle], lower, depth + 1)
    yield from cuts(points[middle + 1 :], upper, depth + 1)


@d.diagram("kd-tree", 520, 300)
def kd_tree():
    """Points in the plane, halved again and again, and a search for the nearest."""
    points = [(260 + 230 * u, 150 + 130 * v) for u, v in scattered(8, 5, 7)]
    x, y, r = 342, 108, 50
    yield d.circle(x, y, r, d.GLOW, d.COOL)
    yield f'<rect x="20" y="10" width="480" height="280" fill="none" stroke="{d.INK}"/>'
    for first, second, depth in cuts(points, (20, 10, 500, 290), 0):
        yield d.line(*first, *second, d.INK if depth < 2 else d.SOFT, max(0.8, 3 - 0.6 * depth))
    for point in points:
        inside = math.dist(point, (x, y)) < r
        yield d.circle(*point, 5, d.WARM if inside else d.SOFT)
    yield d.circle(x, y, 4, d.COOL)


# A floor and a mirror above a point light, whose image is 0.5 above the floor.
MIRROR = """
[camera]
origin  = [0, -0.7, -0.5]
left    = [-0.0001, 0, 0]
up      = [0, 0.0001, 0]
forward = [0, -0.3, 0.5]

[materials]
floor  = { kd = 0.5 }
mirror = { ks = 1 }

[[shapes]]
type = "plane"
normal = [0, 1, 0]
distance = 1
material = "floor"

[[shapes]]
type = "plane"
normal = [0, -1, 0]
distance = -0.55
material = "mirror"

[[lights]]
type = "point"
center = [0, -0.6, 0]
intensity = 1
"""
DIRECT, TRUTH = 0.5 / math.pi / 0.4**2, 0.5 / math.pi / 0.5**2
MAPS, SEEDS = (1, 4, 16, 64, 256), range(1, 65)


@functools.cache
def errors():
    """(maps, bias, noise) of the photons' light at one point, in parts of the truth."""
    scene = "scenes/cornell_box_point.toml"
    whole = (ROOT / scene).read_text()
    sums, found = dict.fromkeys(SEEDS, 0.0), []
    for before, maps in zip((0, *MAPS), MAPS):
        options = "--size 1x1 --max-bounces 2 --threads 1 --photons 2000 --neighbors 100".split()
        options += ["--first-sample", str(before), "--spp", str(maps - before)]
        for seed in SEEDS:
            made = Render(7, scene, [*options, "--seed", str(seed)], [whole, MIRROR]).files(".pfm")[0]
            radiance = read_pfm(made)[2][0][0]
            sums[seed] += (maps - before) * (radiance - DIRECT) / TRUTH
        means = [total / maps for total in sums.values()]
        mean = sum(means) / len(means)
        noise = math.sqrt(sum((one - mean) ** 2 for one in means) / (len(means) - 1))
        found.append((maps, abs(mean - 1), noise))
    return found


def forms():
    """How bias and noise fall with the maps, by the chapter's formulas: the mean of
    the squared radii, and the root of the sum of their inverses over the number."""
    squared, sum_of, sum_of_inverse, found = 1.0, 0.0, 0.0, {}
    for maps in range(1, MAPS[-1] + 1):
        sum_of, sum_of_inverse = sum_of + squared, sum_of_inverse + 1 / squared
        found[maps] = sum_of / maps, math.sqrt(sum_of_inverse) / maps
        squared *= (maps + 2 / 3) / (maps + 1)
    return found


@d.diagram("bias-and-noise", 520, 350)
def bias_and_noise():
    """Both errors against the number of maps, on logarithmic axes."""
    x0, y0, wide, high = 76, 296, 80, 260 / math.log(20)

    def place(maps, error):
        return x0 + 20 + wide * math.log(maps, 4), y0 - high * math.log(error / 0.01)

    yield from d.axes(x0, y0, 376, 274)
    for error in (0.01, 0.02, 0.05, 0.1, 0.2):
        y = place(1, error)[1]
        if error > 0.01:
            yield d.line(x0, y, x0 + 376, y, d.FAINT, 1)
        yield d.text(x0 - 10, y + 5, f"{100 * error:g} %", d.SOFT, "end")
    for maps in MAPS:
        yield d.text(place(maps, 1)[0], y0 + 22, str(maps), d.SOFT)
    yield d.text(x0 + 188, y0 + 46, "maps")
    yield d.curve([place(maps, 0.19 * maps ** (-1 / 3)) for maps in MAPS], d.SOFT, 1.4, "5 4")
    x, y = place(20, 0.19 * 20 ** (-1 / 3))
    yield d.text(x, y - 16, "slope −1/3", d.SOFT, "start")
    for column, color, name in ((0, d.COOL, "bias"), (1, d.WARM, "noise")):
        measured = {row[0]: row[1 + column] for row in errors()}
        ratios = [math.log(measured[maps] / forms()[maps][column]) for maps in MAPS]
        factor = math.exp(sum(ratios) / len(ratios))
        yield d.curve([place(maps, factor * one[column]) for maps, one in forms().items()], color, 2.2)
        for maps, error in measured.items():
            yield d.circle(*place(maps, error), 4.5, color)
        x, y = place(MAPS[-1], measured[MAPS[-1]])
        yield d.text(x + 14, y + 5, name, color, "start")
