"""Makes many small changes to every stage, and lists those that no test catches.

    make mutants                        all stages
    make mutants MUTANTS="--stage 2"    one of them

tests/mistakes has the mistakes that people make; here are those that nobody
thought of. A change that no test catches, a mutant that is *alive*, is either
a gap in the tests or no mistake at all: README.md says how to tell. The
program ends with 1 if the suite fails without any change.

Results are kept in build/mutants/: a mutant runs again only after a change,
and after a change of the tests it first runs the test that caught it before.
"""

import argparse
import collections
import concurrent.futures
import dataclasses
import json
import math
import os
import re
import resource
import subprocess
import sys
import threading
from pathlib import Path

from tests.mistakes import mistakes as catalogue
from tests.mutants import edits, schema
from tools.tree import BUILD, ROOT, Failure, stage_headers

FOLDER = BUILD / "mutants"

# A test that takes this many times the processor time of all tests of an
# unchanged run, and at least this many seconds, counts as endless.
TIMES_AS_LONG, AT_LEAST = 8, 2

# The fastest tests, which together take this share of the suite's time, run
# first, then more of them, and the slow ones last.
SHARES = (0.05, 0.2, 0.5, 1)


@dataclasses.dataclass
class Outcome:
    """The outcome for a mutant: killed (by a test of a kind) or alive, ..."""

    key: str  # of the suite that was run
    state: str  # "killed", "alive" or "does not compile"
    kind: str = ""
    test: str = ""


def include_options(suite):
    """What libclang has to know of how the suite is compiled."""
    words = suite.code.words
    first = next(place for place, word in enumerate(words) if word.startswith("-"))
    own = subprocess.run(
        [*words[:first], "-print-file-name=include"], check=True, capture_output=True, text=True
    ).stdout.strip()
    options = ["-isystem", own]
    for word, following in zip(words, words[1:] + [""]):
        if word in ("-isystem", "-isysroot", "-I"):
            options += [word, following]
        elif re.match(r"-I.|-D|-std", word):
            options.append(word)
    return options


class Stage:
    """A stage's mutants, and the program that contains them all."""

    def __init__(self, number):
        self.number = number
        self.suite = catalogue.Suite(number)
        self.header = self.suite.header
        self.source = self.header.read_bytes()
        self.key = self.suite.key(self.source.decode())
        self.folder = FOLDER / f"stage{number}"
        self.folder.mkdir(parents=True, exist_ok=True)
        found, self.functions = edits.all_mutants(self.header, include_options(self.suite))
        self.mutants = dict(enumerate(found, 1))
        self.names = self.name_all()
        self.saved = self.folder / "outcomes.json"
        self.outcomes = {}
        self.lock = threading.Lock()
        self.kind_of = {}  # of tests, by their names
        self.phases = []  # (doctest's options, seconds allowed) of each run
        if self.saved.exists():
            self.outcomes = {name: Outcome(**one) for name, one in json.loads(self.saved.read_text()).items()}

    def name_all(self):
        """A name for each mutant that does not depend on the lines above it."""
        counts, names = {}, {}
        for number, one in self.mutants.items():
            name = f"{one.function}: {one.before} -> {one.after}"
            counts[name] = counts.get(name, 0) + 1
            names[number] = name if counts[name] == 1 else f"{name} #{counts[name]}"
        return names

    def outcome(self, number):
        return self.outcomes.get(self.names[number])

    def keep(self, number, outcome):
        with self.lock:
            self.outcomes[self.names[number]] = outcome

    def save(self):
        with self.lock:
            rows = {
                name: dataclasses.asdict(self.outcomes[name])
                for name in self.names.values()
                if name in self.outcomes
            }
        whole = self.saved.with_suffix(".new")
        whole.write_text(json.dumps(rows, indent=1))
        whole.replace(self.saved)

    # The program.

    def program(self):
        """Builds the suite with all mutants that compile. Returns its path."""
        program, stamp = self.folder / self.suite.target, self.folder / "program.json"
        made_of = [self.key, list(self.names.values())]
        if program.exists() and stamp.exists():
            *made, bad = json.loads(stamp.read_text())
            if made == made_of:
                for number in bad:
                    self.keep(number, Outcome(self.key, "does not compile"))
                return program
        overlay = self.folder / self.header.relative_to(ROOT)
        overlay.parent.mkdir(parents=True, exist_ok=True)
        bad = {n for n in self.mutants if self.outcome(n) and self.outcome(n).state == "does not compile"}
        while True:
            chosen = {number: one for number, one in self.mutants.items() if number not in bad}
            text = schema.with_choices(self.source, chosen, self.functions)
            overlay.write_text(text)
            command = self.suite.code.words_for(self.suite.split(self.folder), self.folder / "code.o")
            more = self.compile_errors(command, overlay, text)
            if not more:
                break
            bad |= more
        for number in bad:
            self.keep(number, Outcome(self.key, "does not compile"))
        self.suite.build(self.folder)
        stamp.write_text(json.dumps([*made_of, sorted(bad)]))
        return program

    @staticmethod
    def compile_errors(command, overlay, text):
        """The mutants that the compiler complains about."""
        done = subprocess.run([*command, "-fsyntax-only"], capture_output=True, text=True)
        if done.returncode == 0:
            return set()
        errors = re.findall(r"^(.*?):(\d+):\d+: (?:fatal )?error: (.*)", done.stderr, re.MULTILINE)
        bad = set()
        for path, line, _ in errors:
            if Path(path) == overlay:
                bad.update(schema.numbers_on(text, int(line)))
        if not bad:
            raise Failure(f"no mutant is to blame: {errors[0] if errors else done.stderr[:300]}")
        return bad

    # Its runs.

    def run(self, program, number, options=(), seconds=None):
        environment = {"LIGHTWALK_MUTANT": str(number)}
        return catalogue.run_program(program, *options, seconds=seconds, environment=environment)

    def check_unchanged(self, program):
        outcome = self.run(program, 0, ["--duration=true"])
        if not outcome.passed:
            failed = "; ".join(outcome.caught_by)
            raise Failure(f"stage {self.number} fails without a change: {outcome.end} {failed}")
        self.kind_of = {test.name: test.suite for test in outcome.tests}
        durations = [(test.seconds, test.name) for test in outcome.tests]
        whole = sum(seconds for seconds, _ in durations)
        phases, spent = [[] for _ in SHARES], 0.0
        for seconds, name in sorted(durations):
            spent += seconds
            place = next(i for i, share in enumerate(SHARES) if spent <= share * whole or share == 1)
            phases[place].append(filter_text(name))
        for names in filter(None, phases):
            options = [f"--test-case={','.join(names)}"]
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            self.run(program, 0, options)
            seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            self.phases.append((options, math.ceil(AT_LEAST + TIMES_AS_LONG * seconds)))

    def judge(self, program, number):
        known = self.outcome(number)
        if known and known.key == self.key:
            return known
        runs = list(self.phases)
        if known and known.state == "killed" and known.test:
            name = filter_text(known.test)
            limits = [seconds for options, seconds in self.phases if name in options[0]]
            runs.insert(0, ([f"--test-case={name}"], limits[0] if limits else self.phases[-1][1]))
        for options, seconds in runs:
            outcome = self.result(self.run(program, number, ["--abort-after=1", *options], seconds))
            if outcome.state == "killed":
                break
        self.keep(number, outcome)
        return outcome

    def result(self, outcome):
        if not outcome.caught_by and not outcome.end:
            return Outcome(self.key, "alive")
        test = outcome.caught_by[0] if outcome.caught_by else ""
        kind = {"time limit": "time"}.get(outcome.end, outcome.end) or self.kind_of.get(test) or "units"
        return Outcome(self.key, "killed", kind, test)


def filter_text(name):
    """A test's name as a filter, in which a comma would separate names."""
    return re.sub(r"[,\\]", "*", name)


def run_stage(stage, jobs):
    """Runs all mutants of a stage; prints each that is alive at once."""
    program = stage.program()
    stage.check_unchanged(program)
    todo = [
        number
        for number in stage.mutants
        if not (stage.outcome(number) and stage.outcome(number).key == stage.key)
    ]
    print(f"stage {stage.number}: {len(stage.mutants)} mutants, {len(todo)} to run", flush=True)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for count, outcome in enumerate(pool.map(lambda number: stage.judge(program, number), todo), 1):
            if outcome.state == "alive":
                print(f"  alive: {stage.names[todo[count - 1]]}", flush=True)
            if count % 25 == 0:
                print(f"  {count} of {len(todo)}", flush=True)
                stage.save()
    stage.save()


def report(stage):
    """A line with the number of mutants of each outcome, and each that is alive."""
    counts, alive = collections.Counter(), []
    for number, mutant in stage.mutants.items():
        outcome = stage.outcome(number)
        counts[f"killed by {outcome.kind}" if outcome.state == "killed" else outcome.state] += 1
        if outcome.state == "alive":
            line = stage.source[: mutant.edits[0][0]].count(b"\n") + 1
            alive.append((line, mutant))
    words = ", ".join(f"{count} {word}" for word, count in counts.most_common())
    text = f"stage {stage.number}: {len(stage.mutants)} mutants: {words}\n"
    name = stage.header.relative_to(ROOT)
    for line, mutant in alive:
        text += (
            f"\n{name}:{line}: {mutant.function}: {mutant.what}\n    {mutant.before}\n    {mutant.after}\n"
        )
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--stage", type=int, action="append", help="only this stage's; may be given again")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    numbers = options.stage or [int(path.parent.name[0]) for path in stage_headers()]
    reports = []
    try:
        for number in numbers:
            stage = Stage(number)
            run_stage(stage, options.jobs)
            reports.append(report(stage))
    except (Failure, OSError, subprocess.CalledProcessError) as failure:
        sys.exit(f"mutants: {failure}")
    FOLDER.joinpath("alive.txt").write_text("\n".join(reports))
    print("\n".join(["", *reports]))
    print(f"This list is {FOLDER / 'alive.txt'}")


if __name__ == "__main__":
    main()
