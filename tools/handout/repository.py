"""git without anybody's settings: a handout is the same whoever makes it, from
a hook or a worktree, too."""

import os
import subprocess

from tools.tree import ROOT, Failure

SETTINGS = {
    "core.autocrlf": "false",
    "core.hooksPath": os.devnull,
    "core.quotePath": "false",
    "commit.gpgSign": "false",
    "init.defaultBranch": "main",
    "safe.directory": ROOT.as_posix(),
    "user.name": "Lightwalk",
    "user.email": "lightwalk@localhost",
}
# What a tree from an archive has besides the project's own files.
NOT_OURS = {"build", "__pycache__", "node_modules"}


def git(folder, *arguments):
    """What git prints. GIT_DIR and the like name another repository in a hook."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    environment |= {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull, "LC_ALL": "C"}
    settings = [word for name, value in SETTINGS.items() for word in ("-c", f"{name}={value}")]
    try:
        done = subprocess.run(
            ["git", "-C", folder, *settings, *arguments],
            capture_output=True,
            encoding="utf-8",
            errors="surrogateescape",
            env=environment,
        )
    except FileNotFoundError:
        raise Failure("git is not installed, and a handout is a git repository") from None
    if done.returncode:
        raise Failure(f"git {arguments[0]}: {done.stderr.strip()}")
    return done.stdout


def tracked_files():
    """The tree's files, "common/math/vector.hpp" and so on: those that git knows,
    or all where the tree is no repository of its own but comes from an archive."""
    if (ROOT / ".git").exists():
        paths = [path for path in git(ROOT, "ls-files", "-z").split("\0") if path]
    else:
        paths = []
        for folder, folders, names in os.walk(ROOT):
            folders[:] = sorted(name for name in folders if name not in NOT_OURS)
            inside = os.path.relpath(folder, ROOT).replace(os.sep, "/")
            paths += [name if inside == "." else f"{inside}/{name}" for name in sorted(names)]
    if "CMakeLists.txt" not in paths:
        raise Failure(f"{ROOT} is a repository, but its files are not in it: `git add` them")
    return paths


def commit_all(folder, paths, message):
    """Makes the folder a repository with one commit that has these files, all of them."""
    git(folder, "init", "--quiet", "--template=")
    git(folder, "add", "--all", "--force")
    git(folder, "commit", "--quiet", "--no-verify", "--message", message)
    missing = set(paths) - set(git(folder, "ls-files", "-z").split("\0"))
    if missing:
        raise Failure(f"git has not taken {len(missing)} files, {min(missing)} for one")
