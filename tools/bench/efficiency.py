"""Compares estimators at equal quality, by variance times time.

    python3 -m tools.bench.efficiency [--chart build/convergence.svg]

A picture of n samples has the variance v/n and takes n t seconds, so half the
variance costs twice the time for any n, and the efficiency 1/(v t) measures how
good an estimator is. v is the mean variance of a sample over all pixels and
channels, measured as half the mean squared difference of two pictures with the
same sample count and different seeds. The chart shows the remaining noise
against the time, both logarithmic: all lines fall with slope -1/2, and the lower
one is the better. Needs only the standard library.
"""

import argparse
import math
import pathlib
import tempfile

from tools.tree import SCENES, read_pfm, render
from tools.weave.drawing import curve, line, svg, text

COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"]

# A name, a scene, and the two estimators.
COMPARISONS = [
    (
        "finding the lamp or asking it",
        "cornell_box_lamp_diffuse",
        [("stage 1", "stage1", []), ("stage 2", "stage2", [])],
    ),
    (
        "all lobes or one",
        "plastic",
        [("stage 3", "stage3", ["--max-bounces", "6"]), ("stage 4", "stage4", ["--max-bounces", "6"])],
    ),
    (
        "uniform or cosine",
        "cornell_box_ceiling_diffuse",
        [("uniform", "stage1", ["--sampling", "uniform"]), ("cosine", "stage1", ["--sampling", "cosine"])],
    ),
]


def paint(program, arguments, scene, spp, seed):
    """Seconds, and the picture's values."""
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / "picture.pfm"
        options = f"--size 128x128 --spp {spp} --seed {seed}".split()
        report = render(program, SCENES / f"{scene}.toml", picture, *options, *arguments)
        *_, pixels = read_pfm(picture)
    return report["seconds"], [channel for pixel in pixels for channel in pixel]


def measure(program, arguments, scene, counts):
    """For each count of samples, the seconds and the remaining variance."""
    points = []
    for spp in counts:
        time_a, a = paint(program, arguments, scene, spp, 1)
        time_b, b = paint(program, arguments, scene, spp, 2)
        variance = sum((x - y) ** 2 for x, y in zip(a, b)) / len(a) / 2
        points.append((min(time_a, time_b), variance))
    return points


def chart(curves):
    """The root of the variance against time, as SVG."""
    curves = [(name, [(math.log10(t), math.log10(v) / 2) for t, v in points]) for name, points in curves]
    xs, ys = zip(*(point for _, points in curves for point in points))
    left, right = math.floor(min(xs)), math.ceil(max(xs))
    low, high = math.floor(min(ys)), math.ceil(max(ys))

    def at(x, y):
        return 60 + 410 * (x - left) / (right - left), 360 - 300 * (y - low) / (high - low)

    title = "standard deviation of a pixel, against rendering time"
    shapes = ['<rect width="640" height="420" fill="white"/>', text(60, 30, title, anchor="start")]
    for x in range(left, right + 1):
        shapes.append(line(*at(x, low), *at(x, high), "#ddd", 1))
        shapes.append(text(at(x, low)[0], 378, f"{10.0**x:g} s", size=13))
    for y in range(low, high + 1):
        shapes.append(line(*at(left, y), *at(right, y), "#ddd", 1))
        shapes.append(text(54, at(left, y)[1] + 4, f"{10.0**y:g}", anchor="end", size=13))
    for i, (name, points) in enumerate(curves):
        color, dash, y = COLORS[i // 2 % len(COLORS)], "" if i % 2 else "6 4", 60 + 20 * i
        shapes.append(curve([at(*point) for point in points], color, 2, dash))
        shapes.append(line(480, y, 510, y, color, 2, dash=dash))
        shapes.append(text(516, y + 4, name, anchor="start", size=13))
    return svg(shapes, 640, 420)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--chart", type=pathlib.Path)
    parser.add_argument("--max-samples", default=64, type=int)
    options = parser.parse_args()
    counts = [1 << i for i in range(2, options.max_samples.bit_length(), 2)]
    curves = []
    print("| question | scene | estimator | variance of a sample | µs per sample | efficiency |")
    print("|---|---|---|---|---|---|")
    for question, scene, estimators in COMPARISONS:
        first = None
        for name, program, arguments in estimators:
            points = measure(program, arguments, scene, counts)
            curves.append((name, points))
            seconds, variance = points[-1]
            each = seconds / (128 * 128 * counts[-1])
            efficiency = 1 / (variance * seconds)
            first = first or efficiency
            print(
                f"| {question} | {scene} | {name} |"
                f" {variance * counts[-1]:.3g} | {each * 1e6:.3g} |"
                f" {efficiency / first:.2f} |",
                flush=True,
            )
    if options.chart:
        options.chart.write_text(chart(curves))
        print(f"\nThe chart is {options.chart}")


if __name__ == "__main__":
    main()
