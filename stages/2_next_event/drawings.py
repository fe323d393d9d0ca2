"""Drawings of chapter 2 and its deck."""

import base64
import json
import math
import struct
import subprocess
import zlib

from tools.tree import BUILD, Failure, read_pfm
from tools.weave import drawing as d
from tools.weave.renders import Render


@d.diagram("split", 520, 320)
def split():
    """The hemisphere at x: directions to the lamp, and all others."""
    x, y, r = 240, 270, 120
    yield from d.hatched(40, y, 480, y)
    yield from d.hatched(480, y, 480, 50)
    yield d.line(290, 50, 380, 50, d.LAMP, 8)
    yield d.text(335, 34, "lamp: L_e", d.WARM)
    first, last = (math.degrees(math.atan2(end - x, y - 50)) for end in (290, 380))
    yield f'<path d="M{x} {y} L290 54 L380 54z" fill="{d.GLOW}"/>'
    a, b = d.polar(x, y, first, r), d.polar(x, y, last, r)
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {a[0]:.1f} {a[1]:.1f}" fill="none" stroke="{d.COOL}" stroke-width="4"/>'
    yield f'<path d="M{a[0]:.1f} {a[1]:.1f} A{r} {r} 0 0 1 {b[0]:.1f} {b[1]:.1f}" fill="none" stroke="{d.WARM}" stroke-width="6"/>'
    yield f'<path d="M{b[0]:.1f} {b[1]:.1f} A{r} {r} 0 0 1 {x + r} {y}" fill="none" stroke="{d.COOL}" stroke-width="4"/>'
    yield from d.arrow(x, y, *d.polar(x, y, (first + last) / 2, 190), "", d.WARM)
    yield from d.arrow(x, y, *d.polar(x, y, 66, 256), "", d.COOL)
    yield d.circle(480, y - 240 / math.tan(math.radians(66)), 4, d.COOL)
    yield d.text(470, 236, "wall: L_s", d.COOL, "end")
    yield d.text(52, 110, "direct: to the lamp", d.WARM, "start")
    yield d.text(52, 136, "indirect: all others", d.COOL, "start")
    yield d.circle(x, y, 4.5)
    yield d.symbol(x, y + 32, "x")


@d.diagram("shrinking-lamp", 520, 230)
def shrinking_lamp():
    """A lamp that becomes smaller and brighter."""
    for x, half, name in ((90, 44, "A, L_e"), (260, 18, "A/6, 6 L_e"), (430, 0, "a point, I")):
        y = 180
        yield from d.hatched(x - 70, y, x + 70, y)
        if half:
            yield f'<path d="M{x} {y} L{x - half} 54 L{x + half} 54z" fill="{d.GLOW}"/>'
            yield d.line(x - half, 52, x + half, 52, d.LAMP, 7)
        else:
            yield d.circle(x, 52, 6, d.LAMP, d.WARM)
        yield d.dashed(x, y, x, 60, d.WARM)
        yield d.symbol(x + 14, 128, "d", d.INK, "start")
        yield d.text(x, 34, name, d.WARM)
        yield d.circle(x, y, 4)
        yield d.text(x, y + 36, "L_e A/d²" if half == 44 else "the same" if half else "I/d²")


@d.diagram("lamp-cone", 520, 280)
def lamp_cone():
    """The cone that a sphere fills, and the chord of one direction."""
    x, y = 70, 150
    cx, r = 360, 96
    distance = cx - x
    edge = math.degrees(math.asin(r / distance))
    yield d.circle(cx, y, r, d.SAND, d.SOFT)
    for side in (-1, 1):
        a = math.radians(edge) * side
        reach = math.sqrt(distance * distance - r * r)
        yield d.line(x, y, x + reach * math.cos(a), y - reach * math.sin(a), d.SOFT, 1.4)
    cosine, sine = math.cos(math.radians(edge)), math.sin(math.radians(edge))
    yield d.line(x + distance * cosine**2, y + distance * cosine * sine, cx, y, d.INK, 1.4)
    yield d.symbol(cx - 6, y + 54, "r", d.INK, "start")
    yield d.dashed(x, y, cx, y)
    yield d.symbol((x + cx) / 2 + 10, y + 26, "d")
    a = math.radians(9.5)
    near = distance * math.cos(a) - math.sqrt(r * r - (distance * math.sin(a)) ** 2)
    far = distance * math.cos(a) + math.sqrt(r * r - (distance * math.sin(a)) ** 2)
    yield d.line(x, y, x + near * math.cos(a), y - near * math.sin(a), d.WARM, 2.4, True)
    yield d.dashed(
        x + near * math.cos(a), y - near * math.sin(a), x + far * math.cos(a), y - far * math.sin(a), d.WARM
    )
    yield from d.angle(x, y, 90 - edge, 90, 150, "", d.SOFT)
    yield d.symbol(x + 146, y - 70, "t_max", d.SOFT)
    yield from d.angle(x, y, 80.5, 90, 96, "", d.WARM)
    yield d.symbol(x + 112, y - 4, "θ", d.WARM)
    foot = distance * math.cos(a)
    yield d.line(cx, y, x + foot * math.cos(a), y - foot * math.sin(a), d.COOL, 1.6)
    yield d.text(cx + 8, y - 16, "d sin θ", d.COOL, "start", "italic")
    yield d.text(320, y - 68, "half chord", d.WARM, "start")
    yield d.circle(x, y, 4.5)
    yield d.symbol(x - 20, y + 6, "x")
    yield d.circle(cx, y, 3.5)
    yield d.text(260, 266, "sin t_max = r/d", d.SOFT)


@d.diagram("who-counts", 540, 150)
def who_counts():
    """The previous vertex, what was hit, and which of the two counts."""
    rows = (
        ("previous vertex", "rectangle, sphere", "plane, triangle"),
        ("none: the camera", "the hit counts", "the hit counts"),
        ("it asked the lights", "the question counted", "the hit counts"),
    )
    fills = [(1, 1, d.GLASS), (1, 2, d.GLASS), (2, 1, d.GLOW), (2, 2, d.GLASS)]
    yield from d.boxes(6, 12, rows, (176, 190, 162), 42, fills)


@d.diagram("inverse-square", 520, 230)
def inverse_square():
    """One cone of light from a point, and the areas that it covers."""
    x, y = 50, 110
    yield f'<path d="M{x} {y} L450 30 L450 190z" fill="{d.GLOW}"/>'
    for distance, name in ((1, "d"), (2, "2 d")):
        at, half = x + 200 * distance, 40 * distance
        yield d.line(at, y - half, at, y + half, d.WARM, 4)
        yield d.text(
            at,
            212,
            f"area {'A' if distance == 1 else '4 A'}, I/{'d²' if distance == 1 else '(4 d²)'}",
            d.WARM,
        )
        yield d.dashed(at, y + half, at, 194)
    yield d.line(x, y, 248, y, d.SOFT, 1.4, True)
    yield d.symbol(150, y - 8, "d")
    yield d.circle(x, y, 6, d.LAMP, d.WARM)
    yield d.text(x, y + 28, "I", d.WARM, style="italic")


@d.diagram("area-to-angle", 520, 330)
def area_to_angle():
    """A patch of a lamp, turned to face x, and its projection on a sphere."""
    x, y, r = 150, 285, 105
    px, py, half, tilt = 405, 90, 50, 40  # the patch, and how it is tilted
    toward = math.degrees(math.atan2(px - x, y - py))
    u = math.radians(90 + toward - tilt)  # along the patch, from straight up
    ends = [(px + s * half * math.sin(u), py - s * half * math.cos(u)) for s in (-1, 1)]
    yield d.line(20, y, 340, y, d.INK, 2)
    (ax, ay), (bx, by) = ends
    yield f'<path d="M{x} {y} L{ax:.1f} {ay:.1f} L{bx:.1f} {by:.1f}z" fill="{d.GLOW}"/>'
    yield d.curve([d.polar(x, y, a, r) for a in range(-90, 91, 3)], d.SOFT, 1.2, "4 3")
    seen = [math.degrees(math.atan2(ex - x, y - ey)) for ex, ey in ends]
    yield d.curve([d.polar(x, y, seen[0] + (seen[1] - seen[0]) * i / 12, r) for i in range(13)], d.COOL, 6)
    yield d.text(*d.polar(x, y, toward - 22, r + 12), "dω", d.COOL, "middle", "italic")
    yield d.line(ax, ay, bx, by, d.WARM, 6)
    yield d.symbol(bx + 18, by + 8, "dA", d.WARM, "start")
    face = math.radians(90 + toward)
    h = half * math.cos(math.radians(tilt))
    cx, cy = [(px + s * h * math.sin(face), py - s * h * math.cos(face)) for s in (-1, 1)]
    yield d.line(*cx, *cy, d.GREEN, 3, False, "6 4")
    yield d.symbol(cx[0] - 8, cx[1] - 12, "cos θ′ dA", d.GREEN, "middle")
    yield d.dashed(x, y, px, py, d.INK)
    yield d.symbol(284, 212, "d", d.INK, "start")
    back = 180 + toward
    yield from d.arrow(px, py, *d.polar(px, py, back - tilt, 84), "n′", d.WARM)
    yield from d.angle(px, py, back - tilt, back, 40, "θ′", d.WARM)
    yield d.dashed(x, y, x, y - 150)
    yield d.symbol(x - 14, y - 136, "n")
    yield d.text(*d.polar(x, y, -48, r + 10), "radius 1", d.SOFT, "end", size=14)
    yield d.circle(x, y, 4.5)
    yield d.symbol(x, y + 30, "x")


@d.diagram("visible-share", 520, 250)
def visible_share():
    """The cap of a sphere that is seen from x."""
    x, cx, y, r = 60, 340, 120, 92
    distance = cx - x
    alpha = math.degrees(math.acos(r / distance))
    yield d.circle(cx, y, r, d.SAND, d.SOFT)
    top, bottom = d.polar(cx, y, -90 + alpha, r), d.polar(cx, y, -90 - alpha, r)
    yield f'<path d="M{bottom[0]:.1f} {bottom[1]:.1f} A{r} {r} 0 0 1 {top[0]:.1f} {top[1]:.1f}" fill="none" stroke="{d.LAMP}" stroke-width="7"/>'
    for end in (top, bottom):
        yield d.line(x, y, *end, d.SOFT, 1.4)
    yield d.line(cx, y, *top, d.INK, 1.4)
    yield d.symbol(cx - 4, y - 50, "r", d.INK, "start")
    yield d.dashed(x, y, cx, y)
    yield d.symbol(150, y + 24, "d")
    yield from d.angle(cx, y, -90, -90 + alpha, 30, "α")
    yield d.text(x + 50, 40, "visible", d.WARM, "start")
    yield d.line(x + 104, 46, 256, 88, d.WARM, 1, True)
    yield d.text(cx + 104, y + 6, "far side", d.SOFT, "start", size=14)
    yield d.circle(x, y, 4.5)
    yield d.symbol(x - 18, y + 6, "x")
    yield d.circle(cx, y, 3.5)
    yield d.text(260, 240, "cos α = r/d")


@d.diagram("three-answers", 520, 220)
def three_answers():
    """A light that is seen, one that is hidden, and one below the horizon."""
    for x, name, color in (
        (85, "adds light", d.GREEN),
        (260, "blocked: 0", d.WARM),
        (435, "cos θ ≤ 0: 0", d.SOFT),
    ):
        y = 150
        yield from d.hatched(x - 72, y, x + 72, y)
        yield d.dashed(x, y, x, y - 84)
        yield d.symbol(x - 14, y - 74, "n")
        light = (x + 48, 40) if color != d.SOFT else (x + 58, 186)
        yield d.circle(*light, 6, d.LAMP, d.WARM)
        if color == d.WARM:
            yield d.line(x, y, x + 20, 104, d.WARM, 1.8, True)
            yield d.circle(x + 27, 86, 17, d.GLASS, d.COOL)
        elif color == d.GREEN:
            yield d.line(x, y, light[0] - 3, light[1] + 8, d.GREEN, 1.8, True, "6 4")
            yield from d.angle(x, y, 0, 23, 40, "θ")
        else:
            yield d.dashed(x, y, light[0] - 4, light[1] - 4)
        yield d.circle(x, y, 4.5)
        yield d.text(x, 212, name, color if color != d.SOFT else d.INK)


@d.diagram("told-path", 520, 320)
def told_path():
    """The path of the transcript, from the side."""
    yield from d.hatched(40, 280, 500, 280)
    yield from d.hatched(40, 30, 40, 280)
    yield d.text(52, 110, "red wall", d.WARM, "start")
    yield d.line(250, 34, 390, 34, d.LAMP, 8)
    yield d.text(320, 22, "lamp", d.WARM)
    yield d.circle(215, 190, 46, d.GLASS, d.COOL)
    yield d.text(215, 196, "ball", d.COOL)
    zero, one, two = (120, 280), (40, 240), (268, 40)
    yield d.line(470, 200, *zero, d.INK, 2.2, True)
    yield d.text(476, 194, "camera", d.SOFT, "end")
    yield d.line(*zero, *one, d.INK, 2.2, True)
    yield d.line(*one, *two, d.INK, 2.2, True)
    yield d.line(*zero, 179, 223, d.WARM, 1.8, True, "6 4")
    yield d.line(*one, 336, 42, d.GREEN, 1.8, True, "6 4")
    yield d.text(262, 112, "reached", d.GREEN, "start")
    yield d.text(142, 238, "blocked", d.WARM, "end")
    yield d.text(240, 62, "hit: not added", d.INK, "end")
    for (px, py), name, dx, dy in ((zero, "0", 0, 32), (one, "1", -18, 6), (two, "2", 16, 24)):
        yield d.circle(px, py, 4.5)
        yield d.symbol(px + dx, py + dy, name)


def rendered(stage, spp, seed, mistake=None):
    """One of the two renders to compare."""
    words = f"--size 48x48 --spp {spp} --seed {seed}".split()
    one = Render(stage, "scenes/cornell_box_lamp_diffuse.toml", words, mistake=mistake)
    return one.files(".pfm")[0]


def png(width, height, rows):
    """A picture's bytes; a row is its (r, g, b) from 0 to 255."""

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    lines = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    head = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"IDAT", zlib.compress(lines))
        + chunk(b"IEND", b"")
    )


def difference(a, b):
    """A - B as a picture: orange where A is brighter, blue where B is."""
    width, height, first = read_pfm(a)
    second = read_pfm(b)[2]
    mean = sum(map(sum, second)) / len(second)
    zero = 236
    rows = []
    for y in range(height):
        row = []
        for one, other in zip(first[y * width : (y + 1) * width], second[y * width : (y + 1) * width]):
            by = max(-1, min(1, 1.2 * (sum(one) - sum(other)) / mean))
            end = (180, 73, 26) if by > 0 else (31, 95, 168)
            row.append([round(zero + (e - zero) * abs(by)) for e in end])
        rows.append(row)
    return png(width, height, rows)


def verdict_on(a, b):
    """The output of stage-diff for two images."""
    done = subprocess.run([BUILD / "stage-diff", "--json", a, b], check=False, capture_output=True, text=True)
    if done.returncode > 1:
        raise Failure(f"drawing 'stage-2-minus-1': {done.stderr.strip()}")
    return json.loads(done.stdout)


@d.diagram("stage-2-minus-1", 520, 320)
def stage_2_minus_1():
    """Differences of two renders, and the output of stage-diff."""
    found = rendered(1, 1024, 1)
    for x, name, mistake in (
        (8, "stage 2 − stage 1", None),
        (268, "the lamp counted twice", "lamps-counted-twice"),
    ):
        asked = rendered(2, 256, 2, mistake)
        data = base64.b64encode(difference(asked, found)).decode()
        yield (
            f'<image x="{x}" y="8" width="244" height="244" style="image-rendering:pixelated" '
            f'href="data:image/png;base64,{data}"/>'
        )
        said = verdict_on(asked, found)
        yield d.text(x + 122, 278, name)
        verdict = "the same" if said["same"] else "different"
        yield d.text(x + 122, 306, f"largest z {said['worst']['z']:.1f}: {verdict}", d.SOFT)


@d.diagram("next-event", 520, 300)
def next_event():
    yield f'<path d="M30 30 H490 V270 H30" fill="none" stroke="{d.INK}" stroke-width="2"/>'
    yield d.circle(365, 150, 36, d.GLASS, d.COOL)
    yield d.circle(250, 80, 6, d.LAMP, d.WARM)
    yield d.text(250, 62, "light", d.WARM)
    a = (170, 270)
    yield d.line(30, 190, a[0], a[1], d.INK, 2.2, True)
    yield d.text(40, 182, "camera", d.SOFT, "start", size=13)
    yield d.line(*a, 130, 30, d.INK, 2.2, True)
    yield d.line(130, 30, 440, 270, d.INK, 2.2, True, "")
    yield d.line(*a, 248, 87, d.GREEN, 1.6, False, "6 4")
    yield d.line(130, 30, 244, 77, d.GREEN, 1.6, False, "6 4")
    yield d.line(440, 270, 354, 184, d.WARM, 1.6, False, "6 4")
    yield d.line(354, 184, 256, 87, d.SOFT, 1, False, "2 4")
    yield d.text(190, 190, "lit", d.GREEN, "end")
    yield d.text(196, 46, "lit", d.GREEN)
    yield d.text(408, 222, "in shadow", d.WARM, "start", size=12)
    for number, (x, y) in enumerate((a, (130, 30), (440, 270)), 1):
        yield d.circle(x, y, 4.5)
    yield d.text(a[0], a[1] + 20, "1")
    yield d.text(130, 22, "2")
    yield d.text(440, 290, "3")
