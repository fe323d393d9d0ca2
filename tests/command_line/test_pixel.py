"""One path, printed vertex by vertex: --pixel and --sample."""

import re
import struct
import unittest

from programs import SCENES, InFolder, built_stages, read_pfm, run

# A scene that every stage can render, with all kinds of surfaces that it knows.
SCENES_OF = {
    "stage1": ["cornell_box_ceiling_diffuse", "cornell_box_lamp_diffuse"],
    "stage2": ["cornell_box_point_diffuse", "cornell_box_lamp_diffuse"],
    "stage3": ["cornell_box_point", "cornell_box_ceiling", "plastic"],
    "stage4": ["cornell_box_point", "cornell_box_ceiling", "coloured_lobes"],
    "stage5": ["fresnel_glass", "checkered_floor", "cornell_box_ceiling"],
}
SMALL = ["--size", "8x8", "--max-bounces", "5"]

needs_stage4 = unittest.skipUnless("stage4" in built_stages(), "it is told by stage 4")

CAMERA = """\
[camera]
origin = [0, 0, 0]
left = [-0.1, 0, 0]
up = [0, 0.1, 0]
forward = [0, 0, 1]
size = [1, 1]
"""
MATERIALS = """\
white = { kd = 0.8 }
black = { kd = 0 }
mirror = { ks = 0.9 }
glass = { kt = 1, eta = 1.5 }
mixed = { ks = 0.5, kt = 0.5, eta = 1.5 }
lamp = { ke = [3, 2, 1] }
"""


def scene_of(shapes):
    """A scene with these shapes, and their materials."""
    materials = "".join(
        line for line in MATERIALS.splitlines(keepends=True) if f'"{line.split()[0]}"' in shapes
    )
    return f"{CAMERA}[materials]\n{materials}{shapes}"


def square(material, z, towards_camera=True):
    """A large square across the line of sight."""
    u, v = ("[0, 20, 0]", "[20, 0, 0]")
    if not towards_camera:
        u, v = v, u
    return (
        f'[[shapes]]\ntype = "rectangle"\nmaterial = "{material}"\n'
        f"corner = [-10, -10, {z}]\nedge_u = {u}\nedge_v = {v}\n"
    )


def sphere(material, z, radius):
    return f'[[shapes]]\ntype = "sphere"\nmaterial = "{material}"\ncenter = [0, 0, {z}]\nradius = {radius}\n'


def point_light(z):
    return f'[[lights]]\ntype = "point"\ncenter = [0, 0, {z}]\nintensity = 9\n'


def numbers(text):
    """The (r, g, b) or (x, y, z) of a line."""
    inside = re.search(r"\(([^)]*)\)", text)[1]
    return [float(word) for word in inside.split(",")]


def vertices_of(story):
    """For each vertex, its lines: a list of (label, rest of the line)."""
    result = []
    for block in story.split("\n\n"):
        head, *lines = block.strip("\n").split("\n")
        if head.strip().startswith("vertex "):
            result.append([tuple(one.split(None, 1)) for one in lines])
    return result


def as_float(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


class Pixels(InFolder):
    def told(self, program, scene, *arguments):
        result = run(program, scene, *arguments, folder=self.folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def told_of(self, shapes, *arguments, program="stage4", pixel="0,0"):
        (self.folder / "scene.toml").write_text(scene_of(shapes))
        return self.told(program, "scene.toml", "--pixel", pixel, *arguments)

    def radiance(self, story):
        last = story.splitlines()[-1]
        self.assertTrue(last.startswith("radiance of this sample = ("), last)
        return tuple(as_float(number) for number in numbers(last))

    def picture(self, program, scene, *arguments):
        result = run(*[program, scene, "-o", "picture.pfm", "--quiet", *arguments], folder=self.folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return read_pfm(self.folder / "picture.pfm")


class ThePathOfThePicture(Pixels):
    def test_the_last_line_is_the_pixel_of_one_sample(self):
        for program in built_stages():
            for name in SCENES_OF.get(program, SCENES_OF["stage5"]):
                scene = SCENES / f"{name}.toml"
                width, _, pixels = self.picture(program, scene, "--spp=1", *SMALL)
                self.assertGreater(len(set(pixels)), 4, "all pixels alike")
                for column, row in [(0, 0), (7, 0), (3, 1), (2, 6), (5, 5)]:
                    story = self.told(
                        *[program, scene, *SMALL], *["--pixel", f"{column},{row}", "--sample", 0]
                    )
                    self.assertEqual(
                        self.radiance(story), pixels[row * width + column], f"{program} {name} {column},{row}"
                    )

    # The picture's pixel with n samples is the mean of the paths 0 to n - 1.
    def test_each_sample_is_another_path_of_the_pixel(self):
        scene = SCENES / "cornell_box_ceiling_diffuse.toml"
        options = ["--seed", "7", "--sampling", "uniform", *SMALL]
        for program in built_stages():
            sums = [0, 0, 0]
            for sample in range(8):
                story = self.told(*[program, scene, *options], *["--pixel", "4,5", "--sample", sample])
                for channel, value in enumerate(self.radiance(story)):
                    sums[channel] += value
            *_, pixels = self.picture(program, scene, "--spp=8", *options)
            for channel, value in enumerate(pixels[5 * 8 + 4]):
                self.assertGreater(value, 0)
                self.assertAlmostEqual(sums[channel] / 8 / value, 1, places=6)

    def test_the_first_sample_is_told_unless_another_is_asked_for(self):
        scene = SCENES / "cornell_box_ceiling_diffuse.toml"
        first = self.told("stage1", scene, "--pixel=9,9")
        self.assertEqual(first, self.told("stage1", scene, "--pixel=9,9", "--sample=0"))
        self.assertNotEqual(first, self.told("stage1", scene, "--pixel=9,9", "--sample=1"))

    def test_no_image_is_written(self):
        scene = SCENES / "cornell_box_ceiling_diffuse.toml"
        self.told("stage1", scene, "--pixel=1,1", "-o", "out.pfm")
        self.assertEqual(self.files(), [])


class WhatIsTold(Pixels):
    def test_numbers_fit_together(self):
        """Throughputs are products of the weights, sums are sums of what is added."""
        for program in built_stages():
            if program == "stage3":
                continue  # a tree: see below
            for name in SCENES_OF.get(program, SCENES_OF["stage5"]):
                for sample in range(6):
                    story = self.told(
                        *[program, SCENES / f"{name}.toml", *SMALL], *["--pixel=3,6", "--sample", sample]
                    )
                    self.check_numbers(story)

    def check_numbers(self, story):
        expected, total = [1, 1, 1], [0, 0, 0]
        vertices = vertices_of(story)
        self.assertGreater(len(vertices), 0)
        for vertex in vertices:
            for label, rest in vertex:
                if label == "throughput":
                    for a, b in zip(numbers(rest), expected):
                        self.assertAlmostEqual(a, b, delta=2e-3 * abs(b))
                    expected = numbers(rest)
                elif label == "adds" and rest[0] == "(":
                    total = [a + b for a, b in zip(total, numbers(rest))]
                elif label == "sum":
                    for a, b in zip(numbers(rest), total):
                        self.assertAlmostEqual(a, b, delta=2e-3 * abs(b))
                elif label == "goes":
                    length = sum(x * x for x in numbers(rest))
                    self.assertAlmostEqual(length, 1, delta=1e-3)
                elif label == "weight":
                    factors = zip(expected, numbers(rest))
                    expected = [a * b for a, b in factors]
        for a, b in zip(self.radiance(story), total):
            self.assertAlmostEqual(a, b, delta=2e-3 * abs(b))
        self.assertEqual(vertices[-1][-1][0], "ends")

    def test_lines_fit_a_terminal(self):
        for program in built_stages():
            for name in SCENES_OF.get(program, SCENES_OF["stage5"]):
                scene = SCENES / f"{name}.toml"
                story = self.told(program, scene, "--pixel=100,180")
                for line in story.splitlines():
                    self.assertLessEqual(len(line), 78, line)

    def test_a_lamp_in_sight(self):
        for program in built_stages():
            story = self.told_of(square("lamp", 2), program=program)
            self.assertIn("vertex 0: rectangle[0] of 'lamp', bounce 0", story)
            self.assertRegex(story, r"adds .*\( +3, +2, +1\)  emission\n")
            self.assertRegex(story, r"normal .*  the path is in front\n")
            self.assertIn("ends       at a lamp\n", story)
            self.assertEqual(self.radiance(story), (3, 2, 1))

    @needs_stage4
    def test_the_back_of_a_lamp(self):
        story = self.told_of(square("lamp", 2, towards_camera=False))
        self.assertRegex(story, r"adds +nothing: its back is black\n")
        self.assertRegex(story, r"normal .*  the path is behind\n")
        self.assertEqual(self.radiance(story), (0, 0, 0))

    @needs_stage4
    def test_nothing_in_sight(self):
        story = self.told_of(square("white", -2))
        self.assertEqual(vertices_of(story), [])
        self.assertIn("ends       leaves the scene\n", story)

    # In front of a white wall, with a lamp behind the camera: most paths that
    # bounce off the wall hit the lamp, which the wall has sampled already.
    @needs_stage4
    def test_a_lamp_that_was_asked_before(self):
        shapes = square("white", 1) + square("lamp", -1, towards_camera=False)
        said = self.found(shapes, "this lamp was counted at the previous vertex")
        *_, wall, _ = vertices_of(said)
        self.assertRegex(dict(wall)["light"], r"at [\d.]+: reached$")
        self.assertIn("adds       nothing: this lamp", said)
        # Stage 1 samples no lamp, and hits it.
        said = self.found(shapes, "emission", program="stage1")
        self.assertNotIn("light  ", said)

    def found(self, shapes, text, *arguments, program="stage4"):
        """The first of the pixel's paths whose output contains this."""
        for sample in range(60):
            story = self.told_of(shapes, "--sample", sample, *arguments, program=program)
            if text in story:
                return story
        self.fail(f"of no path is told {text!r}: {story}")

    @needs_stage4
    def test_a_light_behind_something(self):
        shapes = square("white", 2) + sphere("white", -1, 0.5) + point_light(-2)
        story = self.told_of(shapes)
        self.assertRegex(story, r"light .*, +-\d\.\d+\)  at [\d.]+: blocked\n")
        self.assertRegex(story, r"adds .*\( +0, +0, +0\)  direct light\n")

    @needs_stage4
    def test_how_a_path_goes_on_and_ends(self):
        for shapes, *expected in [
            (square("white", 1), "diffuse\n", "leaves the scene\n"),
            (square("mirror", 1), "specular\n", "leaves the scene\n"),
            (square("glass", 1), "refraction\n", "leaves the scene\n"),
            (square("mirror", 1), "absorbed (roulette)\n"),
            (square("black", 1), "absorbed: the surface is black\n"),
            (sphere("glass", 3, 1), "the path is outside", "the path is inside"),
            (square("white", 1) + square("white", -1), "bound of 2 bounces\n"),
        ]:
            for text in expected:
                story = self.found(shapes, text, "--max-bounces=2")
                self.assertGreater(len(vertices_of(story)), 0)

    # Looking along the wall from inside the ball: beyond the critical angle.
    @needs_stage4
    def test_total_internal_reflection(self):
        for material, said in [
            ("glass", "total internal reflection\n"),
            ("mixed", "specular or total internal\n"),
        ]:
            ball = (
                f'[[shapes]]\ntype = "sphere"\nmaterial = "{material}"\ncenter = [0.95, 0, 0]\nradius = 1\n'
            )
            story = self.told_of(ball, "--max-bounces=1")
            self.assertIn(said, story)
            self.assertIn("the path is inside", story)

    @unittest.skipUnless("stage3" in built_stages(), "it is stage 3's")
    def test_a_tree_says_which_vertex_follows_which(self):
        shapes = sphere("mixed", 3, 1) + square("white", 9)
        story = self.told_of(shapes, "--max-bounces=2", program="stage3")
        heads = re.findall(r"^( *)vertex (\d+): .*, bounce (\d+)$", story, re.M)
        self.assertEqual([int(i) for _, i, _ in heads], list(range(len(heads))))
        bounces = [int(bounce) for *_, bounce in heads]
        for margin, _, bounce in heads:
            self.assertEqual(len(margin), 2 * int(bounce))
        followed = [int(i) for i in re.findall(r"to vertex (\d+)$", story, re.M)]
        self.assertEqual(sorted(followed), list(range(1, len(heads))))
        # Outside: the mirror image leaves the scene, the other ray goes in.
        first, *others = vertices_of(story)
        ways = [rest for label, rest in first if label == "goes"]
        self.assertEqual(
            [re.search(r"\)  (.*)", way)[1] for way in ways],
            ["specular", "refraction"] if "specular" in ways[0] else ["refraction", "specular"],
        )
        self.assertEqual(dict(first)["ends"], "leaves the scene")
        # Inside: one branch goes out, the other stays; both follow vertex 1.
        self.assertEqual(bounces[:2], [0, 1])
        inside = [rest for label, rest in others[0] if label == "weight"]
        self.assertEqual(len(inside), 2)


class WrongUsage(Pixels):
    def wrong(self, *arguments, about):
        result = run(*["stage1", SCENES / "cornell_box_ceiling_diffuse.toml"], *arguments, folder=self.folder)
        self.assertEqual((result.stdout, result.returncode), ("", 2))
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("stage1: "), result.stderr)
        self.assertIn(about, result.stderr)

    def test_a_pixel_outside_the_picture(self):
        for pixel in ["256,0", "0,256", "2147483647,0"]:
            self.wrong("--pixel", pixel, about=f"{pixel} is outside the picture of 256 x 256 pixels")
        self.wrong("--pixel=4,3", "--size=4x4096", about="4,3 is outside the picture of 4 x 4096 pixels")
        self.told("stage1", SCENES / "cornell_box_ceiling_diffuse.toml", "--pixel=255,255")

    def test_what_is_no_pixel(self):
        for text in ["", "1", "1,", ",1", "1,2,3", "-1,0", "0,-1", "a,b", "1.5,2", "1;2", "99999999999,0"]:
            self.wrong(f"--pixel={text}", about="--pixel")

    def test_what_is_no_sample(self):
        for text in ["", "-1", "1.5", "x", "1000000000", "4294967296"]:
            self.wrong("--pixel=1,1", f"--sample={text}", about="--sample")
        self.wrong("-o", "a.pfm", "--sample=1", about="--pixel")


class NotFinite(Pixels):
    """Prints of a program of which one sample in a hundred is infinite."""

    scene = SCENES / "cornell_box_ceiling_diffuse.toml"

    def is_finite(self, column, row, sample, *options):
        pixel = ["--pixel", f"{column},{row}", "--sample", sample]
        story = self.told("dropping", self.scene, *pixel, *options)
        return "inf" not in story.splitlines()[-1]

    def test_the_first_that_was_dropped_is_named_and_can_be_told(self):
        for seed in [1, 2, 3]:
            options = ["--size", "20x16", "--seed", seed]
            lines = set()
            for threads in [1, 4]:
                result = run(
                    *["dropping", self.scene, "-o", "out.pfm", "--spp=3"],
                    *["--threads", threads, *options],
                    folder=self.folder,
                )
                self.assertEqual(result.returncode, 0, result.stderr)
                lines.add(result.stderr)
            self.assertEqual(len(lines), 1, lines)
            said = re.fullmatch(
                r"dropping: (\d+) samples were not finite and were left out; "
                r"the first is pixel (\d+),(\d+), sample (\d+): --pixel \2,\3 "
                r"--sample \4 tells its path\n",
                lines.pop(),
            )
            self.assertIsNotNone(said)
            dropped, column, row, sample = map(int, said.groups())
            self.assertIn(dropped, range(1, 30))  # of 960
            self.assertFalse(self.is_finite(column, row, sample, *options))
            # The last few of the previous samples, one run for each.
            first = 3 * (20 * row + column) + sample
            for i in range(max(0, first - 40), first):
                pixel = i // 3
                self.assertTrue(self.is_finite(pixel % 20, pixel // 20, i % 3, *options))


if __name__ == "__main__":
    unittest.main()
