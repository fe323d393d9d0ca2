"""Makes a handout for students: `make handout`.

    python3 -m tools.handout.handout STAGE --out FOLDER [--solutions none]
    python3 -m tools.handout.handout STAGE --into FOLDER

--out makes a new folder: the earlier stages with their solutions (or without),
this stage with its exercises open, nothing of later stages, and a git history
of one commit. --into adds the stage to a folder that a student works in: it
adds new files, updates files of an earlier handout that the student has not
changed, and keeps everything that the student has written.
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tools.handout.contents import contents
from tools.handout.third_party import copy_libraries
from tools.tree import ROOT, Failure

NOTE = "handout.json"


def git(folder, *arguments):
    done = subprocess.run(["git", "-C", folder, *arguments], capture_output=True, text=True)
    if done.returncode:
        raise Failure(f"git {arguments[0]}: {done.stderr.strip()}")
    return done.stdout


def sum_of(data):
    return hashlib.sha256(data).hexdigest()


def all_files(stage, solutions):
    """The tree's files and the libraries': {path: bytes}."""
    tracked = git(ROOT, "ls-files").splitlines()
    files = contents(stage, tracked, solutions)
    with tempfile.TemporaryDirectory() as folder:
        copy_libraries(Path(folder))
        for path in sorted(Path(folder).rglob("*")):
            if path.is_file():
                files["third_party/" + path.relative_to(folder).as_posix()] = path.read_bytes()
    return files


def write(folder, path, data):
    target = folder / path
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(data)
    if path in ("compare/diff.sh",):
        target.chmod(0o755)


def note(stage, files):
    """The handout's record of its files, from which the next one knows which of
    them a student has changed."""
    sums = {path: sum_of(data) for path, data in files.items()}
    return json.dumps({"stage": stage, "files": sums}, indent=1) + "\n"


def tell_missing_page(stage, files):
    if not any(re.match(rf"stages/{stage}_\w+/chapter/", path) for path in files):
        print(
            "  without the chapter as a page with its figures: "
            "run `make book` first, then handouts include it"
        )


def make_new(stage, solutions, folder):
    """Writes beside the folder first, so that the folder is complete or missing."""
    if folder.exists() and any(folder.iterdir()):
        raise Failure(f"{folder} is not empty; --into adds to a student's folder")
    files = all_files(stage, solutions)
    folder.parent.mkdir(parents=True, exist_ok=True)
    making = Path(tempfile.mkdtemp(prefix=".handout-", dir=folder.parent))
    try:
        for path, data in files.items():
            write(making, path, data)
        (making / NOTE).write_text(note(stage, files))
        making.chmod(0o755)
        git(making, "init", "--quiet", "--initial-branch=main")
        git(making, "add", "--all")
        name = ["-c", "user.name=Lightwalk", "-c", "user.email=lightwalk@localhost"]
        git(making, *name, "commit", "--quiet", "--message", f"Handout of stage {stage}")
        if folder.exists():
            folder.rmdir()
        os.replace(making, folder)
    except BaseException:
        shutil.rmtree(making, ignore_errors=True)
        raise
    size = sum(map(len, files.values()))
    print(f"{folder}: stage {stage}, {len(files)} files, {size / 1e6:.1f} MB")
    tell_missing_page(stage, files)


def add_to(stage, folder):
    """Adds the stage to a student's folder."""
    known = folder / NOTE
    if not known.exists():
        raise Failure(f"{folder} is no handout: there is no {NOTE} in it")
    before = json.loads(known.read_text())
    if before["stage"] >= stage:
        raise Failure(f"{folder} has stage {before['stage']} already, and this is stage {stage}")
    files, kept, news = all_files(stage, "previous"), [], 0
    for path, data in files.items():
        target = folder / path
        # Earlier stages are the student's, open or not, from the first day.
        theirs = path.startswith("stages/") and not path.startswith(f"stages/{stage}_") and target.exists()
        mine = target.exists() and sum_of(target.read_bytes())
        if theirs or mine == sum_of(data):
            continue
        if mine and mine != before["files"].get(path):
            kept.append(path)
            continue
        write(folder, path, data)
        news += 1
    for path in before["files"].keys() - files.keys():
        target = folder / path
        if target.exists() and sum_of(target.read_bytes()) == before["files"][path]:
            target.unlink()
    known.write_text(note(stage, files))
    print(f"{folder}: stage {stage} is in, {news} files new or newer. `git add -A && git commit` keeps them.")
    for path in kept:
        print(f"  {path} was changed there, and is as it was")
    tell_missing_page(stage, files)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("stage")
    parser.add_argument("--out", type=Path, help="a folder that is not there yet, or empty")
    parser.add_argument("--into", type=Path, help="a folder that a student works in")
    parser.add_argument("--solutions", choices=["previous", "none"], default="previous")
    options = parser.parse_args()
    if not re.fullmatch("[1-9]", options.stage):
        raise Failure(f"the stage is {options.stage!r}, and a number is expected: STAGE=3")
    if (options.out is None) == (options.into is None):
        raise Failure("either --out (OUT=folder) or --into (INTO=folder) says where")
    stage = int(options.stage)
    if options.into:
        return add_to(stage, options.into.absolute())
    return make_new(stage, options.solutions, options.out.absolute())


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (Failure, OSError) as error:
        sys.exit(f"handout: {error}")
