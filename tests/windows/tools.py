"""Are the compiler for Windows and wine there? Exit code 1 and a line if not."""

import shutil
import sys

COMPILER = "x86_64-w64-mingw32-g++-posix"


def wine_program():
    """Wine for 64-bit programs; without Debian's package `wine` it has no command."""
    for name in ("wine64", "wine", "/usr/lib/wine/wine64"):
        if found := shutil.which(name):
            return found
    return None


def missing():
    """What is not installed, or an empty text."""
    absent = [] if shutil.which(COMPILER) else [f"mingw-w64 ({COMPILER})"]
    return " and ".join(absent + ([] if wine_program() else ["wine"]))


if __name__ == "__main__":
    if absent := missing():
        sys.exit(f"test-windows: not installed: {absent}; on Debian and Ubuntu: tools/setup.sh windows")
