"""A broken scene is refused with one line that says where and why."""

import os
import re
import unittest

from broken_scenes import BROKEN, GOOD, with_instead
from programs import InFolder, built_stages, run


class BrokenScenes(InFolder):
    """The code below adds one test for each entry of the table."""

    def check(self, broken):
        if broken.program not in built_stages():
            self.skipTest(f"{broken.program} is not built")
        scene = broken.scene
        data = scene if isinstance(scene, bytes) else scene.encode()
        (self.folder / "scene.toml").write_bytes(data)
        result = run(broken.program, "scene.toml", "-o", "out.pfm", folder=self.folder)
        place = re.match(r"\w+: scene\.toml:\d+:(\d+): .", result.stderr)
        if not place:
            self.fail(
                f"expected {broken.message!r}, but {broken.program} ended with "
                f"{result.returncode} and says {result.stderr[:2000]!r}"
            )
        message = broken.message.replace("COLUMN", place[1])
        self.assert_one_line(result, f"{broken.program}: scene.toml:{message}")
        self.assertEqual(self.files(), ["scene.toml"])


for entry in BROKEN:
    test = lambda self, entry=entry: self.check(entry)
    test.__doc__ = entry.name
    words = "".join(c if c.isalnum() else "_" for c in entry.name)
    assert not hasattr(BrokenScenes, "test_" + words), words
    setattr(BrokenScenes, "test_" + words, test)


class NoSceneFile(InFolder):
    def check(self, scene, message, **options):
        before = self.files()
        result = run("stage1", scene, "-o", "out.pfm", folder=self.folder, **options)
        self.assert_one_line(result, "stage1: " + message)
        self.assertEqual(self.files(), before)

    def test_a_file_that_is_not_there(self):
        self.check("no.toml", "no.toml: there is no such scene file")

    def test_a_scene_of_a_similar_name(self):
        (self.folder / "scenes").mkdir()
        for name in ["box.toml", "glass.toml", "scenes/cube.toml", "scenes/mirror.toml"]:
            (self.folder / name).touch()
        (self.folder / "boxes.toml").mkdir()
        for typed, meant in [
            ("bxo.toml", "box.toml"),
            ("./glas.toml", "./glass.toml"),
            ("box", "box.toml"),
            ("boxes", "box.toml"),
            ("mirrors.toml", "scenes/mirror.toml"),
            ("scenes/mirro.toml", "scenes/mirror.toml"),
            ("scene/cube.toml", "scenes/cube.toml"),
            (f"{self.folder}/mirro.toml", f"{self.folder}/scenes/mirror.toml"),
        ]:
            with self.subTest(typed):
                self.check(typed, f"{typed}: there is no such scene file, did you mean '{meant}'?")
        self.check("sunset.toml", "sunset.toml: there is no such scene file")

    def test_a_name_that_no_file_can_have(self):
        self.check(18_000 * "x", 300 * "x" + "...: there is no such scene file")

    def test_a_name_that_is_empty(self):
        self.check("", "'': there is no such scene file")

    def test_a_name_with_a_line_break(self):
        self.check("no\n.toml", "no .toml: there is no such scene file")

    def test_a_folder(self):
        (self.folder / "folder.toml").mkdir()
        self.check("folder.toml", "folder.toml: is a folder, not a scene file")

    def test_a_file_as_a_folder(self):
        (self.folder / "file").touch()
        self.check("file/scene.toml", "file/scene.toml: there is no such scene file")

    def test_a_link_to_nowhere(self):
        (self.folder / "link.toml").symlink_to("nowhere")
        self.check("link.toml", "link.toml: there is no such scene file")

    def test_a_link_to_itself(self):
        (self.folder / "link.toml").symlink_to("link.toml")
        self.check("link.toml", "link.toml: there is no such scene file")

    def test_a_pipe(self):
        # Opening it would wait for a writer forever.
        os.mkfifo(self.folder / "pipe.toml")
        self.check("pipe.toml", "pipe.toml: is not a regular file")

    def test_devices(self):
        for device in ["/dev/null", "/dev/zero"]:
            with self.subTest(device):
                self.check(device, f"{device}: is not a regular file")

    @unittest.skipUnless(os.path.exists("/proc/self/mem"), "needs Linux")
    def test_a_file_that_cannot_be_read(self):
        self.check("/proc/self/mem", "/proc/self/mem: cannot be read")

    def test_a_file_larger_than_any_scene(self):
        with open(self.folder / "large.toml", "wb") as file:
            file.truncate(1 << 40)  # takes no room on the disk
        self.check("large.toml", "large.toml: is larger than ...")


class GoodScenes(InFolder):
    """The good scene, from which the broken ones are made, is accepted."""

    def accept(self, scene):
        (self.folder / "scene.toml").write_text(scene, encoding="utf-8")
        result = run("stage1", "scene.toml", "-o", "out.pfm", folder=self.folder)
        self.assertEqual(result.stderr, "")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(self.files(), ["out.pfm", "scene.toml"])

    def test_the_good_scene(self):
        self.accept(GOOD)

    def test_a_byte_order_mark_and_the_line_ends_of_windows(self):
        self.accept("\ufeff" + GOOD.replace("\n", "\r\n"))

    def test_points_in_comments_and_strings_are_no_long_keys(self):
        dots = 100 * "a."
        for line in [f"# {dots}", f"'{dots}' = {{}}", f'"\\"{dots}" = {{}}']:
            self.accept(with_instead("white =", line + "\nwhite ="))

    def test_integers_that_no_double_holds(self):
        self.accept(with_instead("center = [0.5,", "center = [500000000001,"))

    def test_a_scene_of_many_lines(self):
        sphere = GOOD.split("\n\n")[4]
        self.assertIn("sphere", sphere)
        spheres = [sphere.replace("0.3", f"0.{1000 + i}") for i in range(2000)]
        self.accept(GOOD + "\n" + "\n\n".join(spheres) + "\n")


if __name__ == "__main__":
    unittest.main()
