"""Checks that the names in backticks in prose exist in the code."""

import functools
import re

from tools.tree import ROOT, Failure
from tools.weave.literate import pieces

IDENTIFIER = re.compile(r"[A-Za-z_]\w*")


@functools.cache
def known_names():
    """Every identifier of the code, every word of the scene format."""
    names = set()
    for pattern in ("common/**/*.hpp", "common/**/*.cpp", "stages/**/*.hpp", "stages/*/*.cpp"):
        for path in ROOT.glob(pattern):
            code = re.sub(r"//.*", "", path.read_text())
            names.update(IDENTIFIER.findall(code))
    for path in ROOT.glob("scenes/*.toml"):
        names.update(IDENTIFIER.findall(path.read_text()))
    return names


def exists(code):
    if "/" in code and (ROOT / code.split("#")[0]).exists():
        return True
    option = re.match(r"--([a-z-]+)", code)
    if option:
        told = re.compile(rf'"(-\w,)?--{option[1]}')
        return any(told.search(path.read_text()) for path in ROOT.glob("common/program/*.?pp"))
    wish = re.match(r"-D(\w+)=", code)
    if wish:
        return any(f"option({wish[1]} " in path.read_text() for path in ROOT.glob("cmake/*.cmake"))
    words = IDENTIFIER.findall(re.sub(r'"[^"]*"', "", code))
    return all(word in known_names() for word in words)


def check_text(text, where):
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    for code in re.findall(r"(?<!`)`([^`]+)`(?!`)", text):
        if not exists(" ".join(code.split())):
            raise Failure(f"{where}: `{code}` is not in the code")


def check_names(header):
    for piece in pieces(header):
        if piece.kind == "prose":
            where = f"{header.relative_to(ROOT)}:{piece.line}"
            check_text("\n".join(piece.lines), where)
