"""The header-only libraries of a handout, with their licenses.

They are copied from this machine's installation.
"""

import shutil
from pathlib import Path

from tools.tree import Failure

PREFIXES = [Path(folder) for folder in ("/usr/local", "/opt/homebrew", "/usr")]
# Of each library: its folder in include/, Debian's package, and its home.
LIBRARIES = {
    "glm": ("glm", "libglm-dev", "https://github.com/g-truc/glm"),
    "CLI11": ("CLI", "libcli11-dev", "https://github.com/CLIUtils/CLI11"),
    "toml++": ("toml++", "libtomlplusplus-dev", "https://github.com/marzer/tomlplusplus"),
    "nlohmann/json": ("nlohmann", "nlohmann-json3-dev", "https://github.com/nlohmann/json"),
    "doctest": ("doctest", "doctest-dev", "https://github.com/doctest/doctest"),
    "stb": ("stb", "libstb-dev", "https://github.com/nothings/stb"),
}
UNNEEDED = ("*.cmake", "*.inl.in", "*.a", "CMakeLists.txt")


def found(name):
    for prefix in PREFIXES:
        if (prefix / "include" / name).exists():
            return prefix / "include" / name
    return None


def license_of(package):
    """The license's text from Debian's folder, else None."""
    path = Path("/usr/share/doc") / package / "copyright"
    return path.read_text(errors="replace") if path.exists() else None


def copy_libraries(target):
    """Fills the folder; raises Failure if a library is not installed."""
    for library, (name, package, home) in LIBRARIES.items():
        source, text = found(name), license_of(package)
        if not source:
            raise Failure(f"{library} is not installed: `make setup` installs it")
        shutil.copytree(source, target / "include" / name, ignore=shutil.ignore_patterns(*UNNEEDED))
        licenses = target / "licenses"
        licenses.mkdir(parents=True, exist_ok=True)
        (licenses / f"{name}.txt").write_text(text or f"See {home}\n")
