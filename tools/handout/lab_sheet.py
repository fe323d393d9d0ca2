"""The lab sheet of a stage: its tasks and their points. Made from the chapter's
marks and exercises.toml, so that it always agrees with them."""

from tools.exercises.sheet import read_sheet, title_of

HAND_IN = """\
## What to hand in

1. `path_tracer.hpp` of this stage, {points} points. `make check` tests it.
2. The picture that `make` renders, and one of your own scene.
3. Your answers to the questions, two or three sentences each.
"""


def hours(minutes):
    return f"{minutes // 60} h {minutes % 60:02}" if minutes >= 60 else f"{minutes} min"


def lab_sheet(header):
    """Markdown."""
    sheet = read_sheet(header)
    tasks = list(sheet.tasks.values())
    lines = [f"# {title_of(header)}", ""]
    lines += [f"Read [path_tracer.hpp]({header.name}) from the top. Each exercise stands where its"]
    lines += ["idea has just been explained. `make check` judges them in this order.", ""]
    lines += ["| | exercise | where | time | points |", "|---|---|---|---|---|"]
    for task in tasks:
        mark = task.mark
        lines.append(
            f"| {mark.number} | {mark.title} | `{mark.region}` | {hours(task.minutes)} | {task.points} |"
        )
    total, points = sum(task.minutes for task in tasks), sum(task.points for task in tasks)
    lines += [f"| | all | | {hours(total)} | {points} |", ""]
    for task in tasks:
        lines += [f"## {task.mark.number} {task.mark.title}", "", task.task.strip(), ""]
        if task.needs:
            lines += [f"Comes after {', '.join(task.needs)}.", ""]
    lines += [HAND_IN.format(points=points), "## Questions", ""]
    lines += [f"{place}. {' '.join(one['ask'].split())}" for place, one in enumerate(sheet.questions, 1)]
    return "\n".join(lines) + "\n"
