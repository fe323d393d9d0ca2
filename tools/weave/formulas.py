"""Checks that MathJax understands every formula of a text."""

import hashlib
import json
import re
import subprocess
from pathlib import Path

from tools.tree import BUILD, ROOT, Failure
from tools.weave.literate import pieces

CODE = re.compile(r"^```.*?^```|`[^`\n]+`|^    .*?$", re.S | re.M)
FORMULA = re.compile(r"\$\$(.+?)\$\$|(?<!\\)\$([^$]+?)\$", re.S)


def formulas(text, where, first_line=1):
    """Every formula with its place: {tex, display, where}."""
    blank = CODE.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)
    found = []
    for match in FORMULA.finditer(blank):
        line = first_line + blank.count("\n", 0, match.start())
        found.append(
            {"tex": (match[1] or match[2]).strip(), "display": bool(match[1]), "where": f"{where}:{line}"}
        )
    return found


def formulas_of_header(header):
    """The formulas of a literate header's prose."""
    name = header.relative_to(ROOT)
    return [
        formula
        for piece in pieces(header)
        if piece.kind == "prose"
        for formula in formulas("\n".join(piece.lines), name, piece.line)
    ]


def check_formulas(found):
    """Calls MathJax, which takes longer to start than the rest of a check: so this
    remembers the formulas that it has accepted."""
    script = Path(__file__).with_name("check_formulas.cjs")
    modules = BUILD / "node/node_modules"
    asked = hashlib.sha256(script.read_bytes() + (modules / "mathjax-full/package.json").read_bytes())
    asked.update(json.dumps([(one["tex"], one["display"]) for one in found]).encode())
    understood = BUILD / "figures/formulas" / asked.hexdigest()[:20]
    if understood.exists():
        return
    run = subprocess.run(["node", script, modules], input=json.dumps(found), capture_output=True, text=True)
    if run.returncode:
        raise Failure((run.stdout or run.stderr).strip().split("\n")[0])
    understood.parent.mkdir(parents=True, exist_ok=True)
    understood.touch()
