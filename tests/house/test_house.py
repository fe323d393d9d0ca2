"""Includes and imports point one way, and the map of the core is complete.

PYTHONPATH=. python3 tests/house/test_house.py    prints these arrows too
"""

import collections
import pathlib
import re
import shutil
import tempfile
import unittest
from unittest import mock

from tools import tree
from tools.tree import ROOT

CPP = re.compile(r'^\s*#\s*include "(.*)"', re.MULTILINE)
PYTHON = re.compile(r"^from (\S+) import (\w+)|^import (\S+)", re.MULTILINE)


def room(path):
    """The unit of the rules: common/geometry, stages/3, tests."""
    first, *rest = path.relative_to(ROOT).parts
    if path.name == "drawings.py":
        return "drawings"
    if path.name == "tree.py":
        return "tree"
    if first == "common" and len(rest) > 1:
        return f"common/{rest[0]}"
    return f"stages/{rest[0][0]}" if first == "stages" and len(rest) > 1 else first


def included(path):
    """The files of the tree that this one includes or imports."""
    text = path.read_text()
    names = CPP.findall(text)
    if path.suffix == ".py":
        for package, name, module in PYTHON.findall(text):
            there = (module or package).replace(".", "/")
            names += [f"{there}.py", f"{there}/{name}.py"]
    for name in names:
        for folder in (ROOT, ROOT / "tests"):
            if (folder / name).is_file():
                yield folder / name
                break


def arrows():
    count = collections.Counter()
    for top in ("common", "stages", "compare", "tests", "tools"):
        for path in (ROOT / top).rglob("*"):
            if path.suffix in (".hpp", ".cpp", ".py"):
                count.update((room(path), room(other)) for other in included(path))
    return count


def ranks():
    """A room may use those of a lower rank; the core's are in its map's order.
    A chapter's drawings use the tools, and nothing imports the drawings. All
    Python uses tools/tree.py."""
    core = re.findall(r"^## (\w+)", (ROOT / "common/README.md").read_text(), re.MULTILINE)
    order = ["tree"] + [f"common/{name}" for name in core] + ["compare", "stages"]
    order += sorted({room(path) for path in tree.stage_headers()})
    return {name: rank for rank, name in enumerate([*order, "tests", "tools", "drawings"])}


class House(unittest.TestCase):
    def test_no_arrow_points_back(self):
        rank = ranks()
        back = [f"{a} -> {b}" for a, b in arrows() if a != b and rank.get(a, -1) <= rank.get(b, 99)]
        self.assertEqual(back, [])

    def test_headers_fit_on_pages(self):
        """The limits of CONTRIBUTING.md: lines of a header, and columns of a line."""
        for path in [*ROOT.glob("common/*/*.hpp"), *ROOT.glob("stages/**/*.hpp")]:
            with self.subTest(path=str(path.relative_to(ROOT))):
                lines = path.read_text().splitlines()
                limit = 700 if path.name == "path_tracer.hpp" else 300
                self.assertLessEqual(len(lines), limit, "lines")
                self.assertLessEqual(max(map(len, lines)), 78, "columns")

    def test_chapters_decks_and_pages_are_in_american_spelling(self):
        british = r"\b(?:towards|grey|(?:colou?|behavio|favo|neighbo)ur(?:s|ed|ing)?|(?:centi|kilo)?metres?|centre[sd]?)\b"
        paths = list(ROOT.glob("*.md"))
        for folder in ("slides", "stages", "common", "tools"):
            paths += (path for path in ROOT.glob(f"{folder}/**/*") if path.suffix in (".hpp", ".md", ".toml"))
        for path in paths:
            with self.subTest(path=str(path.relative_to(ROOT))):
                self.assertEqual(re.findall(british, path.read_text(), re.IGNORECASE), [])

    def test_the_map_lists_the_core_as_it_is(self):
        tree.core_headers()

    def test_a_chapter_lists_its_own_headers_as_they_are(self):
        for header in tree.stage_headers():
            tree.listed_headers(header.parent)

    def assert_refused(self, change, name):
        """After this change to a copy, the map is refused with this name."""
        root = pathlib.Path(tempfile.mkdtemp(prefix="lightwalk-"))
        self.addCleanup(shutil.rmtree, root)
        shutil.copytree(ROOT / "common", root / "common")
        text = (root / "common/README.md").read_text()
        (root / "common/README.md").write_text(change(text))
        with mock.patch.object(tree, "ROOT", root):
            self.assertRaisesRegex(tree.Failure, name, tree.core_headers)

    def test_a_header_that_the_map_lacks(self):
        self.assert_refused(lambda text: text.replace("math/vector.hpp", ""), "math/vector.hpp")

    def test_a_link_that_leads_nowhere(self):
        self.assert_refused(lambda text: text + "[x](math/tensor.hpp)", "math/tensor.hpp")

    def test_a_header_that_the_map_has_twice(self):
        self.assert_refused(lambda text: text + "[x](math/vector.hpp)", "math/vector.hpp")


if __name__ == "__main__":
    users = collections.defaultdict(list)
    for a, b in sorted(arrows()):
        users[a].append(b)
    for name, used in users.items():
        print(f"{name:18} -> {' '.join(other for other in used if other != name)}")
    unittest.main()
