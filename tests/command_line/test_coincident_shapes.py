"""Surfaces in one place: which is first, and when that is left to rounding."""

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
paper = { kd = 0.6 }
black = { kd = 0 }
lamp = { ke = 5 }
bright = { ke = 6 }
sky = { ke = 1 }
"""
GLASS = """
glass = { kt = 1, eta = 1.5 }
water = { kt = 1, eta = 1.33 }
"""
TILES = """
tiles = { kd = { checker = [[0.8, 0.8, 0.8], [0.1, 0.1, 0.1]] } }
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
    """A square across the y axis that faces down, from (x, y, z) on."""
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
    """A surface in the place of another: as if there were a gap."""

    def check(self, shapes, expected, ceiling=1, programs=None):
        for order in [shapes, shapes[::-1]]:
            for program in programs or ["stage1", "stage2"]:
                mean = self.mean_of(order, "--spp=300", program=program, head=seen_from(ceiling - 1))
                with self.subTest(program, first=order[0]):
                    self.assertAlmostEqual(mean / expected, 1, delta=0.02)

    def test_a_lamp_flush_with_the_ceiling(self):
        gap = self.mean_of([*room(1), down(-0.5, 0.9999, -0.5, 1, "lamp")], "--spp=300", program="stage2")
        # At 0 there are no digits to be rounded.
        for y in [1, 0, -40]:
            self.check([*room(y), down(-0.5, y, -0.5, 1, "lamp")], gap, ceiling=y)
        for tile in [down, up]:  # either side of what reflects
            self.check([tile(-9, 1, -9, 18, "white"), *room(1)[1:], down(-0.5, 1, -0.5, 1, "lamp")], gap)
        # The same lamp twice shines once.
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


ROUNDING = "which of them a ray meets is left to rounding; move one of them"
AS_ONE = "they shine as one, not as two; move one of them"

FLOOR = plane([0, 1, 0], 1, "white")
LAMP = down(-0.5, 1, -0.5, 1, "lamp")
CEILING = plane([0, -1, 0], 1, "white")


def warning(shape, other, why=ROUNDING, line=3, other_line=2, more=""):
    return (
        f"scene.toml:{line}:3: warning: the {shape} is in the same place as "
        f"the {other} in line {other_line}: {why}{more}"
    )


WARNED = {
    "two planes": ([FLOOR, plane([0, 1, 0], 1, "black")], warning("plane", "plane")),
    "two planes with opposite normals": ([FLOOR, plane([0, -2, 0], -2, "black")], warning("plane", "plane")),
    "a rug that lies in the floor": ([FLOOR, up(-0.5, -1, 0, 1, "black")], warning("rectangle", "plane")),
    "a rug before the floor": ([up(-0.5, -1, 0, 1, "black"), FLOOR], warning("plane", "rectangle")),
    "a rug at height 0": (
        [up(-5, 0, -5, 10, "white"), up(-0.5, 0, 0, 1, "black")],
        warning("rectangle", "rectangle"),
    ),
    "a rug in a slanted floor": (
        [plane([0.6, 0.8, 0], 1, "white"), rectangle([-0.6, -0.8, 0], [0.4, -0.3, 0], [0, 0, 1], "black")],
        warning("rectangle", "plane"),
    ),
    "a small triangle in a large slope, which rounding tilts": (
        [
            rectangle([-800, 600, -9], [1600, -1200, 0], [0, 0, 18], "white"),
            triangle([400.08, -300.06, 0], [400.16, -300.12, 0.03], [400.11, -300.0825, 0.1], "black"),
        ],
        warning("triangle", "rectangle"),
    ),
    "a plane that shines in the place of another": (
        [CEILING, plane([0, -1, 0], 1, "lamp")],
        warning("plane", "plane"),
    ),
    "a triangle within a rectangle": (
        [up(-5, -1, -5, 10, "white"), triangle([0, -1, 0], [0, -1, 1], [1, -1, 0], "black")],
        warning("triangle", "rectangle"),
    ),
    "a rectangle within a triangle, which comes first": (
        [triangle([-9, -1, -9], [-9, -1, 19], [19, -1, -9], "black"), up(-1, -1, -1, 1, "white")],
        warning("rectangle", "triangle"),
    ),
    "two strips that cross": (
        [
            rectangle([-5, 0, 0], [10, 0, 0], [0, 0, 1], "white"),
            rectangle([0, 0, -5], [1, 0, 0], [0, 0, 10], "black"),
        ],
        warning("rectangle", "rectangle"),
    ),
    "two triangles whose corners overlap": (
        [
            triangle([0, 0, 0], [2, 0, 0], [0, 2, 0], "white"),
            triangle([1.9, 1.9, 0], [0.9, 1.9, 0], [1.9, -0.1, 0], "black"),
        ],
        warning("triangle", "triangle"),
    ),
    "the same lamp twice": ([LAMP, LAMP], warning("rectangle", "rectangle", AS_ONE)),
    "a brighter lamp in a lamp": ([LAMP, down(0, 1, 0, 0.5, "bright")], warning("rectangle", "rectangle")),
    "a small lamp in a large one far away": (
        [down(-50, 40, -50, 999, "lamp"), down(0, 40, 0, 0.5, "bright")],
        warning("rectangle", "rectangle"),
    ),
    "the same ball twice": (
        [FLOOR, sphere([0, 0, 0], 1, "white"), sphere([0, 0, 0], 1, "black")],
        warning("sphere", "sphere", line=4, other_line=3),
    ),
    "a sphere that shines, twice": (
        [sphere([0, 0, 0], 1, "lamp"), sphere([0, 0, 0], 1, "lamp")],
        warning("sphere", "sphere", AS_ONE),
    ),
    "in the place of two, the first is named": (
        [up(-5, -1, -5, 10, "white"), FLOOR, up(0, -1, 0, 1, "black")],
        warning("rectangle", "rectangle", line=4, other_line=2),
    ),
    "three of them": (
        [FLOOR, *(up(x, -1, 0, 1, "black") for x in range(3)), sphere([0, 0, 0], 1, "white")],
        warning("rectangle", "plane", line=3, more=" (and 2 more)"),
    ),
}

WARNED_OF_GLASS = {
    "doubled faces": (2 * [up(0, 0, 0, 1, "glass")], warning("rectangle", "rectangle")),
    "a face doubled in part by other glass": (
        [up(0, 0, 0, 1, "glass"), up(0.5, 0, 0.5, 1, "water")],
        warning("rectangle", "rectangle"),
    ),
    "planes of glass in contact": (
        [plane([0, 1, 0], 1, "glass"), plane([0, -1, 0], -1, "water")],
        warning("plane", "plane"),
    ),
    "a face that doubles a plane": (
        [plane([0, 1, 0], 1, "glass"), up(0, -1, 0, 1, "glass")],
        warning("rectangle", "plane"),
    ),
    "a ball of glass, twice": (2 * [sphere([0, 0, 0], 1, "glass")], warning("sphere", "sphere")),
    "squares of one pattern in other places": (
        [up(0, 0, 0, 1, "tiles"), up(0.5, 0, 0.25, 1, "tiles")],
        warning("rectangle", "rectangle"),
    ),
}

FINE = {
    "a lamp flush with the ceiling": [CEILING, LAMP],
    "a lamp flush with a rectangle": [up(-9, 1, -9, 18, "white"), LAMP],
    "a lamp at height 0": [up(-9, 0, -9, 18, "white"), up(0, 0, 0, 1, "lamp")],
    "a lamp that shines to both sides": [LAMP, up(-0.5, 1, -0.5, 1, "bright")],
    "a lamp before a plane that shines": [plane([0, -1, 0], 1, "sky"), LAMP],
    "the same matt square twice": 2 * [up(0, 0, 0, 1, "white")],
    "two materials that look alike": [FLOOR, up(0, -1, 0, 1, "paper")],
    "balls that touch": [
        sphere([0, 0, 0], 1, "white"),
        sphere([2, 0, 0], 1, "black"),
        sphere([0, 0, 0], 1.001, "black"),
    ],
    "walls that meet in an edge": [
        FLOOR,
        plane([1, 0, 0], 1, "black"),
        rectangle([-1, -1, 1], [2, 0, 0], [0, 2, 0], "white"),
        rectangle([1, -1, 1], [0, 0, -2], [0, 2, 0], "black"),
    ],
    "neighbors that share an edge": [
        up(0, 0, 0, 1, "white"),
        up(1, 0, 0, 1, "black"),
        up(0, 0, 1, 1, "black"),
        triangle([1, 0, 1], [1, 0, 2], [2, 0, 1], "white"),
    ],
    "triangles whose boxes overlap": [
        triangle([0, 0, 0], [2, 0, 0], [0, 2, 0], "white"),
        triangle([1.9, 1.9, 0], [1.1, 1.9, 0], [1.9, 1.1, 0], "black"),
    ],
    "a corner that points at an edge": [
        triangle([0, 0, 0], [2, 0, 0], [0, 2, 0], "white"),
        triangle([1.05, 1.05, 0], [2, 1.3, 0], [1.3, 2, 0], "black"),
    ],
    "a rug a little above the floor": [FLOOR, up(0, -0.99998, 0, 1, "black")],
    "a rug on a floor of kilometers": [up(-9000, 0, -9000, 18000, "white"), up(0, 0.001, 0, 1, "black")],
}

FINE_OF_GLASS = {
    "a cube on the floor": [FLOOR, *cube(0, -1, 0, 1, "glass")],
    "a cube on a cube": [*cube(0, -1, 0, 1, "glass"), *cube(0, 0, 0, 1, "water")],
    "a lamp on a cube": [*cube(0, 0, 0, 1, "glass"), up(0, 1, 0, 1, "lamp")],
    "a lamp that shines into a cube": [*cube(0, 0, 0, 1, "glass"), down(0, 1, 0, 1, "lamp")],
    "the same tiles twice": 2 * [up(0, 0, 0, 1, "tiles")],
}


class Warnings(Scenes):
    def said(self, shapes, *arguments, program="stage2", **scene):
        """What it says on stderr, without the program's name."""
        result = self.result_of(shapes, *arguments, program=program, **scene)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.files(), ["out.pfm", "scene.toml"])
        return result.stderr.removeprefix(f"{program}: ")

    def said_of_glass(self, shapes):
        return self.said(shapes, program="stage5", materials=GLASS + TILES)

    def test_what_is_left_to_rounding(self):
        for name, (shapes, expected) in WARNED.items():
            with self.subTest(name):
                self.assertEqual(self.said(shapes), expected + "\n")

    def test_what_is_left_to_rounding_of_glass(self):
        for name, (shapes, expected) in WARNED_OF_GLASS.items():
            with self.subTest(name):
                self.assertEqual(self.said_of_glass(shapes), expected + "\n")

    def test_what_is_not(self):
        for name, shapes in FINE.items():
            for order in [shapes, shapes[::-1]]:
                with self.subTest(name):
                    self.assertEqual(self.said(order), "")

    def test_what_is_not_of_glass(self):
        for name, shapes in FINE_OF_GLASS.items():
            for order in [shapes, shapes[::-1]]:
                with self.subTest(name):
                    self.assertEqual(self.said_of_glass(order), "")

    def test_with_quiet_it_says_nothing(self):
        shapes, _ = WARNED["two planes"]
        self.assertEqual(self.said(shapes, "--quiet"), "")

    def test_the_scenes_of_the_course(self):
        for scene in sorted(SCENES.glob("*.toml")):
            with self.subTest(scene.name):
                result = run(
                    built_stages()[-1], scene, "-o", "out.pfm", "--spp=1", "--size=1x1", folder=self.folder
                )
                if "introduces" in result.stderr:
                    continue  # the stage that can is not built
                self.assertEqual(result.stderr, "")

    def test_many_tiles_and_one_too_many(self):
        tiles = [
            up(0.1 * i, 0, 0.1 * j, 0.1, ["white", "black"][(i + j) % 2])
            for i in range(40)
            for j in range(40)
        ]
        self.assertEqual(self.said(tiles), "")
        extra = up(1.23, 0, 1.25, 0.02, "black")
        said = self.said([*tiles, extra])  # it lies in tile (12, 12)
        expected = warning("rectangle", "rectangle", line=1602, other_line=2 + 12 * 40 + 12)
        self.assertEqual(said, expected + "\n")

    def test_a_mesh_with_creases_and_flat_parts(self):
        def height(i, j):
            return 0.1 * max(0, i - 10) + 0.01 * (i * j % 3) * (j > 9)

        def vertex(i, j):
            return [0.3 * i, height(i, j), 0.3 * j]

        mesh = []
        for i in range(20):
            for j in range(20):
                corners = vertex(i, j), vertex(i + 1, j + 1)
                mesh.append(triangle(*corners, vertex(i + 1, j), "white"))
                mesh.append(triangle(*corners, vertex(i, j + 1), "black"))
        self.assertEqual(self.said(mesh), "")


if __name__ == "__main__":
    unittest.main()
