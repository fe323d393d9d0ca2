"""What equal quality costs: compares estimators by variance times time.

    python3 -m tools.bench.efficiency [--chart build/convergence.svg]

A picture of n samples has the variance v/n and takes n t seconds, so twice
the quality costs twice the time whatever n is, and 1/(v t) alone says how
good an estimator is. v is the mean variance of a sample over all pixels and
channels, measured as half the mean squared difference of two pictures of one
sample count and different seeds. The chart shows the noise that is left
against the time spent, both logarithmic: all lines fall with slope -1/2, and
the lower one is the better. Needs only the standard library.
"""

import argparse
import math
import pathlib
import tempfile

from compare.stages import SCENES, read_pfm, render

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"]

# A name, a scene, and the two that are compared.
COMPARISONS = [
    (
        "finding the lamp or asking it",
        "cornell_box_lamp_diffuse",
        [("stage 1", "stage1", []), ("stage 2", "stage2", [])],
    ),
    (
        "all lobes or one",
        "plastic",
        [
            ("stage 3", "stage3", ["--max-bounces", "6"]),
            ("stage 4", "stage4", ["--max-bounces", "6"]),
        ],
    ),
    (
        "uniform or cosine",
        "cornell_box_ceiling_diffuse",
        [
            ("uniform", "stage1", ["--sampling", "uniform"]),
            ("cosine", "stage1", ["--sampling", "cosine"]),
        ],
    ),
]


def paint(program, arguments, scene, spp, seed):
    """Seconds, and the picture's numbers."""
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / "picture.pfm"
        report = render(
            program,
            SCENES / f"{scene}.toml",
            picture,
            "--size",
            "128x128",
            "--spp",
            spp,
            "--seed",
            seed,
            *arguments,
        )
        *_, pixels = read_pfm(picture)
    return report["seconds"], [channel for pixel in pixels for channel in pixel]


def measure(program, arguments, scene, counts):
    """For each count of samples, the seconds and the variance left."""
    points = []
    for spp in counts:
        time_a, a = paint(program, arguments, scene, spp, 1)
        time_b, b = paint(program, arguments, scene, spp, 2)
        variance = sum((x - y) ** 2 for x, y in zip(a, b)) / len(a) / 2
        points.append((min(time_a, time_b), variance))
    return points


def chart(curves):
    """The root of the variance against time, as SVG."""
    width, height, margin = 640, 420, 60
    xs = [math.log10(t) for _, points in curves for t, _ in points]
    ys = [math.log10(v) / 2 for _, points in curves for _, v in points]
    low_x, high_x = math.floor(min(xs)), math.ceil(max(xs))
    low_y, high_y = math.floor(min(ys)), math.ceil(max(ys))

    def at(t, v):
        x = (math.log10(t) - low_x) / (high_x - low_x)
        y = (math.log10(v) / 2 - low_y) / (high_y - low_y)
        return (margin + x * (width - margin - 170), height - margin - y * (height - 2 * margin))

    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} '
        f'{height}" font-family="sans-serif" font-size="13">',
        f'<rect width="{width}" height="{height}" fill="white"/>',
    ]
    for power in range(low_x, high_x + 1):
        x, bottom = at(10.0**power, 10.0 ** (2 * low_y))
        _, top = at(10.0**power, 10.0 ** (2 * high_y))
        lines.append(f'<path d="M{x:.1f} {bottom:.1f}V{top:.1f}" stroke="#ddd"/>')
        lines.append(
            f'<text x="{x:.1f}" y="{bottom + 18:.1f}" text-anchor="middle">{10.0**power:g} s</text>'
        )
    for power in range(low_y, high_y + 1):
        left, y = at(10.0**low_x, 10.0 ** (2 * power))
        right, _ = at(10.0**high_x, 10.0 ** (2 * power))
        lines.append(f'<path d="M{left:.1f} {y:.1f}H{right:.1f}" stroke="#ddd"/>')
        lines.append(
            f'<text x="{left - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{10.0**power:g}</text>'
        )
    lines.append(
        f'<text x="{margin}" y="30">standard deviation of a pixel, against rendering time</text>'
    )
    for i, (name, points) in enumerate(curves):
        color = COLOURS[i // 2 % len(COLOURS)]
        dashes = ' stroke-dasharray="6 4"' if i % 2 == 0 else ""
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (at(*point) for point in points))
        lines.append(
            f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="2"{dashes}/>'
        )
        y = margin + 20 * i
        lines.append(f'<path d="M{width - 160} {y}h30" stroke="{color}" stroke-width="2"{dashes}/>')
        lines.append(f'<text x="{width - 124}" y="{y + 4}">{name}</text>')
    return "\n".join([*lines, "</svg>"]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--chart", type=pathlib.Path)
    parser.add_argument("--most-samples", default=64, type=int)
    options = parser.parse_args()
    counts = [1 << i for i in range(2, options.most_samples.bit_length(), 2)]
    curves = []
    print("| question | scene | estimator | variance of a sample | us per sample | efficiency |")
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
