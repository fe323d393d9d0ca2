"""Drawings of chapter 7 and its deck."""

import math

from tools.weave import drawing as d


@d.diagram("two-walks", 520, 330)
def two_walks():
    """A photon's walk and a path from the camera that ends near it."""
    floor = 270
    yield from d.hatched(30, floor, 490, floor)
    yield from d.hatched(490, floor, 490, 60)
    yield d.circle(290, 40, 8, d.LAMP, d.WARM)
    yield d.text(272, 46, "light", d.WARM, "end")
    yield d.circle(300, 180, 42, d.GLASS, d.SOFT)
    yield d.line(290, 48, 284, 141, d.WARM, 2, True)
    yield d.line(284, 141, 296, 222, d.WARM, 2, True)
    yield d.line(296, 222, 312, floor - 3, d.WARM, 2, True)
    yield d.line(312, floor, 486, 150, d.WARM, 2, True)
    yield d.text(420, 228, "photon", d.WARM, "start")
    for x in (276, 290, 297, 306, 312, 324, 340, 180, 110):
        yield d.circle(x, floor, 4, d.WARM)
    for y in (150, 100, 210):
        yield d.circle(490, y, 4, d.WARM)
    yield f'<ellipse cx="270" cy="{floor}" rx="50" ry="11" fill="none" stroke="{d.COOL}" stroke-width="2"/>'
    yield d.line(50, 90, 268, floor - 3, d.COOL, 2, True)
    yield d.text(46, 76, "camera", d.COOL, "start")
    yield d.text(120, 196, "path", d.COOL, "end")
    yield d.line(270, floor - 4, 275, 216, d.GREEN, 1.6, True, "5 4")
    yield d.text(246, 146, "shadow ray,", d.GREEN, "end")
    yield d.text(246, 166, "blocked", d.GREEN, "end")
    yield d.text(270, floor + 38, "photons in a disk", d.COOL)


@d.diagram("photon-start", 520, 220)
def photon_start():
    """Directions of photons: alike from a point, by the cosine from a lamp."""
    x, y = 120, 105
    for i in range(16):
        yield d.ray(x, y, i * 22.5, 70, d.WARM)
    yield d.circle(x, y, 8, d.LAMP, d.WARM)
    yield d.text(x, 208, "a point light")
    x, y = 380, 150
    yield d.line(x - 100, y, x + 100, y, d.LAMP, 8)
    yield d.dashed(x, y, x, 20)
    yield d.symbol(x + 14, 32, "n", d.INK, "start")
    for i in range(9):
        yield d.ray(x, y, math.degrees(math.asin((i - 4) / 4.5)), 90, d.WARM)
    yield d.text(x, 208, "a lamp")


@d.diagram("squeezed-light", 520, 290)
def squeezed_light():
    """Five photons that go into glass, and their two cones."""
    x, y = 260, 140
    yield f'<rect x="20" y="{y}" width="480" height="140" fill="{d.GLASS}"/>'
    yield d.line(20, y, 500, y, d.INK, 2.2)
    yield d.dashed(x, 12, x, 278)
    for degrees in (-64, -32, 0, 32, 64):
        inside = math.degrees(math.asin(math.sin(math.radians(degrees)) / 1.5))
        px, py = d.polar(x, y, degrees, 128)
        yield d.line(px, py, x, y, d.WARM, 2)
        qx, qy = x + 124 * math.sin(math.radians(-inside)), y + 124 * math.cos(math.radians(inside))
        yield d.line(x, y, qx, qy, d.WARM, 2, True)
    yield d.arc(x, y, -64, 64, 70, d.SOFT)
    yield d.arc(x, y, 180 - 36.8, 180 + 36.8, 70, d.SOFT)
    yield d.text(36, 34, "air", anchor="start")
    yield d.text(36, 270, "glass, 1.5", anchor="start")
    yield d.text(484, 62, "wide cone", d.SOFT, "end")
    yield d.text(484, 214, "narrow cone", d.SOFT, "end")


@d.diagram("photon-disk", 520, 290)
def photon_disk():
    """The disk that reaches the sixth photon."""
    x, y, r = 220, 145, 104
    yield d.circle(x, y, r, d.GLOW, d.COOL)
    inside = ((30, -42), (-58, 20), (-30, -70), (62, 40), (-12, 66))
    for dx, dy in inside:
        yield d.circle(x + dx, y + dy, 5, d.WARM)
    rim = d.polar(x, y, 62, r)
    yield d.line(x, y, *rim, d.COOL, 1.6, True)
    yield d.circle(*rim, 5.5, d.PAPER, d.WARM)
    for px, py in ((60, 60), (80, 220), (372, 216), (420, 60), (458, 150), (370, 262), (30, 140), (480, 250)):
        yield d.circle(px, py, 5, d.SOFT)
    yield d.circle(x, y, 4)
    yield d.symbol(x - 14, y + 18, "x")
    yield d.symbol(x + 52, y - 8, "r", d.COOL)
    yield d.text(rim[0] + 14, rim[1] + 2, "sets the radius", d.WARM, "start")
    yield d.text(x, y + r + 30, "5 photons count")


# Root mean square of the error over the mean, of all three channels: 32 x 32
# pixels of scenes/cornell_box_point_diffuse.toml, with --photons 10000 --seed 5,
# beside stage 2 with 16,384 samples and --max-bounces 64.
SAMPLES = (1, 4, 16, 64, 256)
ERRORS = (
    ("k = 10", d.WARM, (0.3016, 0.1734, 0.1094, 0.0661, 0.0456)),
    ("k = 50", d.COOL, (0.1658, 0.1037, 0.0722, 0.0544, 0.0442)),
    ("k = 500", d.GREEN, (0.1793, 0.1483, 0.1269, 0.1083, 0.0924)),
    ("paths", d.SOFT, (0.5556, 0.2836, 0.1409, 0.0690, 0.0356)),
)


@d.diagram("bias-and-noise", 520, 330)
def bias_and_noise():
    """The error against the number of samples, both logarithmic."""
    x, y, width, height = 70, 270, 330, 240
    yield from d.axes(x, y, width, height)

    def place(samples, error):
        return x + width * math.log(samples) / math.log(256), y - height * math.log(error / 0.02) / math.log(
            50
        )

    for samples in SAMPLES:
        yield d.text(place(samples, 1)[0], y + 22, str(samples), d.SOFT)
    for error, label in ((0.02, "2 %"), (0.1, "10 %"), (0.5, "50 %")):
        yield d.text(x - 8, place(1, error)[1] + 5, label, d.SOFT, "end")
    for label, color, errors in ERRORS:
        points = [place(*one) for one in zip(SAMPLES, errors, strict=True)]
        yield d.curve(points, color, 2, "6 3" if label == "paths" else "")
        yield from d.dots(points, color, 3.5)
        shift = {"k = 10": -6, "k = 50": 10, "paths": 22}.get(label, 5)
        yield d.text(x + width + 12, points[-1][1] + shift, label, color, "start")
    yield d.text(x + width / 2, y + 46, "samples of each pixel")
    yield d.text(x, 18, "error", anchor="start")
