"""The page that lists the decks, and where each title of the course is."""

from html import escape
from pathlib import Path

from tools.slides.coverage import shown_on, table


def deck_row(deck):
    return (
        f'<tr><td><a href="{deck.name}.html">{escape(deck.title)}</a></td>'
        f'<td><a href="{deck.name}.pdf">PDF</a></td>'
        f"<td>{len(deck.slides)}</td><td>{deck.minutes:.0f} min</td></tr>"
    )


def title_row(entry, by_name):
    deck = by_name[entry["deck"]]
    pages = ", ".join(
        f'<a href="{deck.name}.html#{s.number}">{s.number}</a>' for s in shown_on(entry["title"], deck)
    )
    chapter = escape(entry.get("chapter", "").replace("/path_tracer.hpp", ""))
    return (
        f"<tr><td>{escape(entry['title'])}</td><td>{chapter}</td>"
        f"<td>{escape(deck.title)}</td><td>{pages}</td></tr>"
    )


def index_page(every):
    by_name = {deck.name: deck for deck in every}
    text = Path(__file__).with_name("index.html").read_text()
    rows = "\n".join(map(deck_row, every))
    titles = "\n".join(title_row(e, by_name) for e in table()["slide"])
    return text.replace("{decks}", rows).replace("{titles}", titles)
