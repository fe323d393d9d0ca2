"""Links names in listings to the lines that define them.

A listing's line numbers become anchors, L12 for line 12, since a page has one
header. A name is resolved as in the code: a stage's own definition, else that of
the nearest earlier stage, else the core's.
"""

import re
from collections import Counter, defaultdict

from tools.tree import ROOT

# At the beginning of a line, as the code style puts them.
FUNCTION = re.compile(
    r"(?:inline |constexpr |explicit )*(?:const )?[A-Z_a-z][\w:]*(?:<[^()]*>)?[&*]? (\w+)\("
)
TYPE = re.compile(r"(?:struct|class|enum class) (?:alignas\(\w+\) )?(\w+)(?=[ :{]|$)(?!.*;)")
CONSTANT = re.compile(r"inline constexpr [\w:<>]+ (\w+)")
ALIAS = re.compile(r"using (\w+) =")
METHOD = re.compile(r"  (?:static |constexpr |const )*[A-Z_a-z][\w:]*(?:<[^()]*>)?[&*]? (\w+)\([^;]*$")
NOT_TYPES = {"return", "else", "case", "using", "namespace", "throw", "delete", "new", "goto"}

NAME = re.compile(
    r'(?:<span class="n">stage(?P<stage>\d)</span><span class="o">::</span>)?'
    r'(?P<access><span class="(?:p|o)">(?:\.|-&gt;)</span>)?'
    r'<span class="n">(?P<name>\w+)</span>(?P<call>(?=<span class="p">\())?'
)
LISTING = re.compile(r'<div class="highlight">.*?</pre></div>', re.S)
LINE_NUMBER = re.compile(r'<span class="linenos">( *)(\d+)</span>')


def definitions(header):
    """({name: line} of the namespace, names of member functions with lines)."""
    found, members = {}, []
    for number, line in enumerate(header.read_text().splitlines(), 1):
        for pattern in (TYPE, CONSTANT, ALIAS, FUNCTION):
            match = pattern.match(line)
            if match and line.split()[0] not in NOT_TYPES:
                found.setdefault(match[1], number)
                break
        else:
            match = METHOD.match(line)
            if match and line.split()[0] not in NOT_TYPES:
                members.append((match[1], number))
    return found, members


def stage_of(header):
    """The stage whose folder the header is in, 0 for the core."""
    top, folder, *_ = header.relative_to(ROOT).parts
    return int(folder[0]) if top == "stages" else 0


class Names:
    """Where each name is defined, as (page, line)."""

    def __init__(self, pages):
        """`pages` are (header, page) of the book, in its order."""
        self.stages = defaultdict(dict)  # the core is 0
        methods = []
        for header, page in pages:
            names, members = definitions(header)
            places = {name: (page, line) for name, line in names.items()}
            known = self.stages[stage_of(header)]
            for name, place in places.items():
                known.setdefault(name, place)
            if header.name != "path_tracer.hpp":
                methods += [(name, (page, line)) for name, line in members]
        often = Counter(name for name, _ in methods)
        self.members = {name: place for name, place in methods if often[name] == 1}

    def place(self, match, stage):
        """The definition of a name in a listing of that stage (0: the core)."""
        name = match["name"]
        if match["access"]:
            return self.members.get(name) if match["call"] else None
        if match["stage"]:
            return self.stages[int(match["stage"])].get(name)
        for number in range(stage, -1, -1):
            if name in self.stages[number]:
                return self.stages[number][name]
        return None


def is_linkable(match, place_line, line):
    """Variables may have the names of functions; a definition needs no link."""
    name = match["name"]
    return bool(match["call"] or name[0].isupper() or "_" in name) and place_line != line


def link_definitions(folder, pages):
    """Rewrites the built pages of the (header, page) given."""
    names = Names(pages)
    for header, page in pages:
        path = folder / f"{page}.html"
        stage = stage_of(header)
        up = "../" * page.count("/")
        path.write_text(LISTING.sub(lambda one: linked(one[0], page, stage, names, up), path.read_text()))


def linked(listing, page, stage, names, up):
    if not LINE_NUMBER.search(listing):
        return listing  # a transcript, or commands
    lines = listing.split("\n")
    for place, text in enumerate(lines):
        number = LINE_NUMBER.search(text)
        line = int(number[2]) if number else 0

        def link(match):
            place = names.place(match, stage)
            if not place or not is_linkable(match, place[1] if place[0] == page else 0, line):
                return match[0]
            address = "" if place[0] == page else f"{up}{place[0]}.html"
            before = match[0][: match[0].rindex('<span class="n">')]
            return f'{before}<a class="n" href="{address}#L{place[1]}">{match["name"]}</a>'

        text = NAME.sub(link, text)
        lines[place] = LINE_NUMBER.sub(r'<span class="linenos" id="L\2">\1\2</span>', text)
    return "\n".join(lines)
