"""The lab's box and its camera, drawn with axes and with the scene's numbers."""

import math
import tomllib

from compare.stages import ROOT
from tools.weave.drawing import (
    COOL,
    FAINT,
    GLASS,
    GREEN,
    INK,
    LAMP,
    RED,
    SAND,
    SOFT,
    WARM,
    arrow,
    circle,
    dashed,
    diagram,
    line,
    symbol,
    text,
)

BOX = "scenes/cornell_box_point.toml"
OPENING = -1  # the box is open towards -z; it is drawn up to here


def scene():
    return tomllib.loads((ROOT / BOX).read_text())


def numbers(values):
    return "(" + ", ".join(f"{value:g}".replace("-", "−") for value in values) + ")"


def face(project, corners, color, opacity=1.0):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (project(*corner) for corner in corners))
    return f'<polygon points="{path}" fill="{color}" fill-opacity="{opacity}" stroke="{SOFT}"/>'


def balls(box):
    """Left and right, as the scene has them."""
    return [shape for shape in box["shapes"] if shape["type"] == "sphere"]


def walls(project):
    """The five planes, the farthest first."""
    near, far = OPENING, 1
    yield face(project, [(-1, -1, far), (1, -1, far), (1, 1, far), (-1, 1, far)], FAINT, 0.35)
    for y in (-1, 1):
        yield face(project, [(-1, y, near), (1, y, near), (1, y, far), (-1, y, far)], FAINT, 0.2)
    for x, color in ((-1, RED), (1, GREEN)):
        yield face(project, [(x, -1, near), (x, -1, far), (x, 1, far), (x, 1, near)], color, 0.2)


@diagram("box-axes", 680, 484)
def box_with_axes():
    """Seen from in front of the box, a little to the right and above."""
    box = scene()

    def scale(z):
        return 480 / (z + 3.2)

    def project(x, y, z):
        return 366 + scale(z) * (x - 0.5), 132 - scale(z) * (y - 0.45)

    def put(at, words, color, dx=0, dy=0, anchor="middle"):
        x, y = project(*at)
        return text(x + dx, y + dy, words, color, anchor)

    def pointed(start, end, color, width=2):
        return line(*project(*start), *project(*end), color, width, True)

    yield from walls(project)
    for start, end in (
        ((-1, 0.3, -0.2), (-0.62, 0.3, -0.2)),
        ((1, 0.3, -0.2), (0.62, 0.3, -0.2)),
        ((0, -1, -0.2), (0, -0.6, -0.2)),
        ((0.5, 1, -0.2), (0.5, 0.62, -0.2)),
    ):
        yield pointed(start, end, SOFT)
        x, y = project(*end)
        yield symbol(x + 16, y - 8, "n", SOFT)
    yield put((-1, -0.3, OPENING), "x = −1", RED, 8, 0, "start")
    yield put((1, -0.3, OPENING), "x = 1", GREEN, 8, 0, "start")
    yield put((-0.2, 1, OPENING), "y = 1", INK, 0, 34)
    yield put((0, -1, OPENING), "y = −1", INK, 0, -12)
    yield put((-1, 1, 1), "z = 1", INK, 8, 26, "start")
    for end, name, dx, dy in (
        ((0.45, 0, 0), "x", 14, 6),
        ((0, 0.36, 0), "y", -14, 8),
        ((0, 0, 1), "z", 16, 0),
    ):
        yield pointed((0, 0, 0), end, INK, 2.4)
        x, y = project(*end)
        yield symbol(x + dx, y + dy, name)
    yield circle(*project(0, 0, 0), 4)
    yield put((0, 0, 0), "0", INK, -14, 14)
    for ball, color, fill, label in zip(balls(box), (COOL, WARM), (GLASS, SAND), (190, 500)):
        x, y = project(*ball["center"])
        r = scale(ball["center"][2]) * ball["radius"]
        yield circle(x, y, round(r, 1), fill, color)
        yield dashed(label, 456, x, y, color)
        yield circle(x, y, 3.5, color)
        yield line(x, y, x + r, y, color, 1.4)
        yield symbol(x + r / 2, y - 6, "r", color)
        yield text(label, 476, numbers(ball["center"]), color)
    yield text(345, 476, f"r = {ball['radius']:g}", INK)
    light = box["lights"][0]["center"]
    x, y = project(*light)
    yield circle(x, y, 7, LAMP, WARM)
    yield text(x + 14, y + 7, numbers(light), WARM, "start")


@diagram("box-camera", 680, 390)
def box_with_camera():
    """From the left: z runs to the right, and what is nearer to you has the
    smaller x. The walls on this side are transparent."""
    box = scene()
    camera = box["camera"]
    size = 112

    def project(x, y, z):
        return 470 + size * (z + 0.42 * x), 190 - size * (y + 0.34 * x)

    def put(at, words, color, dx, dy, anchor="middle"):
        x, y = project(*at)
        return text(x + dx, y + dy, words.replace("-", "−"), color, anchor)

    def moved(point, vector, of=1.0):
        return [a + of * b for a, b in zip(point, vector)]

    origin, forward = camera["origin"], camera["forward"]
    center = moved(origin, forward)
    left, up = moved(center, camera["left"]), moved(center, camera["up"])
    z = center[2]
    yield from walls(project)
    for ball, color, fill in zip(balls(box)[::-1], (WARM, COOL), (SAND, GLASS)):
        yield circle(*project(*ball["center"]), round(size * ball["radius"], 1), fill, color)
    yield face(project, [(-1, -1, z), (1, -1, z), (1, 1, z), (-1, 1, z)], SAND, 0.8)
    for y in (-1, 1):
        yield dashed(*project(*origin), *project(-1, y, z))
    way = [a - b for a, b in zip(ball["center"], origin)]
    hit = moved(ball["center"], way, -ball["radius"] / math.hypot(*way))
    yield line(*project(*origin), *project(*hit), COOL, 2, True)
    yield circle(*project(*moved(origin, way, (z - origin[2]) / way[2])), 4.5, COOL)
    yield line(*project(*origin), *project(*center), INK, 2.4, True)
    yield line(*project(*center), *project(*left), WARM, 2.4, True)
    yield line(*project(*center), *project(*up), GREEN, 2.4, True)
    yield circle(*project(*origin), 5)
    yield put(origin, f"O = {numbers(origin)}", INK, -36, -64, "start")
    yield put(center, f"F = {numbers(forward)}", INK, -122, -10)
    yield put(left, f"L = {numbers(camera['left'])}", WARM, -8, -6, "end")
    yield put(up, f"U = {numbers(camera['up'])}", GREEN, -60, -14, "end")
    yield put((-1, -1, z), f"image plane, z = {z:g}", INK, -6, 32)
    yield put((-1, -1, 1), "z = 1", INK, 0, 32)
    x, y = 54, 84
    for name, dx, dy in (("z", 46, 0), ("y", 0, -46), ("x", 26, -20)):
        yield from arrow(x, y, x + dx, y + dy, name, INK, 1.8)
