"""The page that lists each symbol of the formulas with its name in code."""

import tomllib
from pathlib import Path

from tools.tree import Failure, stage_headers
from tools.weave.names import exists

HERE = Path(__file__).parent


def symbols_page():
    entries = tomllib.loads((HERE / "symbols.toml").read_text())["symbol"]
    lines = (HERE / "symbols.md").read_text().split("\n")
    lines += ["| symbol | in code | what it is | unit | first in |", "|---|---|---|---|---|"]
    for entry in entries:
        tex, stage = entry["tex"], entry["stage"]
        if "`" in entry["code"] or not exists(entry["code"]):
            raise Failure(f"symbols.toml: {entry['code']} is not in the code")
        chapter = stage_headers()[stage - 1]
        if entry.get("in", tex) not in chapter.read_text():
            raise Failure(f"symbols.toml: {tex} is not in stage {stage}")
        lines.append(
            f"| ${tex}$ | `{entry['code']}` | {entry['is']} "
            f"| {entry.get('unit', '1')} "
            f"| [stage {stage}](stages/{chapter.parent.name}.md) |"
        )
    return lines
