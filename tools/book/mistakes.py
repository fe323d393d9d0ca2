"""The gallery of mistakes, from tests/mistakes/stage*.toml."""

import tomllib

from literate import ROOT


def quoted(text):
    return " ".join(text.split()).replace("|", "\\|").replace("<", "\\<")


def mistakes_page():
    """The page's lines, or nothing while nobody has collected mistakes."""
    files = sorted(ROOT.glob("tests/mistakes/stage*.toml"))
    page = ["# A gallery of mistakes", "",
            "Each of these was put into a correct header, built, and run "
            "against that stage's tests. Below it stands the test that "
            "objected. Where it says *must pass*, the change is no mistake "
            "though it may look like one.", ""]
    count = 0
    for path in files:
        entries = next((v for v in tomllib.loads(path.read_text()).values()
                        if isinstance(v, list)), [])
        if not entries:
            continue
        page += [f"## Stage {path.stem.removeprefix('stage')}", ""]
        for entry in entries:
            count += 1
            title = entry["name"].replace("-", " ").capitalize()
            page += [f"### {title}", "", quoted(entry["sentence"]), "",
                     "```diff"]
            for edit in entry.get("edit", [entry]):
                for sign, key in (("- ", "find"), ("+ ", "replace")):
                    page += [sign + line for line in edit[key].split("\n")]
            page += ["```", ""]
            if entry.get("verdict") == "pass":
                page += ["*Must pass: this is not a mistake.*", ""]
            else:
                page += [f"Caught by: “{quoted(entry['caught_by'])}”", ""]
    return page if count else None
