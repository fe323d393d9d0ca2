"""The scripts and styles of the figures that live, for the book's pages.

A figure whose entry in figures.toml says `live = "NAME"` is replaced or
extended in the browser by what a script here registers as
`live.figures.NAME`. Without JavaScript, and on paper, the still figure stands
there. Where no compiler makes WebAssembly, the lab's box stays still.

    python3 -m tools.live.build FOLDER
"""

import sys
from pathlib import Path

from compare.stages import Failure
from tools.live.box import box_script
from tools.weave import drawing

HERE = Path(__file__).parent
# The first is what the others use.
SCRIPTS = ("drawing.js", "inversion.js", "snell.js", "event_bar.js", "fresnel.js")
BOX = ("box_controls.js", "box_path.js", "box.js")
COLORS = ("INK", "SOFT", "PAPER", "WARM", "COOL", "GREEN", "GRAY", "SAND", "GLASS", "FAINT")


def colors():
    """The colors of the drawings, for light pages and dark ones, and classes
    that draw and fill with them."""
    light = {name.lower(): getattr(drawing, name) for name in COLORS}
    dark = {name: drawing.ON_DARK[color] for name, color in light.items()}

    def variables(chosen, sheet):
        return "".join(f"--live-{k}:{v};" for k, v in [*chosen.items(), ("sheet", sheet)])

    on_dark = variables(dark, "transparent")
    lines = [
        f"body{{{variables(light, '#fdfcf9')}}}",
        f"body[data-theme=dark]{{{on_dark}}}",
        f"@media(prefers-color-scheme:dark){{body:not([data-theme=light]){{{on_dark}}}}}",
    ]
    for name in light:
        lines.append(f".live-stage .fill-{name}{{fill:var(--live-{name})}}")
        lines.append(f".live-stage .line-{name}{{stroke:var(--live-{name});fill:none}}")
    return "\n".join(lines) + "\n"


def check_live(entries):
    """Refuses a figure that should live, and that no script makes so."""
    scripts = "".join((HERE / name).read_text() for name in SCRIPTS + BOX)
    for entry in entries.values():
        name = entry.get("live")
        if name and f"live.figures.{name} =" not in scripts and f'live.figures["{name}"] =' not in scripts:
            raise Failure(f"figures.toml: {entry['name']}: no script makes '{name}' live")


def add_live(static):
    """Writes the scripts and styles into the folder of static files."""
    box = box_script()
    names = SCRIPTS
    if box:
        (static / "live-box.js").write_text(box)
        names += BOX
    scripts = "\n".join((HERE / name).read_text() for name in names)
    (static / "live.js").write_text("(() => {\n" + scripts + "})();\n")
    (static / "live.css").write_text(colors() + (HERE / "live.css").read_text())


if __name__ == "__main__":
    try:
        add_live(Path(sys.argv[1]))
    except Failure as error:
        sys.exit(f"live: {error}")
