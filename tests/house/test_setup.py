"""tools/setup.sh on simulated machines: its PATH has a shell's tools, and fakes
of apt-get, brew, pacman and sudo that only record their arguments."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from tools.tree import ROOT

SETUP = ROOT / "tools/setup.sh"
TOOLS = ("sh", "dirname", "sed", "ls", "env")
# Each command is a line of `log`, and ends with the exit code in `NAME.fails`.
WRITES_DOWN = """#!{sh}
printf '%s\\n' "{name} $*" >> "{folder}/log"
if [ -e "{folder}/{name}.fails" ]; then exit 100; fi
{then}
"""
BUILD = """cmake doctest-dev g++ git libbenchmark-dev libcli11-dev libglm-dev libhwy-dev libopenimageio-dev
  libstb-dev libtomlplusplus-dev make ninja-build nlohmann-json3-dev openimageio-tools procps
  python3 python3-jsonschema python3-venv""".split()
OTHERS = {
    "site": "clang libc++-dev-wasm32 libclang-rt-dev-wasm32 lld nodejs npm wasi-libc",
    "slides": "chromium fonts-dejavu-core",
    "class": "bubblewrap util-linux",
    "slurm": "munge slurm-client slurmctld slurmd",
    "fuzz": "clang libclang-rt-dev",
    "bench": "libbenchmark-tools",
    "peers": "libllvm16",
    "windows": "binutils-mingw-w64-x86-64 g++-mingw-w64-x86-64-posix wine64",
    "compilers": "clang",
    "fresh": "debootstrap",
}


class Setup(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lightwalk-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "bin").mkdir()
        for tool in TOOLS:
            (self.folder / "bin" / tool).symlink_to(shutil.which(tool))

    def add(self, name, then="exit 0"):
        """Makes a program of this name that records its calls."""
        program = self.folder / "bin" / name
        text = WRITES_DOWN.format(sh=shutil.which("sh"), name=name, folder=self.folder, then=then)
        program.write_text(text)
        program.chmod(0o755)

    def break_program(self, name):
        (self.folder / f"{name}.fails").touch()

    def debian(self, installed=(), archive=None, user=0):
        self.add("apt-get")
        lines = "".join(f"installed {name}\\n" for name in installed)
        self.add("dpkg-query", f"printf '{lines}config-files lld\\n'")
        self.add("apt-cache", f'case " {archive or ""} " in *" $2 "*) exit 0 ;; esac; exit 100')
        self.add("id", f"echo {user}")

    def sudo(self, then='[ "$1" = -n ] && shift; [ "$1" = -v ] || exec "$@"'):
        self.add("sudo", then)

    def setup(self, *arguments, **environment):
        """The exit code of setup.sh, its output, and the commands that it ran."""
        (self.folder / "log").write_text("")
        done = subprocess.run(
            [shutil.which("sh"), SETUP, *arguments],
            env={"PATH": str(self.folder / "bin"), **environment},
            cwd=self.folder,
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.stdout, "")
        ran = (self.folder / "log").read_text().splitlines()
        does = re.compile("apt-get (update|install) |brew install |pacman -S ")
        return done.returncode, done.stderr, [line for line in ran if does.match(line)]

    def installs(self, *arguments, **environment):
        """The packages that apt-get should install, sorted."""
        code, said, ran = self.setup(*arguments, **environment)
        self.assertEqual(code, 0, said)
        if not ran:
            return []
        self.assertEqual(ran[0], "apt-get update -q")
        self.assertEqual(len(ran), 2, ran)
        words = ran[1].split()
        self.assertEqual(words[:5], ["apt-get", "install", "-q", "-y", "--no-install-recommends"])
        self.assertEqual(len(words[5:]), len(set(words[5:])), words)
        return sorted(words[5:])

    def test_each_purpose_has_its_packages(self):
        self.debian()
        self.assertEqual(self.installs(), BUILD)
        self.assertEqual(self.installs("build"), BUILD)
        for purpose, packages in OTHERS.items():
            with self.subTest(purpose):
                self.assertEqual(self.installs(purpose), packages.split())
        every = sorted(set(BUILD).union(*(packages.split() for packages in OTHERS.values())))
        self.assertEqual(self.installs("all"), every)
        self.assertEqual(self.installs("bench", "peers"), ["libbenchmark-tools", "libllvm16"])

    def test_only_what_is_missing_is_installed(self):
        self.debian(installed=[name for name in BUILD if name != "libhwy-dev"])
        self.assertEqual(self.installs(), ["libhwy-dev"])
        self.debian(installed=BUILD)
        self.assertEqual(self.installs(), [])

    def test_what_is_there_from_elsewhere_counts(self):
        self.debian()
        for program in ("node", "npm", "cmake", "google-chrome", "debootstrap"):
            self.add(program)
        self.assertEqual(
            self.installs("site"), "clang libc++-dev-wasm32 libclang-rt-dev-wasm32 lld wasi-libc".split()
        )
        self.assertEqual(self.installs("slides"), [])
        self.assertEqual(self.installs("fresh"), [])
        self.assertNotIn("cmake", self.installs())
        self.assertNotIn("g++", self.installs(CXX="clang++-19"))
        self.add("clang++")  # links with libFuzzer, and for WebAssembly
        self.assertEqual(self.installs("fuzz", "compilers", "site"), [])
        self.break_program("clang++")
        self.assertEqual(self.installs("fuzz"), ["clang", "libclang-rt-dev"])

    def test_python_without_a_module_is_not_enough(self):
        self.debian(installed=[name for name in BUILD if name != "python3-venv"])
        self.add("python3")
        self.assertEqual(self.installs(), [])
        self.break_program("python3")
        self.assertEqual(self.installs(), ["python3-venv"])

    def test_of_alternatives_the_first_that_the_archive_has(self):
        self.debian(archive="libllvm18 libllvm19 chromium-browser")
        self.assertEqual(self.installs("peers"), ["libllvm18"])
        self.assertEqual(self.installs("slides"), ["chromium-browser", "fonts-dejavu-core"])
        self.debian(installed=["libllvm19"], archive="libllvm16")
        self.assertEqual(self.installs("peers"), [])

    def test_sudo(self):
        self.debian(user=1000)
        self.sudo()
        self.assertEqual(self.installs("fresh"), ["debootstrap"])
        self.assertIn("sudo apt-get update", (self.folder / "log").read_text())

    def test_without_sudo_one_sentence_says_whom_to_ask(self):
        sentence = "setup: please ask an administrator to run: apt-get install --no-install-recommends"
        self.debian(user=1000)
        self.assertEqual(self.setup("fuzz"), (1, f"{sentence} clang libclang-rt-dev\n", []))
        self.sudo("exit 1")  # installed, but not for this user
        self.assertEqual(self.setup("fuzz"), (1, f"{sentence} clang libclang-rt-dev\n", []))
        self.assertEqual(self.setup("fuzz", SETUP="no"), (0, "", []))

    def test_without_a_network_the_last_line_is_our_own(self):
        self.debian()
        self.break_program("apt-get")
        code, said, _ = self.setup("fuzz")
        self.assertEqual(code, 1)
        self.assertEqual(
            said.splitlines()[-1],
            "setup: apt-get could not install (see its message above): clang libclang-rt-dev",
        )

    def test_print_runs_nothing(self):
        self.debian(user=1000)
        code, said, ran = self.setup("fresh", SETUP="print")
        self.assertEqual((code, ran), (1, []))
        self.assertRegex(said, r"^setup: sudo apt-get update -q\nsetup: sudo env .* debootstrap\n$")
        self.debian(installed=["debootstrap"])
        self.assertEqual(self.setup("fresh", SETUP="print"), (0, "", []))

    def test_arguments_are_looked_at_first(self):
        self.debian()
        known = f"known are: build {' '.join(OTHERS)} all"
        self.assertEqual(self.setup("fuzz", "wndows"), (2, f"setup: 'wndows' is not known; {known}\n", []))
        self.assertEqual(self.setup(SETUP="prnt"), (2, "setup: SETUP='prnt': print or no is expected\n", []))

    def test_fuzz_takes_the_compiler_that_is_named(self):
        self.debian(installed=["clang", "libclang-rt-dev"])
        code, said, ran = self.setup("fuzz", FUZZ_CXX="/no/clang++")
        self.assertEqual((code, ran), (1, []))
        self.assertIn("FUZZ_CXX='/no/clang++': Clang with libFuzzer", said)

    def test_homebrew(self):
        (self.folder / "opt/glm").mkdir(parents=True)
        for name in ("brew", "make", "c++", "git"):
            self.add(name, f'[ "$*" != --prefix ] || echo "{self.folder}"')
        code, said, ran = self.setup()
        self.assertEqual(len(ran), 1, ran)
        self.assertRegex(ran[0], r"^brew install cmake ninja python .*highway$")
        self.assertNotIn("glm", ran[0])
        self.assertEqual(code, 1)
        self.assertRegex(
            said, r"\nsetup: brew has no package of it; please install: jsonschema for Python .*\n$"
        )
        self.add("python3")  # now it finds its modules
        self.assertEqual(self.setup()[0], 0)
        self.assertEqual(self.setup("site")[2], ["brew install node"])
        self.break_program("brew")
        self.assertEqual(self.setup("bench")[0], 1)

    def test_msys2(self):
        self.add("pacman", '[ "$*" != -Qq ] || printf "mingw-w64-ucrt-x86_64-gcc\\nmake\\n"')
        environment = {"MINGW_PACKAGE_PREFIX": "mingw-w64-ucrt-x86_64"}
        code, said, ran = self.setup(**environment)
        self.assertEqual((code, len(ran)), (0, 1), said)
        self.assertTrue(
            ran[0].startswith("pacman -S --needed --noconfirm git mingw-w64-ucrt-x86_64-cmake "), ran
        )
        packages = set(ran[0].replace("mingw-w64-ucrt-x86_64-", "").split()[4:])
        self.assertEqual(packages & {"gcc", "make", "-"}, set())
        self.assertLessEqual({"python", "python-jsonschema", "highway", "glm", "openimageio"}, packages)
        self.assertEqual(self.setup(SETUP="print", **environment)[::2], (1, []))

    def test_without_a_package_manager_one_sentence_says_all(self):
        code, said, ran = self.setup()
        self.assertEqual((code, ran), (1, []))
        self.assertEqual(said.count("\n"), 1, said)
        for words in ("a C++20 compiler", "CMake 3.22 or newer", "GLM", "jsonschema for Python", "SETUP=no"):
            self.assertIn(words, said)
        self.assertRegex(said, r"\(and, for more, Ninja, .*OpenImageIO, .*Highway\)")
        # With a compiler that finds each header, and with all programs and modules.
        for name in ("c++", "make", "git", "cmake", "python3"):
            self.add(name, "exit 0")
        self.assertEqual(self.setup()[:2], (0, ""))
        self.break_program("python3")
        code, said, _ = self.setup()
        self.assertEqual(code, 1)
        self.assertIn("Python 3.11 or newer with venv, jsonschema", said)
        self.assertNotIn("GLM", said)

    def test_make_setup_that_only_prints_is_no_failure(self):
        self.debian()
        # A PATH with what make needs, and with fakes of Debian's tools.
        path = f"{self.folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
        command = ["make", "-s", "--no-print-directory", f"BUILD={self.folder}/build"]
        environment = {"PATH": path, "SETUP": "print"}
        (self.folder / "log").write_text("")
        for goals, code in (["setup-fresh"], 0), (["setup"], 0), (["setup", "clean"], 2):
            done = subprocess.run(
                [*command, *goals],
                cwd=ROOT,
                env=environment,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
            )
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn("libglm-dev", done.stderr)
            self.assertEqual(bool(re.search(r"\*\*\*", done.stderr)), code != 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
