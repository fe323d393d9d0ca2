"""Runs the README's commands on freshly installed systems.

    make test-fresh                 python3 -m tests.fresh [RELEASE...]

Installs a minimal Debian of each release with debootstrap, with only git and
make; clones this tree's last commit into root's home; and runs the README's
commands one after the other, with CI=true, so that skipped tests and left-out
parts fail. Prints a table of exit codes, seconds of processor time, and
packages. Needs root, debootstrap and an hour.

Uses this machine's mirrors, certificates and proxies.
"""

import argparse
import dataclasses
import os
import re
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

from tools.tree import BUILD, ROOT

RELEASES = ("bookworm", "trixie")  # Debian 12 and 13
HOME = "/root/lightwalk"
BEGINNING = ["git", "make", "ca-certificates"]
# The command, its folder, and the expected exit code.
COMMANDS = (
    ("make", HOME, 0),
    ("make test", HOME, 0),
    ("make test-site", HOME, 0),
    ("make handout STAGE=1 OUT=../student", HOME, 0),
    ("make check", "/root/student", 2),  # its exercises are open: make's code for a check that says 1
    ("make check STAGE=1", HOME, 0),
    ("make bench", HOME, 0),
    ("make single-header", HOME, 0),
    ("make test-single-header", HOME, 0),
    ("make fuzz SECONDS=20", HOME, 0),
)
MOUNT = (
    'mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && mount -t tmpfs shm "$1/dev/shm"'
    ' && cd / && exec chroot "$1" sh -c "cd $2 && exec env CI=true $3"'
)


@dataclasses.dataclass
class Done:
    command: str
    code: int
    expected: int
    seconds: float
    packages: int


class System:
    """A Debian in a folder."""

    def __init__(self, release, folder):
        self.release, self.folder = release, folder / release
        self.log = folder / f"{release}.log"

    def make(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        command = ["debootstrap", "--variant=minbase", f"--include={','.join(BEGINNING)}", self.release]
        with self.log.open("w") as log:
            done = subprocess.run([*command, self.folder, *mirror()], stdout=log, stderr=log)
        if done.returncode:
            sys.exit(f"test-fresh: debootstrap of {self.release} failed: {self.log}")
        for path in ("/etc/resolv.conf", "/etc/hosts"):
            if os.path.exists(path):
                shutil.copy(path, self.folder / path[1:])
        certificates = "usr/local/share/ca-certificates"
        if os.path.isdir(f"/{certificates}"):
            shutil.copytree(f"/{certificates}", self.folder / certificates, dirs_exist_ok=True)
        self.run("update-ca-certificates", "/")
        subprocess.run(["git", "clone", "--quiet", ROOT, f"{self.folder}{HOME}"], check=True)

    def run(self, command, place):
        """Runs a command in a shell of the system; its output goes to the log."""
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LANG": "C.UTF-8"}
        for name, value in os.environ.items():
            if re.search("proxy|_cert|_ca_", name, re.IGNORECASE) and not value.startswith("/opt"):
                environment[name] = value
        # Only this command sees the mounts, and its processes end with it.
        inside = ["unshare", "--mount", "--pid", "--fork", "--kill-child"]
        with self.log.open("a") as log:
            log.write(f"\n$ {command}\n")
            log.flush()
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run(
                [*inside, "sh", "-c", MOUNT, "fresh", self.folder, place, command],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
            )
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return done.returncode, seconds

    def packages(self):
        status = (self.folder / "var/lib/dpkg/status").read_text()
        return status.count("Status: install ok installed")


def mirror():
    """The mirror of this machine, if it is a Debian."""
    for path in [Path("/etc/apt/sources.list"), *Path("/etc/apt/sources.list.d").glob("debian*")]:
        if path.exists() and (
            found := re.search(r"^(?:URIs: |deb )(\S+/debian/?)(?:\s|$)", path.read_text(), re.M)
        ):
            return [found[1]]
    return []


def type_all(system, only):
    system.make()
    seen = system.packages()
    for command, place, expected in COMMANDS:
        if only and command not in only:
            continue
        print(f"{system.release}: {command}", flush=True)
        start = time.monotonic()
        code, seconds = system.run(command, place)
        now = system.packages()
        print(
            f"  exit code {code}, {seconds:.0f} s of the processor, {time.monotonic() - start:.0f} s",
            flush=True,
        )
        yield Done(command, code, expected, seconds, now - seen)
        seen = now


def table(system, rows):
    yield f"\n| Debian {system.release} | exit code | processor s | new packages |"
    yield "|---|---|---|---|"
    for row in rows:
        code = str(row.code) if row.code == row.expected else f"{row.code}, expected {row.expected}"
        yield f"| `{row.command}` | {code} | {row.seconds:.0f} | {row.packages} |"


def last_lines(system, command):
    """The last lines of a failed command's output."""
    text = system.log.read_text(errors="replace").split(f"\n$ {command}\n")[-1].split("\n$ ")[0]
    return "\n".join("    " + line for line in text.rstrip().splitlines()[-12:])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("releases", nargs="*", default=RELEASES, metavar="RELEASE")
    parser.add_argument("--only", action="append", help="run only this command", metavar="COMMAND")
    options = parser.parse_args()
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        print("test-fresh: not run: it needs root and debootstrap (tools/setup.sh fresh)", file=sys.stderr)
        return 1
    if subprocess.run(["git", "diff", "--quiet", "HEAD"], cwd=ROOT).returncode:
        print("test-fresh: what is not committed is not tested", file=sys.stderr)
    lines, failed = [], 0
    for release in options.releases:
        system = System(release, BUILD / "fresh")
        rows = list(type_all(system, options.only))
        lines += table(system, rows)
        for row in rows:
            if row.code != row.expected:
                failed += 1
                print(f"\n{release}: {row.command}\n{last_lines(system, row.command)}")
    print("\n".join(lines))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
