"""Checks that the tests catch mistakes: puts them into the stages, one by one.

Each mistake of tests/mistakes/stageN.toml is a small change to the header of
stage N. The program makes it in a copy, which the compiler finds before the
header itself, and builds and runs the stage's suite with it; the tests that
fail have caught the mistake. It writes the table of mistakes and tests to
build/mistakes/table.md and table.json. It ends with 1 if:

- the text to replace is not in the header exactly once;
- the changed header does not compile;
- no test catches the mistake;
- a test fails for a variant that is no mistake (verdict = "pass");
- a failure prints an address, which means nothing to a reader.

Results are kept: a mistake runs again only after a change.
"""

import argparse
import concurrent.futures
import dataclasses
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

from tests import split_header
from tests.runner import suite as runner
from tests.runner import watch
from tools.tree import BUILD, ROOT, Failure, stage_headers, test_names, tests_filter

CATALOGUE = Path(__file__).parent


@dataclasses.dataclass
class Mistake:
    """One change to one stage's header: a mistake, or a right variant."""

    stage: int
    name: str
    sentence: str
    edits: list
    number: int | None = None
    caught_by: str = ""
    verdict: str = "fail"


@dataclasses.dataclass
class Result:
    """The outcome for a mistake."""

    key: str
    caught: list  # names of the tests that failed, or hung or crashed
    end: str  # "", "time limit" or "crash"
    error: str  # why there is no result
    noise: list = dataclasses.field(default_factory=list)  # factors that the suite reported
    says: dict = dataclasses.field(default_factory=dict)  # of each of these tests, the first failure


def read_mistakes(path):
    """The mistakes of one stageN.toml."""
    stage = int(re.fullmatch(r"stage(\d)", path.stem)[1])
    result = []
    for entry in tomllib.loads(path.read_text())["mistake"]:
        edits = entry.pop("edit", None) or [entry]
        edits = [(edit["find"], edit["replace"]) for edit in edits]
        entry.pop("find", None)
        entry.pop("replace", None)
        result.append(Mistake(stage=stage, edits=edits, **entry))
    return result


def check_catalogue(mistakes):
    """Refuses a catalog with unknown tests, bad verdicts or double names."""
    names = [f"{one.stage}/{one.name}" for one in mistakes]
    for name in set(names):
        if names.count(name) > 1:
            raise Failure(f"two mistakes are called {name}")
    tests = {stage: test_names(f"stage{stage}") for stage in {one.stage for one in mistakes}}
    for one in mistakes:
        if one.verdict not in ("pass", "fail"):
            raise Failure(f"{one.name}: verdict is neither pass nor fail")
        if one.verdict == "fail" and not one.caught_by:
            raise Failure(f"{one.name}: caught_by is missing")
        if one.caught_by and not any(test.startswith(one.caught_by) for test in tests[one.stage]):
            raise Failure(f'{one.name}: stage {one.stage} has no test called "{one.caught_by}"')
    core = test_names("core")
    for one in tomllib.loads((CATALOGUE / "not_here.toml").read_text())["mistake"]:
        for guard in one["guarded_by"]:
            if guard not in core:
                raise Failure(f'not_here.toml: number {one["number"]}: no core test is called "{guard}"')


def link_command(target, folder):
    """The words that link the target. They name files as seen from the folder,
    where they are run."""
    if (BUILD / "build.ninja").exists():
        command = ["ninja", "-C", BUILD, "-t", "commands", target]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        line = said.strip().splitlines()[-1].removeprefix(": && ").removesuffix(" && :")
    else:
        line = (folder / f"CMakeFiles/{target}.dir/link.txt").read_text()
    return shlex.split(line)


class Command:
    """How the build compiles one file of a target, whose name begins so."""

    def __init__(self, target, name):
        path = BUILD / "compile_commands.json"
        if not path.is_file():
            raise Failure(f"{path}, which says how to compile, is not there")
        commands = json.loads(path.read_text())
        found = [
            one
            for one in commands
            if f"/{target}.dir/" in one["command"] and Path(one["file"]).name.startswith(name)
        ]
        if len(found) != 1:
            raise Failure(f"{target} is not compiled as one file")
        self.source, self.folder = found[0]["file"], Path(found[0]["directory"])
        self.words = shlex.split(found[0]["command"])

    def words_for(self, source, target, options=()):
        """The same for another file, with these options first."""
        words = [str(source) if word == self.source else word for word in self.words]
        words[words.index("-o") + 1] = str(target)
        for option in ("-MD", "-MT", "-MF"):
            if option in words:
                place = words.index(option)
                del words[place : place + (1 if option == "-MD" else 2)]
        return [words[0], *options, *words[1:]]

    def run(self, source, target, options=()):
        run(self.words_for(source, target, options), "does not compile", self.folder)
        return str(target)


class Suite:
    """How the build makes one stage's suite: of its tests, which see what the
    header declares, and of what its functions do (tests/split_header.py)."""

    def __init__(self, stage):
        self.stage = stage
        self.target = f"stage{stage}_tests"
        self.header = next((path for path in stage_headers() if path.parent.name[0] == str(stage)), None)
        if not self.header:
            raise Failure(f"stage {stage} is not in this tree")
        self.name = self.header.relative_to(ROOT)
        self.tests, self.code = (
            Command(self.target, "suite"),
            Command(f"stage{stage}_header", f"stage{stage}."),
        )
        self.declared = BUILD / "tests/generated/declared" / self.name
        self.folder = self.tests.folder
        self.link = link_command(self.target, self.folder)
        self.given_key = self.hash_given()

    def hash_given(self):
        """A hash of all that a mistake does not change, without the suite itself."""
        files = [
            path
            for pattern in (
                "common/**/*.hpp",
                "tests/support/*",
                "tests/every_stage/*",
                "tests/golden/**/*",
                "compare/*.hpp",
                "scenes/**/*",
            )
            for path in ROOT.glob(pattern)
            if path.is_file()
        ]
        folders = [path.parent for path in stage_headers() if path <= self.header]
        files += [path for one in folders for path in one.rglob("*.hpp") if path != self.header]
        whole = hashlib.sha256(repr(self.link).encode())
        for path in sorted(files):
            whole.update(str(path).encode() + path.read_bytes())
        return whole.hexdigest()

    def key(self, header):
        """Of all that the suite with this header is made from."""
        whole = hashlib.sha256((self.given_key + header + repr(self.code.words)).encode())
        for source in sorted((ROOT / f"tests/stage{self.stage}").glob("*")):
            whole.update(source.read_bytes())
        return whole.hexdigest()

    def split(self, folder):
        """Splits the header that is in the folder; returns its code."""
        code = folder / "code.cpp"
        split_header.main(folder / self.name, folder / "declared" / self.name, code)
        return code

    def build(self, folder):
        """Builds the suite with the header that is in the folder; returns the
        program, which is there, too."""
        program = folder / self.target
        objects = [self.code.run(self.split(folder), folder / "code.o")]
        gone = [f"stage{self.stage}_header.dir/"]
        if (folder / "declared" / self.name).read_bytes() != self.declared.read_bytes():
            options = [f"-I{folder / 'declared'}"]
            objects.append(self.tests.run(self.tests.source, folder / "suite.o", options))
            gone.append(f"{self.target}.dir/")
        words = [word for word in self.link if not any(name in word for name in gone)]
        place = words.index("-o")
        words = [*words[:place], *objects, "-o", str(program), *words[place + 2 :]]
        run(words, "does not link", self.folder)
        for path in objects:
            Path(path).unlink()
        return program


def run(command, what, folder=None):
    """Runs a compiler or linker; its first error is the failure."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if "error" in line]
        raise Failure(f"{what}: {(lines or [done.stderr])[0].strip()}")


def changed_header(mistake, suite):
    """The header's text with the mistake in it."""
    text = suite.header.read_text()
    for find, replace in mistake.edits:
        if text.count(find) != 1:
            raise Failure(
                f"the text to replace occurs {text.count(find)} "
                f"times in {suite.header.relative_to(ROOT)}: "
                f"{find.strip().splitlines()[0]}"
            )
        text = text.replace(find, replace)
    return text


def noted_noise(notes):
    """The factors of noise, relative to a right program, that the suite reported."""
    text = "\n".join(notes)
    return sorted(float(one) for one in re.findall(r"([0-9][0-9.e+-]*)\s+times the (?:noise|golden's)", text))


def run_program(program, *options, seconds=None, environment=None):
    """Runs a suite, which loads the image library from the build folder."""
    paths = {name: str(BUILD) for name in ("LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")}
    return runner.run(
        program,
        *options,
        seconds=seconds or watch.seconds_for(BUILD),
        environment=paths | (environment or {}),
    )


def run_suite(program, named=""):
    """The tests that failed, how the program ended, the noise that it reported,
    and what the tests say.

    With `named`, runs only tests whose names begin with it.
    """
    outcome = run_program(program, *([f"-tc={tests_filter([named])}"] if named else []))
    says = {test.name: test.failed[0][0] for test in outcome.tests if test.failed}
    return outcome.caught_by, outcome.end, noted_noise(outcome.notes), says


def build_with(header, suite, folder):
    """The suite's program, in the folder, with this text as its header."""
    overlay = folder / suite.name
    overlay.parent.mkdir(parents=True, exist_ok=True)
    overlay.write_text(header)
    return suite.build(folder)


def try_mistake(mistake, suite, folder, named_first=False):
    """Builds and runs a suite with a mistake in its stage's header.

    With `named_first` runs the test that the catalog names alone, and the others
    only if it does not fail.
    """
    folder = folder / f"stage{mistake.stage}" / mistake.name
    saved = folder / "result.json"
    try:
        header = changed_header(mistake, suite)
    except Failure as failure:
        return Result("", [], "", str(failure))
    key = suite.key(header)
    named = mistake.caught_by if named_first and mistake.verdict == "fail" else ""
    if saved.exists():
        result = Result(**json.loads(saved.read_text()))
        if result.key == key or (named and result.key == key + named):
            return result
    result = Result(key, [], "", "")
    try:
        program = build_with(header, suite, folder)
        if named:
            result.caught, result.end, result.noise, result.says = run_suite(program, named)
        if result.caught:
            result.key += named
        else:
            result.caught, result.end, result.noise, result.says = run_suite(program)
        program.unlink()
    except Failure as failure:
        result.error = str(failure)
    saved.write_text(json.dumps(dataclasses.asdict(result), indent=1))
    return result


def judge(mistake, result):
    """A word for the table, and an error, which may be empty."""
    if result.error:
        return "no result", result.error
    for test, says in result.says.items():
        if re.search(r"\b0x[0-9a-f]{4}", says):
            return "prints an address", f'"{test}" prints an address: {says}'
    caught = bool(result.caught or result.end)
    if mistake.verdict == "pass":
        if caught:
            return "wrongly caught", "is no mistake, and was caught by: " + "; ".join(result.caught)
        if result.noise:
            low, high = result.noise[0], result.noise[-1]
            return f"passes, with {low:.1f} to {high:.1f} times the noise", ""
        return "passes, as it should", ""
    if not caught:
        return "NOT CAUGHT", "no test catches it"
    if any(test.startswith(mistake.caught_by) for test in result.caught):
        return "as expected", ""
    return "by other tests", ""


def as_markdown(rows):
    """The table of mistakes, and the table of tests."""
    lines = ["# Mistakes, and the tests that catch them\n"]
    for stage in sorted({mistake.stage for mistake, _, _ in rows}):
        lines += [
            f"\n## Stage {stage}\n",
            "| # | mistake | what is wrong | expected test | caught by |",
            "|---|---|---|---|---|",
        ]
        caught = {test: 0 for test in test_names(f"stage{stage}")}
        for mistake, result, word in rows:
            if mistake.stage != stage:
                continue
            tests = list(result.caught)
            for test in tests:
                caught[test] = caught.get(test, 0) + 1
            if result.end:
                tests.append(f"*{result.end}*")
            cells = (
                str(mistake.number or "-"),
                mistake.name,
                mistake.sentence,
                word,
                "; ".join(tests) or "-",
            )
            lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
        lines += ["\n| test | mistakes it caught |", "|---|---|"]
        lines += [f"| {test.replace('|', chr(92) + '|')} | {count} |" for test, count in caught.items()]
    return "\n".join(lines) + "\n"


def main():
    """Runs the mistakes of the command line."""
    parser = argparse.ArgumentParser(
        description="Puts each known mistake into its stage and reports which tests catch it."
    )
    parser.add_argument("names", nargs="*", help="only these mistakes")
    parser.add_argument("--stage", type=int, help="only this stage's")
    parser.add_argument(
        "--named-first",
        action="store_true",
        help="run the named test alone, and the others only if it passes: half the time, "
        "but the table does not say which others fail",
    )
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    folder = BUILD / "mistakes"
    try:
        mistakes = [one for path in sorted(CATALOGUE.glob("stage?.toml")) for one in read_mistakes(path)]
        unknown = set(options.names) - {one.name for one in mistakes}
        if unknown:
            raise Failure(f"no such mistake: {', '.join(sorted(unknown))}")
        chosen = [
            one
            for one in mistakes
            if (not options.names or one.name in options.names) and options.stage in (None, one.stage)
        ]
        check_catalogue(chosen)
        suites = {stage: Suite(stage) for stage in sorted({one.stage for one in chosen})}
    except (Failure, OSError, subprocess.CalledProcessError) as failure:
        sys.exit(f"mistakes: {failure}")
    # The unchanged stage must pass, or the results mean nothing.
    chosen = [
        Mistake(stage, "nothing-changed", "The unchanged stage.", [], verdict="pass") for stage in suites
    ] + chosen

    rows, errors = [], 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = pool.map(
            lambda one: try_mistake(one, suites[one.stage], folder, options.named_first), chosen
        )
        for mistake, result in zip(chosen, results):
            word, error = judge(mistake, result)
            rows.append((mistake, result, word))
            errors += bool(error)
            print(f"stage {mistake.stage}: {mistake.name}: {error or word}", flush=True)
    table = [
        {
            **dataclasses.asdict(mistake),
            "outcome": word,
            "tests": result.caught,
            "end": result.end,
            "error": result.error,
        }
        for mistake, result, word in rows
    ]
    (folder / "table.json").write_text(json.dumps(table, indent=1) + "\n")
    (folder / "table.md").write_text(as_markdown(rows))
    total = {word: sum(row[2] == word for row in rows) for word in dict.fromkeys(row[2] for row in rows)}
    print(", ".join(f"{count} {word}" for word, count in total.items()))
    print(f"The table is {folder / 'table.md'}")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
