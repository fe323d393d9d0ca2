"""The processor and the compiler, which a measurement depends on."""

import os
import platform
import re
from pathlib import Path

from tools.tree import BUILD

CPU_INFO = Path("/proc/cpuinfo")


def processor():
    """Name and numbers: on a virtual machine the name is only that of a family."""
    if not CPU_INFO.exists():
        return platform.processor() or platform.machine()
    found = dict(re.findall(r"^(.*?)\s*: (.*)", CPU_INFO.read_text(), re.MULTILINE))
    name = found.get("model name", platform.machine())
    numbers = [
        f"{key} {found[word]}"
        for key, word in (("family", "cpu family"), ("model", "model"))
        if word in found
    ]
    return f"{name} ({', '.join(numbers)})" if numbers else name


def compiler():
    """The one that CMake has found for the programs in BUILD."""
    files = sorted(BUILD.glob("CMakeFiles/*/CMakeCXXCompiler.cmake"), key=lambda path: path.stat().st_mtime)
    text = files[-1].read_text() if files else ""
    found = dict(re.findall(r'set\(CMAKE_CXX_COMPILER_(ID|VERSION) "(.+)"\)', text))
    name = {"GNU": "GCC"}.get(found.get("ID"), found.get("ID", "unknown compiler"))
    return f"{name} {found.get('VERSION', '')}".strip()


def machine():
    return f"{processor()}, {os.cpu_count()} processors, {compiler()}"
