"""Checks that the compiler for Windows and wine are installed. Exit code 1 and a line if not."""

import shutil
import sys

from tools.tree import left_out


def wine_program():
    """Wine for 64-bit programs; without Debian's package `wine` it has no command."""
    for name in ("wine64", "wine", "/usr/lib/wine/wine64"):
        if found := shutil.which(name):
            return found
    return None


if __name__ == "__main__":
    if lacks := left_out("test-windows"):
        sys.exit(f"test-windows: nothing was tested: {lacks[0]}")
