"""Splits a stage's header in two: what it declares, and what its functions do.

    python3 tests/split_header.py HEADER DECLARED CODE

DECLARED is the header without the bodies of its functions: tests include it, and
are compiled once. CODE is the whole header, as a source file that brings all its
functions: it alone is compiled after each change, with the compiler's warnings.

A body that somebody needs to see stays in DECLARED: of a template, of a constexpr
or static function, of a constructor, or where the return type is `auto`. So does
all that this does not understand: it is slower, and as right. Both files are
written only where they change, so that what is made from them is not made again.
"""

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

# Comments, literals and lines of the preprocessor: no brace in them counts.
SKIPPED = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^\s()\\]{0,16})\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"'
    r"|(?<![0-9A-Fa-f])'(?:[^'\\\n]|\\.)+'|^[ \t]*#(?:[^\n\\]|\\.)*",
    re.S | re.M,
)
SHOWN = re.compile(r"\b(template|constexpr|consteval|static|friend|typedef|using|extern|asm)\b")
NESTED = re.compile(r"(\w+)\s*::\s*~?(\w+|operator[^(]*)\s*\(")


@dataclass
class Function:
    start: int  # of its declaration
    body: int  # of its first brace
    end: int  # behind its last
    member_outside: bool = False  # void Class::function() {}


@dataclass
class Split:
    functions: list = field(default_factory=list)
    balanced: bool = True


def blanked(text):
    """The text with blanks for all that is no code; every place stays."""

    def blank(match):
        return re.sub(r"[^\n]", " ", match[0])

    return SKIPPED.sub(blank, text)


def outside_parentheses(text):
    """A declaration's words that stand in no parentheses, (...) or <...>."""
    depth, kept = 0, []
    for letter in text.replace("->", "  "):
        if letter in "(<[":
            depth += 1
        kept.append(letter if depth == 0 else " ")
        if letter in ")>]":
            depth = max(0, depth - 1)
    return "".join(kept)


def is_separable(declaration, within_class):
    """Whether the function can be called by who does not see its body."""
    bare = outside_parentheses(declaration)
    if SHOWN.search(declaration) or re.search(r"\bdelete\b|\bdefault\b", bare):
        return False
    if re.search(r"\bauto\b", bare) and "->" not in declaration:
        return False
    if re.search(r"(?<!:):(?!:)", bare):  # a constructor's initializers
        return False
    if within_class:
        return re.match(r"(\[\[.*?\]\]|\s)*[\w:<>,&*\s]+[\s&*>]\w+\s*\(", declaration) is not None
    return True


def closing(code, start):
    """Behind the brace that closes the one at start, or None."""
    depth = 0
    for match in re.compile("[{}]").finditer(code, start):
        depth += 1 if match[0] == "{" else -1
        if depth == 0:
            return match.end()
    return None


def split(text):
    """The functions that can be separated, in order."""
    code, found = blanked(text), Split()
    scopes, start, place, round_brackets = [], 0, 0, 0
    while place < len(code):
        letter = code[place]
        if letter in "()":
            round_brackets += 1 if letter == "(" else -1
        elif round_brackets:
            pass
        elif letter == ";":
            start = place + 1
        elif letter == "}":
            if not scopes:
                break
            scopes.pop()
            start = place + 1
        elif letter == ":" and re.search(r"\b(public|private|protected)\s*$", code[start:place]):
            start = place + 1
        elif letter == "{":
            declaration = code[start:place]
            bare = outside_parentheses(declaration)
            if re.match(r"\s*(inline\s+)?namespace\s+[\w:]+\s*$", declaration):
                scopes.append("namespace")
                start = place + 1
            elif re.match(r"\s*(class|struct)\b", declaration) and "=" not in bare and "(" not in bare:
                scopes.append("class")
                start = place + 1
            else:
                end = closing(code, place)
                if end is None:
                    break
                # S(int a) : b{a} {}: the first braces are no body.
                last = declaration.rstrip()[-1:]
                if re.search(r"(?<!:):(?!:)", bare) and (last.isalnum() or last == "_"):
                    place = end
                    continue
                if ")" in declaration and ("=" not in bare or "operator" in declaration):
                    within_class = "class" in scopes
                    if is_separable(declaration, within_class):
                        first = start + len(declaration) - len(declaration.lstrip())
                        outside = bool(NESTED.search(declaration)) and not within_class
                        found.functions.append(Function(first, place, end, outside))
                    start = end
                place = end
                continue
        place += 1
    found.balanced = not scopes and round_brackets == 0 and place == len(code)
    return found


def declared(text, found):
    parts, last = [], 0
    for one in found.functions:
        if one.member_outside:
            parts.append(text[last : one.start])
        else:
            head = text[one.start : one.body].rstrip()
            parts.append(text[last : one.start] + re.sub(r"\binline\s+", "", head) + ";")
        last = one.end
    text = "".join([*parts, text[last:]])
    # A comment is no reason to compile anything again.
    text = re.sub(SKIPPED, lambda match: " " if match[0][:2] in ("//", "/*") else match[0], text)
    lines = (line.rstrip() for line in text.replace("\r", "").splitlines())
    return "#pragma GCC system_header\n" + "".join(line + "\n" for line in lines if line)


def code(text, found, header):
    """With each function marked, so that it is there though nobody here calls it."""
    name = header.as_posix()
    parts, last = [f'#line 1 "{name}"\n'], 0
    for one in found.functions:
        line = text.count("\n", 0, one.start) + 1
        column = one.start - text.rfind("\n", 0, one.start) - 1
        parts.append(f'{text[last : one.start]}\n[[gnu::used]]\n#line {line} "{name}"\n{" " * column}')
        last = one.start
    return "".join([*parts, text[last:]]).replace("#pragma once", "", 1)


def write(path, text):
    data = text.encode("latin-1")
    if not path.exists() or path.read_bytes() != data:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def main(header, declared_file, code_file):
    # Every byte is a letter of Latin-1: what the text is encoded in does not matter.
    text = header.read_bytes().removeprefix(b"\xef\xbb\xbf").decode("latin-1")
    found = split(text)
    if not found.balanced:
        found = Split()  # the compiler says where
    write(code_file, code(text, found, header))
    write(declared_file, declared(text, found))


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
