"""Grades the submissions of a class: `make class`.

    python3 -m tools.grading FROM STAGE [OPTION]...

Each header, folder, .zip and git .bundle in FROM is a submission. The page of the
class, its tables and all results go to the folder OUT. What has not changed is not
judged again, and a grader that was killed goes on where it was. Exit code 0 if all
submissions are judged, whatever their points.
"""

import argparse
import concurrent.futures
import hashlib
import multiprocessing
import os
import shlex
import signal
import sys
from pathlib import Path

from tests.runner import process
from tools.exercises.check import header_of
from tools.grading import page, slurm, tables
from tools.grading.grade import grade
from tools.grading.submissions import submissions
from tools.grading.workshop import Workshop
from tools.tree import BUILD, Failure


def arguments():
    parser = argparse.ArgumentParser(
        prog="python3 -m tools.grading", description=__doc__.splitlines()[0], allow_abbrev=False
    )
    parser.add_argument("folder", type=Path, metavar="FROM", help="the submissions")
    parser.add_argument("stage", type=int, metavar="STAGE")
    parser.add_argument("--out", type=Path, help="for the page and the tables (build/class/stageN)")
    parser.add_argument("--roster", type=Path, help="a table of the students (.csv)")
    parser.add_argument("--hidden", type=Path, help="a folder of scenes that are rendered, too")
    parser.add_argument("--hide-names", action="store_true", help="the page has numbers instead of names")
    parser.add_argument("--only", metavar="NAME", help="judge this submission, again, and explain")
    parser.add_argument("--engine", choices=("here", "slurm"), default="here", help="where to judge (here)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="at the same time")
    parser.add_argument("--share", help=argparse.SUPPRESS)  # K/N: of a cluster's job
    return parser.parse_args()


class Class:
    """The submissions of a stage, and where their results are."""

    def __init__(self, options):
        header_of(options.stage)  # or says which stages have exercises
        self.stage = options.stage
        self.folder = (options.out or BUILD / "class" / f"stage{options.stage}").absolute()
        self.submissions = submissions(options.folder, options.roster)
        self.names_hidden = options.hide_names
        self.source = options.folder
        self.results = {}

    def place(self, one):
        """The folder of a submission; its name may be anything."""
        return self.folder / "students" / hashlib.sha256(one.name.encode("utf-8", "replace")).hexdigest()[:16]

    def repeat(self, one):
        """The command that judges it again."""
        words = ["make", "class", f"FROM={self.source}", f"STAGE={self.stage}", f"ONLY={one.name}"]
        return shlex.join(words)


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
            print(f"{count:4}/{len(chosen)}  {page.plain(one.name)}: {words}", flush=True)


def explain(whole, one):
    """All that is known of one submission."""
    result = whole.results[one.name]
    for row in result["exercises"]:
        print(f"  {row['number']:5}{row['title']:44}{row['state']}")
    for row in (*result["exercises"], result["whole_stage"] or {}):
        if row.get("message"):
            print(f"\n{row['number']} {row['title']}\n{row['message']}")
    print(f"\nThe header that was judged is in {whole.place(one)}")


def main():
    global workshop
    options = arguments()
    whole = Class(options)
    chosen = whole.submissions
    if options.only is not None:
        chosen = [one for one in chosen if one.name == options.only]
        if not chosen:
            raise Failure(f"ONLY={options.only}: no submission has this name")
        (whole.place(chosen[0]) / "result.json").unlink(missing_ok=True)
    workshop = Workshop(options.stage, options.hidden)
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
        return 0
    tables.write(whole)
    page.write(whole, workshop)
    print("\n".join(page.summary(whole)))
    print(f"\nThe page of the class is {whole.folder / 'index.html'}")
    return 0


if __name__ == "__main__":
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")
    try:
        sys.exit(main())
    except Failure as error:
        sys.exit(f"class: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
