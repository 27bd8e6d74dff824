#!/usr/bin/env python3
"""Draws the force on a tool, from the history.csv of a run: over its stroke; of a tool that rests over that of the tool that moves most, or over time."""
import argparse
import csv
import os
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from result_fields import write_picture

AXES = "xyz"
RESTS = 0.01  # of the longest way


def read_columns(path):
    """Column name -> values; text stays text, an empty number is NaN."""
    try:
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        sys.exit(f"{path}: cannot be read as the history.csv of a run: {error}")
    if rows and "stage" not in rows[0]:
        sys.exit(f"{path}: has no column stage, so it is not the history.csv of a run")
    if len(rows) < 2:
        sys.exit(f"{path}: holds no rows yet")
    columns = {}
    for name, *values in zip(*rows):
        try:
            columns[name] = np.array([float(value) if value else np.nan for value in values])
        except ValueError:
            columns[name] = np.array(values)
    return columns


def tools(columns):
    """Tool name -> (positions, forces), n x 3 each."""
    found = {}
    for column in columns:
        match = re.fullmatch(r"tool_(.*)_force_x_(N|N_per_m)", column)
        if match:
            name, unit = match.groups()
            found[name] = (np.stack([columns[f"tool_{name}_position_{a}_m"] for a in AXES], axis=1),
                           np.stack([columns[f"tool_{name}_force_{a}_{unit}"] for a in AXES], axis=1))
    return found


def travel(positions):
    """Displacement from the start, where it is greatest along any one axis: (axis, displacement)."""
    displacement = positions - positions[0]
    axis = int(np.argmax(np.abs(displacement).max(axis=0)))
    return axis, displacement[:, axis]


def way_of(name, all_tools, times):
    """(values, unit, label) of what the force on a tool is drawn over: its own stroke, where it rests that of the tool that moves most, where all rest the time."""
    ways = {tool: np.abs(travel(positions)[1]).max() for tool, (positions, _) in all_tools.items()}
    mover = max(ways, key=ways.get)
    if ways[mover] == 0:
        return 1e3 * times, "ms", "time"
    mover = name if ways[name] > RESTS * ways[mover] else mover
    axis, displacement = travel(all_tools[mover][0])
    direction = np.sign(displacement[np.argmax(np.abs(displacement))])
    return 1e3 * direction * displacement, "mm", f"stroke of {mover} along {AXES[axis]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("history", help="history.csv of a run")
    parser.add_argument("--tool", help="name of the tool; default: the one that moves most")
    parser.add_argument("--axis", choices=list(AXES), help="direction of the force; default: in which it is largest")
    parser.add_argument("--output", help="PNG to write; default: force.png beside the history")
    options = parser.parse_args()

    columns = read_columns(options.history)
    all_tools = tools(columns)
    if not all_tools:
        sys.exit(f"{options.history}: has no tools, so there is no force to draw")
    name = options.tool or max(all_tools, key=lambda t: np.abs(travel(all_tools[t][0])[1]).max())
    if name not in all_tools:
        sys.exit(f"--tool: given {name}; the tools are {', '.join(all_tools)}")
    forces = all_tools[name][1]
    axis = AXES.index(options.axis) if options.axis else int(np.argmax(np.abs(forces).max(axis=0)))
    way, way_unit, label = way_of(name, all_tools, columns["time_s"])
    peak = int(np.argmax(np.abs(forces[:, axis])))
    sign = np.sign(forces[peak, axis]) or 1.0
    force = 1e-3 * sign * forces[:, axis]  # the largest is positive

    plane_strain = any(column.endswith("_N_per_m") for column in columns)
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    stages = columns["stage"]
    names = list(dict.fromkeys(stages))
    colours = plt.get_cmap("viridis")(np.linspace(0, 0.85, len(names)))
    for colour, stage in zip(colours, names):
        rows = np.flatnonzero(stages == stage)
        rows = np.arange(max(rows[0] - 1, 0), rows[-1] + 1)  # join the line to the stage before
        if np.ptp(way[rows]) > RESTS * np.ptp(way):  # a stage in which it goes on
            axes.plot(way[rows], force[rows], color=colour, linewidth=1.6, label=stage)
    unit = "N/mm" if plane_strain else "kN"
    axes.plot(way[peak], force[peak], "o", color="tab:red", markersize=5,
              label=f"peak {force[peak]:.4g} {unit} at {way[peak]:.3g} {way_unit}")
    axes.axhline(0, color="0.6", linewidth=0.8)
    axes.set_xlabel(f"{label} [{way_unit}]")
    axes.set_ylabel(f"force on {name} along {'-' if sign < 0 else ''}{AXES[axis]}" + (" per width" if plane_strain else "") + f" [{unit}]")
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    output = options.output or os.path.join(os.path.dirname(options.history), "force.png")
    write_picture(figure, output, dpi=150)


main()
