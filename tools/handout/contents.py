"""The contents of a handout: which files of the tree, and how they change."""

import posixpath
import re
import tomllib
from pathlib import Path

from tools.exercises.marks import exercises
from tools.exercises.sheet import title_of
from tools.handout.chapter_page import book_page, chapter_page
from tools.handout.lab_sheet import lab_sheet
from tools.handout.opened import opened
from tools.tree import ROOT, Failure, stage_headers

OVERLAY = Path(__file__).parent / "tree"
# The files that every stage needs. A folder ends with a slash.
COMMON = (
    "common/",
    "cmake/",
    "scenes/README.md",
    "scenes/scene.schema.json",
    "stages/introductions.hpp",
    "compare/",
    "tests/__init__.py",
    "tests/every_stage/stage.hpp.in",
    "tests/runner/",
    "tests/split_header.py",
    "tests/suites.cmake",
    "tests/leaks.supp",
    "tools/__init__.py",
    "tools/tree.py",
    "tools/exercises/",
    "tools/handout/__init__.py",
    "tools/handout/single_header.py",
    "tools/handout/single_header.txt",
    "CMakeLists.txt",
    ".gitattributes",
    ".gitignore",
    ".clang-format",
    "LICENSE",
    "WORDS.md",
)
# The course's own tools and tests, and formats that no exercise needs.
NOT_FOR_STUDENTS = re.compile(r"tools/exercises/(test_\w+|mistakes)\.py$|common/image/openimageio\.cpp$")
# Files of a chapter's folder that only the book uses.
FOR_THE_BOOK = ("/figures.toml", "/drawings.py")
ANSWER = re.compile(r'^answer = (?:"""[\s\S]*?"""|"(?:[^"\\]|\\.)*")$', re.MULTILINE)
INCLUDE = re.compile(r'^#include "(support/[^"]+)"', re.MULTILINE)
IMAGE = re.compile(r'image\s*=\s*"([^"]+)"')


def stage_of(header):
    return int(header.parent.name[0])


def words_of(table):
    """All keys and all strings of a scene."""
    if isinstance(table, dict):
        for key, value in table.items():
            yield key
            yield from words_of(value)
    elif isinstance(table, list):
        for value in table:
            yield from words_of(value)
    elif isinstance(table, str):
        yield table


def introduced():
    """The stage that introduces each word of the scene format."""
    text = (ROOT / "stages/introductions.hpp").read_text(encoding="utf-8")
    return {word: int(stage) for word, stage in re.findall(r'\{"(\w+)", (\d)\}', text)}


def scenes_until(stage, tracked):
    """The scenes that a stage can read, and their images."""
    stages = introduced()
    for path in tracked:
        if not (path.startswith("scenes/") and path.endswith(".toml")):
            continue
        try:
            text = (ROOT / path).read_text(encoding="utf-8-sig")
            words = list(words_of(tomllib.loads(text)))
        except ValueError as error:
            raise Failure(f"{path}: {error}") from None
        if max((stages.get(word, 1) for word in words), default=1) > stage:
            continue
        yield path
        for image in IMAGE.findall(text):
            shown = posixpath.normpath(posixpath.join(posixpath.dirname(path), image))
            if shown not in tracked:
                raise Failure(f"{path}: the tree has no image {shown}")
            yield shown


def support_of(paths, tracked):
    """The files of tests/support that these tests need: what is compiled, and what is included."""
    support = {path for path in tracked if path.startswith("tests/support/")}
    wanted = {path for path in support if not path.endswith(".hpp")}
    new = wanted | set(paths)
    while new:
        included = {
            name for path in new for name in INCLUDE.findall((ROOT / path).read_text(encoding="utf-8"))
        }
        new = {f"tests/{name}" for name in included if f"tests/{name}" in support} - wanted
        wanted |= new
    return wanted


def goldens_until(stage):
    """goldens.toml without the later stages' entries."""
    text = (ROOT / "tests/golden/goldens.toml").read_text(encoding="utf-8")
    head, *entries = re.split(r"(?m)^(?=\[\[golden\]\])", text)
    return head + "".join(entry for entry in entries if tomllib.loads(entry)["golden"][0]["stage"] <= stage)


def contents(stage, tracked, solutions):
    """The handout's files: {path: bytes}. `tracked` are the tree's files. The
    stages before `stage` have their solutions if `solutions` is "previous", and
    not if it is "none"."""
    headers = {stage_of(header): header for header in stage_headers()}
    if stage not in headers:
        raise Failure(f"stage {stage} is not in this tree; there are {', '.join(map(str, headers))}")
    if not exercises(headers[stage]):
        raise Failure(f"stage {stage} has no exercise: {headers[stage].relative_to(ROOT)} has no mark")
    # A chapter for reading repeats solutions of the others.
    for_reading = {number for number, header in headers.items() if not exercises(header)}
    chosen = set(scenes_until(stage, tracked))
    for path in tracked:
        number = re.match(r"(?:stages/|tests/(?:every_stage/from_|golden/)?stage)(\d)", path)
        if number:
            given = int(number[1]) <= stage and int(number[1]) not in for_reading
            if given and not path.endswith(FOR_THE_BOOK):
                chosen.add(path)
        elif any(path == name or (name.endswith("/") and path.startswith(name)) for name in COMMON):
            chosen.add(path)
    chosen = {path for path in chosen if not NOT_FOR_STUDENTS.match(path)}
    tests = [path for path in chosen if re.match(r"tests/(every_stage|stage\d)/.*\.cpp$", path)]
    chosen |= support_of(tests, tracked)
    files = {path: (ROOT / path).read_bytes() for path in sorted(chosen)}
    files["tests/golden/goldens.toml"] = goldens_until(stage).encode()
    for number, header in headers.items():
        if number > stage or number in for_reading:
            continue
        folder = header.parent.relative_to(ROOT).as_posix()
        if number == stage or solutions == "none":
            files[f"{folder}/path_tracer.hpp"] = opened(header).encode()
            sheet = files.get(f"{folder}/exercises.toml", b"").decode()
            files[f"{folder}/exercises.toml"] = ANSWER.sub('answer = ""', sheet).encode()
        else:
            # Their marks stay, their stubs go.
            numbers = [one.number for one in exercises(header)]
            files[f"{folder}/path_tracer.hpp"] = opened(header, numbers).encode()
        files[f"{folder}/README.md"] = lab_sheet(header).encode()
        page = chapter_page(header, files[f"{folder}/path_tracer.hpp"].decode())
        files |= {f"{folder}/{path}": data for path, data in page.items()}
    for path in sorted(OVERLAY.rglob("*")):
        if path.is_file():
            files[path.relative_to(OVERLAY).as_posix()] = path.read_bytes()
    files["README.md"] = readme(headers[stage]).encode()
    return files


def readme(header):
    first = exercises(header)[0]
    scenes = {
        1: "scenes/cornell_box_ceiling_diffuse.toml",
        2: "scenes/cornell_box_point_diffuse.toml",
        5: "scenes/checkered_floor.toml",
    }
    folder = f"stages/{header.parent.name}"
    reading = (
        "Read it from the top. A line `![](name)` is a figure; figures are in the book,\n"
        "which your instructor can make with `make book` and hand out, too.\n"
    )
    if book_page(header):
        reading = (
            f"Read it from the top, in a browser: [{folder}/chapter.html]({folder}/chapter.html)\n"
            "has the same text with its formulas set and its figures.\n"
        )
    return (
        (OVERLAY / "README.md")
        .read_text(encoding="utf-8")
        .format(
            stage=stage_of(header),
            title=title_of(header).split(": ", 1)[1],
            header=header.relative_to(ROOT).as_posix(),
            folder=header.parent.name,
            reading=reading,
            first=f"{first.number}: {first.title}",
            scene=scenes.get(stage_of(header), "scenes/cornell_box_point.toml"),
        )
    )
