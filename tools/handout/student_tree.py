"""A folder that a student works in. Nothing in it is believed: neither its note,
nor that its names lead where they seem to lead."""

import json
import os
import tempfile
from pathlib import Path, PurePosixPath, PureWindowsPath

from tools.tree import HANDOUT_NOTE, Failure, sum_of


def sums_of(files):
    return {path: sum_of(data) for path, data in files.items()}


def note(stage, sums, coming=None):
    """What a handout has brought, so that the next one knows what a student has
    changed; and what is `coming`, as long as it is being written."""
    text = {"stage": stage, "files": sums} | ({"coming": coming} if coming else {})
    return (json.dumps(text, indent=1) + "\n").encode()


# What handouts may take away again. A chapter is the student's from the first day.
REMOVABLE = ("cmake", "common", "compare", "scenes", "tests", "third_party", "tools")


def is_inside(path):
    """Whether a name can only mean a file below the folder, on every system."""
    windows = PureWindowsPath(path)
    parts = PurePosixPath(path).parts
    return (
        bool(parts)
        and PurePosixPath(path).as_posix() == path
        and not windows.drive
        and not windows.root
        and ".." not in windows.parts
        and "\0" not in path
        and max(len(part.encode(errors="replace")) for part in parts) < 200
    )


class StudentTree:
    def __init__(self, folder):
        self.folder = folder
        self.stage, self.sums, self.broken_off = self.read_note()

    def read_note(self):
        """The stage, the sums of what was brought, and those of what was being
        brought when it was broken off."""
        path = self.folder / HANDOUT_NOTE
        if not os.path.lexists(path):
            raise Failure(f"{self.folder} is no handout: there is no {HANDOUT_NOTE} in it")
        damaged = Failure(
            f"{path} is damaged, and says what is yours and what was handed out: "
            f"`git checkout HEAD -- {HANDOUT_NOTE}` brings it back, or copy it from the handout"
        )
        if self.what_is_at(HANDOUT_NOTE) != "file":
            raise damaged
        try:
            found = json.loads(path.read_text(encoding="utf-8-sig"))
            stage, sums, coming = found["stage"], found["files"], found.get("coming", {})
        except (ValueError, KeyError, TypeError, RecursionError, MemoryError):
            raise damaged from None
        if type(stage) is not int or stage not in range(1, 10) or {type(sums), type(coming)} != {dict}:
            raise damaged
        return stage, sums, coming

    def what_is_at(self, path):
        """ "file", "" for nothing, or what is in the way of a file there."""
        place = self.folder
        *folders, name = PurePosixPath(path).parts
        for part in folders:
            place = place / part
            if place.is_symlink():
                return f"{place.relative_to(self.folder)} is a link, and a folder is expected"
            if not os.path.lexists(place):
                return ""
            if not place.is_dir():
                return f"{place.relative_to(self.folder)} is no folder, and a folder is expected"
        place = place / name
        if place.is_symlink():
            return f"{path} is a link, and a file is expected"
        if not os.path.lexists(place):
            return ""
        return "file" if place.is_file() else f"{path} is no file, and a file is expected"

    def state_of(self, path, data):
        """Of a place for `data`: "new", "same", "old" as it was handed out, or
        "changed" by the student."""
        if self.what_is_at(path) != "file":
            return "new"
        total = sum_of((self.folder / path).read_bytes())
        if total == sum_of(data):
            return "same"
        return "old" if total in (self.sums.get(path), self.broken_off.get(path)) else "changed"

    def write(self, path, data):
        """The file is the old one or the new one, whole, whenever this is broken off."""
        there = self.what_is_at(path)  # that may have changed since all were looked at
        if there not in ("", "file"):
            raise Failure(f"{self.folder}: {there}; the same command goes on from here")
        target = self.folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        handle, beside = tempfile.mkstemp(prefix=".handout-", dir=target.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            os.chmod(beside, mode_of(path))
            os.replace(beside, target)
        except BaseException:
            Path(beside).unlink(missing_ok=True)
            raise

    def remove(self, path):
        """If it is as it was handed out, and no chapter."""
        if not is_inside(path) or PurePosixPath(path).parts[0] not in REMOVABLE:
            return
        if self.what_is_at(path) == "file":
            target = self.folder / path
            if sum_of(target.read_bytes()) == self.sums[path]:
                target.unlink()


def mode_of(path):
    return 0o755 if path.endswith(".sh") else 0o644
