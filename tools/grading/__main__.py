"""Grades the submissions of a class: `make class`.

    python3 -m tools.grading FROM STAGE [OPTION]...

Each header, folder, .zip and git .bundle in FROM is a submission. The page of the
class, its tables and all results go to the folder OUT. What has not changed is not
judged again, and a grader that was killed goes on where it was. Exit code 0 if all
submissions are judged, whatever their points.
"""

import argparse
import concurrent.futures
import difflib
import hashlib
import json
import multiprocessing
import os
import shlex
import signal
import sys
from pathlib import Path

from tests.runner import process
from tools.exercises.check import Parser, header_of
from tools.exercises.marks import exercises
from tools.grading import page, slurm, tables
from tools.grading.grade import grade, note_read
from tools.grading.submissions import Refused, submissions
from tools.grading.workshop import Workshop
from tools.handout.opened import INCLUDE, opened
from tools.tree import BUILD, Failure


def arguments():
    parser = Parser(prog="class", description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument("folder", type=Path, metavar="FROM", help="the submissions")
    parser.add_argument("stage", metavar="STAGE")
    parser.add_argument("--out", type=Path, help="for the page and the tables (build/class/stageN)")
    parser.add_argument("--roster", type=Path, help="a table of the students (.csv)")
    parser.add_argument("--hidden", type=Path, help="a folder of scenes that are rendered, too")
    parser.add_argument("--hide-names", action="store_true", help="another page has numbers, not names")
    parser.add_argument("--only", metavar="NAME", help="judge this submission, again, and explain")
    parser.add_argument("--read", action="store_true", help="its header has been read: judge it")
    parser.add_argument("--engine", choices=("here", "slurm"), default="here", help="where to judge (here)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="at the same time")
    parser.add_argument("--share", help=argparse.SUPPRESS)  # K/N: of a cluster's job
    options = parser.parse_args()
    options.stage = int(options.stage) if options.stage.isdecimal() else repr(options.stage)
    if options.read and options.only is None:
        parser.error("READ=1 needs ONLY: which header was read?")
    return options


class Class:
    """The submissions of a stage, and where their results are."""

    def __init__(self, options):
        header_of(options.stage)  # or says which stages have exercises
        self.stage = options.stage
        self.folder = (options.out or BUILD / "class" / f"stage{options.stage}").absolute()
        given = submissions(options.folder, options.roster)
        self.given, self.submissions = given, given.submissions
        self.names_hidden = options.hide_names
        self.options = options
        self.results = {}

    def place(self, one):
        """The folder of a submission; its name may be anything."""
        return self.folder / "students" / hashlib.sha256(one.name.encode("utf-8", "replace")).hexdigest()[:16]

    def called(self, name):
        """The submission of this name, or of the student's."""
        for one in self.submissions:
            if name in (one.name, one.student):
                return one
        names = [name for one in self.submissions for name in (one.name, one.student) if name]
        near = difflib.get_close_matches(name, names, 1, 0.5)
        raise Failure(f"ONLY={name}: no submission has this name" + f"; {near[0]} has" * bool(near))

    def repeat(self, one):
        """The command that judges it again."""
        options = self.options
        words = ["make", "class", f"FROM={options.folder}", f"STAGE={self.stage}"]
        for name in ("roster", "hidden", "out"):
            if value := getattr(options, name):
                words.append(f"{name.upper()}={value}")
        words += [
            f"ONLY={one.name}",
            *(["READ=1"] if self.results[one.name]["state"] == "to be read" else []),
        ]
        return shlex.join(words)

    def take_kept(self):
        """Results of an earlier run, where this one has none; returns whether all are there."""
        for one in self.submissions:
            kept = self.place(one) / "result.json"
            if one.name not in self.results and kept.exists():
                self.results[one.name] = json.loads(kept.read_text(encoding="utf-8")) | {"kept": True}
        return len(self.results) == len(self.submissions)


workshop = None  # of a worker


def start_worker():
    process.in_the_suite()  # no core files; ends with the grader
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def judge_one(one, place):
    return grade(one, workshop, place)


def judge_all(whole, chosen, jobs):
    """Judges in several processes; results come as they are done."""
    fork = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(max(1, jobs), fork, start_worker) as pool:
        waiting = {pool.submit(judge_one, one, whole.place(one)): one for one in chosen}
        for count, done in enumerate(concurrent.futures.as_completed(waiting), 1):
            one, result = waiting[done], done.result()
            whole.results[one.name] = result
            words = f"{result['points']} of {result['out_of']}, {page.in_short(result)}"
            words += " (as before)" if result.get("kept") else ""
            print(f"{count:4}/{len(chosen)}  {page.plain(one.name)}: {words}", flush=True)


class Reference:
    """Our own solution as a student would hand it in."""

    path = name = "reference"

    @staticmethod
    def header(stage):
        every = {one.number for one in exercises(header_of(stage))}
        return opened(header_of(stage), every).replace("#include", f"{INCLUDE}\n#include", 1).encode()


def check_the_grader():
    """No student pays for what is wrong here: our own solution has all points."""
    result = grade(Reference, workshop, workshop.folder / "reference")
    if result["points"] < result["out_of"]:
        raise Failure(
            f"our own solution does not get all points, so nobody is judged: {page.message_of(result)}"
        )


def explain(whole, one):
    """All that is known of one submission."""
    result, place = whole.results[one.name], whole.place(one)
    for row in result["exercises"]:
        print(f"  {row['number']:5}{row['title']:44}{row['state']}")
    print()
    for row in (*result["exercises"], result["whole_stage"] or {}):
        if row.get("message"):
            print(f"{row['number']} {row['title']}\n{row['message']}\n")
    print(*[result["error"], *result["notes"]], sep="\n")
    if result["state"] == "to be read":
        print(f"When you have read it: {whole.repeat(one)}")
    if result["header"]:
        print(f"The header that was judged is {place / whole.header}")


def main():
    global workshop
    options = arguments()
    whole = Class(options)
    chosen = whole.submissions
    if options.only is not None:
        chosen = [whole.called(options.only)]
        (whole.place(chosen[0]) / "result.json").unlink(missing_ok=True)
    print("\n".join([*whole.given.remarks(), "The tests and the reference are built ..."]), flush=True)
    workshop = Workshop(options.stage, options.hidden)
    whole.header = workshop.suite.name
    check_the_grader()
    if options.read:
        note_read(whole.place(chosen[0]), chosen[0].header(options.stage))
    if options.engine == "slurm":
        return slurm.submit(whole, options)
    if options.share:
        number, of = map(int, options.share.split("/"))
        chosen = chosen[number::of]
    judge_all(whole, chosen, options.jobs)
    if options.share:
        return 0
    if options.only is not None:
        explain(whole, chosen[0])
        if not whole.take_kept():
            return 0
    tables.write(whole)
    index = page.write(whole, workshop)
    if options.only is None:
        print("\n".join(page.summary(whole)))
    print(f"\nThe page of the class is {index}")
    return 0


if __name__ == "__main__":
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")
    try:
        sys.exit(main())
    except (Failure, Refused) as error:
        sys.exit(f"class: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
