"""Says when stage 6 has lost its speed: what stage 5 takes, over what it takes.

    python3 -m tools.bench.bar

One attribute decides whether a step is compiled into one piece, and the loss is
not seen in any picture. Five alternating runs of each twin, medians of seconds
of processor time. It warns, and is no test: other programs run here, too.
"""

import os
import statistics
import tempfile
from pathlib import Path

from compare.stages import BUILD, SCENES, render

# Less than this means that something is not inlined any more.
BARS = {"avx2": 2.5, "avx512": 3.5}


def instruction_sets():
    """Those that this processor has a twin of stage 6 for."""
    info = Path("/proc/cpuinfo")
    flags = info.read_text() if info.exists() else ""
    found = ["baseline"]
    if (BUILD / "avx2/stage6").exists() and " avx2 " in flags:
        found.append("avx2")
    if (BUILD / "avx512/stage6").exists() and " avx512bw " in flags:
        found.append("avx512")
    return found


def main():
    scene = SCENES / "cornell_box_point.toml"
    with tempfile.NamedTemporaryFile(suffix=".pfm") as image:

        def seconds(program, instructions):
            os.environ["LIGHTWALK_INSTRUCTIONS"] = instructions
            return render(program, scene, image.name, "--spp", 16, "--threads", 1)["cpu_seconds"]

        for instructions in instruction_sets()[1:]:
            bar = BARS[instructions]
            runs = [(seconds("stage5", "avx2"), seconds("stage6", instructions)) for _ in range(5)]
            one, many = (statistics.median(times) for times in zip(*runs))
            print(f"stage 6 with {instructions}: stage 5 takes {one / many:.1f} times as long")
            if one / many < bar:
                print(f"  That is less than {bar}: is LIGHTWALK_IN_ONE_PIECE still at its step?")


if __name__ == "__main__":
    main()
