"""Surfaces in one place: which of them comes first, and which are refused."""

import itertools
import unittest

from programs import SCENES, InFolder, built_stages, read_pfm, run

HEAD = """
[camera]
origin = [0, 0, -3.5]
left = [-1, 0, 0]
up = [0, 1, 0]
forward = [0, 0, 3]
size = [24, 24]

[render]
samples_per_pixel = 1
max_bounces = 2

[materials]
white = { kd = 0.6 }
black = { kd = 0 }
lamp = { ke = 5 }
sky = { ke = 1 }
"""
GLASS = """
glass = { kt = 1, eta = 1.5 }
"""


def plane(normal, distance, material):
    return f'type = "plane", normal = {normal}, distance = {distance}, material = "{material}"'


def sphere(center, radius, material):
    return f'type = "sphere", center = {center}, radius = {radius}, material = "{material}"'


def rectangle(corner, u, v, material):
    return f'type = "rectangle", corner = {corner}, edge_u = {u}, edge_v = {v}, material = "{material}"'


def triangle(a, b, c, material):
    return f'type = "triangle", vertices = [{a}, {b}, {c}], material = "{material}"'


def down(x, y, z, size, material):
    """A square perpendicular to the y axis that faces down, with a corner at (x, y, z)."""
    return rectangle([x, y, z], [size, 0, 0], [0, 0, size], material)


def up(x, y, z, size, material):
    return rectangle([x, y, z], [0, 0, size], [size, 0, 0], material)


def cube(x, y, z, s, material):
    return [
        down(x, y, z, s, material),
        up(x, y + s, z, s, material),
        rectangle([x, y, z], [0, s, 0], [s, 0, 0], material),
        rectangle([x, y, z + s], [s, 0, 0], [0, s, 0], material),
        rectangle([x, y, z], [0, 0, s], [0, s, 0], material),
        rectangle([x + s, y, z], [0, s, 0], [0, 0, s], material),
    ]


class Scenes(InFolder):
    def result_of(self, shapes, *arguments, program, materials="", head=HEAD):
        """Runs a scene with a shape on each of the lines 2, 3, 4 ..."""
        if program not in built_stages():
            self.skipTest(f"{program} is not built")
        lines = "".join(f"  {{ {shape} }},\n" for shape in shapes)
        (self.folder / "scene.toml").write_text(f"shapes = [\n{lines}]\n{head}{materials}")
        return run(program, "scene.toml", "-o", "out.pfm", *arguments, folder=self.folder)

    def mean_of(self, shapes, *arguments, **scene):
        result = self.result_of(shapes, *arguments, **scene)
        self.assertEqual(result.returncode, 0, result.stderr)
        width, height, pixels = read_pfm(self.folder / "out.pfm")
        return sum(pixel[1] for pixel in pixels) / (width * height)


# A floor, 2 below its ceiling, and a wall at the back.
def room(ceiling):
    return [
        plane([0, -1, 0], ceiling, "white"),
        plane([0, 1, 0], 2 - ceiling, "white"),
        plane([0, 0, -1], 1, "white"),
    ]


def seen_from(height):
    return HEAD.replace("[0, 0, -3.5]", f"[0, {height}, -3.5]")


class Means(Scenes):
    """A surface in the place of another counts as if there were a gap."""

    def check(self, shapes, expected, ceiling=1, programs=None):
        for order in [shapes, shapes[::-1]]:
            for program in programs or ["stage1", "stage2"]:
                mean = self.mean_of(order, "--spp=300", program=program, head=seen_from(ceiling - 1))
                with self.subTest(program, first=order[0]):
                    self.assertAlmostEqual(mean / expected, 1, delta=0.02)

    def test_a_lamp_flush_with_the_ceiling(self):
        gap = self.mean_of([*room(1), down(-0.5, 0.9999, -0.5, 1, "lamp")], "--spp=300", program="stage2")
        # At 0 no digits are rounded.
        for y in [1, 0, -40]:
            self.check([*room(y), down(-0.5, y, -0.5, 1, "lamp")], gap, ceiling=y)
        for tile in [down, up]:  # both sides of the reflecting surface
            self.check([tile(-9, 1, -9, 18, "white"), *room(1)[1:], down(-0.5, 1, -0.5, 1, "lamp")], gap)
        # Two equal lamps shine once.
        self.check([*room(1), *2 * [down(-0.5, 1, -0.5, 1, "lamp")]], gap)

    def test_a_lamp_in_a_slanted_ceiling_that_is_larger(self):
        corner, u, v = [-0.48, 1.48, -0.5], [0.96, 0.28, 0], [0, 0, 1]
        wide_corner = [-9.12, -1.04, -9]
        wide_u, wide_v = [17.28, 5.04, 0], [0, 0, 18]
        gap = self.mean_of(
            [
                rectangle(wide_corner, wide_u, wide_v, "white"),
                *room(1)[1:],
                rectangle([-0.48, 1.4799, -0.5], u, v, "lamp"),
            ],
            "--spp=300",
            program="stage2",
        )
        self.check(
            [rectangle(wide_corner, wide_u, wide_v, "white"), *room(1)[1:], rectangle(corner, u, v, "lamp")],
            gap,
        )

    def test_a_lamp_that_shines_to_both_sides(self):
        for y in [0, 0.5]:
            gap = self.mean_of(
                [*room(1), down(-0.5, y - 0.0001, -0.5, 1, "lamp"), up(-0.5, y, -0.5, 1, "lamp")],
                "--spp=300",
                program="stage2",
            )
            self.check([*room(1), down(-0.5, y, -0.5, 1, "lamp"), up(-0.5, y, -0.5, 1, "lamp")], gap)

    def test_slabs_of_glass_in_contact_absorb_nothing(self):
        def face(z, material, to_back):
            edges = [[18, 0, 0], [0, 18, 0]]
            edges = edges if to_back else edges[::-1]
            return rectangle([-9, -9, z], *edges, material)

        shapes = [
            plane([0, 0, -1], 5, "sky"),
            plane([0, 0, 1], 5, "sky"),
            face(1, "glass", False),
            face(2, "glass", True),
            face(2, "glass", False),
            face(3, "glass", True),
        ]
        for order in itertools.permutations(shapes[2:]):
            mean = self.mean_of(
                [*shapes[:2], *order], "--spp=4", "--max-bounces=9", program="stage4", materials=GLASS
            )
            self.assertAlmostEqual(mean, 1, delta=1e-5)

    def test_no_light_comes_through_the_floor_under_glass(self):
        # A black floor that fills the picture, and a sky below it.
        for x, y in [(0, -1), (0, 0), (9, -1), (200, -1)]:
            floor = plane([0, 1, 0], -y, "black")
            wide = up(x - 9, y, -9, 18, "black")
            for ground in [floor, wide]:
                mean = self.mean_of(
                    [ground, plane([0, 1, 0], 50, "sky"), *cube(x - 0.5, y, -0.5, 1, "glass")],
                    "--spp=4",
                    "--max-bounces=9",
                    program="stage4",
                    materials=GLASS,
                    head=HEAD.replace("[0, 0, -3.5]", f"[{x}, {y + 2}, -2]")
                    .replace("left = [-1, 0, 0]", "left = [-0.2, 0, 0]")
                    .replace("up = [0, 1, 0]", "up = [0, 0.2, 0]")
                    .replace("[0, 0, 3]", "[0, -1.5, 2]"),
                )
                with self.subTest(ground, x=x, y=y):
                    self.assertEqual(mean, 0)


BLACK, WHITE = sphere([0, 0, 0], 1, "black"), sphere([0, 0, 0], 1, "white")
LAMP, WIDE = down(-0.5, 1, -0.5, 1, "lamp"), down(-0.5, 1, -0.5, 1, "white")


def warning(shape, line, other_line, more=""):
    return (
        f"stage2: scene.toml:{line}:3: warning: the {shape} has the same numbers as that in line "
        f"{other_line}: a ray meets only one of them; delete the other{more}\n"
    )


WARNED = {
    "a ball, twice": ([WHITE, WHITE], warning("sphere", 3, 2)),
    "a ball of two colors": ([LAMP, BLACK, *room(1), WHITE], warning("sphere", 7, 3)),
    "a plane, twice": ([*room(1), room(1)[0]], warning("plane", 5, 2)),
    "a lamp, twice": ([LAMP, WIDE, LAMP], warning("rectangle", 4, 2)),
    "a triangle, twice": (
        2 * [triangle([0, 0, 0], [1, 0, 0], [0, 1, 0], "white")],
        warning("triangle", 3, 2),
    ),
    "a ball three times, and a plane twice": (
        [WHITE, *room(1), WHITE, room(1)[2], BLACK],
        warning("sphere", 6, 2, " (and 2 more)"),
    ),
}
FINE = {
    "a lamp in the place of a wall": [WIDE, LAMP],
    "lamps back to back": [LAMP, up(-0.5, 1, -0.5, 1, "lamp")],
    "balls that touch": [WHITE, sphere([2, 0, 0], 1, "white"), sphere([0, 0, 0], 0.999, "white")],
    "a square and its half": [
        rectangle([0, 0, 0], [1, 0, 0], [0, 1, 0], "white"),
        triangle([0, 0, 0], [1, 0, 0], [0, 1, 0], "white"),
    ],
}


class Duplicates(Scenes):
    """A shape that the file has twice is reported, with both lines."""

    def said(self, shapes, *arguments):
        result = self.result_of(shapes, *arguments, program="stage2")
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stderr

    def test_what_is_there_twice(self):
        for name, (shapes, expected) in WARNED.items():
            with self.subTest(name):
                self.assertEqual(self.said(shapes), expected)
                self.assertEqual(self.said(shapes, "--quiet"), "")

    def test_what_is_not(self):
        for name, shapes in FINE.items():
            with self.subTest(name):
                self.assertEqual(self.said(shapes), "")

    def test_the_scenes_of_the_course(self):
        for scene in sorted(SCENES.glob("*.toml")):
            with self.subTest(scene.name):
                result = run(
                    built_stages()[-1], scene, "-o", "out.pfm", "--spp=1", "--size=1x1", folder=self.folder
                )
                if "introduces" in result.stderr:
                    continue  # the stage that can is not built
                self.assertEqual(result.stderr, "")


if __name__ == "__main__":
    unittest.main()
