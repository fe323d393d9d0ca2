"""The page that lists the decks, and the plans of sessions."""

from html import escape
from pathlib import Path


def deck_row(deck):
    return (
        f'<tr><td><a href="{deck.name}.html">{escape(deck.title)}</a></td>'
        f'<td><a href="{deck.name}.pdf">PDF with notes</a>, '
        f'<a href="{deck.name}_questions.pdf">without answers</a></td>'
        f"<td>{len(deck.slides)}</td><td>{deck.minutes:.0f} min</td></tr>"
    )


def skipped_slides(part):
    """Links to the slides that are left out, one for each heading."""
    first = {}
    for slide in part.skipped:
        first.setdefault(slide.heading, []).append(slide.number)
    return ", ".join(
        f'<a href="{part.deck.name}.html#{numbers[0]}">{title(heading)}</a>'
        + f" ({len(numbers)} slides)" * (len(numbers) > 1)
        for heading, numbers in first.items()
    )


def part_line(part):
    line = f'<a href="{part.deck.name}.html">{escape(part.deck.title)}</a>, {part.minutes:g} min'
    if part.skipped:
        line += f'<span class="skipped">without {skipped_slides(part)}</span>'
    return line


def plan_section(plan, sessions):
    rows = "\n".join(
        f'<tr><td><a href="{one.name}.html">{escape(one.title)}</a></td>'
        f"<td>{'<br>'.join(map(part_line, one.parts))}</td><td>{one.minutes:g} min</td></tr>"
        for one in sessions
    )
    return (
        f"<h3>{escape(plan['name'])}</h3>\n<p>{escape(plan['says'])}</p>\n"
        '<div class="wide"><table class="plan">\n'
        f"<tr><th>session</th><th>decks</th><th>takes</th></tr>\n{rows}\n</table></div>"
    )


def title(tex):
    """A heading without TeX."""
    letters = {r"\Omega": "Ω", r"\omega_o": "ω<sub>o</sub>"}
    text = escape(tex).replace("$", "")
    for old, new in letters.items():
        text = text.replace(old, new)
    return text


def index_page(every, of_plans):
    text = Path(__file__).with_name("index.html").read_text()
    rows = "\n".join(map(deck_row, every))
    text = text.replace("{plans}", "\n".join(plan_section(*one) for one in of_plans))
    return text.replace("{decks}", rows)
