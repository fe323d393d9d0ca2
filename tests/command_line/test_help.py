"""--help: an example that works, and every option with its real default."""

import json
import re
import unittest

from broken_scenes import GOOD, with_instead
from programs import ROOT, InFolder, built_stages, run

SHARED = "common/program/command_line.hpp"
# Without a size and [render], so that these have the program's defaults.
SCENE = with_instead("size = [4, 4]\n", "")
# A stage that has photons has these, too.
PHOTONS = {"--photons", "--neighbors", "--filter", "--radius"}
SCENE = with_instead(SCENE[SCENE.index("[render]") : SCENE.index("[materials]")], "", SCENE)


def options_in(*sources):
    """The options that these sources add to a command line."""
    text = "".join((ROOT / source).read_text() for source in sources)
    return set(re.findall(r'"(?:-\w,)?(--[a-z-]+)"', text))


class Help(InFolder):
    def help_of(self, program):
        result = run(program, "--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(run(program, "-h").stdout, result.stdout)
        return result.stdout

    def rows(self, program):
        """Each option's default, "" if it has none, and its meaning."""
        text = self.help_of(program)
        lines = text.split("\n\n")[2].splitlines()
        start = lines[0].find("default")
        rows = {}
        for line in lines:
            found = re.match(r"  (?:-\w, )?(--[a-z-]+)(?: [A-Za-z,]+)?  +(.*)", line)
            if not found:
                continue
            has_default = start >= 0 and line[start] != " "
            default, meaning = re.split("  +", found[2]) if has_default else ("", found[2])
            rows[found[1]] = default, meaning
        return rows

    def test_fits_in_80_columns(self):
        for program in [*built_stages(), "stage-diff"]:
            with self.subTest(program):
                text = self.help_of(program)
                for line in text.splitlines():
                    self.assertLessEqual(len(line), 80, line)
                self.assertNotRegex(text, r"REQUIRED|TEXT|FLOAT|ENUM|\{", "CLI11's own words")

    def test_every_option_is_in_it(self):
        sources = {program: "common/program/options.cpp" for program in built_stages()}
        for program, source in {**sources, "stage-diff": "compare/stage_diff.cpp"}.items():
            with self.subTest(program):
                rows = self.rows(program)
                taken = options_in(source, SHARED)
                main = next(ROOT.glob(f"stages/{program.removeprefix('stage')}_*/main.cpp"), None)
                if not main or "has_photons" not in main.read_text():
                    taken -= PHOTONS
                self.assertLessEqual({"--output", "--help", "--version"}, taken)
                self.assertEqual(set(rows), taken)
                for option, (_, meaning) in rows.items():
                    self.assertTrue(meaning, f"{option} has no meaning")

    def rendered(self, program, option, *given):
        """The output of a small render, with or without `option`."""
        small = [] if option == "--size" else ["--size", "4x4"]
        small += [] if option == "--spp" else ["--spp", "1"]
        if option == "--sample":
            small += ["--pixel", "1,1"]
        image = "a.png" if option in ("--tone-map", "--gamma", "--exposure") else "a.pfm"
        result = run(
            program, "scene.toml", "-o", image, "--report", "a.json", *small, *given, folder=self.folder
        )
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        if option == "--sample":
            return result.stdout
        report = json.loads((self.folder / "a.json").read_text())
        known = {key: value for key, value in report.items() if "second" not in key}
        return known, (self.folder / image).read_bytes()

    def test_each_default_is_the_real_one(self):
        (self.folder / "scene.toml").write_text(SCENE)
        for program in {built_stages()[0], built_stages()[-1]}:
            defaults = {option: row[0] for option, row in self.rows(program).items() if row[0]}
            self.assertLessEqual({"--spp", "--max-bounces", "--size", "--tone-map"}, set(defaults))
            for option, default in defaults.items():
                value = default.removeprefix("scene's, or ")
                self.assertEqual(
                    self.rendered(program, option),
                    self.rendered(program, option, option, value),
                    f"{program} {option} {default}",
                )

    def test_the_example_works(self):
        for program in built_stages():
            command, scene, *options = self.example(program)
            self.assertEqual(command, f"build/{program}")
            result = run(program, ROOT / scene, *options, "--size", "4x4", "--spp", "1", folder=self.folder)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(self.files(), ["box.png"])

    def test_the_example_of_stage_diff_works(self):
        (self.folder / "scene.toml").write_text(GOOD)
        for name, seed in [("a.pfm", "1"), ("b.pfm", "2")]:
            run("stage1", "scene.toml", "-o", name, "--spp", "9", "--seed", seed, folder=self.folder)
        command, *arguments = self.example("stage-diff")
        self.assertEqual(command, "build/stage-diff")
        result = run("stage-diff", *arguments, folder=self.folder)
        self.assertEqual(result.stderr, "")
        self.assertEqual(self.files(), ["a.pfm", "b.pfm", "diff.png", "scene.toml"])

    def example(self, program):
        first, usage = self.help_of(program).splitlines()[:2]
        self.assertTrue(usage.startswith(f"Usage: {program} "), usage)
        self.assertTrue(first.startswith("Example: "), first)
        return first.split()[1:]


if __name__ == "__main__":
    unittest.main()
