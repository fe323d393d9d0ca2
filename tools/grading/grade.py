"""Judges one submission: compiles it, asks the tests, and looks at its pictures.

All of the student's code runs in the sandbox, and what judges it runs outside. It
believes that a test has passed if the line that says so has the grader's secret
(seal.cpp), and if just the tests have run that the reference runs. Pictures are
rendered by the student's program and compared out here.
"""

import dataclasses
import functools
import hashlib
import json
import os
import secrets
import shutil
import subprocess
import textwrap

from tests.runner import report, suite
from tools.exercises import compiler, screen
from tools.exercises.judge import Judged, Verdict, as_dictionary, judge, last_in_the_loop
from tools.exercises.marks import OPENS, exercises, marks, order
from tools.grading import sandbox
from tools.grading.pictures import picture_files
from tools.grading.submissions import Refused
from tools.grading.workshop import SAMPLES
from tools.tree import BUILD, SCENES, Failure, program_path, write_whole

COMPILING = sandbox.Limits(seconds=60, memory=2048 * sandbox.MB)
RUNNING = sandbox.Limits(seconds=300, memory=2048 * sandbox.MB)
# A picture takes a right program a second.
RENDERING = sandbox.Limits(seconds=30, memory=2048 * sandbox.MB)
MOST_SAID = 4000
KINDS = [kind for kind in report.KINDS if kind != "golden images"]
STOPPED = {
    "busy": "does not end: it was stopped after {0.seconds} seconds of processor time",
    "idle": "does not end, and waits: it was stopped",
    "memory": "takes more than {0.memory} bytes of memory: it was stopped",
    "much": "writes more than it may: it was stopped",
}


def grade(submission, workshop, folder):
    """The result as a dictionary, from the folder's result.json where nothing has
    changed ("kept"); else it is written there, whole."""
    kept = folder / "result.json"
    try:
        header, refused = submission.header(workshop.stage) if submission.path else b"", ""
    except Refused as error:
        header, refused = b"", str(error)
    was_read = has_read(folder, header)
    key = hashlib.sha256(header + refused.encode() + workshop.key.encode() + bytes([was_read])).hexdigest()
    if kept.exists():
        result = json.loads(kept.read_text(encoding="utf-8"))
        if result["key"] == key:
            return result | {"kept": True}
    folder.mkdir(parents=True, exist_ok=True)
    before = sum(os.times()[:4]) + sandbox.clock.seconds
    if not submission.path:
        result = {"state": "nothing handed in"}
    elif refused:
        result = {"state": "refused", "error": refused}
    else:
        result = judged(header, workshop, folder, was_read)
    result = empty(workshop) | result
    result |= {"key": key, "header": hashlib.sha256(header).hexdigest() if header else ""}
    result["seconds"] = round(sum(os.times()[:4]) + sandbox.clock.seconds - before, 2)
    write_whole(kept, json.dumps(result, indent=1))
    return result


def note_read(folder, header):
    """From now on this header is judged, whatever the screen says."""
    folder.mkdir(parents=True, exist_ok=True)
    write_whole(folder / "read", hashlib.sha256(header).hexdigest())


def has_read(folder, header):
    note = folder / "read"
    return note.exists() and note.read_text(encoding="utf-8") == hashlib.sha256(header).hexdigest()


def empty(workshop):
    """What every result has: no exercise is done."""
    tasks = workshop.tasks.items()
    rows = [Judged(number, title, "", task, "not judged") for number, (title, task) in tasks]
    whole = as_dictionary(workshop.stage, "", Verdict(rows))
    return {"state": "judged", "error": "", "pictures": [], "code": "", **whole}


def put(header, workshop, folder):
    """Writes a header where it is compiled; returns its path."""
    place = folder / workshop.suite.name
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_bytes(header)
    place.with_name("exercises.toml").write_bytes(workshop.header.with_name("exercises.toml").read_bytes())
    return place


def judged(header, workshop, folder, was_read):
    """Of a submission that has a header."""
    place = put(header, workshop, folder)
    text = header.removeprefix(b"\xef\xbb\xbf").decode("utf-8", errors="replace")
    stages = {match[1] for match in map(OPENS.match, map(str.strip, text.splitlines())) if match}
    if len(stages) == 1 and int(*stages) != workshop.stage:
        return {"state": "refused", "error": f"it is the header of stage {int(*stages)}"}
    remark = screen.remark(text)
    if remark and not was_read:
        return {"state": "to be read", "error": remark}
    try:
        marks(place)
    except Failure as error:
        return {"state": "refused", "error": f"its marks of exercises are broken: {error}"}
    if broken := build(workshop, folder):
        return broken
    verdict, dead = verdict_on(place, workshop, folder)
    pictures = []
    if not dead and all(one.state != "open" for one in verdict.exercises):
        for one in workshop.pictures:
            pictures.append(look(one, workshop, folder))
            if "size" not in pictures[-1]:  # it does not end, or crashes
                break
    if not dead:
        judge_what_waits(header, workshop, folder, verdict)
    wrong = next((one for one in pictures if one["wrong"]), None)
    if wrong and verdict.passed:
        late = last_in_the_loop(place, verdict.exercises)
        says = f"{wrong['name']}: {wrong['says']}"
        verdict.late = dataclasses.replace(
            late, state="wrong", test=f"the picture of {wrong['name']}", says=says
        )
    for path in ("tests", "render", "code.cpp"):
        (folder / path).unlink(missing_ok=True)
    shutil.rmtree(folder / "with_ours", ignore_errors=True)
    code = code_of(place, verdict.first)
    return as_dictionary(workshop.stage, "", verdict) | {"pictures": pictures, "code": code}


def verdict_on(place, workshop, folder):
    """Of a header that is built; and the run that ended before its first test, if one did:
    so would all others."""
    dead = []
    run = functools.partial(run_suite, folder / "tests", functools.partial(sealed_run, workshop, dead))
    return judge(workshop.stage, place, run), dead


def judge_what_waits(header, workshop, folder, verdict):
    """So that a mistake costs once: what builds on an exercise that is not done is judged
    with our solution of that."""
    rows, ours, folder = verdict.exercises, [], folder / "with_ours"
    while any(one.state == "waits" for one in rows):
        more = [one.number for one in rows if one.state in ("wrong", "open") and one.number not in ours]
        place = put(header, workshop, folder)
        put(with_ours(header, workshop, ours + more, place), workshop, folder)
        if not more or build(workshop, folder):
            break
        ours = sorted(ours + more, key=order)
        again, _ = verdict_on(place, workshop, folder)
        for at, one in enumerate(rows):
            if one.state == "waits":
                rows[at] = again.exercises[at]
        verdict.late = again.late
    if ours:
        verdict.notes.append(f"What builds on {', '.join(ours)} was judged with our solution of that.")


def with_ours(header, workshop, numbers, place):
    """The header's bytes with our solution of these exercises."""
    solutions = {one.number: one.body for one in exercises(workshop.header)}
    lines = header.decode("utf-8", errors="surrogateescape").splitlines()
    for one in reversed(marks(place)):
        if one.number in numbers:
            lines[one.first - 1 : one.last] = solutions[one.number]
    return "\n".join([*lines, ""]).encode("utf-8", errors="surrogateescape")


def code_of(place, one):
    """What the student wrote for an exercise that is wrong."""
    found = next((mark for mark in marks(place) if one and mark.number == one.number), None)
    return textwrap.dedent("\n".join(found.body)) if found and one.state == "wrong" else ""


def run_suite(program, run, stage, *options):
    return suite.run_by_kinds(program, *options, first_only=True, kinds=KINDS, run=run)


def stopped_words(done, limits):
    return STOPPED[done.stopped].format(limits) if done.stopped else f"ended with code {done.code}"


def build(workshop, folder):
    """Compiles and links; returns what went wrong, or nothing."""
    source, fits = workshop.split(folder)
    code, tests, program = "/tmp/code.o", "/tmp/tests", "/tmp/render"
    commands = [workshop.compiling(source, code)]
    reads = [*workshop.compiler_reads(), (folder / workshop.suite.name, workshop.header), source]
    suite, main = None, workshop.folder / "main.o"
    if not fits:
        suite, main = "/tmp/suite.o", "/tmp/main.o"
        commands += workshop.compiling_anew(folder / "declared", suite, main)
        reads += [folder / "declared", *workshop.test_reads()]
    linking = [workshop.linking_tests(code, suite, tests), workshop.linking_program(code, main, program)]
    reads += [path for words in linking for path in workshop.read_by(words)]
    commands += linking
    done = sandbox.run(commands, reads, [tests, program], COMPILING, workshop.suite.folder)
    if done.stopped:
        return {"state": "does not compile", "error": f"compiling {stopped_words(done, COMPILING)}"}
    if done.code:
        error = compiler.first_error(done.printed.replace(f"{folder}/", ""))
        if not error.startswith("stages/") and "error" in error:
            error = f"The tests do not compile with this header: has a name or a type changed?\n{error}"
        return {"state": "does not compile", "error": error[:MOST_SAID]}
    for path, data in zip((folder / "tests", folder / "render"), done.files):
        path.write_bytes(data)
        path.chmod(0o755)
    return None


def sealed_run(workshop, dead, program, *options, **others):
    """Runs the suite in the sandbox. A run that passes has the seal on each of its
    tests, which are those of the reference."""
    if dead:
        return dead[0]
    expected = sorted(workshop.tests_of(options))
    if not expected:
        return suite.Outcome(str(program))
    secret = secrets.token_hex(16).encode()
    reading, writing = os.pipe()
    os.write(writing, secret)
    os.close(writing)
    lines = sandbox.Taken(sandbox.MB)
    reads = [SCENES, program, *workshop.libraries()]

    def within(writing, time):
        seal = {"LIGHTWALK_SEAL": f"{reading},{writing}", "LD_LIBRARY_PATH": str(BUILD)}
        return sandbox.sandbox(reads, RUNNING, time, environment=seal)

    sandbox.clock.began = False
    try:
        outcome = suite.run(
            program,
            *options,
            within=within,
            feeds=[lines.feed, sandbox.clock.feed],
            pass_fds=[reading],
            watcher=lambda *of_run: sandbox.Guard(*of_run, RUNNING.memory),
            owner=sandbox.OWNER,
            **others,
        )
    finally:
        os.close(reading)
    if outcome.end != "time limit":
        sandbox.begun(outcome.printed)
    if outcome.why and not outcome.tests:
        dead.append(outcome)
    if outcome.passed or not (outcome.tests or outcome.why):
        ran = sorted(test.name for test in outcome.tests)
        if not sealed(lines.data, secret) == ran == expected:
            outcome.end = "crash"
            outcome.why = (
                "The program says that its tests have passed, but the tests have not said so. "
                "Something in it writes reports, or ends it."
            )
    return outcome


def sealed(data, secret):
    """The names of the tests that have passed, sorted, or None where the run has not said
    that it is at its end: the secret alone."""
    lines = [line.removeprefix(secret) for line in data.splitlines() if line.startswith(secret)]
    return sorted(line[1:].decode(errors="replace") for line in lines if line) if b"" in lines else None


def look(picture, workshop, folder):
    """Renders a picture by the student's program, and compares it. Right pictures differ
    by chance once in thousands: so a difference counts if another render has it, too."""
    result = {"name": picture.name, "wrong": True, "says": ""}
    for attempt in (1, 2):
        seed = int(hashlib.sha256(f"{picture.reference.name} {attempt}".encode()).hexdigest()[:12], 16)
        scene = f"/scenes/{picture.scene.name}"
        command = [folder / "render", scene, "-o", "/tmp/picture.pfm", *picture.options]
        command += ["--spp", SAMPLES, "--seed", seed, "--threads", 2]
        done = sandbox.run(
            [command],
            [(picture.scene.parent, "/scenes"), folder / "render", *workshop.libraries()],
            ["/tmp/picture.pfm"],
            RENDERING,
        )
        if done.code or done.stopped:
            said = " ".join(done.printed.split())[-300:]
            return result | {"says": f"the program {stopped_words(done, RENDERING)} {said}".strip()}
        mine = folder / "mine.pfm"
        mine.write_bytes(done.files[0])
        compared = subprocess.run(
            [program_path("stage-diff"), mine, picture.reference, "--other-seeds"],
            capture_output=True,
            text=True,
            errors="replace",
        )
        said = next(iter((compared.stdout or compared.stderr).splitlines()), "")
        said = said.replace(": A is ", ": it is ").replace(f"{mine}: ", "")
        result |= {"says": said, "wrong": compared.returncode != 0}
        if compared.returncode != 1:
            break
    if compared.returncode not in (0, 1):  # a file that is not to be read
        return result
    shown = picture_files(mine, picture.reference, SAMPLES, folder / picture.name)
    mine.unlink()
    return result | shown
