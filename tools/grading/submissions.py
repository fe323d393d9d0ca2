"""The submissions in a folder, and the header in each.

Each header, folder, .zip and git .bundle of the folder is a submission, named as
the file is. Nothing of it is unpacked here but that header.
"""

import csv
import io
import os
import re
import unicodedata
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

from tools.grading import sandbox
from tools.tree import Failure

# The largest header of the course has 60 kB.
MOST = 1 << 20
MOST_FILES = 5000
ENDINGS = (".hpp", ".h", ".zip", ".bundle")
NAMES = ("name", "full name", "student")
FIRST = ("first name", "given name", "vorname")
LAST = ("last name", "surname", "family name", "nachname")


class Refused(Exception):
    """Why a submission has no header that can be judged."""


@dataclass(frozen=True)
class Submission:
    name: str  # without its ending
    path: Path | None  # None where nothing was handed in
    student: str = ""  # the full name, from the roster
    row: tuple = ()  # its cells there

    def header(self, stage):
        """The bytes of its header of the stage."""
        path, ending = self.path, self.path.suffix.lower()
        if path.is_symlink():
            raise Refused(f"{path.name} is a link, which may lead out of the folder")
        if path.is_dir():
            return from_names(files_below(path), stage, lambda name: read(path, name))
        if ending == ".zip":
            return from_zip(path, stage)
        if ending == ".bundle":
            return from_bundle(path, stage)
        return read(path.parent, path.name)


@dataclass
class Given:
    """What a class has handed in."""

    submissions: list
    columns: list = field(default_factory=list)  # of the roster
    not_read: list = field(default_factory=list)  # names of files that are no submission

    @property
    def handed_in(self):
        return [one for one in self.submissions if one.path]

    def remarks(self):
        """What an instructor has to look at before the class is judged, a line each."""
        if self.not_read:
            yield f"not read, since it is no folder, .hpp, .zip or .bundle: {', '.join(self.not_read)}"
        if self.columns:
            if strangers := [one.name for one in self.submissions if not one.row]:
                yield f"not in the roster: {', '.join(strangers)}"
            if absent := [one.student or one.name for one in self.submissions if not one.path]:
                yield f"handed in nothing: {', '.join(absent)}"


def submissions(folder, roster=None):
    """All of them, by name; those of the roster who handed in nothing, too."""
    if not folder.is_dir():
        raise Failure(
            f"FROM={folder}: {'a folder is expected' if folder.exists() else 'there is no such folder'}"
        )
    found, not_read = {}, []
    for path in sorted(folder.iterdir()):
        is_one = path.suffix.lower() in ENDINGS
        if path.name.startswith("."):
            continue
        if not (is_one or path.is_symlink() or path.is_dir()):
            not_read.append(path.name)
            continue
        name = path.stem if is_one else path.name
        if name in found:
            raise Failure(f"{folder}: {found[name].path.name} and {path.name} are one student's")
        found[name] = Submission(name, path)
    if not found:
        raise Failure(f"FROM={folder}: it has no submission: no folder, .hpp, .zip or .bundle")
    columns, rows = read_roster(roster) if roster else ([], [])
    if roster:
        found = with_students(found, rows, roster)
    return Given(list(found.values()), columns, not_read)


def read_roster(path):
    """The columns, and [(cells, full name)], of a table whose first line names its columns;
    separated by commas, semicolons or tabs, in UTF-8 or Windows' letters."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise Failure(f"ROSTER={path}: {error.strerror}") from None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    separator = max(",;\t", key=text.partition("\n")[0].count)
    rows = [[cell.strip() for cell in row] for row in csv.reader(io.StringIO(text), delimiter=separator)]
    columns, students = rows[0] if rows else [], []
    for line, cells in enumerate(rows[1:], 2):
        if not any(cells):
            continue
        if not cells[0] or any(cells[0] == other[0] for other, _ in students):
            what = f"{cells[0]} is there twice" if cells[0] else "its first column is empty"
            raise Failure(f"ROSTER={path}: row {line}: {what}")
        named = dict(zip(map(str.lower, columns), cells))
        parts = [next((named[name] for name in names if name in named), "") for names in (NAMES, FIRST, LAST)]
        students.append((tuple(cells), parts[0] or " ".join(filter(None, parts[1:]))))
    if not students:
        raise Failure(f"ROSTER={path}: a line that names the columns is expected, and one for each student")
    return columns, students


def same(name):
    """What is left of a name where letters are written in another way: ö may be one letter
    or two, and a file that was there is "ana (1)"."""
    return re.sub(r" \(\d+\)$", "", unicodedata.normalize("NFC", name).casefold())


def words(name):
    """Those of a name, in whatever order."""
    return sorted(re.findall(r"[^\s,]+", same(name)))


def is_of(name, cells, full):
    """Whether a submission of this name is the student's of this row."""
    handles = {same(cell) for cell in cells} | {same(cell).split("@")[0] for cell in cells if "@" in cell}
    return same(name) in handles - {""} or bool(full and words(name.split("_")[0]) == words(full))


def with_students(found, students, roster):
    """Submissions by the roster: a student's is called what stands in any of the row's
    columns, or before the @ of an address, or has the words of the full name: Moodle's
    folders are "Full Name_123_..."."""
    every, left = {}, dict(found)
    for cells, full in students:
        names = [name for name in left if is_of(name, cells, full)]
        if len(names) > 1:
            raise Failure(f"ROSTER={roster}: {cells[0]} has {len(names)} submissions: {', '.join(names)}")
        one = names[0] if names else cells[0]
        every[one] = Submission(one, left.pop(one).path if names else None, full, cells)
    if len(left) == len(found):
        raise Failure(
            f"ROSTER={roster}: no submission is called what stands in it, as {next(iter(found))} is not"
        )
    return every | left


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
    """Of the commit that the bundle's HEAD names, or else of its newest branch."""
    bundle, repository = "/in.bundle", "/tmp/in.git"
    git = f"git -C {repository}"
    newest = f"{git} for-each-ref --count=1 --sort=-committerdate '--format=%(refname)'"
    fetch = (
        f"git init -q --bare {repository} && {{ {git} fetch -q {bundle} +HEAD:refs/theirs 2> /dev/null || "
        f"{{ {git} fetch -q {bundle} '+refs/*:refs/*' && {git} update-ref refs/theirs $({newest}); }}; }}"
    )
    clone = [["sh", "-c", fetch]]
    listed = [["sh", "-c", f"{git} ls-tree -r --name-only -z refs/theirs > /tmp/names"]]
    done = sandbox.run([*clone, *listed], [(path, bundle)], ["/tmp/names"])
    if done.code or done.stopped:
        raise Refused(f"it is no git bundle that can be read: {done.printed.strip()[-200:]}")
    names = done.files[0].decode(errors="surrogateescape").split("\0")[:-1]

    def content(name):
        show = [["sh", "-c", f'{git} show "refs/theirs:$0" > /tmp/header', name]]
        shown = sandbox.run([*clone, *show], [(path, bundle)], ["/tmp/header"], most=MOST + 1)
        if shown.code or shown.stopped:
            raise Refused(f"{name} cannot be read from the bundle: {shown.printed.strip()[-200:]}")
        return bounded(shown.files[0], name)

    return from_names(names, stage, content)
