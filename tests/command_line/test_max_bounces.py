"""The bound on bounces reaches every stage's paths, from the option and the scene file.

A lamp of radius 1/2 within a sphere of radius 1 fills a quarter of what any
point of the wall sees. With at most N bounces the wall's radiance is

    kd ke F (1 + q + ... + q^(N-1)),   F = 1/4,  q = kd (1 - F)
"""

import math
import statistics
import unittest

import programs

SCENE = """[camera]
origin = [0.6, 0, 0]
left = [0, 0, 0.4]
up = [0, 0.4, 0]
forward = [1, 0, 0]
size = [8, 8]
[materials]
wall = { kd = 0.8 }
lamp = { ke = 4 }
[[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 1
material = "wall"
[[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 0.5
material = "lamp"
"""


def radiance(bounces):
    return 0.8 * 4 / 4 * sum((0.8 * 3 / 4) ** i for i in range(bounces))


class MaxBounces(programs.InFolder):
    def check(self, stage, bounces, said_in_scene):
        """The mean over the pixels, which all estimate the same number."""
        scene = SCENE + (f"[render]\nmax_bounces = {bounces}\n" if said_in_scene else "")
        (self.folder / "scene.toml").write_text(scene)
        options = [] if said_in_scene else ["--max-bounces", bounces]
        done = programs.run(stage, "scene.toml", "-o", "out.pfm", "--spp", 64, *options, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        reds = [pixel[0] for pixel in programs.read_pfm(self.folder / "out.pfm")[2]]
        mean = statistics.fmean(reds)
        sigma = statistics.stdev(reds) / math.sqrt(len(reds))
        expected = radiance(bounces)
        self.assertLessEqual(
            abs(mean - expected),
            5 * sigma + 1e-4,
            f"{stage}, at most {bounces} bounces: mean {mean:.4f} +- {sigma:.4f}, expected "
            f"{expected:.4f}; one bounce less has {radiance(max(0, bounces - 1)):.4f}, "
            f"one more {radiance(bounces + 1):.4f}",
        )

    def test_the_option_is_exact(self):
        for stage in programs.built_stages():
            for bounces in range(4):
                with self.subTest(stage=stage, bounces=bounces):
                    self.check(stage, bounces, said_in_scene=False)

    def test_the_scenes_word_is_exact(self):
        for stage in programs.built_stages():
            for bounces in (0, 3):
                with self.subTest(stage=stage, bounces=bounces):
                    self.check(stage, bounces, said_in_scene=True)


if __name__ == "__main__":
    unittest.main()
