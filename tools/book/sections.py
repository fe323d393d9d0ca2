"""What the search knows: the text of each section of each built page."""

import json
import re
import unicodedata
from html.parser import HTMLParser

SKIPPED = {"script", "style", "svg", "nav", "button", "noscript"}
VOID = {"img", "br", "hr", "input", "meta", "link", "col", "wbr"}
READ = {
    "cos": "cos ",
    "sin": "sin ",
    "sqrt": "√",
    "cdot": "·",
    "le": "≤",
    "ge": "≥",
    "int": "∫",
    "approx": "≈",
    "sum": "∑",
    "times": "×",
    "infty": "∞",
    "max": "max ",
    "min": "min ",
    "to": "→",
    "Rightarrow": "⇒",
}
NOT_SEARCHED = {"search.html", "genindex.html"}


class Sections(HTMLParser):
    """Collects {anchor, title, text} of what is within the page's article."""

    def __init__(self):
        super().__init__()
        self.found = []
        self.open = []  # (tag, what to do at its end)
        self.stack = []  # the sections that are open
        self.skipping = 0
        self.in_article = self.in_title = False

    def handle_starttag(self, tag, attributes):
        if tag in VOID:
            return
        names = dict(attributes)
        classes = (names.get("class") or "").split()
        end = ""
        if tag == "article":
            self.in_article, end = True, "article"
        elif self.skipping or tag in SKIPPED or {"headerlink", "linenos", "copybtn"} & set(classes):
            self.skipping += 1
            end = "skip"
        elif tag == "section" and names.get("id") and self.in_article:
            section = {"anchor": "#" + names["id"], "title": "", "text": []}
            self.found.append(section)
            self.stack.append(section)
            end = "section"
        elif re.fullmatch(r"h[1-6]", tag) and self.stack and not self.stack[-1]["title"]:
            self.in_title, end = True, "title"
        self.open.append((tag, end))

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        while self.open:
            name, end = self.open.pop()
            if end == "article":
                self.in_article = False
            elif end == "skip":
                self.skipping -= 1
            elif end == "section":
                self.stack.pop()
            elif end == "title":
                self.in_title = False
            if name == tag:
                return

    def handle_data(self, data):
        if self.skipping or not self.stack:
            return
        if self.in_title:
            self.stack[-1]["title"] += data
        else:
            self.stack[-1]["text"].append(data)


def symbol(match):
    """A command of TeX as it is read: a Greek letter, or its name."""
    name = match[1]
    try:
        return unicodedata.lookup(
            f"GREEK {'CAPITAL' if name[0].isupper() else 'SMALL'} LETTER {name.upper()}"
        )
    except KeyError:
        return READ.get(name, "")


def plain(text):
    """Formulas become what is left of them without their marks."""
    formula = re.compile(r"\\\((.*?)\\\)|\\\[(.*?)\\\]", re.S)

    def read(match):
        tex = match[1] or match[2]
        tex = re.sub(r"\\(?:d|t)?frac\{([^{}]*)\}\{([^{}]*)\}", r"\1/\2", tex)
        return " " + re.sub(r"[{}&]|\\[^A-Za-z]", "", re.sub(r"\\([A-Za-z]+) ?", symbol, tex)) + " "

    return " ".join(formula.sub(read, text).split())


def sections_of(page, text):
    reader = Sections()
    reader.feed(text)
    chapter = next((plain(one["title"]) for one in reader.found), page)
    return [
        {
            "page": page,
            "anchor": one["anchor"],
            "title": plain(one["title"]),
            "chapter": chapter,
            "text": plain("".join(one["text"])),
        }
        for one in reader.found
    ]


def write_sections(folder):
    """Writes _static/sections.js. To be called before formulas are set."""
    found = []
    for path in sorted(folder.rglob("*.html")):
        page = path.relative_to(folder).as_posix()
        if page not in NOT_SEARCHED:
            found += sections_of(page, path.read_text())
    text = json.dumps(found, ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/")
    (folder / "_static/sections.js").write_text(f"const sections = {text};\n")
