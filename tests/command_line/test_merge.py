"""Parts of a picture, rendered with --first-sample, and put together."""

from programs import ENDINGS, SCENES, InFolder, read_pfm, run

from tools.tree import read_variance

SCENE = SCENES / "cornell_box_ceiling_diffuse.toml"
OPTIONS = ["--size", "24x17", "--max-bounces", "5", "--quiet"]


def floats(path):
    """All numbers of the mean, and of the variance."""
    pictures = read_pfm(path)[2], read_variance(path)[2]
    return [[x for pixel in pixels for x in pixel] for pixels in pictures]


class Merge(InFolder):
    def part(self, first, count, *others, name=None, ending="pfm"):
        path = self.folder / f"{name or first}.{ending}"
        done = run("stage1", SCENE, "-o", path, *OPTIONS, "--spp", count, "--first-sample", first, *others)
        self.assertEqual(done.returncode, 0, done.stderr)
        return path

    def merge(self, *parts, output="whole.pfm"):
        return run("stage-merge", *parts, "-o", self.folder / output)

    def assert_refuses(self, sentence, *parts):
        done = self.merge(*parts)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn(sentence, done.stderr)
        self.assertFalse((self.folder / "whole.pfm").exists())

    def test_a_merged_picture_is_the_whole_one_to_rounding(self):
        for ending in [one for one in ENDINGS if one in ("pfm", "exr")]:
            parts = [self.part(first, count, ending=ending) for first, count in ((0, 20), (20, 1), (21, 43))]
            done = self.merge(parts[2], parts[0], parts[1])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("64 samples per pixel", done.stdout)
            means, variances = floats(self.folder / "whole.pfm")
            expected = floats(self.part(0, 64, name="at_once"))
            # Each part's mean is rounded to 24 bits, and so is the whole one: some units
            # in the last place of the largest of the parts.
            for found, right, relative in ((means, expected[0], 4e-7), (variances, expected[1], 4e-6)):
                scale = max(right)
                for one, other in zip(found, right):
                    self.assertLessEqual(abs(one - other), relative * scale, (one, other))

    def test_a_part_has_the_samples_that_it_says(self):
        # The sum of 3 and 1 samples is that of 4: with other samples it would not be.
        three, one, four = (
            floats(self.part(*which, name=name))[0]
            for *which, name in ((0, 3, "a"), (3, 1, "b"), (0, 4, "c"))
        )
        for a, b, c in zip(three, one, four):
            self.assertAlmostEqual((3 * a + b) / 4, c, delta=1e-6 * (abs(a) + abs(b) + 1e-3))

    def test_a_merged_picture_can_be_merged_again(self):
        self.merge(self.part(0, 2), self.part(2, 2), output="half.pfm")
        done = self.merge(self.folder / "half.pfm", self.part(4, 4))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"# samples_per_pixel 8\n", (self.folder / "whole.pfm").read_bytes())

    def test_what_is_no_part_is_refused(self):
        first = self.part(0, 4)
        self.assert_refuses("sample 2 is in two parts", first, self.part(2, 4))
        self.assert_refuses("sample 4 is in no part", first, self.part(6, 4))
        self.assert_refuses("different seeds", first, self.part(4, 4, "--seed", 2))
        self.assert_refuses("different bounds of bounces", first, self.part(4, 4, "--max-bounces", 2))
        self.assert_refuses("different sizes", first, self.part(4, 4, "--size", "5x5"))
        other = self.folder / "other.toml"
        other.write_text(SCENE.read_text() + "# another\n")
        path = self.folder / "other.pfm"
        run("stage1", other, "-o", path, *OPTIONS, "--spp", 4, "--first-sample", 4)
        self.assert_refuses("different scenes", first, path)
        (self.folder / "broken.pfm").write_text("PF\n")
        self.assert_refuses("broken.pfm", first, self.folder / "broken.pfm")

    def test_usage(self):
        self.assertEqual(run("stage-merge").returncode, 2)
        self.assertIn("--first-sample", run("stage-merge", "--help").stdout)
