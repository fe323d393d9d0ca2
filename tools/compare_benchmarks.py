#!/usr/bin/env python3
"""Prints a table of a benchmark run, or compares it with an earlier one.

    compare_benchmarks.py build/bench.json [base.json]

Times of one program scatter, and not like a bell: something else runs now and
then, and nothing ever runs faster than it can. So medians are compared, and
whether a difference is more than chance is asked of the ranks alone (Mann and
Whitney, "On a Test of Whether one of Two Random Variables is Stochastically
Larger than the Other", 1947). Needs only the standard library.
"""

import argparse
import json
import math
import statistics
import sys


def read(path):
    """Seconds per iteration and items per second of each repetition."""
    with open(path, encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]
    scale = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}
    table = {}
    for run in runs:
        if run.get("run_type") == "aggregate" or "error_occurred" in run:
            continue
        times, rates = table.setdefault(run["run_name"], ([], []))
        times.append(run["real_time"] * scale[run["time_unit"]])
        rates.append(run.get("items_per_second", 0))
    return table


def mann_whitney(a, b):
    """The two-sided probability that chance alone ranks a and b so unevenly.

    By the normal approximation, with the correction for ties and for
    continuity: U has mean mn/2 and variance mn(m + n + 1)/12.
    """
    m, n = len(a), len(b)
    values = sorted([(x, 0) for x in a] + [(x, 1) for x in b])
    rank_sum, ties, i = 0.0, 0, 0
    while i < m + n:
        j = i
        while j < m + n and values[j][0] == values[i][0]:
            j += 1
        rank = (i + j + 1) / 2
        rank_sum += rank * sum(1 for value in values[i:j] if value[1] == 0)
        ties += (j - i) ** 3 - (j - i)
        i = j
    u = rank_sum - m * (m + 1) / 2
    total = m + n
    variance = m * n / 12 * (total + 1 - ties / max(1, total * (total - 1)))
    if variance <= 0:
        return 1.0
    z = max(0.0, abs(u - m * n / 2) - 0.5) / math.sqrt(variance)
    return math.erfc(z / math.sqrt(2))


def with_unit(x, unit):
    for factor, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""),
                           (1e-3, "m"), (1e-6, "u")):
        if x >= factor:
            return f"{x / factor:.3g} {prefix}{unit}"
    return f"{x / 1e-9:.3g} n{unit}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("new")
    parser.add_argument("base", nargs="?")
    parser.add_argument("--chance", type=float, default=0.05,
                        help="differences less likely by chance are marked")
    options = parser.parse_args()
    try:
        new = read(options.new)
        base = read(options.base) if options.base else {}
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"compare_benchmarks.py: {error}")

    print(f"| {'benchmark':<48} | {'median':>9} | {'items':>11} |"
          + (f" {'speed':>6} | {'chance':>6} |" if base else ""))
    print("|---|---|---|" + ("---|---|" if base else ""))
    for name, (times, rates) in new.items():
        median = statistics.median(times)
        rate = statistics.median(rates)
        line = (f"| {name:<48} | {with_unit(median, 's'):>9} |"
                f" {with_unit(rate, '/s') if rate else '':>11} |")
        if name in base:
            before = base[name][0]
            chance = mann_whitney(before, times)
            mark = " *" if chance < options.chance else ""
            line += (f" {statistics.median(before) / median:>6.2f} |"
                     f" {chance:>6.3f} |{mark}")
        print(line)
    if base:
        print("\nspeed: how many times as fast as before, by medians; "
              f"* where chance is below {options.chance}")
        missing = sorted(set(base) - set(new))
        if missing:
            print("only in the base: " + ", ".join(missing))


if __name__ == "__main__":
    main()
