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
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from tools.handout.contents import contents
from tools.handout.repository import commit_all, tracked_files
from tools.handout.student_tree import StudentTree, mode_of, note, sums_of
from tools.handout.third_party import copy_libraries
from tools.tree import HANDOUT_NOTE, Failure


def all_files(stage, solutions):
    """The tree's files and the libraries': {path: bytes}."""
    files = contents(stage, tracked_files(), solutions)
    with tempfile.TemporaryDirectory() as folder:
        copy_libraries(Path(folder))
        for path in sorted(Path(folder).rglob("*")):
            if path.is_file():
                files["third_party/" + path.relative_to(folder).as_posix()] = path.read_bytes()
    return files


def tell_missing_page(stage, files):
    if not any(re.match(rf"stages/{stage}_\w+/chapter.html", path) for path in files):
        print(
            "  without the chapter as a page with its figures: "
            "run `make book` first, then handouts include it"
        )


def make_new(stage, solutions, folder):
    """Writes beside the folder first, so that the folder is complete or missing."""
    if folder.exists() and any(folder.iterdir()):
        raise Failure(f"{folder} is not empty; --into adds to a student's folder")
    files = all_files(stage, solutions)
    size = sum(map(len, files.values()))
    folder.parent.mkdir(parents=True, exist_ok=True)
    making = Path(tempfile.mkdtemp(prefix=".handout-", dir=folder.parent))
    try:
        for path, data in {**files, HANDOUT_NOTE: note(stage, sums_of(files))}.items():
            target = making / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(data)
            target.chmod(mode_of(path))
        making.chmod(0o755)
        commit_all(making, [*files, HANDOUT_NOTE], f"Handout of stage {stage}")
        if folder.exists():
            folder.rmdir()
        os.replace(making, folder)
    except BaseException:
        shutil.rmtree(making, ignore_errors=True)
        raise
    print(f"{folder}: stage {stage}, {len(files)} files, {size / 1e6:.1f} MB")
    tell_missing_page(stage, files)


def add_to(stage, folder):
    """Adds the stage to a student's folder. Where it is broken off, the same
    command goes on."""
    tree = StudentTree(folder)
    if tree.stage >= stage:
        raise Failure(f"{folder} has stage {tree.stage} already, and this is stage {stage}")
    # Chapters that were handed out are the student's, open or not.
    theirs = re.compile(rf"stages/[1-{tree.stage}]_")
    brought = all_files(stage, "previous")
    files = {path: data for path, data in brought.items() if not theirs.match(path)}
    states = {path: tree.state_of(path, data) for path, data in files.items()}
    in_the_way = [
        said for path in [*files, HANDOUT_NOTE] if (said := tree.what_is_at(path)) not in ("", "file")
    ]
    in_the_way += [
        f"{path} is there already and was not handed out: move it away"
        for path, state in states.items()
        if state == "changed" and path.startswith(f"stages/{stage}_") and path not in tree.sums
    ]
    if in_the_way:
        raise Failure(f"{folder}: {in_the_way[0]}; nothing has been changed")
    written = [path for path, state in states.items() if state in ("new", "old")]
    path, sums = HANDOUT_NOTE, sums_of(files)
    try:
        tree.write(path, note(tree.stage, tree.sums, coming=tree.broken_off | sums))
        for path in written:
            states[path] = tree.state_of(path, files[path])  # the student may be saving
            if states[path] in ("new", "old"):
                tree.write(path, files[path])
        for path in tree.sums.keys() - files.keys():
            tree.remove(path)
        path = HANDOUT_NOTE
        tree.write(path, note(stage, sums))
    except OSError as error:
        raise Failure(f"{folder}: {path}: {error.strerror}; the same command goes on from here") from None
    print(
        f"{folder}: stage {stage} is in, {len(written)} files new or newer. "
        "`git add -A && git commit` keeps them."
    )
    for path, state in states.items():
        if state == "changed":
            print(f"  {path} was changed there, and is as it was")
    for path in brought.keys() - files.keys():
        if path.endswith("/path_tracer.hpp") and not (folder / path).exists():
            print(f"  {path} is not there, and later chapters include it")
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
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")
    try:
        sys.exit(main())
    except (Failure, OSError) as error:
        sys.exit(f"handout: {error}")
    except MemoryError:
        sys.exit("handout: there is not enough memory")
    except KeyboardInterrupt:
        sys.exit("handout: broken off; the same command goes on from here")
