"""The page of speed and convergence, from what `make bench` has measured."""

import shutil


def table(path):
    return [line for line in path.read_text().split("\n")
            if line.startswith("|")]


def measurements_page(build, source):
    """The page's lines; how to measure, where nobody has yet."""
    page = ["# Speed and convergence", "",
            "Measured by `make bench` on the machine that made this book. "
            "Samples of different estimators are not worth the same, so the "
            "first table has the *efficiency*: one over variance times time, "
            "relative to the first of each pair. Twice the efficiency is the "
            "same picture in half the time.", ""]
    efficiency, bench = build / "efficiency.md", build / "bench.md"
    chart = build / "convergence.svg"
    if not (efficiency.exists() and bench.exists() and chart.exists()):
        return [*page, "This book was made before anything was measured: run "
                "`make bench`, and then `make book` again.", ""]
    (source / "figures").mkdir(parents=True, exist_ok=True)
    shutil.copy(chart, source / "figures/convergence.svg")
    return [*page, *table(efficiency), "",
            "![Noise against time for each estimator]"
            "(figures/convergence.svg)", "",
            "All lines fall with slope -1/2: half the noise costs four times "
            "the time, whichever estimator it is. The lower line is the "
            "better one.", "",
            "## What everything costs", "", *table(bench), ""]
