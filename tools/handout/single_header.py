"""Writes a stage, the core that it needs and paint() as one header.

    python3 -m tools.handout.single_header      build/single/stageN.hpp, each N

Each header of the tree is copied once, in the order in which a compiler would
read it, without its #includes: the headers of the tree replace those that name
them, and those of GLM and the standard library are collected at the top. The
result depends only on the tree, so the same tree gives the same bytes.
"""

import re
import string
import sys
from dataclasses import dataclass
from pathlib import Path

from tools.tree import BUILD, ROOT, Failure, stage_headers

# The headers of the core that a program may use beside its stage.
CORE = ["common/render/paint.hpp", "common/image/pfm.hpp", "common/image/ppm.hpp"]
FOR_PROGRAMS = {"fstream"}

INCLUDE = re.compile(r'\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)\s*(?://.*)?$')
ANY_INCLUDE = re.compile(r"\s*#\s*include\b")
CONDITION = re.compile(r"\s*#\s*(if|endif)")
# Headers of compilers and systems: they stay where they are, with their #if.
PLATFORM = {"hwy/highway.h", "immintrin.h"}


@dataclass(frozen=True)
class Box:
    """The lab's box as far as a stage can paint it, and the scene's file."""

    scene: str
    materials: str
    ceiling: str
    balls: tuple
    light: str
    arguments: str


WHITE = "  const auto* white = box.add(Material{.kd = Vec3(0.8f)});\n"
BLUE = "  const auto* blue = box.add(Material{.kd = {0.3f, 0.3f, 0.8f}});\n"
LAMP = "  const auto* lamp = box.add(Material{.ke = Vec3(1)});\n"
PLASTIC_AND_GLASS = """\
  const auto* plastic =
      box.add(Material{.kd = {0.2f, 0.2f, 0.6f}, .ks = Vec3(0.3f)});
  const auto* glass = box.add(Material{.ks = Vec3(0.1f), .kt = Vec3(0.9f)});
"""
POINT = "  box.add(PointLight{{0, 0.5f, 0}, Vec3(1)});\n"
WITH_A_BOUND = "\n      box, {.samples_per_pixel = 16, .max_bounces = 8}"
WITHOUT = "box, {.samples_per_pixel = 16}"
CEILING = "scenes/cornell_box_ceiling_diffuse.toml"
DIFFUSE = "scenes/cornell_box_point_diffuse.toml"
ALL_MATERIALS = "scenes/cornell_box_point.toml"

# By the first stage that can paint it; a later stage paints it, too.
BOXES = {
    1: Box(CEILING, WHITE + BLUE + LAMP, "lamp", ("blue", "white"), "", WITH_A_BOUND),
    2: Box(DIFFUSE, WHITE + BLUE, "white", ("blue", "white"), POINT, WITH_A_BOUND),
    3: Box(ALL_MATERIALS, WHITE + PLASTIC_AND_GLASS, "white", ("plastic", "glass"), POINT, WITH_A_BOUND),
    4: Box(ALL_MATERIALS, WHITE + PLASTIC_AND_GLASS, "white", ("plastic", "glass"), POINT, WITHOUT),
}

PROGRAM = """\
#include "stage$stage.hpp"
using namespace lightwalk;

int main() {
  Scene box;
$materials  box.add(Plane{{1, 0, 0}, 1, box.add(Material{.kd = {0.8f, 0.2f, 0.2f}})});
  box.add(Plane{{-1, 0, 0}, 1, box.add(Material{.kd = {0.2f, 0.8f, 0.2f}})});
  box.add(Plane{{0, 1, 0}, 1, white});
  box.add(Plane{{0, -1, 0}, 1, $ceiling});
  box.add(Plane{{0, 0, -1}, 1, white});
  box.add(Sphere{{-0.5f, -0.7f, 0.25f}, 0.3f, $left});
  box.add(Sphere{{0.5f, -0.7f, -0.25f}, 0.3f, $right});
$light  const auto picture = paint<stage$stage::PathTracer>($arguments);
  std::ofstream("box.pfm", std::ios::binary) << encode_pfm(picture.radiance);
}
"""

# After a wrong include these are the first errors.
OPENING = """\
#ifndef LIGHTWALK_STAGE${stage}_HPP
#define LIGHTWALK_STAGE${stage}_HPP

#if defined(LIGHTWALK_SINGLE_HEADER)
#error "stage$stage.hpp: another stage is included already. Include only the newest: it contains the others."
#elif defined(__cplusplus) && __cplusplus < 201709L && !defined(_MSC_VER)
#error "stage$stage.hpp needs C++20: compile with -std=c++20"
#elif !__has_include(<glm/vec3.hpp>)
#error "stage$stage.hpp needs GLM: install it (libglm-dev, or glm), or name its folder with -I"
#else
#define LIGHTWALK_SINGLE_HEADER $stage

"""
CLOSING = """
#endif  // what it needs is there
#endif  // LIGHTWALK_STAGE${stage}_HPP
"""


def box_of(stage):
    return BOXES[max(number for number in BOXES if number <= stage)]


def example(stage):
    """The program that the how-to shows."""
    box = box_of(stage)
    left, right = box.balls
    return string.Template(PROGRAM).substitute(vars(box), stage=stage, left=left, right=right)


class Collected:
    """Some headers of a tree and all that they include, in the order of inclusion."""

    def __init__(self, root, names):
        self.root = root
        self.parts = {}  # name to lines
        self.angled = set(FOR_PROGRAMS)  # <vector>, <glm/vec3.hpp>, ...
        for name in names:
            self.add(name, name)

    def add(self, name, user):
        if name in self.parts:
            return
        path = self.root / name
        if not path.is_file():
            raise Failure(f'{user}: there is no header "{name}"')
        self.parts[name] = []  # a header that includes itself ends here
        depth, lines = 0, []
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            where = f"{name}:{number}"
            if condition := CONDITION.match(line):
                depth += 1 if condition[1] == "if" else -1
            if line == "#pragma once" or self.takes(line, where, depth):
                continue
            if line or (lines and lines[-1]):
                lines.append(line)
        while lines and not lines[-1]:
            lines.pop()
        del self.parts[name]
        self.parts[name] = lines

    def takes(self, line, where, depth):
        """Whether the line is an #include, which is removed."""
        if not ANY_INCLUDE.match(line):
            return False
        include = INCLUDE.match(line)
        if not include:
            raise Failure(f'{where}: #include "file" or <file> is expected, and nothing else')
        own, angled = include.groups()
        if angled in PLATFORM and depth > 0:
            return False
        if depth > 0:
            raise Failure(f"{where}: {own or angled} is included under a condition, and must not be")
        if own:
            self.add(own, where)
        elif angled.startswith("glm/") or re.fullmatch(r"[a-z_]+", angled):
            self.angled.add(angled)
        else:
            raise Failure(f"{where}: <{angled}> is neither of GLM nor of the standard library")
        return True

    def includes(self):
        glm = {name for name in self.angled if name.startswith("glm/")}
        for group in (self.angled - glm, glm):
            yield from (f"#include <{name}>" for name in sorted(group))
            yield ""


def indented(text):
    return "\n".join(f"    {line}".rstrip() for line in text.splitlines())


def commented(text):
    return [f"// {line}".rstrip() for line in text.splitlines()]


def title(lines):
    """The chapter's, without "Stage 4: "."""
    return re.match(r"// # (?:Stage \d: )?(.*)", next(line for line in lines if line.startswith("// # ")))[1]


def version(root):
    return re.search(
        r"VERSION (\d[\d.]*)", (root / "CMakeLists.txt").read_text(encoding="utf-8").split("project(")[1]
    )[1]


def text_of(header, root=ROOT):
    """The single header of a stage, from its header in the tree."""
    name = header.relative_to(root).as_posix()
    stage = int(header.parent.name.split("_")[0])
    collected = Collected(root, [*CORE, name])

    body = string.Template(OPENING).substitute(stage=stage).splitlines()
    body += collected.includes()
    begins = []  # of each part and exercise: its line of the body, its name
    for part, lines in collected.parts.items():
        begins.append((len(body), part))
        body += [f"// ==== {part} " + "=" * max(0, 71 - len(part)), ""]
        for line in lines:
            if exercise := re.match(r"\s*// #region (exercise \S+ .*)", line):
                begins.append((len(body), "  " + exercise[1]))
            body.append(line)
        body.append("")
    body += string.Template(CLOSING).substitute(stage=stage).splitlines()[1:]

    how_to = string.Template((Path(__file__).parent / "single_header.txt").read_text(encoding="utf-8"))

    def opening(lines_before):
        contents = "\n".join(f"{lines_before + line + 1:5}  {what}" for line, what in begins)
        return commented(
            how_to.substitute(
                stage=stage,
                version=version(root),
                title=title(collected.parts[name]),
                example=indented(example(stage)),
                scene=box_of(stage).scene,
                contents=contents,
                license=(root / "LICENSE").read_text(encoding="utf-8").rstrip(),
            )
        ) + [""]

    return "\n".join([*opening(len(opening(0))), *body]) + "\n"


def main():
    folder = BUILD / "single"
    folder.mkdir(parents=True, exist_ok=True)
    for header in stage_headers():
        path = folder / f"stage{header.parent.name[0]}.hpp"
        path.write_text(text_of(header))
        print(path)


if __name__ == "__main__":
    try:
        main()
    except Failure as error:
        sys.exit(f"single_header: {error}")
