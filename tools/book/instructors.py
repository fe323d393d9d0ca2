"""The table of hours on the page for instructors."""

from tools.book.page import page_of
from tools.exercises.sheet import headers_with_exercises, read_sheet, title_of
from tools.slides.deck import decks

HEAD = ["| chapter | lecture | exercises | at home | points |", "|---|---|---|---|---|"]


def hours():
    """For each chapter the minutes of its deck and of its exercises."""
    by_name = {deck.name: deck for deck in decks()}
    lines, sums = list(HEAD), [0, 0, 0, 0]
    for header in headers_with_exercises():
        tasks = read_sheet(header).tasks.values()
        deck = by_name.get(header.parent.name)
        row = [
            deck.minutes if deck else 0,
            len(tasks),
            sum(task.minutes for task in tasks),
            sum(task.points for task in tasks),
        ]
        sums = [a + b for a, b in zip(sums, row)]
        lines.append(table_row(f"[{title_of(header)}]({page_of(header)}.md)", row))
    return [*lines, table_row("together", sums)]


def table_row(name, row):
    lecture, exercises, home, points = row
    return f"| {name} | {lecture:g} min | {exercises} | {home} min | {points} |"
