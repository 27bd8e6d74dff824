#!/usr/bin/env python3
"""Draws the forming limit diagram of a run, from its result.h5: the principal strains of every surface
facet of the sheets, the larger over the smaller, true strains. Of bodies whose material has a forming limit they are those of the middle of the sheet, and its curve is drawn.

The sheet is the facets whose nodes are all in the set `top` or all in `bottom` of their body (or in the other two sides that its thickness is between, as `inside` and `outside` of a tube); --set
chooses others, and shows the strains of the surface itself. A limit curve, given as a CSV of rows "minor,major" in true strain, is drawn with it, and
what share of the area that it had when the run began lies beyond it is printed.
"""
import argparse
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from result_fields import add_frame_options, opened, pick_frame, title, write_picture


def sides_of_the_sheets(result, wanted):
    """{set: which facets of the surface are in it}, over all bodies that have it."""
    facets = result["topology/surface"][:]
    body = result["topology/body"][:][result["topology/surface_element"][:]]
    sides, known = {}, set()
    for index in result["bodies"]:
        sets = result["bodies"][index]["sets"].values()
        names = {group.attrs["name"] for group in sets}
        known |= names
        of_body = wanted or result["bodies"][index].attrs.get("thickness_between", "bottom top").split()
        for group in sets:
            name = group.attrs["name"]
            if name not in of_body:
                continue
            inside = np.zeros(len(result["topology/initial_positions"]), bool)
            inside[group["nodes"][:]] = True
            sides[name] = sides.get(name, False) | (inside[facets].all(axis=1) & (body == int(index)))
    sides = {name: chosen for name, chosen in sides.items() if chosen.any()}
    if not sides:
        sought = " or ".join(wanted or ["top", "bottom"])
        sys.exit(f"--set: no surface facet lies in {sought}; the bodies have the sets {', '.join(sorted(known)) or 'none'}")
    return sides


def weight_of_facets(result):
    """Area at the start, of a section per width or per radian."""
    points, facets = result["topology/initial_positions"][:], result["topology/surface"][:]
    if facets.shape[1] == 2:
        a, b = points[facets[:, 0]], points[facets[:, 1]]
        return np.linalg.norm(b - a, axis=1) * ((a + b)[:, 0] / 2 if result.attrs["axisymmetric"] else 1)
    a, b, c = (points[facets[:, k]] for k in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def read_limit(path):
    """(minor, major), by increasing minor strain."""
    try:
        with open(path, newline="") as file:
            rows = [row for row in csv.reader(file) if row and not row[0].lstrip().startswith("#")]
    except (OSError, UnicodeDecodeError) as error:
        sys.exit(f"--limit: {path} cannot be read: {error}")
    try:
        points = np.array([[float(number) for number in row] for row in rows[0 if rows and is_number(rows[0][0]) else 1:]])
    except ValueError:
        sys.exit(f"--limit: {path} holds a row that is not two numbers; give rows minor,major, below one line of names at most")
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
        sys.exit(f"--limit: {path} holds no curve; give two rows minor,major or more")
    return points[np.argsort(points[:, 0])].T


def limit_of_the_scene(result):
    """(minor, major) of the sheets' material, level beyond its ends as in the run; None where it has none."""
    curves = [body["forming_limit"][:] for body in result["bodies"].values() if "forming_limit" in body]
    if not curves:
        return None
    if any(curve.shape != curves[0].shape or (curve != curves[0]).any() for curve in curves):
        sys.exit("the bodies have several limit curves; give one with --limit, and the sets of its body with --set")
    (first, left), (last, right) = curves[0][0], curves[0][-1]
    return np.array([(min(first, 0) - 5, left), *curves[0], (max(last, 0) + 5, right)]).T


def strains(frame, wanted):
    """(major, minor, of what) per facet: of the middle of the sheets with a forming limit, nan elsewhere, where no other surface is asked for."""
    if not wanted and "membrane_strain" in frame:
        return frame["membrane_strain"][:], frame["membrane_strain_minor"][:], "middle"
    return frame["surface_strain"][:], frame["surface_strain_minor"][:], "surface"


def is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_frame_options(parser)
    parser.add_argument("--set", action="append", default=[], help="a set of the surface; can be given again; default: the two sides that the thickness is between")
    parser.add_argument("--limit", help="CSV of a limit curve: rows minor,major, true strains; default: that of the scene")
    options = parser.parse_args()

    with opened(options.result) as result:
        frame = pick_frame(result, options)
        sides = sides_of_the_sheets(result, options.set)
        major, minor, surface = strains(frame, options.set)
        sides = {name: chosen & np.isfinite(major) for name, chosen in sides.items()}
        limit = read_limit(options.limit) if options.limit else limit_of_the_scene(result)
        weight = weight_of_facets(result)
        heading = title(result, frame)

    figure, axes = plt.subplots(figsize=(7, 6), layout="constrained")
    shown = np.any(list(sides.values()), axis=0)
    for name, chosen in sides.items():
        axes.plot(minor[chosen], major[chosen], ".", markersize=3, label=name)
    low = min(minor[shown].min(), -0.05)
    high = max(major[shown].max(), 0.1)
    for ratio, name in ((-0.5, "uniaxial"), (0, "plane strain"), (1, "equibiaxial")):
        reach = high if ratio <= 0 else min(high, max(minor[shown].max(), 0.05))
        axes.plot([0, ratio * reach], [0, reach], color="0.75", linewidth=0.8, zorder=0)
        axes.annotate(name, (ratio * reach, reach), fontsize=8, color="0.5", ha="center", va="bottom")
    if limit is not None:
        limit_minor, limit_major = limit
        axes.plot(limit_minor, limit_major, color="black", linewidth=1.4, label="limit")
        under = shown & (minor >= limit_minor[0]) & (minor <= limit_minor[-1])
        if not under.any():
            sys.exit(f"--limit: the curve goes from {limit_minor[0]:g} to {limit_minor[-1]:g}, the sheet's minor strains from {minor[shown].min():.4g} to {minor[shown].max():.4g}")
        reached = np.full(len(major), np.nan)
        reached[under] = major[under] / np.interp(minor[under], limit_minor, limit_major)
        print(f"beyond the limit: {100 * weight[under & (reached > 1)].sum() / weight[shown].sum():.3g} % of the sheet; the most strained facet is at {100 * np.nanmax(reached):.3g} % of it")
        if not under[shown].all():
            print(f"outside of the curve's range: {100 * weight[shown & ~under].sum() / weight[shown].sum():.3g} % of the sheet")
        high = max(high, np.interp(np.clip(0, limit_minor[0], limit_minor[-1]), limit_minor, limit_major))
    axes.set_xlim(1.15 * low, 1.6 * max(minor[shown].max(), 0.05))
    axes.set_ylim(min(1.1 * major[shown].min(), -0.02 * high), 1.15 * high)
    axes.set_xlabel(f"smaller principal strain of the {surface} (true)")
    axes.set_ylabel(f"larger principal strain of the {surface} (true)")
    axes.set_title(heading, fontsize=10)
    axes.legend(frameon=False, fontsize=9, loc="center left", bbox_to_anchor=(1, 0.5))
    output = options.output or os.path.join(os.path.dirname(options.result), "forming_limit.png")
    write_picture(figure, output, dpi=150)


main()
