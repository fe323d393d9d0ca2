"""--report: what was rendered and how fast, for programs."""

import json
import resource
import unittest

from programs import SCENES, InFolder, built_stages, run
from test_command_line import Programs, interrupt

BOX = SCENES / "cornell_box_ceiling_diffuse.toml"
SMALL = ["--size", "12x8", "--spp", "5", "--max-bounces", "3"]

KEYS = (
    "program scene scene_hash width height samples_per_pixel first_sample max_bounces seed "
    "threads seconds cpu_seconds samples rays samples_per_second "
    "rays_per_sample dropped interrupted version outputs"
).split()


class Reports(Programs):
    def report(self, name="report.json"):
        return json.loads(self.bytes_of(name))

    def test_says_what_was_rendered(self):
        for program in built_stages():
            self.render(
                *["-o", "a.pfm", "-o", "b.ppm", "--report", "report.json"],
                *["--threads", "2", "--seed", "9", *SMALL],
                program=program,
            )
            report = self.report()
            self.assertEqual(list(report), KEYS)
            expected = {
                "program": program,
                "scene": str(BOX),
                "width": 12,
                "height": 8,
                "samples_per_pixel": 5,
                "max_bounces": 3,
                "seed": 9,
                "threads": 2,
                "samples": 12 * 8 * 5,
                "dropped": 0,
                "interrupted": False,
                "outputs": ["a.pfm", "b.ppm"],
            }
            self.assertEqual({key: report[key] for key in expected}, expected)
            # The same as in the image.
            pfm = self.bytes_of("a.pfm")
            for key in [
                "scene_hash",
                "rays",
                "seed",
                "samples_per_pixel",
                "first_sample",
                "max_bounces",
                "dropped",
            ]:
                self.assertIn(f"\n# {key} {report[key]}\n".encode(), pfm)

    def test_figures_fit_together(self):
        self.render("-o", "a.pfm", "--report", "report.json", "--spp", "64")
        report = self.report()
        self.assertGreater(report["seconds"], 0)
        self.assertGreater(report["cpu_seconds"], 0)
        self.assertLess(report["cpu_seconds"], report["seconds"] * report["threads"] + 0.1)
        self.assertAlmostEqual(report["samples_per_second"] * report["seconds"] / report["samples"], 1)
        self.assertAlmostEqual(report["rays_per_sample"] * report["samples"] / report["rays"], 1)
        self.assertGreater(report["rays_per_sample"], 1)

    def test_needs_no_image(self):
        self.render("--report", "report.json", *SMALL)
        self.assertEqual(self.files(), ["report.json"])
        self.assertEqual(self.report()["outputs"], [])

    def test_whole_numbers_of_64_bits_stay_whole(self):
        for seed in [0, 2**53 + 1, 2**64 - 1]:
            self.render("--report", "report.json", "--seed", seed, *SMALL)
            self.assertEqual(self.report()["seed"], seed)

    def test_any_name_of_a_file_is_valid_text(self):
        name = 'a "b" \\ \u00e9 \u2713.pfm'
        self.render("-o", name, "--report", "report.json", *SMALL)
        self.assertEqual(self.report()["outputs"], [name])
        result = run(
            *["stage1", BOX, "-o", b"\xff.pfm".decode("utf-8", "surrogateescape")],
            *["--report", "report.json", *SMALL],
            folder=self.folder,
        )
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.report()["outputs"], ["\ufffd.pfm"])

    def test_an_interrupted_render_says_so(self):
        process = self.start(
            *[BOX, "--report", "report.json", "-o", "a.pfm"],
            *["--spp", "1000000000", "--size", "16x16", "--quiet"],
        )
        interrupt(process)
        self.assertEqual(process.wait(60), 130)
        report = self.report()
        self.assertTrue(report["interrupted"])
        self.assertGreater(report["samples_per_pixel"], 0)
        self.assertLess(report["samples_per_pixel"], 10**9)
        self.assertGreaterEqual(report["samples"], 256 * report["samples_per_pixel"])

    def test_where_it_cannot_be_written(self):
        for path, why in [("no/report.json", "there is no folder 'no'"), ("folder.json", "it is a folder")]:
            (self.folder / "folder.json").mkdir(exist_ok=True)
            result = run(
                *["stage1", BOX, "-o", "a.pfm", "--report", path],
                *["--spp", "1000000000"],
                folder=self.folder,
            )
            self.assert_one_line(result, f"stage1: {path} cannot be written: {why}")
            self.assertEqual(self.files(), ["folder.json"])

    def test_a_full_disk_leaves_the_old_one(self):
        def let_no_file_grow():
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))

        (self.folder / "report.json").write_text("the old file")
        result = run(
            *["stage1", BOX, "--report", "report.json", *SMALL],
            folder=self.folder,
            preexec_fn=let_no_file_grow,
        )
        self.assert_one_line(result, "stage1: report.json cannot be written: ...")
        self.assertEqual(self.bytes_of("report.json"), b"the old file")
        self.assertEqual(self.files(), ["report.json"])

    def test_its_name_ends_in_json(self):
        for name in ["report", "a.pfm", "json", ".json"]:
            result = run("stage1", BOX, "--report", name, folder=self.folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn(f"'{name}' does not end in .json", result.stderr)


del Programs, InFolder  # unittest would run the tests that it imports

if __name__ == "__main__":
    unittest.main()
