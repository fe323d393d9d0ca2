"""Warns if stage 6 has lost its speed: stage 5's time over stage 6's.

    python3 -m tools.bench.bar

One attribute makes the compiler inline a whole step, and no picture shows if it
is missing. Compares the medians of processor time of five alternating runs. It
only warns and is not a test, since other programs disturb the times.
"""

import re
import statistics
import tempfile

from tools.tree import BUILD, SCENES, render, run

# Less than this means that something is not inlined any more.
BARS = {"AVX2": 2.5, "AVX-512": 3.5}


def registers(folder=BUILD):
    """The registers that stage 6 was compiled for, "" if it follows one path at a time."""
    found = re.search(r", (\S+): \d+ paths at once", run(folder / "stage6", "--version").stdout)
    return found[1] if found else ""


def main():
    scene = SCENES / "cornell_box_point.toml"
    names = registers()
    if not names:
        print("stage 6 follows one path at a time here: stage6 --version")
        return
    with tempfile.NamedTemporaryFile(suffix=".pfm") as image:

        def seconds(program):
            return render(program, scene, image.name, "--spp", 16, "--threads", 1)["cpu_seconds"]

        runs = [(seconds("stage5"), seconds("stage6")) for _ in range(5)]
        one, many = (statistics.median(times) for times in zip(*runs))
        print(f"stage 6 with {names}: stage 5 takes {one / many:.1f} times as long")
        if one / many < BARS.get(names, 0):
            print(f"  That is less than {BARS[names]}: is LIGHTWALK_FLATTEN still at its step?")


if __name__ == "__main__":
    main()
