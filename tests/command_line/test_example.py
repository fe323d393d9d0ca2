"""examples/paint.cpp: a separate program that needs only GLM and this folder."""

import os
import re
import shutil
import subprocess
import unittest

from programs import BUILD, ROOT, SCENES, InFolder, read_pfm, run, run_command


def configured(name):
    """A variable of the build folder's CMake cache."""
    cache = (BUILD / "CMakeCache.txt").read_text()
    found = re.search(rf"^{name}:\w+=(.*)$", cache, re.MULTILINE)
    return found[1] if found else ""


@unittest.skipUnless(list(ROOT.glob("stages/4_*/path_tracer.hpp")), "it paints with stage 4")
class Example(InFolder):
    def test_is_built_and_run_in_an_empty_folder(self):
        shutil.copy(ROOT / "examples/paint.cpp", self.folder)
        compiler = os.environ.get("CXX") or configured("CMAKE_CXX_COMPILER")
        command = [compiler, "-std=c++20", "-O1", "-ffp-contract=off"]
        command += ["-pthread", "-I", ROOT, "paint.cpp", "-o", "paint"]
        if prefix := re.match(r"(.*)/(share|lib\w*)/", configured("glm_DIR")):
            if os.path.isdir(f"{prefix[1]}/include/glm"):
                command += ["-idirafter", f"{prefix[1]}/include"]
        built = subprocess.run(
            [*command, "-MD", "-MF", "needs"], cwd=self.folder, capture_output=True, text=True
        )
        self.assertEqual((built.returncode, built.stderr), (0, ""))
        # No other library, not even its headers.
        for library in ["toml++", "CLI", "OpenImageIO", "nlohmann", "boost"]:
            needs = (self.folder / "needs").read_text()
            self.assertNotIn(f"/{library}/", needs)
        self.assertIn("/glm/", needs)

        before = self.files()
        done = run_command([self.folder / "paint"], cwd=self.folder)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(self.files(), sorted([*before, "box.pfm"]))

        # It is the lab's box: the same bits as from its scene file.
        width, height, pixels = read_pfm(self.folder / "box.pfm")
        self.assertEqual((width, height), (128, 128))
        same = run(
            *["stage4", SCENES / "cornell_box_point.toml", "-o", "same.pfm"],
            *["--size", "128x128", "--spp", "16"],
            folder=self.folder,
        )
        self.assertEqual(same.returncode, 0, same.stderr)
        self.assertEqual(pixels, read_pfm(self.folder / "same.pfm")[2])

    def test_is_short(self):
        text = (ROOT / "examples/paint.cpp").read_text()
        lines = [one for one in text.splitlines() if one.strip()]
        self.assertLessEqual(len(lines), 45)


if __name__ == "__main__":
    unittest.main()
