"""Checks numbers in README.md, CHANGELOG.md and chapter 6 against tools/bench/measured/, or counts them.

PYTHONPATH=. python3 tests/house/test_figures.py
"""

import re
import tomllib
import unittest
from decimal import Decimal

from tools.tree import ROOT, stage_headers

MEASURED = ROOT / "tools/bench/measured"
WORDS = "zero one two three four five six seven eight nine ten".split()
BOXES = {
    "point light, diffuse": "cornell_box_point_diffuse",
    "shining ceiling, diffuse": "cornell_box_ceiling_diffuse",
    "point light, all materials": "cornell_box_point",
    "shining ceiling, all materials": "cornell_box_ceiling",
}
PROGRAMS = {"stage 5": "stage5, avx2", "stage 6, AVX2": "stage6, avx2", "stage 6, AVX-512": "stage6, avx512"}


def rows(text):
    """The cells of a table's rows, the head first."""
    lines = [line.strip("| \n").split("|") for line in text.split("\n") if line.startswith("|")]
    return [[cell.strip() for cell in cells] for cells in lines if not set(cells[0]) <= {"-"}]


def section(text, title):
    """The text below a title of Markdown or of a chapter's prose."""
    text = re.sub(r"^// ?", "", text, flags=re.MULTILINE)
    return re.split(r"^## ", re.split(rf"^## {title}$", text, flags=re.MULTILINE)[1], flags=re.MULTILINE)[0]


def peers():
    """Seconds of processor time, and how many times as long Mitsuba takes, by box and program."""
    found = rows((MEASURED / "peers.md").read_text().lower().replace("avx-", "avx"))[1:]
    return {(box, name): (Decimal(cpu), Decimal(times.split(" ")[0])) for box, name, cpu, times, *_ in found}


def rate(benchmark):
    """Items per second of a benchmark."""
    for name, _, items in rows((MEASURED / "benchmarks.md").read_text()):
        if name == benchmark:
            number, unit = items.split(" ")
            return Decimal(number) * {"k/s": 10**3, "M/s": 10**6}[unit]
    raise AssertionError(f"tools/bench/measured/benchmarks.md has no {benchmark}")


def differs(figure, measured):
    """Whether a figure differs from the measured number, rounded to as many digits.
    The measured number has been rounded, too."""
    digits = Decimal(1).scaleb(Decimal(figure).as_tuple().exponent)
    return abs(Decimal(figure) - measured) > digits * Decimal("0.51")


class Figures(unittest.TestCase):
    def setUp(self):
        self.readme = (ROOT / "README.md").read_text()

    def find(self, pattern, text, name):
        """The only match of the pattern in a text."""
        found = re.findall(pattern, " ".join(text.split()))
        self.assertEqual(len(found), 1, f"{name}: {pattern!r} is there {len(found)} times")
        return found[0]

    def assert_measured(self, what, figure, table, measured):
        if differs(figure, measured):
            self.fail(f"{what} has {figure}, and {table} {measured:.2f}")

    def test_the_table_of_speed(self):
        head, *lines = rows(section(self.readme, "Speed"))
        self.assertEqual((head[1:], [line[0] for line in lines]), (list(PROGRAMS), list(BOXES)))
        for label, *figures in lines:
            for column, figure in zip(head[1:], figures, strict=True):
                _, times = peers()[BOXES[label], PROGRAMS[column]]
                self.assert_measured(
                    f"README.md, Speed: {label}, {column},", figure, "tools/bench/measured/peers.md", times
                )

    def test_how_it_was_measured(self):
        runs, cores = self.find(r"on the same (\w+) cores.*medians of (\w+) runs", self.readme, "README.md")[
            ::-1
        ]
        peers_py = (ROOT / "tools/bench/peers.py").read_text()
        samples = self.find(r"(\d+) samples per pixel, beside", self.readme, "README.md")
        for said, option in ((WORDS.index(runs), "repetitions"), (int(samples), "spp")):
            told = int(self.find(rf'"--{option}", default=(\d+)', peers_py, "tools/bench/peers.py"))
            self.assertEqual(
                said, told, f"README.md, Speed: {said}, and tools/bench/peers.py --{option} {told}"
            )
        processors = self.find(
            r"(\d+) processors", (MEASURED / "peers.md").read_text(), "tools/bench/measured/peers.md"
        )
        self.assertEqual(
            WORDS.index(cores), int(processors), "README.md, Speed: cores, tools/bench/measured/peers.md"
        )
        for box in BOXES.values():
            size = tomllib.loads((ROOT / f"scenes/{box}.toml").read_text())["camera"]["size"]
            said = self.find(rf"boxes, (\d+) x (\d+) and {samples} samples", self.readme, "README.md")
            self.assertEqual(
                [*map(int, said)], size, f"README.md, Speed: {said}, and scenes/{box}.toml {size}"
            )

    def test_many_spheres(self):
        figure = self.find(
            r"100,000 spheres renders at 1/([\d.]+) of the speed of one with ten", self.readme, "README.md"
        )
        measured = rate("cost_of_shapes/spheres/10") / rate("cost_of_shapes/spheres/100000")
        self.assert_measured(
            "README.md: 100,000 spheres", figure, "tools/bench/measured/benchmarks.md", measured
        )

    def test_stage_6_beside_stage_5(self):
        found = peers()

        def gain(box, program):
            return found[box, "stage5, avx2"][0] / found[box, program][0]

        chapter = next(ROOT.glob("stages/6_*/path_tracer.hpp")).read_text()
        lines = rows(section(chapter, "What it buys"))
        for line, box in zip(lines[1:], ("cornell_box_point", "cornell_box_ceiling"), strict=True):
            for column, figure, program in zip(
                lines[0][1:], line[1:], ("stage6, avx2", "stage6, avx512"), strict=True
            ):
                what = f"chapter 6, What it buys: {line[0]}, {column},"
                self.assert_measured(what, figure, "tools/bench/measured/peers.md", gain(box, program))
        gains = [gain(box, name) for box in BOXES.values() for name in ("stage6, avx2", "stage6, avx512")]
        changes = (ROOT / "CHANGELOG.md").read_text()
        least, most = self.find(r"to the last bit, (\w+) to (\w+) times sooner", changes, "CHANGELOG.md")
        for word, measured in ((least, min(gains)), (most, max(gains))):
            self.assert_measured(
                "CHANGELOG.md, stage 6", str(WORDS.index(word)), "tools/bench/measured/peers.md", measured
            )

    def test_the_mistakes_are_counted(self):
        files = sorted((ROOT / "tests/mistakes").glob("stage?.toml"))
        entries = [one for path in files for one in tomllib.loads(path.read_text())["mistake"]]
        count = sum(one.get("verdict", "fail") == "fail" for one in entries)
        said = int(self.find(r"each of over (\d+) mistakes", self.readme, "README.md"))
        self.assertEqual(
            said, count // 10 * 10, f"README.md: over {said} mistakes, and tests/mistakes/ has {count}"
        )
        gallery = len(tomllib.loads((ROOT / "tools/book/gallery.toml").read_text())["mistake"])
        said = int(
            self.find(r"a gallery of (\d+) mistakes", (ROOT / "CHANGELOG.md").read_text(), "CHANGELOG.md")
        )
        self.assertEqual(said, gallery, "CHANGELOG.md: the gallery, and tools/book/gallery.toml")

    def test_the_rooms_are_counted(self):
        rooms = len({path.parent for path in (ROOT / "common").glob("*/*.hpp")})
        for name in ("common/README.md", "CHANGELOG.md"):
            word = self.find(r"in (\w+) rooms", (ROOT / name).read_text(), name)
            self.assertEqual(WORDS.index(word), rooms, f"{name} has {word} rooms, and common/ {rooms}")

    def test_the_stages_are_counted(self):
        listed = rows(section(self.readme, "The stages"))[1:]
        links = [f"{number}: {re.search(r'stages/.*hpp', chapter)[0]}" for number, chapter, _ in listed]
        headers = [header.relative_to(ROOT).as_posix() for header in stage_headers()]
        # Counts from the first: a stage that is being written is not there yet.
        chapters = [f"{header[7]}: {header}" for header in headers[: len(links)]]
        self.assertEqual(links, chapters, "README.md, The stages")
        first, last = map(
            int, self.find(r"Stages (\d) to (\d) follow one path at a time", self.readme, "README.md")
        )
        many = [int(path[7]) for path in headers if "/rows/" in (ROOT / path).read_text()]
        single = [int(path[7]) for path in headers if int(path[7]) not in many]
        self.assertLessEqual(
            set(range(first, last + 1)), set(single), "README.md: stages that follow one path at a time"
        )
        self.assertEqual(many, [int(self.find(r"Stage (\d) follows sixteen", self.readme, "README.md"))])


if __name__ == "__main__":
    unittest.main()
