"""Renders the formulas of built pages as SVG in the page, without a script."""

import html
import json
import re
import subprocess
from pathlib import Path

from tools.tree import BUILD, Failure

FORMULA = re.compile(
    r'<span class="math notranslate nohighlight">\\\((?P<inline>.*?)\\\)</span>'
    r'|<div class="math notranslate nohighlight"[^>]*>\s*\\\[(?P<display>.*?)\\\]</div>',
    re.S,
)
LOADER = re.compile(
    r"\s*<script[^>]*>window\.MathJax = .*?</script>|\s*<script[^>]*mathjax/[^>]*></script>", re.S
)


def formulas_in(text):
    return [
        {"tex": html.unescape(one["inline"] or one["display"]).strip(), "display": one["inline"] is None}
        for one in FORMULA.finditer(text)
    ]


def set_formulas(folder):
    """Rewrites the pages under the folder, and writes _static/formulas.css."""
    pages = {path: path.read_text() for path in sorted(folder.rglob("*.html"))}
    found = [{"page": str(path), "formulas": formulas_in(text)} for path, text in pages.items()]
    script = Path(__file__).with_name("formulas.cjs")
    run = subprocess.run(
        ["node", script, BUILD / "node/node_modules"], input=json.dumps(found), capture_output=True, text=True
    )
    if run.returncode:
        raise Failure(f"formulas: {run.stderr.strip().splitlines()[-1]}")
    made = json.loads(run.stdout)
    for (path, text), page in zip(pages.items(), made["pages"]):
        each = iter(page["formulas"])

        def replaced(match):
            kind = "div" if match["inline"] is None else "span"
            return f'<{kind} class="math">{next(each)}</{kind}>'

        text = LOADER.sub("", FORMULA.sub(replaced, text))
        if page["formulas"]:
            text = text.replace("</body>", page["defs"] + "</body>")
        path.write_text(text)
    (folder / "_static/formulas.css").write_text(made["css"])
