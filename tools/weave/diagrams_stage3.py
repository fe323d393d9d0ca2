"""The drawings of chapter 3."""

import math

from tools.weave.drawing import (
    COOL,
    GLASS,
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
    dashed,
    diagram,
    hatched,
    line,
    polar,
    text,
    tree,
)
from tools.weave.renders import Render


@diagram("refraction-parts", 520, 330)
def refraction_parts():
    """The refracted direction, and its parts."""
    x, y, a, r = 250, 170, 52, 140
    b = math.degrees(math.asin(math.sin(math.radians(a)) / 1.5))
    yield f'<path d="M60 {y} H460 V320 H60z" fill="{GLASS}"/>'
    yield line(60, y, 460, y, COOL, 2)
    yield dashed(x, y, x, y + 146)
    yield from arrow(x, y, x, y - 118, "n")
    up, down = polar(x, y, -a, r), polar(x, y, 180 - b, r)
    yield from arrow(x, y, *up, "w_o", COOL, 2.4)
    yield from arrow(x, y, *down, "w_t", WARM, 2.4)
    yield line(up[0], up[1], x, up[1], SOFT, 1.4)
    yield text((up[0] + x) / 2 + 4, up[1] - 10, "sin t_o", COOL)
    yield line(x, down[1], down[0], down[1], SOFT, 1.4)
    yield text(down[0] + 20, down[1] - 2, "sin t_i", WARM, "start")
    yield text(x - 12, y + 96, "cos t_i", WARM, "end")
    yield from angle(x, y, -a, 0, 44, "t_o")
    yield from angle(x, y, 180, 180 - b, 52, "t_i")
    yield text(452, y - 12, "e_o", SOFT, "end")
    yield text(452, y + 30, "e_i", SOFT, "end")
    yield circle(x, y, 4)


@diagram("mirror-parts", 520, 400)
def mirror_parts():
    """wo and its mirror image, each as a sum of two parts; and the wrong one."""
    x, y, a, r = 260, 240, 48, 165
    left, right, wrong = polar(x, y, -a, r), polar(x, y, a, r), polar(x, y, a - 180, 150)
    yield from hatched(x - 220, y, x + 220, y)
    yield from arrow(x, y, *left, "w_o", COOL, 2.4)
    yield from arrow(x, y, *right, "w_r", WARM, 2.4)
    yield line(x, y, *wrong, SOFT, 2, True, "6 5")
    yield text(wrong[0] - 10, wrong[1] + 30, "wrong sign", SOFT)
    yield line(x, y, x, left[1], GREEN, 2.4, True)
    yield line(x, left[1], left[0] + 4, left[1], COOL, 1.6, True)
    yield line(x, left[1], right[0] - 4, right[1], WARM, 1.6, True)
    yield text(x, 50, "along the normal: kept", GREEN)
    yield dashed(x, 60, x, left[1] - 6, GREEN)
    yield text(x - 66, left[1] - 12, "the rest", COOL)
    yield text(x + 66, left[1] - 12, "turned", WARM)
    yield from angle(x, y, -a, 0, 46, "θ")
    yield from angle(x, y, 0, a, 46, "θ")
    yield circle(x, y, 4)


@diagram("critical-cone", 520, 330)
def critical_cone():
    """Paths of an eye in glass, within the critical cone and beyond it."""
    x, y, r = 260, 160, 128
    critical = math.degrees(math.asin(1 / 1.5))
    yield f'<path d="M40 {y} H480 V320 H40z" fill="{GLASS}"/>'
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{SAND}" stroke="{SOFT}"/>'
    a, b = polar(x, y, 180 + critical, r), polar(x, y, 180 - critical, r)
    yield (
        f'<path d="M{x} {y} L{a[0]:.1f} {a[1]:.1f} A{r} {r} 0 0 0 {b[0]:.1f} {b[1]:.1f}z" '
        f'fill="{SAND}" stroke="{WARM}"/>'
    )
    yield line(40, y, 480, y, COOL, 2)
    for within in (-39, -28, -14, 14, 28, 39):
        out = math.degrees(math.asin(1.5 * math.sin(math.radians(within))))
        yield line(*polar(x, y, 180 + within, r - 6), x, y, WARM, 1.6)
        yield line(x, y, *polar(x, y, out, r + 20), WARM, 1.6, True)
    yield line(*polar(x, y, 180 + 62, 170), x, y, COOL, 1.8)
    yield line(x, y, *polar(x, y, 180 - 62, 170), COOL, 1.8, True)
    yield text(x + 84, y + 124, "41.8°", INK, "start")
    yield text(470, y + 36, "reflected", COOL, "end")
    yield text(48, y - 12, "air", SOFT, "start")
    yield text(48, y + 150, "glass", SOFT, "start")


def disk(x, radius, scale, name, area):
    """Directions from the side, above, and as points of a disk, below."""
    side, above, unit = 146, 356, 96
    turn = 180 if scale < 1 else 0
    edge = math.degrees(math.asin(scale))
    arc = [polar(x, side, turn + edge * i / 24, unit) for i in range(-24, 25)]
    path = " ".join(f"{px:.1f},{py:.1f}" for px, py in ((x, side), *arc))
    yield f'<polygon points="{path}" fill="{SAND}" stroke="{SOFT}"/>'
    yield line(x - unit - 14, side, x + unit + 14, side, COOL, 2)
    for out in (-70, -45, -20, 20, 45, 70):
        within = math.degrees(math.asin(scale * math.sin(math.radians(out))))
        yield line(x, side, *polar(x, side, turn - within if turn else within, unit), WARM, 1.6, True)
    yield circle(x, above, unit, "none", SOFT)
    yield circle(x, above, unit * scale, SAND, WARM)
    for ring in (20, 45, 70):
        for step in range(12):
            px, py = polar(x, above, 30 * step, unit * scale * math.sin(math.radians(ring)))
            yield circle(px, py, 2.4, WARM)
    yield text(x, 34, name)
    yield text(x, above + unit + 30, f"radius {radius}")
    yield text(x, above + unit + 54, f"area {area}", WARM)


@diagram("radiance-disks", 520, 526)
def radiance_disks():
    yield from disk(135, "1", 1, "outside", "π")
    yield from disk(385, "1/1.5", 1 / 1.5, "in the glass", "π/2.25")


def bent(d_x, d_y, n_x, n_y, ratio):
    """Snell's law in the plane; the normal is against the ray."""
    cosine = -(d_x * n_x + d_y * n_y)
    k = ratio * cosine - math.sqrt(1 - ratio * ratio * (1 - cosine * cosine))
    return ratio * d_x + k * n_x, ratio * d_y + k * n_y


def through_ball(x, y, radius, light, degrees):
    """Where a ray from the light enters the ball, leaves it, and goes on to."""
    d_x, d_y = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    o_x, o_y = light[0] - x, light[1] - y
    b = o_x * d_x + o_y * d_y
    t = -b - math.sqrt(b * b - (o_x * o_x + o_y * o_y - radius * radius))
    p_x, p_y = o_x + t * d_x, o_y + t * d_y
    e_x, e_y = bent(d_x, d_y, p_x / radius, p_y / radius, 1 / 1.5)
    t = -2 * (p_x * e_x + p_y * e_y)
    q_x, q_y = p_x + t * e_x, p_y + t * e_y
    f_x, f_y = bent(e_x, e_y, -q_x / radius, -q_y / radius, 1.5)
    return (x + p_x, y + p_y), (x + q_x, y + q_y), (f_x, f_y)


@diagram("glass-shadow", 520, 360)
def glass_shadow():
    x, y, radius, light, floor = 240, 186, 52, (240, 40), 316
    yield circle(x, y, radius, GLASS, COOL)
    yield from hatched(40, floor, 480, floor)
    for degrees in (-15, -10, -5, 5, 10, 15):
        first, second, d = through_ball(x, y, radius, light, degrees)
        reach = (floor - second[1]) / d[1]
        yield line(*light, *first, WARM, 1.6)
        yield line(*first, *second, WARM, 1.6)
        yield line(*second, second[0] + reach * d[0], floor, WARM, 1.6)
    yield circle(*light, 6, LAMP, WARM)
    yield text(light[0] + 18, light[1] + 4, "point light", WARM, "start")
    at = (290, floor)
    away = math.hypot(light[0] - at[0], light[1] - at[1])
    u_x, u_y = (light[0] - at[0]) / away, (light[1] - at[1]) / away
    b = (at[0] - x) * u_x + (at[1] - y) * u_y
    stop = -b - math.sqrt(b * b - ((at[0] - x) ** 2 + (at[1] - y) ** 2 - radius**2))
    yield line(*at, at[0] + stop * u_x, at[1] + stop * u_y, GREEN, 2.2, True, "6 4")
    yield text(304, floor - 40, "shadow ray: stopped", GREEN, "start")
    yield text(x, floor + 34, "caustic", WARM)


@diagram("tree", 520, 330)
def tree_of_rays():
    """Two lobes at every hit: one, two, four, eight rays."""
    leaf = ("", [])
    node = ("", [("", [leaf, leaf]), ("", [leaf, leaf])])
    yield from tree(200, 62, 360, ("", [node, node]), 66)
    for level in range(4):
        yield text(430, 67 + 66 * level, str(2**level), WARM)
        yield text(490, 67 + 66 * level, str(2**level) if level < 3 else "0", GREEN)
    yield text(424, 26, "rays", WARM)
    yield text(486, 26, "shadow", GREEN)
    yield text(330, 312, "in all", INK, "end")
    yield text(430, 312, "15", WARM)
    yield text(490, 312, "7", GREEN)


@diagram("tree-counts", 520, 122)
def tree_counts():
    """The formula beside what the program counts."""
    bounds = (1, 2, 4, 6, 8, 10)
    counts = []
    for bound in bounds:
        options = f"--size 16x16 --spp 16 --max-bounces {bound}".split()
        count = Render(3, "scenes/plastic.toml", options).rays_per_sample()
        counts.append(f"{count:.3g}" if count < 1000 else f"{float(f'{count:.3g}'):,.0f}")
    rows = (
        ("bounces", *map(str, bounds)),
        ("formula", *(f"{3 * 2**n - 2:,}" for n in bounds)),
        ("counted", *counts),
    )
    yield from boxes(5, 8, rows, (92, 62, 62, 66, 70, 76, 82), 35)
