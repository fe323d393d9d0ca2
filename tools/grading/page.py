"""The page of a class: one folder that works from a disk, without network."""

import functools
import hashlib
import html
import re
import secrets
import shutil
import statistics
import textwrap
from pathlib import Path

from tools.tree import ROOT, write_whole

HERE = Path(__file__).parent
VIEWER = ROOT / "tools/book/viewer.js"
BOOK_STYLE = ROOT / "tools/book/book.css"
PARTS = ("student", "difference", "z", "reference")  # the viewer begins with the first and the last
TABLES = (
    'Tables for other programs: <a href="points.csv">points.csv</a>, <a href="moodle.csv">moodle.csv</a>, '
    '<a href="junit.xml">junit.xml</a>; each student\'s folder has a results.json for Gradescope.'
)
CAPTION = (
    "Difference: black where both agree; red where the student's is brighter, blue where it is "
    "darker. z: the same in units of the noise, with the full color at 6 standard deviations."
)


def plain(name):
    """A name in one line."""
    return "".join(letter if letter.isprintable() else "?" for letter in name)


def escape(text):
    return html.escape(str(text).encode("utf-8", "replace").decode())


def first_of(result):
    """The first exercise that is wrong, or what the whole stage says."""
    return next((row for row in result["exercises"] if row["state"] == "wrong"), result["whole_stage"])


def message_of(result):
    """The sentence that a student is told."""
    if result["state"] != "judged":
        return f"{result['state']}: {result['error']}" if result["error"] else result["state"]
    first = first_of(result)
    if first:
        return f"{first['number']} {first['title']}\n{first['message']}".strip()
    open_ones = [row["number"] for row in result["exercises"] if row["state"] == "open"]
    return f"open: {', '.join(open_ones)}" if open_ones else "all done"


def in_short(result):
    """A line for tables and the terminal."""
    first = first_of(result) if result["state"] == "judged" else None
    if first and first["test"]:
        return f"{first['number']} {first['test']}".strip()
    text = re.sub(r"^It printed last:\n(?:  .*\n)+", "", message_of(result), flags=re.MULTILINE)
    return textwrap.shorten(text, 120, placeholder=" ...")


def mistakes_of(whole):
    """What is wrong in the class: [(count, exercise, test)], the most frequent first."""
    counts = {}
    for one in whole.submissions:
        result = whole.results[one.name]
        if not one.path:
            continue
        if result["state"] != "judged":
            key = ("", result["state"])
        elif first := first_of(result):
            key = (f"{first['number']} {first['title']}".strip(), first["test"])
        else:
            continue
        counts[key] = counts.get(key, 0) + 1
    return sorted(((count, *key) for key, count in counts.items()), reverse=True)


def results_of(whole):
    """Of all who handed in something."""
    return [whole.results[one.name] for one in whole.given.handed_in]


def in_numbers(whole):
    """The class in a line."""
    every = results_of(whole)
    done = sum(result["points"] == result["out_of"] for result in every)
    median = statistics.median(result["points"] for result in every) if every else 0
    out_of = every[0]["out_of"] if every else 0
    return f"{len(every)} submissions, {done} with all {out_of} points; median {median:g}"


def summary(whole):
    """The lines at the end of the terminal's report."""
    found, now = mistakes_of(whole), [one for one in results_of(whole) if not one.get("kept")]
    yield ""
    for count, exercise, test in found[:10]:
        yield f"{count:4} of {len(whole.given.handed_in)}: {', '.join(filter(None, (exercise, test)))}"
    if found[10:]:
        yield f"     and {len(found) - 10} more, on the page"
    seconds = sum(result["seconds"] for result in now)
    yield f"\n{in_numbers(whole)}"
    yield f"{len(now)} were judged now, in {seconds:.0f} s of processor time"


def shown_names(whole):
    """What the page calls each submission, and its folder there: [(submission, name, id, folder)]."""
    if not whole.names_hidden:
        return [
            (one, plain(one.student or one.name), plain(one.name), f"students/{whole.place(one).name}")
            for one in whole.submissions
        ]
    salt = whole.folder / "salt"  # so that nobody finds a number by trying names
    if not salt.exists():
        write_whole(salt, secrets.token_hex())
    text = salt.read_text(encoding="utf-8")
    order = sorted(whole.given.handed_in, key=lambda one: hashlib.sha256((text + one.name).encode()).digest())
    return [(one, f"student {n}", "", f"students/{n}") for n, one in enumerate(order, 1)]


def bars(whole):
    found = mistakes_of(whole)
    most = max((count for count, *_ in found), default=1)
    for count, exercise, test in found:
        words = escape(", ".join(filter(None, (exercise, test))))
        yield (
            f'<li><span class="bar" style="width:{12 * count / most:.2f}rem"></span>'
            f"{count} of {len(whole.given.handed_in)}: {words}</li>"
        )


def row_of(result, name, handle, folder):
    cells = [f'<th scope="row"><a href="{folder}/index.html">{escape(name)}</a></th>']
    cells.append(f"<td>{escape(handle)}</td><td>{result['points']}</td>")
    for row in result["exercises"]:
        state = row["state"]
        word = state.split()[0]
        mark = {"done": "✓", "wrong": "✗", "open": "○"}.get(word, "–")
        cells.append(
            f'<td class="{escape(word)}" title="{escape(row["title"])}: {escape(state)}">'
            f'{mark}<span class="words"> {escape(state)}</span></td>'
        )
    cells.append(f"<td>{escape(in_short(result))}</td><td>{result['seconds']:.1f}</td>")
    return f"<tr>{''.join(cells)}</tr>"


@functools.cache
def text_in(path):
    return path.read_text(encoding="utf-8")


def filled(template, **parts):
    """A page of this folder, with its parts."""
    parts["style"] = text_in(HERE / "page.css")
    return re.sub(r"\{\{(\w+)\}\}", lambda match: parts[match[1]], text_in(HERE / template))


def viewer_style():
    """The book's rules for figures that open large."""
    text = text_in(BOOK_STYLE)
    return text[text.index("/* A figure opened large") :].split("\n\n/*")[0]


def figure(picture):
    panels = "".join(
        f'<div class="panel"><p><img src="{escape(picture["name"])}/{part}.png" alt="{part}" width="160" '
        f'height="160" data-values="{escape(picture.get(part, ""))}"></p><p>{part}</p></div>'
        for part in PARTS
    )
    word = "different" if picture["wrong"] else "the same"
    says = escape(picture["says"])
    if "size" not in picture:
        return f"<h3>{escape(picture['name'])}: no picture</h3><p>{says}</p>"
    return (
        f'<h3>{escape(picture["name"])}: {word}</h3><div class="figure">{panels}'
        f'<div class="caption"><p>{says}</p></div></div>'
    )


def student_page(whole, one, name, neighbors):
    result = whole.results[one.name]
    rows = "".join(
        f'<tr><th scope="row">{row["number"]}</th><td>{escape(row["title"])}</td><td>{escape(row["state"])}</td>'
        f"<td>{row['points']} of {row['out_of']}</td></tr>"
        for row in result["exercises"]
    )
    when = "When you have read it" if result["state"] == "to be read" else "To judge it again"
    repeat = "" if whole.names_hidden else f"<p>{when}:</p><pre>{escape(whole.repeat(one))}</pre>"
    code = (
        f'<h2>What was handed in</h2><pre tabindex="0">{escape(result["code"])}</pre>'
        if result["code"]
        else ""
    )
    notes = "".join(f"<p>{escape(note)}</p>" for note in result["notes"])
    pictures = "".join(map(figure, result["pictures"]))
    return filled(
        "student.html",
        title=f"{escape(name)}, stage {whole.stage}",
        neighbors=" ".join(f'<a href="../../{folder}/index.html">{word}</a>' for word, folder in neighbors),
        points=f"{result['points']} of {result['out_of']} points",
        message=escape(message_of(result)),
        code=code,
        rows=rows,
        notes=notes,
        repeat=repeat,
        pictures=(f"<h2>Pictures</h2><p>{CAPTION}</p>{pictures}" if pictures else ""),
        viewer_style=viewer_style(),
        viewer=text_in(VIEWER),
    )


def write(whole, workshop):
    """Writes the page of the class; returns its path. Without names it lies in a folder of
    its own, which tells nothing else of who is who."""
    target = whole.folder / "without_names" if whole.names_hidden else whole.folder
    if whole.names_hidden:
        shutil.rmtree(target, ignore_errors=True)
    shown = shown_names(whole)
    for at, (one, name, _, folder) in enumerate(shown):
        around = [("previous", at - 1)] * (at > 0) + [("next", at + 1)] * (at + 1 < len(shown))
        (target / folder).mkdir(parents=True, exist_ok=True)
        for picture in whole.results[one.name]["pictures"]:
            made = whole.place(one) / picture["name"]
            if whole.names_hidden and made.exists():
                shutil.copytree(made, target / folder / picture["name"])
        neighbors = [(word, shown[other][3]) for word, other in around]
        write_whole(target / folder / "index.html", student_page(whole, one, name, neighbors))
    heads = "".join(
        f'<th scope="col" title="{escape(title)}">{number}</th>'
        for number, (title, _) in workshop.tasks.items()
    )
    text = filled(
        "class.html",
        title=f"Stage {whole.stage}",
        numbers=escape(in_numbers(whole)),
        remarks=""
        if whole.names_hidden
        else "".join(f"<p>{escape(one)}</p>" for one in whole.given.remarks()),
        out_of=str(sum(task["points"] for _, task in workshop.tasks.values())),
        heads=heads,
        rows="\n".join(row_of(whole.results[one.name], *names) for one, *names in shown),
        bars="".join(bars(whole)),
        tables="" if whole.names_hidden else TABLES,
    )
    write_whole(target / "index.html", text)
    return target / "index.html"
