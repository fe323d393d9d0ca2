"""The build folder: made for this tree, by a compiler that is there."""

import os
import re
import shlex
import shutil
import subprocess
import sys

from tools.tree import BUILD, ROOT, Failure

# What a build folder has that no compiler has made.
KEPT = ("check", "pictures")
HOW_TO_GET = """\
  Debian, Ubuntu  sudo apt-get install g++ cmake make ninja-build
  macOS           xcode-select --install, and brew install cmake ninja
  Windows         MSYS2: pacman -S mingw-w64-ucrt-x86_64-{gcc,cmake,ninja}"""


def is_ours(cache):
    """Whether the build folder is where it was made, and of this tree. A copied or
    renamed folder's build compiles the original's code. Another tree's own build
    folder is a Failure: it is not to be thrown away."""
    text = cache.read_text(encoding="utf-8", errors="replace")

    def is_at(name, place):
        found = re.search(rf"^{name}:INTERNAL=(.*)$", text, re.MULTILINE)
        return bool(found) and os.path.realpath(found[1]) == os.path.realpath(place)

    in_place, of_this_tree = is_at("CMAKE_CACHEFILE_DIR", BUILD), is_at("CMAKE_HOME_DIRECTORY", ROOT)
    if in_place and not of_this_tree:
        raise Failure(f"{BUILD} is the build folder of another tree: name another one, or delete it")
    return in_place and of_this_tree


def throw_away():
    for path in BUILD.iterdir():
        if path.name in KEPT:
            continue
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink()


def configure():
    """Makes the build folder ready, if it is not."""
    cache = BUILD / "CMakeCache.txt"
    if cache.exists():
        if is_ours(cache):
            return
        print("This folder was copied or renamed: all of it is compiled again.\n", flush=True)
        throw_away()
    odd = re.search(r"[][*?]", str(ROOT))
    if odd:
        raise Failure(f"CMake takes {odd[0]} in a folder's name for a pattern: rename {ROOT}")
    command = ["cmake", "-S", ROOT, "-B", BUILD, "-DCMAKE_BUILD_TYPE=Release"]
    command += ["-G", "Ninja"] if shutil.which("ninja") else []
    command += shlex.split(os.environ.get("CMAKE_ARGS", ""))
    try:
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", errors="replace"
        )
    except FileNotFoundError:
        raise Failure(f"CMake is not installed.\n{HOW_TO_GET}") from None
    if done.returncode == 0:
        return
    cache.unlink(missing_ok=True)
    said = done.stdout + done.stderr
    if re.search(
        r"No CMAKE_CXX_COMPILER could be found|CMAKE_CXX_COMPILER not set|is not able to compile", said
    ):
        raise Failure(f"there is no C++ compiler that works.\n{HOW_TO_GET}")
    errors = said[max(0, said.find("CMake Error")) :].strip().splitlines()
    raise Failure("CMake cannot prepare the build:\n" + "\n".join(errors[:16]))


if __name__ == "__main__":
    try:
        configure()
    except Failure as error:
        sys.exit(f"make: {error}")
