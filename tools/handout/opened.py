"""A stage's header with its exercises open.

The stub replaces the body of each exercise. A call before it prints once, on
stderr, that the exercise is open and where.
"""

from tools.exercises.marks import exercises

INCLUDE = '#include "common/open_exercise.hpp"'


def opened(header, solved=()):
    """The header's text, with all its exercises open but those `solved`."""
    lines = header.read_text(encoding="utf-8").splitlines()
    marked = exercises(header)
    for one in reversed(marked):
        if one.number in solved:
            # Their marks stay, without the stub.
            lines[one.start : one.first - 1] = []
            continue
        indent = " " * (len(one.body[0]) - len(one.body[0].lstrip()))
        call = f'open_exercise("{one.number}", "{one.title}");'
        lines[one.start : one.last] = [indent + line for line in (call, *one.stub)]
    if any(one.number not in solved for one in marked):
        first = next(n for n, line in enumerate(lines) if line.startswith('#include "'))
        lines.insert(first, INCLUDE)
    return "\n".join(lines) + "\n"
