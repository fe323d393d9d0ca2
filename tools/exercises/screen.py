"""What in a header a person has to read before its points count.

The grader's sandbox keeps the machine safe whatever a header says. This keeps the
report true: code in the machine's language, or with the names of what runs the tests,
could make them say what is not so. Hardly any honest header has it, and the
student's check says so, too.
"""

import re
from bisect import bisect_left

# The standard library's, but what reads files and what other threads are made of.
STANDARD = """
algorithm any array bit bitset cassert cctype cerrno cfloat charconv chrono cinttypes climits clocale cmath
compare complex concepts cstdarg cstddef cstdint cstdio cstdlib cstring ctime cwchar deque exception
execution expected format forward_list functional initializer_list iomanip ios iosfwd iostream istream iterator
limits list locale map memory new numbers numeric optional ostream print queue random ranges ratio regex set
source_location span sstream stack stdexcept streambuf string string_view tuple type_traits typeindex typeinfo
unordered_map unordered_set utility valarray variant vector version
assert.h ctype.h errno.h float.h inttypes.h limits.h math.h stddef.h stdint.h stdio.h stdlib.h string.h time.h
""".split()
INCLUDE = re.compile(
    rf'include\s*[<"](?:(?:common|stages|glm)/(?!.*\.\.)[\w/.]+|{"|".join(map(re.escape, STANDARD))})[>"]\s*'
)
PRAGMA = re.compile(r"pragma\s+(?:(?:once|region|endregion|mark)\b|GCC\s+diagnostic\b|warning\b).*")
HARMLESS = re.compile(r"(?:define|undef|if\w*|el\w*|endif|error|warning)\b.*|")
NAMES = re.compile(
    r"asm|gnu|clang|extern|syscall|ptrace|mmap|mprotect|dlopen|dlsym|fopen|freopen|[io]?fstream|filesystem|environ|getenv"
    r"|_Pragma|\w*doctest\w*|\w*DOCTEST\w*"
    r"|__(?!(?:func|FUNCTION|PRETTY_FUNCTION|FILE|LINE|cplusplus|restrict|has_include|GNUC|clang|builtin_expect)"
    r"(?:__)?$)\w+"
)
# As the compiler reads: a comment begins in no literal, and no literal in a comment.
TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
    |(?P<raw>\b(?:u8|[uUL])?R")
    |(?P<literal>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')
    |(?P<number>\.?\d(?:'?\w|\.|(?<=[eEpP])[+-])*)
    |(?P<name>[^\W\d]\w*)
    |(?P<paste>\#\#|%:%:)
    |(?P<odd>["']|/\*)""",
    re.DOTALL | re.VERBOSE,
)
ODD = {
    "raw": "a raw string",
    "paste": "## makes words out of parts",
    "odd": "a quote or a comment without an end",
}
DIRECTIVE = re.compile(r"^[ \t\f\v]*(?:\#|%:)[ \t\f\v]*(.*)$", re.MULTILINE)
SPLICE = re.compile(r"\\[ \t\f\v]*\n")


def remark(text):
    """What is to be read, with its line, or nothing."""
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    # A backslash joins two lines, even in the middle of a word.
    joins = [
        one.start() - sum(map(len, SPLICE.findall(text, 0, one.start()))) for one in SPLICE.finditer(text)
    ]
    text, lines = SPLICE.sub("", text), text.splitlines()
    code, last = [], 0

    def found(place, what):
        number = text.count("\n", 0, place) + bisect_left(joins, place) + 1
        shown = lines[number - 1].strip() if number <= len(lines) else ""
        return f"line {number}: {what}: {shown[:80]}"

    for token in TOKEN.finditer(text):
        kind = token.lastgroup
        if kind in ODD:
            return found(token.start(), ODD[kind])
        if kind == "name" and NAMES.fullmatch(token[0]):
            return found(token.start(), token[0])
        if kind == "comment":
            # A space, and its lines.
            blank = re.sub(r"[^\n]", " ", token[0])
            code += [text[last : token.start()], blank]
            last = token.end()
    for one in DIRECTIVE.finditer("".join([*code, text[last:]])):
        if not any(pattern.fullmatch(one[1].strip()) for pattern in (INCLUDE, PRAGMA, HARMLESS)):
            return found(one.start(1), "#" + one[1].split()[0].split("<")[0].split('"')[0])
    return ""
