"""Code on a slide: a region of a header, or the steps of it that fit."""

import re
from html import escape

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import CppLexer

from tools.tree import ROOT, Failure
from tools.weave.code_colors import CodeColors
from tools.weave.literate import changed_lines, earlier_version, region

# Pixels of a slide of 1280 by 720, as in slides/theme.css. The last row needs 17
# points of a page that is 540 points high.
SIZE = 23
LETTER, LINE = 0.602, 1.36  # widest usual monospace letter, line height


def indent(line):
    return len(line) - len(line.lstrip()) if line.strip() else -1


def excerpt(lines, steps, reference):
    """The numbers of the lines that belong to the steps, and None where lines are
    left out between two. A step begins at the line, comment or code, that starts
    with its words, and ends at the next empty line or at the end of its block."""
    chosen = []
    for step in steps:
        first = next((n for n, line in enumerate(lines) if line.strip().lstrip("/ ").startswith(step)), None)
        if first is None:
            raise Failure(f"{reference}: no step begins '{step}'")
        last = next(
            (n for n in range(first, len(lines)) if indent(lines[n]) < indent(lines[first])), len(lines)
        )
        if chosen:
            chosen.append(None)
        chosen += range(first, last)
    return chosen


def between(lines, last, first):
    """What a slide shows between two steps: dots if code was left out there."""
    code = [x for x in lines[last + 1 : first] if x.strip() and not x.lstrip().startswith("//")]
    return " " * indent(lines[first]) + "// ..." if code else ""


def marked_lines(lines, marks, reference):
    """The lines, counted from 1, that begin with these words."""
    for mark in marks:
        found = [n for n, line in enumerate(lines, 1) if line.lstrip().startswith(mark)]
        if not found:
            raise Failure(f"{reference}: no line begins '{mark}'")
        yield from found


def listing(reference, steps="", marks="", width=1112, height=485):
    """HTML for the region; marks these lines, or those that are new since the
    previous stage."""
    piece = region(reference)
    code = piece.lines
    path, name = reference.split("#")
    new = set()
    if path.startswith("stages/"):
        _, old = earlier_version(ROOT / path, name)
        new = set(changed_lines(old, code)) if old else set()
    chosen = list(range(len(code)))
    if steps:
        chosen = excerpt(code, [s.strip() for s in steps.split(";")], reference)
    lines = [
        between(code, chosen[i - 1], chosen[i + 1]) if n is None else code[n] for i, n in enumerate(chosen)
    ]
    outer = min(indent(x) for x in lines if x)
    lines = [x[outer:] for x in lines]
    marked = [i for i, n in enumerate(chosen, 1) if n is not None and n + 1 in new]
    if len(marked) == len(lines):
        marked = []
    if marks:
        marked = list(marked_lines(lines, [m.strip() for m in marks.split(";")], reference))
    if max(map(len, lines)) * LETTER * SIZE > width or len(lines) * LINE * SIZE > height:
        raise Failure(
            f"{reference}: {len(lines)} lines of up to "
            f"{max(map(len, lines))} columns do not fit a slide; "
            "name its steps"
        )
    html = highlight("\n".join(lines), CppLexer(stripnl=False), HtmlFormatter(nowrap=True))
    html = html.rstrip("\n").split("\n")
    exercises = [None if n is None else piece.exercise_at(piece.numbers[n]) for n in chosen]
    for place in range(len(html)):
        # These spans are block elements, which end their lines themselves.
        classes = ["hll"] * (place + 1 in marked) + ["exercise"] * bool(exercises[place])
        end = "\n" if classes or place + 1 < len(html) else ""
        html[place] += end
        if classes:
            html[place] = f'<span class="{" ".join(classes)}">{html[place]}</span>'
    source = f"{escape(path)}, <b>{escape(name)}</b>"
    for one in dict.fromkeys(one.number for one in exercises if one):
        source += exercise_link(path, one)
    return f"""<pre class="listing">{"".join(html)}</pre>
<p class="source">{source}</p>"""


def exercise_link(path, number):
    """A badge that links to the task in the book, which is built beside the
    slides."""
    page = f"../book/{path.rsplit('/', 1)[0]}.html#exercise-{number.replace('.', '-')}"
    return f' <a class="exercise" href="{page}">exercise {number}</a>'


def colors():
    rules = HtmlFormatter(style=CodeColors).get_style_defs("pre.listing")
    return "\n".join(
        rule for rule in rules.split("\n") if "<" not in rule and re.match(r"pre\.listing \.(?!hll)", rule)
    )


def fill(text, where, narrow=False):
    """The slide with its empty blocks ```cpp region=... filled."""

    def filled(match):
        options = dict(re.findall(r'(\w+)=("[^"]*"|\S+)', match[1]))
        options = {key: value.strip('"') for key, value in options.items()}
        reference = options.pop("region")
        for key in options:
            if key not in ("steps", "marks", "width", "height"):
                raise Failure(f"{where}: a listing has no option '{key}'")
        try:
            return listing(
                reference,
                options.get("steps", ""),
                options.get("marks", ""),
                int(options.get("width", 1046 if narrow else 1112)),
                int(options.get("height", 485)),
            )
        except Failure as error:
            raise Failure(f"{where}: {error}") from None

    return re.sub(r"^```cpp (region=.*)\n```$", filled, text, flags=re.M)
