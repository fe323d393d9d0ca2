"""What the compiler says, as far as it helps: the student's lines, without the
notes on libraries, at most as wide as a terminal."""

import contextlib
import os
import re
import signal
import subprocess
import textwrap
from dataclasses import dataclass, field

from tests.runner import watch
from tests.runner.report import WIDTH
from tools.tree import BUILD, ROOT

# Of processor time; all that is compiled takes a third of it on a slow machine.
MAX_SECONDS = 600
MESSAGE = re.compile(r"^((?:[A-Za-z]:)?[^:\n]+):(\d+):(?:(\d+):)? (fatal error|error|warning|note): (.*)$")
CONTEXT = re.compile(
    r"^(In file included from |\s+from |.*: (In|At) |.*: required from )|^\[\d+/\d+\]|^ninja:|^FAILED:|^g?make"
)
# What is said by a compiler in its own words, and what it means here.
EXPLAINED = (
    (
        r"operator\s?\*.*operand types are '(int|double)' and '.*(Vec3|vec<)"
        r"|operator\s?\*.*operand types are '.*(Vec3|vec<).*' and '(int|double)"
        r"|invalid operands to binary expression \('(int|double)' and '(const )?(Vec3|.*vec<)",
        "A vector is multiplied by a float: write 2.0f * v, not 2 * v.",
    ),
    (
        r"could not convert .*<brace-enclosed initializer list>.* to 'std::optional<|"
        r"no viable conversion from returned value of type 'void' to .*std::optional<",
        "What goes into a std::optional is named with its type: return Type{a, b};",
    ),
    (
        r"(class|struct) ?std::optional<.*has no member|no member named '.*' in 'std::optional"
        r"|could not convert .* from '.*optional<|no (viable|known) conversion (from|for).*'(const )?std::optional"
        r"|invalid initialization of reference of type .* from expression of type '.*std::optional<",
        "A std::optional may be empty: `if (!x)` asks whether it is, x->part is a part of\n"
        "what is in it, and *x all of it.",
    ),
)


@dataclass
class Message:
    path: str
    line: int
    kind: str
    says: str
    shown: list = field(default_factory=list)  # the code, and a caret

    def lines(self):
        says = plain_types(f"{self.path}:{self.line}: {self.kind}: {self.says}")
        says = textwrap.wrap(
            says,
            WIDTH,
            subsequent_indent="    ",
            max_lines=3,
            placeholder=" ...",
            break_long_words=False,
            break_on_hyphens=False,
        )
        return [*says, *(plain_types(line)[:WIDTH] for line in self.shown)]


def plain_types(text):
    """Without what a type is called in its library."""
    text = re.sub(r" \{aka '[^']*'\}| \(aka '[^']*'\)", "", text)
    text = re.sub(r"(?:glm::)?vec<(\d), float(?:, \(?(?:glm::)?\w+\)?\w*)?>", r"Vec\1", text)
    return re.sub(r"lightwalk::(?=Vec\d|\w+::)", "", text)


def messages(said):
    """The compiler's, in its order; one in a library has the student's line that led there."""
    found, led_there = [], ""
    for line in said.replace(ROOT.as_posix() + "/", "").replace(str(ROOT) + os.sep, "").splitlines():
        match = MESSAGE.match(line)
        if required := re.match(r"(stages/[^:]+:\d+):\d+:\s+required from", line):
            led_there = required[1]
        elif match:
            says = match[5]
            if led_there and match[4] != "note" and not match[1].startswith("stages/"):
                says = f"{led_there} leads there: {says}"
            found.append(Message(match[1], int(match[2]), match[4], says))
            led_there = ""
        elif found and not CONTEXT.match(line) and re.match(r"\s+(\d+ )?\s*\|| ", line):
            found[-1].shown.append(line.rstrip())
    return found


def explanation(one):
    says = plain_types(one.says)
    return next((text for pattern, text in EXPLAINED if re.search(pattern, says)), "")


def in_words(found, most=20):
    """Errors or warnings with the notes on the student's own lines, a screenful."""
    lines, explained = [], ""
    for one in found:
        # Notes on libraries, and on templates that were tried.
        if one.kind == "note" and (not one.path.startswith("stages/") or one.says.startswith(" ")):
            continue
        explained = explained or explanation(one)
        if len(lines) + len(one.lines()) > most and lines:
            break
        lines += one.lines()
    return "\n".join([*lines, *(["", *explained.splitlines()] if explained else [])])


def first_error(said):
    """From the first error on. Never nothing."""
    found = messages(said)
    start = next((n for n, one in enumerate(found) if "error" in one.kind), None)
    if start is not None:
        return in_words([one for one in found[start:] if one.kind != "warning"])
    lines = [line[:WIDTH] for line in said.splitlines() if line.strip()]
    return "\n".join(lines[-12:]) or "The compiler ended without a word: `make clean` and try again."


def warnings(said, header, exercises):
    """Those in a stage's header, with their notes. What is not used is told of
    exercises that are solved; the others use nothing yet."""
    solved = [mark for mark in exercises if not mark.is_open]
    kept, keep = [], False
    for one in messages(said):
        if one.kind != "note":
            keep = one.kind == "warning" and one.path == header
            if "-Wunused" in one.says and len(solved) < len(exercises):
                keep = keep and any(mark.start <= one.line <= mark.end for mark in solved)
        if keep:
            kept.append(one)
    return in_words(kept, 12)


def build(*targets):
    """What the compiler says, and whether it has made the targets."""
    command = ["cmake", "--build", BUILD, "-j", str(os.cpu_count() or 2), "--target", *targets]
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    environment = os.environ | {"LC_ALL": "C", "COLUMNS": str(WIDTH)}
    process = subprocess.Popen(command, **pipes, env=environment, start_new_session=os.name != "nt")
    try:
        said, _ = watch.communicate(process, seconds=MAX_SECONDS)
    except watch.Endless:
        return "error: the compiler does not come to an end", False
    finally:
        if os.name != "nt":
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(process.pid, signal.SIGKILL)
    return said.decode(errors="backslashreplace"), process.returncode == 0
