"""What the tree uses from outside agrees with the lists of it.

The lists are tools/setup/packages.txt for packages of the system,
tools/setup/*.in for PyPI, tools/package.json for npm, and vcpkg.json.
"""

import ast
import collections
import functools
import json
import pathlib
import re
import sys
import unittest

from tools.tree import BUILD, ROOT

TABLE = "tools/setup/packages.txt"
COLUMNS = "purpose use debian homebrew msys2 vcpkg words optional".split()
# Names in these files are not uses: the lists, their readers, and texts about them.
LISTS = (
    "tools/setup",
    "tools/package",
    "tests/house/test_packages",
    "tests/house/test_setup",
    "vcpkg",
    "README",
    "CHANGELOG",
)
SUFFIXES = {
    ".hpp",
    ".cpp",
    ".h",
    ".py",
    ".js",
    ".cjs",
    ".cmake",
    ".txt",
    ".md",
    ".sh",
    ".mk",
    ".json",
    ".in",
    ".toml",
    ".html",
}
# Of C, POSIX, Windows and compilers.
SYSTEM_HEADERS = set(
    """assert.h ctype.h errno.h float.h limits.h math.h signal.h stdarg.h stddef.h stdint.h stdio.h stdlib.h string.h time.h
    dirent.h dlfcn.h fcntl.h poll.h pthread.h unistd.h io.h windows.h immintrin.h""".split()
)
# Programs of every system with a shell, and builtins of the shell.
SHELL = set("cat cd cp date echo exit export mkdir printf rm sed set sh sleep step tee touch xargs".split())
NODE_ITSELF = {"fs", "path"}
CMAKE_ITSELF = {"Threads"}
# Uses that the tree does not name directly.
SAID = {"module:ensurepip": "-m venv", "library:LLVM": "libLLVM"}

Row = collections.namedtuple("Row", ["line", *COLUMNS])


def read_tree():
    """The text of each file, by its path. Leaves out builds and names that begin
    with a dot, except those that continuous integration and editors run."""
    files = {}
    for top in sorted(ROOT.iterdir()):
        if top == BUILD or re.match(r"build|\.(?!ci$|devcontainer$)", top.name):
            continue
        for path in sorted(top.rglob("*")) if top.is_dir() else [top]:
            plain = path.suffix in SUFFIXES or path.name == "Makefile" or top.name == ".ci"
            if plain and path.is_file() and "__pycache__" not in path.parts:
                files[path.relative_to(ROOT).as_posix()] = path.read_text(errors="replace")
    return files


def read_table(files):
    rows = []
    for number, line in enumerate(files[TABLE].splitlines(), 1):
        if line and not line.startswith("#"):
            cells = [cell.strip() for cell in line.split("|")]
            cells += [""] * (len(COLUMNS) - len(cells))
            rows.append(Row(number, *cells))
    return rows


def names(rows, column):
    """The packages of a column; each alternative is one."""
    cells = " ".join(getattr(row, column) for row in rows).replace("/", " ")
    return set(cells.split()) - {"-"}


def python_uses(text, own):
    """Modules that a file imports, and programs that it starts by name."""
    for node in ast.walk(ast.parse(text)):
        modules = []
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            modules = [node.module]
        for module in modules:
            first = module.partition(".")[0]
            if first not in sys.stdlib_module_names and first not in own:
                yield f"module:{first}"
        if not isinstance(node, ast.Call) or not node.args:
            continue
        called, first = ast.unparse(node.func), node.args[0]
        if called.startswith("subprocess.") and isinstance(first, ast.List | ast.Tuple) and first.elts:
            first = first.elts[0]
        elif (
            called == "os.environ.get"
            and ast.unparse(first).strip("'").endswith("CXX")
            and len(node.args) > 1
        ):
            first = node.args[1]
        elif not called.startswith("subprocess.") and called != "shutil.which":
            continue
        # Names with a slash were built here.
        if isinstance(first, ast.Constant) and "/" not in first.value and first.value not in SHELL:
            yield f"program:{first.value}"


def cpp_uses(text):
    for header in re.findall(r"^\s*#\s*include\s*<([^>]+)>", text, re.MULTILINE):
        standard = not re.search("[./]", header)
        if not standard and header not in SYSTEM_HEADERS and not header.startswith("sys/"):
            yield f"header:{header}"


def cmake_uses(text):
    text = re.sub("#.*", "", text)
    for package in re.findall(r"find_package\((\w+)", text):
        if package not in CMAKE_ITSELF:
            yield f"package:{package}"
    for header in re.findall(r"find_(?:path|headers)\(\w+\s+([\w./+-]+)", text):
        yield f"header:{header}"
    for programs in re.findall(r"find_(?:program|command)\(\w+\s+(?:NAMES\s+)?((?:[a-z][\w+-]*\s*)+)", text):
        yield from (f"program:{name}" for name in programs.split())
    for program in re.findall(r"set\(CMAKE_\w+_COMPILER\s+(\S+)\)", text):
        yield f"program:{program}"


def shell_uses(text, indented):
    """The first word of each command of a script, or of a Makefile's recipes."""
    text = re.sub(r""""[^"\n]*"|'[^'\n]*'""", "", text)
    for line in re.findall(r"^\t@?(\S.*)" if indented else r"^(\w.*)", text, re.MULTILINE):
        for command in re.split(r"&&|\|\|?|;|\{", line):
            word = command.strip().partition(" ")[0]
            if re.fullmatch(r"[a-z][\w+.-]*", word) and word not in SHELL:
                yield f"program:{word}"
    for word in re.findall(r"command -v ([\w+.-]+)", text):
        yield f"program:{word}"


def node_uses(text):
    for module in re.findall(
        r"""(?:require|import)\(["']([^"'$]+)["']\)|^import .* from ["']([^"']+)""", text, re.MULTILINE
    ):
        name = module[0] or module[1]
        if not name.startswith((".", "node:")) and name not in NODE_ITSELF:
            yield f"node:{name}"
    for program in re.findall(r"""(?:execFileSync|execFile|spawn|spawnSync)\(["'](\w[\w+.-]*)["']""", text):
        yield f"program:{program}"


@functools.cache
def file_uses(path, text, own):
    suffix = pathlib.PurePath(path).suffix
    kinds = []
    if suffix == ".py":
        kinds.append(python_uses(text, own))
    elif suffix in (".hpp", ".cpp", ".h"):
        kinds.append(cpp_uses(text))
    elif suffix == ".cmake" or path.endswith("CMakeLists.txt"):
        kinds.append(cmake_uses(text))
    elif suffix in (".js", ".cjs"):
        kinds.append(node_uses(text))
    elif path in ("Makefile", "tools/site.mk", ".ci/run"):
        kinds.append(shell_uses(text, indented=path != ".ci/run"))
    if not path.startswith(LISTS):
        kinds.append(f"node:{name}" for name in re.findall(r"node_modules/((?:@[\w-]+/)?\w[\w.-]*)", text))
    return {use for kind in kinds for use in kind}


def uses(files):
    """What the tree uses, and in which files."""
    own = {
        name
        for path in files
        if path.endswith(".py")
        for name in (pathlib.PurePath(path).stem, path.split("/")[0])
    }
    found = collections.defaultdict(list)
    for path, text in files.items():
        for use in file_uses(path, text, frozenset(own)):
            found[use].append(path)
    return found


def answers(listed, use):
    """Whether a listed name covers a use: headers match by their folder, npm
    packages by their scope."""
    if listed == use:
        return True
    kind, _, name = use.partition(":")
    other_kind, _, other = listed.partition(":")
    folder = name.partition("/")[0]
    inside = kind == "header" and "/" in name or kind == "node"
    return kind == other_kind and inside and other.startswith(folder + "/")


def listed_uses(files):
    """The entries of a list, and their places in it."""
    listed = {}
    for row in read_table(files):
        for use in row.use.split():
            listed[use] = f"{TABLE}:{row.line}"
    for path, text in files.items():
        if path.startswith("tools/setup/") and path.endswith(".in"):
            for number, line in enumerate(text.splitlines(), 1):
                if not line.startswith("#"):
                    listed[line.partition("# ")[2]] = f"{path}:{number}"
    for name in json.loads(files["tools/package.json"])["dependencies"]:
        listed[f"node:{name}"] = "tools/package.json"
    return listed


def unlisted(files):
    listed = listed_uses(files)
    for use, where in sorted(uses(files).items()):
        if not any(answers(one, use) for one in listed):
            kind, _, name = use.partition(":")
            wanted = {"module": f"{TABLE} or tools/setup/*.in", "node": "tools/package.json"}.get(kind, TABLE)
            yield f"{where[0]} uses the {kind} {name}, which is not in {wanted}"


@functools.cache
def says(text, name):
    return name in text and bool(re.search(rf"(?<![\w.+]){re.escape(name)}(?![\w+])", text))


def unused(files):
    found = uses(files)
    texts = [text for path, text in files.items() if not path.startswith(LISTS)]
    for listed, where in listed_uses(files).items():
        kind, _, name = listed.partition(":")
        said = SAID.get(listed, name.rpartition("/")[2] if kind in ("file", "node") else name)
        if kind == "check":
            used = f"has_{name}()" in files["tools/setup.sh"]
        elif kind in ("package", "header"):
            used = any(answers(listed, use) for use in found)
        else:
            used = any(says(text, said) for text in texts)
        if not used:
            yield f"{where}: nothing in the tree uses {listed}"


@functools.cache
def words_of(pattern, text):
    """The words of all matches: names of packages, or of purposes."""
    found = " ".join(re.findall(pattern, text, re.MULTILINE)).replace("mingw-w64-ucrt-x86_64-", "")
    return [word for word in re.split(r"[\s{},]+", found) if word and not word.startswith("-")]


def other_lists(files):
    """Complaints about vcpkg.json, the Makefile and sentences beside the table."""
    rows = read_table(files)
    for row in rows:
        place = f"{TABLE}:{row.line}: {row.words or row.use or row.purpose}"
        cells = (row.purpose, row.use, row.debian, row.homebrew, row.msys2, row.vcpkg, row.words)
        if not all(cells) or row.optional not in ("", "optional"):
            yield f"{place}: {len(COLUMNS)} cells are expected, and the last is empty or `optional`"
        elif row.debian == "-":
            yield f"{place}: a package of Debian is expected"
    vcpkg = json.loads(files["vcpkg.json"])
    features = [feature["dependencies"] for feature in vcpkg["features"].values()]
    there = set(sum(features, vcpkg["dependencies"]))
    for name in sorted(there ^ names(rows, "vcpkg")):
        yield f"vcpkg: {name} is in {'vcpkg.json' if name in there else TABLE} alone"
    purposes = {row.purpose for row in rows} | {"all"}
    makefile = set(re.search(r"^setups := .*setup-,(.*)\)", files["Makefile"], re.MULTILINE)[1].split())
    for purpose in sorted(makefile ^ purposes - {"build"}):
        yield f"Makefile: the purpose {purpose} is in {'setups' if purpose in makefile else TABLE} alone"
    columns = {
        r"pacman -S ([\w{},= -]+)": names(rows, "msys2"),
        r"brew install ([\w -]+)": names(rows, "homebrew"),
        r"apt-get install ([\w+. -]+)": names(rows, "debian") | {"ca-certificates"},
        r"\b((?:lib[\w+.-]+|[\w-]+)-dev)\b": names(rows, "debian"),
        r"pip install ([\w-]+)": {
            use[7:] for row in rows for use in row.use.split() if use.startswith("module:")
        },
        r"""(?:setup\.sh |make setup-)([a-z]+)(?:[`"');]| &|$)""": purposes,
        r'leave_out\([^()]*" ([a-z]+)\)': purposes,
    }
    for path, text in files.items():
        if path.startswith(("tools/setup", "tests/house/test_", "CHANGELOG")):
            continue
        for pattern, known in columns.items():
            for word in words_of(pattern, text):
                if not known & {word, f"={word}"}:
                    yield f"{path} says '{word}', which {TABLE} does not have"


def complaints(files):
    return [*unlisted(files), *unused(files), *other_lists(files)]


class Packages(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.files = read_tree()

    def test_what_is_used_is_listed_and_what_is_listed_is_used(self):
        self.assertEqual(complaints(self.files), [])

    def assert_complaint(self, expected, path, change):
        """After this change the tree has exactly one complaint, with this text."""
        found = complaints(self.files | {path: change(self.files.get(path, ""))})
        self.assertEqual(len(found), 1, found)
        self.assertIn(expected, found[0])

    def test_a_package_that_is_taken_off(self):
        self.assert_complaint(
            "Highway: a package of Debian", TABLE, lambda text: text.replace("libhwy-dev", "-")
        )

    def test_a_row_that_is_taken_off(self):
        def without(text):
            return re.sub(r".*libglm-dev.*\n", "", text)

        found = "\n".join(complaints(self.files | {TABLE: without(self.files[TABLE])}))
        self.assertIn("uses the header glm/", found)
        self.assertIn("uses the package glm, which is not in", found)
        self.assertIn("vcpkg: glm is in vcpkg.json alone", found)

    def test_new_uses(self):
        for path, line, expected in (
            (
                "common/math/vector.hpp",
                "#include <boost/any.hpp>\n",
                "vector.hpp uses the header boost/any.hpp",
            ),
            ("CMakeLists.txt", "\nfind_package(Boost)\n", "CMakeLists.txt uses the package Boost"),
            ("CMakeLists.txt", "\nfind_path(EMBREE embree4/rtcore.h)\n", "uses the header embree4/rtcore.h"),
            ("tools/tree.py", "\nimport pandas\n", "tree.py uses the module pandas"),
            ("tools/tree.py", '\nsubprocess.run(["gnuplot", "x"])\n', "tree.py uses the program gnuplot"),
            ("tests/site/browser.cjs", '\nrequire("sharp");\n', "browser.cjs uses the node sharp"),
            ("Makefile", "\n\t@cd x && doxygen\n", "Makefile uses the program doxygen"),
        ):
            with self.subTest(line):
                self.assert_complaint(expected, path, lambda text: text + line)

    def test_what_nothing_uses(self):
        row = "build | package:Boost | libboost-dev | boost | boost | - | Boost |\n"
        self.assert_complaint("nothing in the tree uses package:Boost", TABLE, lambda text: text + row)

        def with_scrapy(text):
            return text + "scrapy  # module:scrapy\n"

        line = len((ROOT / "tools/setup/site.in").read_text().splitlines()) + 1
        self.assert_complaint(
            f"site.in:{line}: nothing in the tree uses module:scrapy", "tools/setup/site.in", with_scrapy
        )

        def with_left_pad(text):
            return text.replace('"axe-core"', '"left-pad": "1.0.0", "axe-core"')

        self.assert_complaint("nothing in the tree uses node:left-pad", "tools/package.json", with_left_pad)

    def test_sentences_and_other_lists(self):
        self.assert_complaint("vcpkg: stb is in", "vcpkg.json", lambda text: text.replace('    "stb",\n', ""))
        self.assert_complaint(
            "README.md says 'windoze'",
            "README.md",
            lambda text: text.replace("setup.sh windows", "setup.sh windoze"),
        )
        self.assert_complaint(
            "README.md says 'libtiny-dev'",
            "README.md",
            lambda text: text.replace("libopenimageio-dev", "libtiny-dev"),
        )
        self.assert_complaint(
            "the purpose peers is in",
            "Makefile",
            lambda text: text.replace("bench peers windows", "bench windows"),
        )


if __name__ == "__main__":
    unittest.main()
