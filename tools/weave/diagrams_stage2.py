"""The drawings of chapter 2."""

import base64
import json
import math
import struct
import subprocess
import zlib

from compare.stages import BUILD, Failure, read_pfm
from tools.weave.drawing import (
    COOL,
    GLASS,
    GLOW,
    GREEN,
    INK,
    LAMP,
    SAND,
    SOFT,
    WARM,
    angle,
    arrow,
    boxes,
    circle,
    curve,
    dashed,
    diagram,
    hatched,
    line,
    polar,
    symbol,
    text,
)
from tools.weave.renders import Render


@diagram("split", 520, 320)
def split():
    """The hemisphere at x: directions to the lamp, and all others."""
    x, y, r = 240, 270, 120
    yield from hatched(40, y, 480, y)
    yield from hatched(480, y, 480, 50)
    yield line(290, 50, 380, 50, LAMP, 8)
    yield text(335, 34, "lamp: L_e", WARM)
    first, last = (math.degrees(math.atan2(end - x, y - 50)) for end in (290, 380))
    yield f'<path d="M{x} {y} L290 54 L380 54z" fill="{GLOW}"/>'
    a, b = polar(x, y, first, r), polar(x, y, last, r)
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {a[0]:.1f} {a[1]:.1f}" fill="none" stroke="{COOL}" stroke-width="4"/>'
    yield f'<path d="M{a[0]:.1f} {a[1]:.1f} A{r} {r} 0 0 1 {b[0]:.1f} {b[1]:.1f}" fill="none" stroke="{WARM}" stroke-width="6"/>'
    yield f'<path d="M{b[0]:.1f} {b[1]:.1f} A{r} {r} 0 0 1 {x + r} {y}" fill="none" stroke="{COOL}" stroke-width="4"/>'
    yield from arrow(x, y, *polar(x, y, (first + last) / 2, 190), "", WARM)
    yield from arrow(x, y, *polar(x, y, 66, 256), "", COOL)
    yield circle(480, y - 240 / math.tan(math.radians(66)), 4, COOL)
    yield text(470, 236, "wall: L_s", COOL, "end")
    yield text(52, 110, "direct: to the lamp", WARM, "start")
    yield text(52, 136, "indirect: all others", COOL, "start")
    yield circle(x, y, 4.5)
    yield symbol(x, y + 32, "x")


@diagram("shrinking-lamp", 520, 230)
def shrinking_lamp():
    """A lamp that becomes smaller and brighter."""
    for x, half, name in ((90, 44, "A, L_e"), (260, 18, "A/6, 6 L_e"), (430, 0, "a point, I")):
        y = 180
        yield from hatched(x - 70, y, x + 70, y)
        if half:
            yield f'<path d="M{x} {y} L{x - half} 54 L{x + half} 54z" fill="{GLOW}"/>'
            yield line(x - half, 52, x + half, 52, LAMP, 7)
        else:
            yield circle(x, 52, 6, LAMP, WARM)
        yield dashed(x, y, x, 60, WARM)
        yield symbol(x + 14, 128, "d", INK, "start")
        yield text(x, 34, name, WARM)
        yield circle(x, y, 4)
        yield text(x, y + 36, "L_e A/d²" if half == 44 else "the same" if half else "I/d²")


@diagram("lamp-cone", 520, 280)
def lamp_cone():
    """The cone that a sphere fills, and the chord of one direction."""
    x, y = 70, 150
    cx, r = 360, 96
    d = cx - x
    edge = math.degrees(math.asin(r / d))
    yield circle(cx, y, r, SAND, SOFT)
    for side in (-1, 1):
        a = math.radians(edge) * side
        reach = math.sqrt(d * d - r * r)
        yield line(x, y, x + reach * math.cos(a), y - reach * math.sin(a), SOFT, 1.4)
    cosine, sine = math.cos(math.radians(edge)), math.sin(math.radians(edge))
    yield line(x + d * cosine**2, y + d * cosine * sine, cx, y, INK, 1.4)
    yield symbol(cx - 6, y + 54, "r", INK, "start")
    yield dashed(x, y, cx, y)
    yield symbol((x + cx) / 2 + 10, y + 26, "d")
    a = math.radians(9.5)
    near = d * math.cos(a) - math.sqrt(r * r - (d * math.sin(a)) ** 2)
    far = d * math.cos(a) + math.sqrt(r * r - (d * math.sin(a)) ** 2)
    yield line(x, y, x + near * math.cos(a), y - near * math.sin(a), WARM, 2.4, True)
    yield dashed(
        x + near * math.cos(a), y - near * math.sin(a), x + far * math.cos(a), y - far * math.sin(a), WARM
    )
    yield from angle(x, y, 90 - edge, 90, 150, "", SOFT)
    yield symbol(x + 176, y - 62, "t_m", SOFT)
    yield from angle(x, y, 80.5, 90, 96, "", WARM)
    yield symbol(x + 112, y - 4, "θ", WARM)
    foot = d * math.cos(a)
    yield line(cx, y, x + foot * math.cos(a), y - foot * math.sin(a), COOL, 1.6)
    yield text(cx + 8, y - 16, "d sin θ", COOL, "start", "italic")
    yield text(320, y - 68, "half chord", WARM, "start")
    yield circle(x, y, 4.5)
    yield symbol(x - 20, y + 6, "x")
    yield circle(cx, y, 3.5)
    yield text(260, 272, "sin t_m = r/d", SOFT)


@diagram("who-counts", 540, 150)
def who_counts():
    """The vertex before, what was hit, and which of the two counts."""
    rows = (
        ("the vertex before", "rectangle, sphere", "plane, triangle"),
        ("none: the camera", "the hit counts", "the hit counts"),
        ("it asked the lights", "the question counted", "the hit counts"),
    )
    fills = [(1, 1, GLASS), (1, 2, GLASS), (2, 1, GLOW), (2, 2, GLASS)]
    yield from boxes(6, 12, rows, (176, 190, 162), 42, fills)


@diagram("inverse-square", 520, 230)
def inverse_square():
    """One cone of light from a point, and the areas that it covers."""
    x, y = 50, 110
    yield f'<path d="M{x} {y} L450 30 L450 190z" fill="{GLOW}"/>'
    for d, name in ((1, "d"), (2, "2 d")):
        at, half = x + 200 * d, 40 * d
        yield line(at, y - half, at, y + half, WARM, 4)
        yield text(at, 212, f"area {'A' if d == 1 else '4 A'}, I/{'d²' if d == 1 else '(4 d²)'}", WARM)
        yield dashed(at, y + half, at, 194)
    yield line(x, y, 248, y, SOFT, 1.4, True)
    yield symbol(150, y - 8, "d")
    yield circle(x, y, 6, LAMP, WARM)
    yield text(x, y + 28, "I", WARM, style="italic")


@diagram("area-to-angle", 520, 330)
def area_to_angle():
    """A patch of a lamp, turned to face x, and its projection on a sphere."""
    x, y, r = 150, 285, 105
    px, py, half, tilt = 405, 90, 50, 40  # the patch, and how it is tilted
    towards = math.degrees(math.atan2(px - x, y - py))
    u = math.radians(90 + towards - tilt)  # along the patch, from straight up
    ends = [(px + s * half * math.sin(u), py - s * half * math.cos(u)) for s in (-1, 1)]
    yield line(20, y, 340, y, INK, 2)
    (ax, ay), (bx, by) = ends
    yield f'<path d="M{x} {y} L{ax:.1f} {ay:.1f} L{bx:.1f} {by:.1f}z" fill="{GLOW}"/>'
    yield curve([polar(x, y, a, r) for a in range(-90, 91, 3)], SOFT, 1.2, "4 3")
    seen = [math.degrees(math.atan2(ex - x, y - ey)) for ex, ey in ends]
    yield curve([polar(x, y, seen[0] + (seen[1] - seen[0]) * i / 12, r) for i in range(13)], COOL, 6)
    yield text(*polar(x, y, towards - 22, r + 12), "dω", COOL, "middle", "italic")
    yield line(ax, ay, bx, by, WARM, 6)
    yield symbol(bx + 18, by + 8, "dA", WARM, "start")
    face = math.radians(90 + towards)
    h = half * math.cos(math.radians(tilt))
    cx, cy = [(px + s * h * math.sin(face), py - s * h * math.cos(face)) for s in (-1, 1)]
    yield line(*cx, *cy, GREEN, 3, False, "6 4")
    yield symbol(cx[0] - 8, cx[1] - 12, "cos θ′ dA", GREEN, "middle")
    yield dashed(x, y, px, py, INK)
    yield symbol(284, 212, "d", INK, "start")
    back = 180 + towards
    yield from arrow(px, py, *polar(px, py, back - tilt, 84), "n′", WARM)
    yield from angle(px, py, back - tilt, back, 40, "θ′", WARM)
    yield dashed(x, y, x, y - 150)
    yield symbol(x - 14, y - 136, "n")
    yield text(*polar(x, y, -48, r + 10), "radius 1", SOFT, "end", size=14)
    yield circle(x, y, 4.5)
    yield symbol(x, y + 30, "x")


@diagram("visible-share", 520, 250)
def visible_share():
    """The cap of a sphere that is seen from x."""
    x, cx, y, r = 60, 340, 120, 92
    d = cx - x
    alpha = math.degrees(math.acos(r / d))
    yield circle(cx, y, r, SAND, SOFT)
    top, bottom = polar(cx, y, -90 + alpha, r), polar(cx, y, -90 - alpha, r)
    yield f'<path d="M{bottom[0]:.1f} {bottom[1]:.1f} A{r} {r} 0 0 1 {top[0]:.1f} {top[1]:.1f}" fill="none" stroke="{LAMP}" stroke-width="7"/>'
    for end in (top, bottom):
        yield line(x, y, *end, SOFT, 1.4)
    yield line(cx, y, *top, INK, 1.4)
    yield symbol(cx - 4, y - 50, "r", INK, "start")
    yield dashed(x, y, cx, y)
    yield symbol(150, y + 24, "d")
    yield from angle(cx, y, -90, -90 + alpha, 30, "α")
    yield text(x + 50, 40, "visible", WARM, "start")
    yield line(x + 104, 46, 256, 88, WARM, 1, True)
    yield text(cx + 104, y + 6, "far side", SOFT, "start", size=14)
    yield circle(x, y, 4.5)
    yield symbol(x - 18, y + 6, "x")
    yield circle(cx, y, 3.5)
    yield text(260, 240, "cos α = r/d")


@diagram("three-answers", 520, 220)
def three_answers():
    """A light that is seen, one that is hidden, and one below the horizon."""
    for x, name, color in ((85, "adds light", GREEN), (260, "blocked: 0", WARM), (435, "cos θ ≤ 0: 0", SOFT)):
        y = 150
        yield from hatched(x - 72, y, x + 72, y)
        yield dashed(x, y, x, y - 84)
        yield symbol(x - 14, y - 74, "n")
        light = (x + 48, 40) if color != SOFT else (x + 58, 186)
        yield circle(*light, 6, LAMP, WARM)
        if color == WARM:
            yield line(x, y, x + 20, 104, WARM, 1.8, True)
            yield circle(x + 27, 86, 17, GLASS, COOL)
        elif color == GREEN:
            yield line(x, y, light[0] - 3, light[1] + 8, GREEN, 1.8, True, "6 4")
            yield from angle(x, y, 0, 23, 40, "θ")
        else:
            yield dashed(x, y, light[0] - 4, light[1] - 4)
        yield circle(x, y, 4.5)
        yield text(x, 212, name, color if color != SOFT else INK)


@diagram("told-path", 520, 320)
def told_path():
    """The path of the transcript, from the side."""
    yield from hatched(40, 280, 500, 280)
    yield from hatched(40, 30, 40, 280)
    yield text(52, 110, "red wall", WARM, "start")
    yield line(250, 34, 390, 34, LAMP, 8)
    yield text(320, 22, "lamp", WARM)
    yield circle(215, 190, 46, GLASS, COOL)
    yield text(215, 196, "ball", COOL)
    zero, one, two = (120, 280), (40, 240), (268, 40)
    yield line(470, 200, *zero, INK, 2.2, True)
    yield text(476, 194, "camera", SOFT, "end")
    yield line(*zero, *one, INK, 2.2, True)
    yield line(*one, *two, INK, 2.2, True)
    yield line(*zero, 179, 223, WARM, 1.8, True, "6 4")
    yield line(*one, 336, 42, GREEN, 1.8, True, "6 4")
    yield text(262, 112, "reached", GREEN, "start")
    yield text(142, 238, "blocked", WARM, "end")
    yield text(240, 62, "hit: not added", INK, "end")
    for (px, py), name, dx, dy in ((zero, "0", 0, 32), (one, "1", -18, 6), (two, "2", 16, 24)):
        yield circle(px, py, 4.5)
        yield symbol(px + dx, py + dy, name)


def rendered(stage, spp, seed, mistake=None):
    """One of the two renders to compare, as .exr and .pfm."""
    words = f"--size 48x48 --spp {spp} --seed {seed}".split()
    one = Render(stage, "scenes/cornell_box_lamp_diffuse.toml", words, mistake=mistake)
    return one.files(".exr", ".pfm")[:2]


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
    """What stage-diff says of two images."""
    done = subprocess.run([BUILD / "stage-diff", "--json", a, b], check=False, capture_output=True, text=True)
    if done.returncode > 1:
        raise Failure(f"drawing 'stage-2-minus-1': {done.stderr.strip()}")
    return json.loads(done.stdout)


@diagram("stage-2-minus-1", 520, 320)
def stage_2_minus_1():
    """Differences of two renders, and what stage-diff says of them."""
    found = rendered(1, 1024, 1)
    for x, name, mistake in (
        (8, "stage 2 − stage 1", None),
        (268, "the lamp counted twice", "lamps-counted-twice"),
    ):
        asked = rendered(2, 256, 2, mistake)
        data = base64.b64encode(difference(asked[1], found[1])).decode()
        yield (
            f'<image x="{x}" y="8" width="244" height="244" style="image-rendering:pixelated" '
            f'href="data:image/png;base64,{data}"/>'
        )
        said = verdict_on(asked[0], found[0])
        yield text(x + 122, 278, name)
        verdict = "the same" if said["same"] else "different"
        yield text(x + 122, 306, f"largest z {said['worst']['z']:.1f}: {verdict}", SOFT)
