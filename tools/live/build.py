"""The box that the book paints in the page: its scripts, styles and module.

A figure with `live = true` in figures.toml has a script in tools/book/live/, or
is one for which box.js offers the lab's box. Without JavaScript, and on paper,
there is only the still figure; the box also needs a compiler for WebAssembly.

    python3 -m tools.live.build FOLDER
"""

import sys
from pathlib import Path

from tools.live.box import box_script
from tools.tree import Failure

HERE = Path(__file__).parent
# The others use the first.
SCRIPTS = ("elements.js", "controls.js", "path.js", "box.js")
DRAGGED = HERE.parent / "book/live"


def check_live(entries):
    """Refuses a figure with `live = true` and without a script."""
    scripts = "".join(path.read_text() for path in [*DRAGGED.glob("*.js"), HERE / "box.js"])
    for name, entry in entries.items():
        if entry.get("live") and f'live("{name}"' not in scripts and f'"{name}": {{' not in scripts:
            raise Failure(f"{entry['file']}: {name} is live, and no script says how")


def add_box(static):
    """Writes lab.js, lab.css and the module into the folder of static files."""
    module = box_script()
    scripts = "\n".join((HERE / name).read_text() for name in SCRIPTS)
    (static / "lab.js").write_text("(() => {\n" + scripts + "})();\n" if module else "")
    (static / "lab.css").write_text((HERE / "lab.css").read_text())
    if module:
        (static / "lab-module.js").write_text(module)


if __name__ == "__main__":
    try:
        add_box(Path(sys.argv[1]))
    except Failure as error:
        sys.exit(f"live: {error}")
