"""The submissions in a folder, and the header in each.

Each header, folder, .zip and git .bundle of the folder is a submission, named as
the file is. Nothing of it is unpacked here but that header.
"""

import csv
import os
import zipfile
from dataclasses import dataclass
from pathlib import Path

from tools.grading import sandbox
from tools.tree import Failure

# The largest header of the course has 60 kB.
MOST = 1 << 20
MOST_FILES = 5000
ENDINGS = (".hpp", ".h", ".zip", ".bundle")
IDS = ("id", "username", "student id", "id number", "email", "email address")
NAMES = ("name", "full name", "student")


class Refused(Exception):
    """Why a submission has no header that can be judged."""


@dataclass(frozen=True)
class Submission:
    name: str  # without its ending
    path: Path | None  # None where nothing was handed in
    student: str = ""  # the full name, from the roster

    def header(self, stage):
        """The bytes of its header of the stage."""
        path = self.path
        if path.is_symlink():
            raise Refused(f"{path.name} is a link, which may lead out of the folder")
        if path.is_dir():
            return from_names(files_below(path), stage, lambda name: read(path, name))
        if path.suffix == ".zip":
            return from_zip(path, stage)
        if path.suffix == ".bundle":
            return from_bundle(path, stage)
        return read(path.parent, path.name)


def submissions(folder, roster=None):
    """All of them, by name; those of the roster who handed in nothing, too."""
    if not folder.is_dir():
        raise Failure(f"FROM={folder}: there is no such folder")
    found = {}
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or not (path.is_symlink() or path.is_dir() or path.suffix in ENDINGS):
            continue
        name = path.stem if path.suffix in ENDINGS else path.name
        if name in found:
            raise Failure(f"{folder}: {found[name].path.name} and {path.name} are one student's")
        found[name] = Submission(name, path)
    if roster:
        found = with_students(found, read_roster(roster), roster)
    if not found:
        raise Failure(f"FROM={folder}: it has no submission: no folder, header, .zip or .bundle")
    return list(found.values())


def read_roster(path):
    """{id: full name} of a CSV file whose first line names its columns."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise Failure(f"ROSTER={path}: {error}") from None
    columns = {(name or "").strip().lower(): name for name in (rows[0] if rows else {})}
    key = next((columns[name] for name in IDS if name in columns), None)
    full = next((columns[name] for name in NAMES if name in columns), None)
    if not key:
        raise Failure(f"ROSTER={path}: no column is called {', '.join(IDS[:3])} or the like")
    students = {}
    for line, row in enumerate(rows, 2):
        one = (row[key] or "").strip()
        if not one or one in students:
            raise Failure(f"ROSTER={path}: row {line}: {key} is {'there twice: ' + one if one else 'empty'}")
        students[one] = (row[full] or "").strip() if full else ""
    return students


def with_students(found, students, roster):
    """Submissions by the roster's ids. Moodle calls a folder "Full Name_123_...": that
    is found by the full name."""
    every = {}
    for one, full in students.items():
        names = [name for name in found if name == one or (full and name.startswith(f"{full}_"))]
        if len(names) > 1:
            raise Failure(f"ROSTER={roster}: {one} has {len(names)} submissions: {', '.join(names)}")
        path = found.pop(names[0]).path if names else None
        every[one] = Submission(one, path, full)
    return every | found


def files_below(folder):
    """Names of the files in a folder; no link is followed."""
    names = []
    for place, _, files in os.walk(folder):
        names += [os.path.relpath(os.path.join(place, name), folder) for name in files]
        if len(names) > MOST_FILES:
            raise Refused(f"it has more than {MOST_FILES} files")
    return names


def read(folder, name):
    path = folder / name
    if any(part.is_symlink() for part in (path, *path.parents) if folder in part.parents):
        raise Refused(f"{name} is a link, which may lead out of the folder")
    if not path.is_file():
        raise Refused(f"{name} is no file")
    with path.open("rb") as file:
        return bounded(file.read(MOST + 1), name)


def bounded(data, name):
    if len(data) > MOST:
        raise Refused(f"{name} is larger than {MOST >> 20} MB")
    return data


def from_names(names, stage, content):
    """The stage's header among the files of these names."""
    parts = [(name, name.replace("\\", "/").split("/")) for name in names]
    headers = [name for name, path in parts if path[-1] == "path_tracer.hpp"]
    in_place = [
        name for name, path in parts if name in headers and path[-2:-1] and path[-2].startswith(f"{stage}_")
    ]
    every = in_place or headers or [name for name in names if name.endswith(".hpp")]
    if not every:
        raise Refused(f"it has no path_tracer.hpp of stage {stage}")
    if len(every) > 1:
        raise Refused(f"it has {len(every)} headers of stage {stage}: {', '.join(sorted(every)[:3])}")
    return content(every[0])


def from_zip(path, stage):
    try:
        with zipfile.ZipFile(path) as archive:
            entries = {one.filename: one for one in archive.infolist() if not one.is_dir()}
            if len(entries) > MOST_FILES:
                raise Refused(f"it has more than {MOST_FILES} files")

            def content(name):
                if entries[name].external_attr >> 28 == 0o12:
                    raise Refused(f"{name} is a link, which may lead out of the folder")
                with archive.open(entries[name]) as file:
                    return bounded(file.read(MOST + 1), name)

            return from_names(list(entries), stage, content)
    except (zipfile.BadZipFile, OSError, RuntimeError, NotImplementedError, ValueError, EOFError) as error:
        raise Refused(f"it is no .zip that can be read: {error}") from None


def from_bundle(path, stage):
    """Of the commit that the bundle's HEAD names, or else its first branch."""
    bundle, repository = "/in.bundle", "/tmp/in.git"
    git = ["git", "-C", repository, "-c", "safe.directory=*"]
    clone = [
        ["git", "init", "-q", "--bare", repository],
        [*git, "fetch", "-q", bundle, "+refs/*:refs/*", "+HEAD:refs/theirs"],
    ]
    listed = [["sh", "-c", f"{' '.join(git[:3])} ls-tree -r --name-only -z refs/theirs > /tmp/names"]]
    done = sandbox.run([*clone, *listed], [(path, bundle)], ["/tmp/names"])
    if done.code or done.stopped:
        raise Refused(f"it is no git bundle that can be read: {done.printed.strip()[-200:]}")
    names = done.files[0].decode(errors="surrogateescape").split("\0")[:-1]

    def content(name):
        show = [["sh", "-c", f'{" ".join(git[:3])} show "refs/theirs:$0" > /tmp/header', name]]
        shown = sandbox.run([*clone, *show], [(path, bundle)], ["/tmp/header"], most=MOST + 1)
        if shown.code or shown.stopped:
            raise Refused(f"{name} cannot be read from the bundle: {shown.printed.strip()[-200:]}")
        return bounded(shown.files[0], name)

    return from_names(names, stage, content)
