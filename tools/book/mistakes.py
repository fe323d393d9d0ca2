"""The gallery of mistakes, from tests/mistakes/stage*.toml."""

import tomllib

from literate import ROOT


def quoted(text):
    return " ".join(text.split()).replace("|", "\\|")


def mistakes_page():
    """The page's lines, or nothing while nobody has collected mistakes."""
    files = sorted(ROOT.glob("tests/mistakes/stage*.toml"))
    page = ["# A gallery of mistakes", "",
            "Each of these was put into a correct header, built, and run "
            "against that stage's tests. The last column names the test that "
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
            page += [f"### {quoted(entry['name']).replace('_', ' ')}", "",
                     quoted(entry["sentence"]), ""]
            old, new = (entry[k].rstrip("\n").split("\n")
                        for k in ("find", "replace"))
            page += ["```diff", *("- " + line for line in old),
                     *("+ " + line for line in new), "```", ""]
            caught = entry.get("caught_by", "")
            names = [caught] if isinstance(caught, str) else caught
            if entry.get("verdict", "").replace("_", " ") == "must pass" \
                    or not any(names):
                page += ["*Must pass: this is not a mistake.*", ""]
            else:
                page += ["Caught by: " + "; ".join(
                    f"“{quoted(name)}”" for name in names), ""]
    return page if count else None
