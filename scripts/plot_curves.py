#!/usr/bin/env python3
"""Draws the curves of a figure that forming_bench wrote: a CSV with the columns series, x, y."""
import argparse
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


COLOURS = 10  # of matplotlib's cycle: what comes after has them again, with another marker
MARKERS = "os^Dv"


def read_series(path):
    """Name of a series -> (list of x, list of y), in the order of the file."""
    series = {}
    try:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                x, y = series.setdefault(row["series"], ([], []))
                x.append(float(row["x"]))
                y.append(float(row["y"]))
    except (OSError, ValueError, KeyError, TypeError) as error:
        sys.exit(f"{path}: cannot be read as rows of series, x, y: {error}")
    if not series:
        sys.exit(f"{path}: holds no rows")
    return series


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("csv")
    parser.add_argument("--title", default="")
    parser.add_argument("--x", default="x", help="label of the x axis")
    parser.add_argument("--y", default="y", help="label of the y axis")
    parser.add_argument("--logarithmic", action="store_true", help="both axes in powers of ten")
    parser.add_argument("--equal", action="store_true", help="both axes in the same scale")
    parser.add_argument("--output", required=True, help="PNG to write")
    options = parser.parse_args()

    series = read_series(options.csv)
    many = len(series) > COLOURS
    figure, axes = plt.subplots(figsize=(11 if many else 8, 5), layout="constrained")
    for index, (name, (x, y)) in enumerate(series.items()):
        # The dashed ones are what a curve is compared with.
        reference = any(word in name for word in ("exact", "measured", "analytic", "expected"))
        marker = MARKERS[index // COLOURS % len(MARKERS)] if len(x) < 12 or options.logarithmic else None
        axes.plot(x, y, "--" if reference else "-", marker=marker, markersize=4, linewidth=1.2, label=name)
    if options.logarithmic:
        axes.set_xscale("log")
        axes.set_yscale("log")
    if options.equal:
        axes.set_aspect("equal")
    axes.set_title(options.title)
    axes.set_xlabel(options.x)
    axes.set_ylabel(options.y)
    axes.grid(True, which="both", alpha=0.3)
    if options.equal or many:  # shapes fill their axes, and so do many curves
        axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1))
    else:
        axes.legend(fontsize=8)
    figure.savefig(options.output, dpi=130)


if __name__ == "__main__":
    main()
