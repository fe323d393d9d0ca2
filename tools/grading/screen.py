"""What no header of the course needs, and what only an attack on the grader has.

The sandbox keeps the machine safe whatever a header says. This keeps the report
safe: who writes in the machine's language, or names what a library hides, could
look for the grader's secret in memory. An honest header has none of it.
"""

import re

INCLUDES = re.compile(
    r'^[ \t]*#[ \t]*include[ \t]*(?:"(?:common|stages)/[\w/]+\.hpp"|'
    r"<(?:algorithm|array|bit|cassert|cfloat|chrono|climits|cmath|concepts|cstddef|cstdint|cstdio|cstdlib|cstring|functional|initializer_list|"
    r"iomanip|iostream|iterator|limits|memory|numbers|numeric|optional|random|ranges|span|sstream|string|string_view|tuple|"
    r"type_traits|utility|variant|vector|glm/[\w/.]+)>)[ \t\r]*$"
)
DIRECTIVE = re.compile(r"^[ \t]*#[ \t]*(\w+)(.*)$", re.M)
PRAGMA = re.compile(r"[ \t]*once[ \t\r]*$")
FORBIDDEN = re.compile(
    r"\b(asm|extern|_exit|_Exit|quick_exit|syscall|dlopen|dlsym|fork|vfork|exec[lv]\w*|popen|system"
    r"|ptrace|mmap|mprotect|fopen|freopen|[io]?fstream|filesystem|sigaction|doctest\w*|DOCTEST\w*"
    r"|__(?!func__|FILE__|LINE__|PRETTY_FUNCTION__)\w+)\b"
)
ODD = (
    (re.compile(r"\[\[\s*(?:using\s+)?(gnu|clang)\b"), "an attribute of one compiler"),
    (re.compile(r"##|%:"), "## or %:, which make words out of parts"),
    (re.compile(r"\?\?[=/'()!<>-]"), "a trigraph"),
    (re.compile(r"\\[ \t\r]*$|\\[uUN]", re.M), "a backslash that continues a line or names a letter"),
)
# What the compiler takes for a comment, too, whatever stands around it: no literal
# begins before it, and what ends another comment or a literal is not in it.
COMMENT = re.compile(r"^([^\"'\n]*?)//(?:(?!\*/)[^\n\"])*$", re.M)


def remark(text):
    """Why a header is not judged, or nothing. Comments are prose; all else counts, in
    literals too: where they end is the compiler's to say."""
    text = COMMENT.sub(r"\1", text.replace("\r", ""))

    def where(place):
        return f"line {text.count(chr(10), 0, place) + 1}"

    for one in DIRECTIVE.finditer(text):
        if one[1] == "include" and not INCLUDES.match(one[0]):
            return f"{where(one.start())}: {one[0].strip()[:80]}: no header of the course includes that"
        if one[1] == "pragma" and not PRAGMA.match(one[2]):
            return f"{where(one.start())}: {one[0].strip()[:80]}: no header of the course needs that"
        if one[1] in ("include_next", "import", "embed", "line", "ident", "sccs"):
            return f"{where(one.start())}: #{one[1]}: no header of the course needs that"
    for pattern, what in ((FORBIDDEN, None), *ODD):
        if found := pattern.search(text):
            return f"{where(found.start())}: {what or found[0]}: no header of the course needs that"
    return ""
