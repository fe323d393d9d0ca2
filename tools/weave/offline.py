"""Checks that pages need no network.

offline.py FOLDER   names the first file that refers to the network
"""

import re
import sys
from pathlib import Path

from tools.tree import Failure

ELSEWHERE = r"[\"']?\s*(?:https?:|wss?:)?//[\w.-]+"
REQUESTS = re.compile(
    r"<(?:script|img|iframe|source|video|audio|embed|object|image|use)\b"
    rf"[^>]*?\s(?:src|href|data|xlink:href|srcset)=({ELSEWHERE})"
    r"|<link\b(?=[^>]*?\brel=[\"']?(?:stylesheet|icon|preload|prefetch|"
    rf"preconnect|modulepreload))[^>]*?\shref=({ELSEWHERE})"
    rf"|\burl\(\s*({ELSEWHERE})|@import\s+(?:url\()?({ELSEWHERE})",
    re.I,
)


def check_offline(folder):
    for path in sorted(folder.rglob("*")):
        if path.suffix not in (".html", ".css", ".svg"):
            continue
        found = REQUESTS.search(path.read_text())
        if found:
            address = next(filter(None, found.groups())).strip("\"' ")
            raise Failure(
                f"{path.relative_to(folder.parent)}: asks {address}; pages must work without a network"
            )


if __name__ == "__main__":
    try:
        check_offline(Path(sys.argv[1]).resolve())
    except Failure as error:
        sys.exit(f"offline: {error}")
