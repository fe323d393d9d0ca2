"""The gallery of mistakes, from tests/mistakes/stage*.toml.

With the pictures that `make signatures` has left behind, for the mistakes
that show: wrong, right, their difference and its z.
"""

import re
import shutil
import tomllib

from compare.stages import BUILD, ROOT


def quoted(text):
    return " ".join(text.split()).replace("|", "\\|").replace("<", "\\<")


def change(entry):
    lines = ["```diff"]
    for edit in entry.get("edit", [entry]):
        for sign, key in (("- ", "find"), ("+ ", "replace")):
            lines += [sign + line for line in edit[key].split("\n")]
    return [*lines, "```", ""]


def picture(source, stage, name):
    """The most telling golden that the mistake fails, if it was rendered."""
    folder = BUILD / "signatures" / f"stage{stage}" / name
    report = folder / "report.txt"
    if not report.exists():
        return []
    for scene, verdict in re.findall(rf"golden image (\w+) of stage{stage}: (.*)", report.read_text()):
        image = folder / "golden_failures" / f"stage{stage}_{scene}.png"
        if image.exists():
            target = source / "mistakes" / f"stage{stage}-{name}.png"
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(image, target)
            return [
                f"![Wrong, right, the difference and its z](mistakes/{target.name})",
                "",
                f"`{scene}`, wrong, right, the difference and its z: " + quoted(verdict),
                "",
            ]
    return []


def gallery_entry(source, stage, entry):
    title = entry["name"].replace("-", " ").capitalize()
    lines = [f"### {title}", "", quoted(entry["sentence"]), "", *change(entry)]
    if entry.get("verdict") == "pass":
        return [*lines, "*Must pass: this is not a mistake.*", ""]
    return [*lines, *picture(source, stage, entry["name"]), f"Caught by: “{quoted(entry['caught_by'])}”", ""]


def mistakes_page(source):
    """The page's lines, or nothing while nobody has collected mistakes."""
    page = [
        "# A gallery of mistakes",
        "",
        "Each of these was put into a correct header, built, and run "
        "against that stage's tests. Below it stands the test that "
        "objected. Where it says *must pass*, the change is no mistake "
        "though it may look like one. Pictures are there once `make "
        "signatures` has painted them.",
        "",
    ]
    count = 0
    for path in sorted(ROOT.glob("tests/mistakes/stage*.toml")):
        entries = next((v for v in tomllib.loads(path.read_text()).values() if isinstance(v, list)), [])
        stage = path.stem.removeprefix("stage")
        page += [f"## Stage {stage}", ""] if entries else []
        for entry in entries:
            page += gallery_entry(source, stage, entry)
        count += len(entries)
    return page if count else None
