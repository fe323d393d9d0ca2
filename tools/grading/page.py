"""The page of a class: one folder that works from a disk, without network."""

import functools
import html
import re
from pathlib import Path

from tools.tree import ROOT, write_whole

HERE = Path(__file__).parent
VIEWER = ROOT / "tools/book/viewer.js"
BOOK_STYLE = ROOT / "tools/book/book.css"
PARTS = ("student", "reference", "difference", "z")
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
    return " ".join(message_of(result).split())[:120]


def mistakes_of(whole):
    """What is wrong in the class: [(count, exercise, test)], the most frequent first."""
    counts = {}
    for one in whole.submissions:
        result = whole.results[one.name]
        if result["state"] != "judged":
            key = ("", result["state"])
        elif first := first_of(result):
            key = (f"{first['number']} {first['title']}".strip(), first["test"])
        else:
            continue
        counts[key] = counts.get(key, 0) + 1
    return sorted(((count, *key) for key, count in counts.items()), reverse=True)


def summary(whole):
    """The lines at the end of the terminal's report."""
    every = [whole.results[one.name] for one in whole.submissions]
    done = sum(result["points"] == result["out_of"] for result in every)
    seconds = sum(result["seconds"] for result in every)
    yield ""
    for count, exercise, test in mistakes_of(whole)[:10]:
        yield f"{count:4} of {len(every)}: {', '.join(filter(None, (exercise, test)))}"
    yield f"\n{len(every)} submissions, {done} with all points; {seconds:.0f} s of processor time"


def shown_names(whole):
    """What the page calls each submission."""
    if not whole.names_hidden:
        return {one.name: (plain(one.student or one.name), plain(one.name)) for one in whole.submissions}
    by_hash = sorted(whole.submissions, key=lambda one: whole.place(one).name)
    return {one.name: (f"student {number}", "") for number, one in enumerate(by_hash, 1)}


def bars(whole):
    found = mistakes_of(whole)
    most = max((count for count, *_ in found), default=1)
    for count, exercise, test in found:
        words = escape(", ".join(filter(None, (exercise, test))))
        yield (
            f'<li><span class="bar" style="width:{12 * count / most:.2f}rem"></span>'
            f"{count} of {len(whole.submissions)}: {words}</li>"
        )


def row_of(one, result, names, place):
    name, handle = names[one.name]
    cells = [f'<th scope="row"><a href="students/{place}/index.html">{escape(name)}</a></th>']
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


def student_page(whole, one, names):
    result, (name, _) = whole.results[one.name], names[one.name]
    rows = "".join(
        f'<tr><th scope="row">{row["number"]}</th><td>{escape(row["title"])}</td><td>{escape(row["state"])}</td>'
        f"<td>{row['points']} of {row['out_of']}</td></tr>"
        for row in result["exercises"]
    )
    repeat = "" if whole.names_hidden else f"<p>To judge it again:</p><pre>{escape(whole.repeat(one))}</pre>"
    pictures = "".join(map(figure, result["pictures"]))
    return filled(
        "student.html",
        title=f"{escape(name)}, stage {whole.stage}",
        points=f"{result['points']} of {result['out_of']} points",
        message=escape(message_of(result)),
        rows=rows,
        repeat=repeat,
        pictures=(f"<h2>Pictures</h2><p>{CAPTION}</p>{pictures}" if pictures else ""),
        viewer_style=viewer_style(),
        viewer=text_in(VIEWER),
    )


def write(whole, workshop):
    names = shown_names(whole)
    numbers = [(number, title) for number, (title, _) in workshop.tasks.items()]
    rows = [row_of(one, whole.results[one.name], names, whole.place(one).name) for one in whole.submissions]
    for one in whole.submissions:
        write_whole(whole.place(one) / "index.html", student_page(whole, one, names))
    heads = "".join(f'<th scope="col" title="{escape(title)}">{number}</th>' for number, title in numbers)
    text = filled(
        "class.html",
        title=f"Stage {whole.stage}: {len(rows)} submissions",
        heads=heads,
        rows="\n".join(rows),
        bars="".join(bars(whole)),
    )
    write_whole(whole.folder / "index.html", text)
