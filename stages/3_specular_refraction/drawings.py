"""Drawings of chapter 3 and its deck."""

import math

from tools.weave import drawing as d
from tools.weave.renders import Render


@d.diagram("refraction-parts", 520, 330)
def refraction_parts():
    """The refracted direction, and its parts."""
    x, y, a, r = 250, 170, 52, 140
    b = math.degrees(math.asin(math.sin(math.radians(a)) / 1.5))
    yield f'<path d="M60 {y} H460 V320 H60z" fill="{d.GLASS}"/>'
    yield d.line(60, y, 460, y, d.COOL, 2)
    yield d.dashed(x, y, x, y + 146)
    yield from d.arrow(x, y, x, y - 118, "n")
    up, down = d.polar(x, y, -a, r), d.polar(x, y, 180 - b, r)
    yield from d.arrow(x, y, *up, "w_o", d.COOL, 2.4)
    yield from d.arrow(x, y, *down, "w_t", d.WARM, 2.4)
    yield d.line(up[0], up[1], x, up[1], d.SOFT, 1.4)
    yield d.text((up[0] + x) / 2 + 4, up[1] - 10, "sin t_o", d.COOL)
    yield d.line(x, down[1], down[0], down[1], d.SOFT, 1.4)
    yield d.text(down[0] + 20, down[1] - 2, "sin t_i", d.WARM, "start")
    yield d.text(x - 12, y + 96, "cos t_i", d.WARM, "end")
    yield from d.angle(x, y, -a, 0, 44, "t_o")
    yield from d.angle(x, y, 180, 180 - b, 52, "t_i")
    yield d.text(452, y - 12, "e_o", d.SOFT, "end")
    yield d.text(452, y + 30, "e_i", d.SOFT, "end")
    yield d.circle(x, y, 4)


@d.diagram("mirror-parts", 520, 400)
def mirror_parts():
    """wo and its mirror image, each as a sum of two parts; and the wrong one."""
    x, y, a, r = 260, 240, 48, 165
    left, right, wrong = d.polar(x, y, -a, r), d.polar(x, y, a, r), d.polar(x, y, a - 180, 150)
    yield from d.hatched(x - 220, y, x + 220, y)
    yield from d.arrow(x, y, *left, "w_o", d.COOL, 2.4)
    yield from d.arrow(x, y, *right, "w_r", d.WARM, 2.4)
    yield d.line(x, y, *wrong, d.SOFT, 2, True, "6 5")
    yield d.text(wrong[0] - 10, wrong[1] + 30, "wrong sign", d.SOFT)
    yield d.line(x, y, x, left[1], d.GREEN, 2.4, True)
    yield d.line(x, left[1], left[0] + 4, left[1], d.COOL, 1.6, True)
    yield d.line(x, left[1], right[0] - 4, right[1], d.WARM, 1.6, True)
    yield d.text(x, 50, "along the normal: kept", d.GREEN)
    yield d.dashed(x, 60, x, left[1] - 6, d.GREEN)
    yield d.text(x - 66, left[1] - 12, "the rest", d.COOL)
    yield d.text(x + 66, left[1] - 12, "turned", d.WARM)
    yield from d.angle(x, y, -a, 0, 46, "θ")
    yield from d.angle(x, y, 0, a, 46, "θ")
    yield d.circle(x, y, 4)


@d.diagram("critical-cone", 520, 330)
def critical_cone():
    """Paths of an eye in glass, within the critical cone and beyond it."""
    x, y, r = 260, 160, 128
    critical = math.degrees(math.asin(1 / 1.5))
    yield f'<path d="M40 {y} H480 V320 H40z" fill="{d.GLASS}"/>'
    yield f'<path d="M{x - r} {y} A{r} {r} 0 0 1 {x + r} {y}" fill="{d.SAND}" stroke="{d.SOFT}"/>'
    a, b = d.polar(x, y, 180 + critical, r), d.polar(x, y, 180 - critical, r)
    yield (
        f'<path d="M{x} {y} L{a[0]:.1f} {a[1]:.1f} A{r} {r} 0 0 0 {b[0]:.1f} {b[1]:.1f}z" '
        f'fill="{d.SAND}" stroke="{d.WARM}"/>'
    )
    yield d.line(40, y, 480, y, d.COOL, 2)
    for within in (-39, -28, -14, 14, 28, 39):
        out = math.degrees(math.asin(1.5 * math.sin(math.radians(within))))
        yield d.line(*d.polar(x, y, 180 + within, r - 6), x, y, d.WARM, 1.6)
        yield d.line(x, y, *d.polar(x, y, out, r + 20), d.WARM, 1.6, True)
    yield d.line(*d.polar(x, y, 180 + 62, 170), x, y, d.COOL, 1.8)
    yield d.line(x, y, *d.polar(x, y, 180 - 62, 170), d.COOL, 1.8, True)
    yield d.text(x + 84, y + 124, "41.8°", d.INK, "start")
    yield d.text(470, y + 36, "reflected", d.COOL, "end")
    yield d.text(48, y - 12, "air", d.SOFT, "start")
    yield d.text(48, y + 150, "glass", d.SOFT, "start")


def from_above(x, y, unit, scale):
    """The same directions as points of the unit disk, or of a smaller one."""
    yield d.circle(x, y, unit, "none", d.SOFT)
    yield d.circle(x, y, unit * scale, d.SAND, d.WARM)
    for ring in (20, 45, 70):
        for step in range(12):
            px, py = d.polar(x, y, 30 * step, unit * scale * math.sin(math.radians(ring)))
            yield d.circle(px, py, 2.4, d.WARM)


def disk(x, radius, scale, name, area):
    """Directions from the side, above, and as points of a disk, below."""
    side, above, unit = 146, 356, 96
    turn = 180 if scale < 1 else 0
    edge = math.degrees(math.asin(scale))
    arc = [d.polar(x, side, turn + edge * i / 24, unit) for i in range(-24, 25)]
    path = " ".join(f"{px:.1f},{py:.1f}" for px, py in ((x, side), *arc))
    yield f'<polygon points="{path}" fill="{d.SAND}" stroke="{d.SOFT}"/>'
    yield d.line(x - unit - 14, side, x + unit + 14, side, d.COOL, 2)
    for out in (-70, -45, -20, 20, 45, 70):
        within = math.degrees(math.asin(scale * math.sin(math.radians(out))))
        yield d.line(x, side, *d.polar(x, side, turn - within if turn else within, unit), d.WARM, 1.6, True)
    yield from from_above(x, above, unit, scale)
    yield d.text(x, 34, name)
    yield d.text(x, above + unit + 30, f"radius {radius}")
    yield d.text(x, above + unit + 54, f"area {area}", d.WARM)


@d.diagram("radiance-disks", 520, 526)
def radiance_disks():
    yield from disk(135, "1", 1, "outside", "π")
    yield from disk(385, "1/1.5", 1 / 1.5, "in the glass", "π/2.25")


@d.diagram("radiance-areas", 520, 262)
def radiance_areas():
    """The disks alone, with letters for a slide."""
    for x, scale, words in ((130, 1, "outside: π"), (390, 1 / 1.5, "in glass: π/2.25")):
        yield from from_above(x, 110, 104, scale)
        yield d.text(x, 250, words, d.WARM, size=22)


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


@d.diagram("glass-shadow", 520, 360)
def glass_shadow():
    x, y, radius, light, floor = 240, 186, 52, (240, 40), 316
    yield d.circle(x, y, radius, d.GLASS, d.COOL)
    yield from d.hatched(40, floor, 480, floor)
    for degrees in (-15, -10, -5, 5, 10, 15):
        first, second, leaving = through_ball(x, y, radius, light, degrees)
        reach = (floor - second[1]) / leaving[1]
        yield d.line(*light, *first, d.WARM, 1.6)
        yield d.line(*first, *second, d.WARM, 1.6)
        yield d.line(*second, second[0] + reach * leaving[0], floor, d.WARM, 1.6)
    yield d.circle(*light, 6, d.LAMP, d.WARM)
    yield d.text(light[0] + 18, light[1] + 4, "point light", d.WARM, "start")
    at = (290, floor)
    away = math.hypot(light[0] - at[0], light[1] - at[1])
    u_x, u_y = (light[0] - at[0]) / away, (light[1] - at[1]) / away
    b = (at[0] - x) * u_x + (at[1] - y) * u_y
    stop = -b - math.sqrt(b * b - ((at[0] - x) ** 2 + (at[1] - y) ** 2 - radius**2))
    yield d.line(*at, at[0] + stop * u_x, at[1] + stop * u_y, d.GREEN, 2.2, True, "6 4")
    yield d.text(304, floor - 40, "shadow ray: stopped", d.GREEN, "start")
    yield d.text(x, floor + 34, "caustic", d.WARM)


@d.diagram("tree", 520, 330)
def tree_of_rays():
    """Two lobes at every hit: one, two, four, eight rays."""
    leaf = ("", [])
    node = ("", [("", [leaf, leaf]), ("", [leaf, leaf])])
    yield from d.tree(200, 62, 360, ("", [node, node]), 66)
    for level in range(4):
        yield d.text(430, 67 + 66 * level, str(2**level), d.WARM)
        yield d.text(490, 67 + 66 * level, str(2**level) if level < 3 else "0", d.GREEN)
    yield d.text(424, 26, "rays", d.WARM)
    yield d.text(486, 26, "shadow", d.GREEN)
    yield d.text(330, 312, "in all", d.INK, "end")
    yield d.text(430, 312, "15", d.WARM)
    yield d.text(490, 312, "7", d.GREEN)


@d.diagram("tree-counts", 520, 122)
def tree_counts():
    """The formula beside the program's counts."""
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
    yield from d.boxes(5, 8, rows, (92, 62, 62, 66, 70, 76, 82), 35)


@d.diagram("snell", 520, 270)
def snell():
    for x, angle in ((95, 25), (260, 41.81), (425, 60)):
        y = 120
        yield (f'<path d="M{x - 75} {y} H{x + 75} V250 H{x - 75}z" fill="#d9e4ef"/>')
        yield d.line(x - 75, y, x + 75, y, d.COOL, 2)
        yield d.line(x, y - 92, x, y + 108, d.SOFT, 1, False, "4 4")
        length = min(116, 74 / math.sin(math.radians(angle)))
        yield d.line(x, y, *d.polar(x, y, 180 + angle, length), d.COOL, 2, True)
        sine = 1.5 * math.sin(math.radians(angle))
        yield (
            d.line(x, y, *d.polar(x, y, 180 - angle, 100), d.SOFT, 1.2, True)
            if sine < 1
            else d.line(x, y, *d.polar(x, y, 180 - angle, length), d.WARM, 2.2, True)
        )
        if sine < 1.0005:
            out = math.degrees(math.asin(min(sine, 1)))
            yield d.ray(x, y, out if out < 89 else 90, 80, d.WARM)
            yield d.text(
                *d.polar(x + 6, y - 10 if out > 89 else y, min(out, 84), 64 if out > 89 else 88),
                "w_t",
                d.WARM,
            )
        else:
            yield d.text(x + 36, y - 40, "none", d.WARM)
        yield d.text(*d.polar(x - 12, y - 6, 180 + angle, length - 34), "w_o", d.COOL)
        yield d.text(x, 24, f"{angle:.1f}°")
        yield d.circle(x, y, 3)
    yield d.text(12, 112, "air, η = 1", d.SOFT, "start", size=12)
    yield d.text(22, 264, "glass, η = 1.5", d.SOFT, "start", size=12)


def surface(x, y, half):
    yield d.line(x - half, y, x + half, y, d.INK, 2.2)
    yield d.line(x, y, x, y - 112, d.SOFT, 1, False, "4 4")


def lobe(x, y, name):
    yield from surface(x, y, 90)
    yield d.ray(x, y, -42, 96, d.COOL)
    yield d.text(*d.polar(x - 10, y - 2, -42, 106), "w_o", d.COOL)
    if name == "diffuse":
        for angle in (-64, -20, 0, 22, 44, 66):
            yield d.ray(x, y, angle, 70, d.WARM, 1.6)
    elif name == "specular":
        yield d.ray(x, y, 42, 96, d.WARM, 2.4)
        yield d.text(*d.polar(x + 12, y - 2, 42, 106), "w_r", d.WARM)
    else:
        yield d.ray(x, y, 180 - 26.5, 76, d.WARM, 2.4)
        yield d.text(*d.polar(x + 20, y + 4, 180 - 26.5, 72), "w_t", d.WARM, "start")


@d.diagram("diffuse-lobe", 220, 150)
def diffuse_lobe():
    yield from lobe(110, 130, "diffuse")


@d.diagram("specular-lobe", 220, 150)
def specular_lobe():
    yield from lobe(110, 130, "specular")


@d.diagram("refraction-lobe", 220, 220)
def refraction_lobe():
    yield from lobe(110, 130, "refraction")


@d.diagram("mirror", 280, 190)
def mirror_of_the_slide():
    """With wo as on the course's slide: it points at the surface."""
    x, y = 140, 170
    yield d.line(x - 115, y, x + 115, y, d.INK, 2.2)
    yield d.ray(x, y, 0, 140, d.INK)
    yield d.text(x + 13, y - 130, "n", style="italic")
    yield d.ray(x, y, 48, 124, d.WARM, 2.4)
    yield d.text(*d.polar(x + 14, y, 48, 132), "w_r", d.WARM)
    yield d.arc(x, y, 0, 48, 40)
    yield d.arc(x, y, -48, 0, 40)
    tip = d.polar(x, y, -48, 124)
    yield d.line(*tip, *d.polar(x, y, -48, 5), d.COOL, 2.4, True)
    yield d.text(tip[0] - 14, tip[1] + 2, "w_o", d.COOL)


@d.diagram("mirror-cone", 520, 200)
def mirror_cone():
    """A mirror as the limit of ever thinner cones around one direction."""
    for x, half, name in ((90, 16, "a glossy surface"), (260, 8, "a glossier one"), (430, 0, "a mirror")):
        y = 140
        tip = d.polar(x, y, 42 - half, 104), d.polar(x, y, 42 + half, 104)
        if half:
            path = " ".join(f"{a:.1f},{b:.1f}" for a, b in ((x, y), *tip))
            yield f'<polygon points="{path}" fill="{d.SAND}"/>'
            for end in tip:
                yield d.dashed(x, y, *end, d.WARM)
            yield from d.angle(x, y, 42 - half, 42 + half, 90, "ε", d.WARM)
        yield from d.hatched(x - 76, y, x + 76, y)
        yield d.dashed(x, y, x, y - 104)
        yield from d.arrow(x, y, *d.polar(x, y, 42, 72), "" if half else "w_r", d.WARM)
        yield from d.arrow(x, y, *d.polar(x, y, -42, 72), "w_o", d.COOL)
        yield d.text(x, 186, name)


@d.diagram("mirror-through", 440, 256)
def mirror_through():
    """A direction that points away, and the results of both formulas."""
    x, y, a, r = 200, 150, 50, 124
    yield from d.hatched(x - 180, y, x + 190, y)
    yield from d.arrow(x, y, x, y - 118, "n")
    yield from d.arrow(x, y, *d.polar(x, y, -a, r), "w_o", d.COOL, 2.4)
    yield from d.arrow(x, y, *d.polar(x, y, a, r), "", d.WARM, 2.4)
    yield d.text(x + 104, y - 78, "its negative", d.WARM, "start")
    yield d.line(x, y, *d.polar(x, y, a - 180, 112), d.SOFT, 2.2, True, "7 5")
    yield d.text(x - 96, y + 96, "the slide's formula", d.INK)
    yield from d.angle(x, y, -a, 0, 42, "θ")
    yield from d.angle(x, y, 0, a, 42, "θ")
    yield d.circle(x, y, 4)


@d.diagram("four-coefficients", 520, 300)
def four_coefficients():
    """What each coefficient does with light at one surface."""
    x, y = 260, 170
    yield f'<path d="M40 {y} H480 V290 H40z" fill="{d.GLASS}"/>'
    yield d.line(40, y, 480, y, d.INK, 2)
    yield d.dashed(x, y, x, y - 140)
    yield from d.arrow(x, y, *d.polar(x, y, -52, 150), "w_o", d.COOL, 2.4)
    for a in (-32, -16, 14, 30, 70, 80):
        yield d.line(x, y, *d.polar(x, y, a, 84), d.WARM, 1.4, True)
    yield d.symbol(x + 24, y - 98, "k_d", d.WARM)
    yield from d.arrow(x, y, *d.polar(x, y, 52, 150), "k_s", d.GREEN, 2.4)
    yield from d.arrow(x, y, *d.polar(x, y, 180 - 31.7, 108), "k_t", d.GREEN, 2.4)
    yield f'<path d="M70 {y} A54 54 0 0 1 178 {y}z" fill="{d.GLOW}" stroke="{d.LAMP}"/>'
    yield d.symbol(124, y - 14, "k_e", d.INK)
    yield d.circle(x, y, 4)
