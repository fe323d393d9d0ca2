"""Textures that cannot be used: one clear line each, and no picture."""

import resource
import struct
import unittest
import zlib

import programs

SCENE = """[camera]
origin = [0, 0, -3.5]
left = [-1, 0, 0]
up = [0, 1, 0]
forward = [0, 0, 3]
size = [8, 8]
[materials]
m = { kd = { image = "NAME" } }
[[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 1
material = "m"
[[lights]]
type = "point"
center = [0, 0, -3]
intensity = 1
"""


def chunk(kind, data):
    check = zlib.crc32(kind + data)
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)


def png(width, height, rows):
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )


GOOD = png(64, 64, (b"\0" + bytes(range(192))) * 64)


def little_memory():
    """Limits the memory, so that a header which promises gigabytes must be refused."""
    limit = 1 << 30
    resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))


@unittest.skipUnless("stage5" in programs.built_stages(), "there is no stage 5")
class Textures(programs.InFolder):
    def render(self, name):
        scene = self.folder / "scenes" / "scene.toml"
        scene.parent.mkdir(exist_ok=True)
        scene.write_text(SCENE.replace("NAME", name))
        return programs.run(
            "stage5",
            *("scenes/scene.toml", "-o", "out.pfm", "--spp", "1"),
            folder=self.folder,
            preexec_fn=None if programs.sanitized() else little_memory,
        )

    def check_refused(self, name, expected):
        result = self.render(name)
        shown = name[:60].replace(r"\u0000", " ")
        place = f"stage5: scenes/scene.toml:8:22: texture '{shown}"
        self.assert_one_line(result, place + "...")
        self.assertIn(expected, result.stderr)
        self.assertNotIn("out.pfm", self.files())

    def put(self, name, data):
        path = self.folder / "scenes" / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(data)

    def test_a_good_one_is_used(self):
        self.put("good.png", GOOD)
        result = self.render("good.png")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_missing(self):
        self.check_refused("missing.png", "there is no such file")

    def test_a_folder(self):
        self.put("a.txt", b"")
        (self.folder / "scenes" / "folder.png").mkdir()
        self.check_refused("folder.png", "it is not a file")

    def test_unknown_ending(self):
        self.put("texture.gif", GOOD)
        self.check_refused("texture.gif", "ends in none of .png, .jpg, .jpeg")

    def test_empty(self):
        self.put("empty.png", b"")
        self.check_refused("empty.png", "cannot be used: ")

    def test_not_an_image(self):
        self.put("text.png", b"this is no picture, whatever its name says\n" * 9)
        self.check_refused("text.png", "cannot be used: ")

    def test_truncated(self):
        for length in (20, 40, len(GOOD) // 2, len(GOOD) - 30):
            with self.subTest(length=length):
                self.put("cut.png", GOOD[:length])
                self.check_refused("cut.png", "cannot be used: ")

    def test_damaged(self):
        middle = len(GOOD) // 2
        damaged = GOOD[:middle] + b"\xff" * 40 + GOOD[middle + 40 :]
        self.put("damaged.png", damaged)
        self.check_refused("damaged.png", "cannot be used: ")

    def test_huge_by_its_header(self):
        for width, height in ((100_000, 100_000), (2**31 - 1, 1), (60_000, 60_000)):
            with self.subTest(width=width, height=height):
                self.put("huge.png", png(width, height, b"\0" * 1000))
                self.check_refused("huge.png", "cannot be used: ")

    def test_more_than_a_texture_may_have(self):
        self.put("large.png", png(16_000, 16_000, b"\0" * 1000))
        self.check_refused("large.png", "claims 16000 x 16000 pixels; possible are")

    def test_a_name_with_a_nul(self):
        self.put("a.png", GOOD)
        self.check_refused(r"a.png\u0000.png", "its name has a NUL character")

    def test_no_pixels(self):
        self.put("none.png", png(0, 8, b""))
        self.check_refused("none.png", "cannot be used: ")

    def test_outside_the_scenes_folder(self):
        (self.folder / "scenes").mkdir()
        (self.folder / "outside.png").write_bytes(GOOD)
        outside = "it must lie in the scene's folder"
        self.check_refused("../outside.png", outside)
        self.check_refused(str(self.folder / "outside.png"), outside)
        self.check_refused(str(self.folder / "scenes" / "in.png"), outside)
        (self.folder / "scenes" / "link.png").symlink_to(self.folder / "outside.png")
        self.check_refused("link.png", outside)

    def test_below_the_scenes_folder(self):
        (self.folder / "scenes" / "deep").mkdir(parents=True)
        self.put("deep/good.png", GOOD)
        self.assertEqual(self.render("deep/../deep/good.png").returncode, 0)


if __name__ == "__main__":
    unittest.main()
