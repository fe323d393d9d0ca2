"""Triangles: degenerate or not, whichever vertex comes first."""

import itertools
import unittest

import programs

SCENE = """[camera]
origin = [499, 0, -1]
left = [-0.001, 0, 0]
up = [0, 0.001, 0]
forward = [0, 0, 1]
size = [16, 16]
[materials]
white = { ke = 1 }
[[shapes]]
type = "triangle"
vertices = VERTICES
material = "white"
"""

# A kilometer long and a millimeter high: the camera sees its thick end.
NEEDLE = ([-500, 0, 0], [500, 9e-4, 0], [500, 0, 0])
# The same with its two long edges equally long.
ISOSCELES = ([-500, 0, 0], [500, 9e-4, 0], [500, -9e-4, 0])


class Needles(programs.InFolder):
    def render(self, vertices):
        scene = self.folder / "scene.toml"
        scene.write_text(SCENE.replace("VERTICES", str(vertices)))
        return programs.run(
            "stage1", *("scene.toml", "-o", "a.pfm", "--spp", "64", "--threads", "1"), folder=self.folder
        )

    def picture(self, vertices):
        result = self.render(vertices)
        self.assertEqual((result.returncode, result.stderr), (0, ""), vertices)
        return programs.read_pfm(self.folder / "a.pfm")[2]

    def test_every_order_of_the_vertices_is_the_same_picture(self):
        for needle, mean in ((NEEDLE, 0.45), (ISOSCELES, 0.9)):
            pictures = []
            for order in itertools.permutations(range(3)):
                pixels = self.picture([needle[i] for i in order])
                lit = sum(pixel[0] for pixel in pixels) / len(pixels)
                if lit == 0:  # its back, which does not shine
                    continue
                pictures.append(pixels)
                self.assertAlmostEqual(lit, mean, delta=0.01, msg=order)
            self.assertEqual(len(pictures), 3)
            self.assertEqual(pictures.count(pictures[0]), 3)

    def test_every_order_of_a_line_is_refused(self):
        for line in (
            ([-500, 0, 0], [500, 9e-6, 0], [500, 0, 0]),
            ([0, 0, 0], [1, 1, 1], [3, 3, 3]),
            ([1, 2, 3], [1, 2, 3], [3, 3, 3]),
            ([1, 2, 3], [1, 2, 3], [1, 2, 3]),
        ):
            for order in itertools.permutations(range(3)):
                result = self.render([line[i] for i in order])
                self.assert_one_line(
                    result,
                    "stage1: scene.toml:11:12: the triangle's vertices lie on one line: they span no area",
                )


if __name__ == "__main__":
    unittest.main()
