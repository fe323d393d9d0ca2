"""Says when stage 6 has lost its speed: what stage 5 takes, over what it takes.

    python3 -m tools.bench.bar

One attribute decides whether a step is compiled into one piece, and the loss is
not seen in any picture. Five alternating runs of each twin, medians of seconds
of processor time. It warns, and is no test: other programs run here, too.
"""

import os
import statistics
import tempfile

from compare.stages import BUILD, SCENES, render

# Less than this means that something is not inlined any more.
BARS = {"avx2": 2.5, "avx512": 3.5}


def main():
    scene = SCENES / "cornell_box_point.toml"
    with tempfile.NamedTemporaryFile(suffix=".pfm") as image:

        def seconds(program, instructions):
            os.environ["LIGHTWALK_INSTRUCTIONS"] = instructions
            return render(program, scene, image.name, "--spp", 16, "--threads", 1)["cpu_seconds"]

        for instructions, bar in BARS.items():
            twin = BUILD / instructions / "stage6"
            if not twin.exists() or instructions.removesuffix("512") not in flags():
                continue
            runs = [(seconds("stage5", "avx2"), seconds("stage6", instructions)) for _ in range(5)]
            one, many = (statistics.median(times) for times in zip(*runs))
            print(f"stage 6 with {instructions}: stage 5 takes {one / many:.1f} times as long")
            if one / many < bar:
                print(f"  That is less than {bar}: is LIGHTWALK_IN_ONE_PIECE still at its step?")


def flags():
    """What the processor says of itself; all, where it says nothing."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return file.read()
    except OSError:
        return "avx2 avx512"


if __name__ == "__main__":
    main()
