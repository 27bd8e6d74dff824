#!/usr/bin/env python3
"""Draws a field over the deformed section of a run, with the tools, from its result.h5.

In dimension 2 the section is the model; in 3D it is a cut normal to y, beside the plane of
symmetry of a half or quarter, else half way along the blank's width. Tools that have left are drawn pale where they last stood.
"""
import argparse
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from result_fields import add_options, opened, pick_frame, read_on, title, write_picture

NEAR = 1e-3  # of the blank's size

def cut(points, simplices, axis, at):
    """Cuts triangles or tetrahedra at coordinate `at`: (polygons in the other two axes, index of each one's simplex)."""
    kept = [i for i in range(3) if i != axis]
    height = points[simplices][:, :, axis] - at
    crossed = np.flatnonzero((height.min(axis=1) < 0) & (height.max(axis=1) >= 0))
    polygons = []
    for corners, h in zip(simplices[crossed], height[crossed]):
        below, above = corners[h < 0], corners[h >= 0]
        low, high = h[h < 0], h[h >= 0]
        cuts = [[points[a] + (points[b] - points[a]) * (ha / (ha - hb)) for b, hb in zip(above, high)]
                for a, ha in zip(below, low)]
        if len(cuts) == 2 and len(cuts[0]) == 2:  # a quadrilateral, in order around it
            ring = [cuts[0][0], cuts[0][1], cuts[1][1], cuts[1][0]]
        else:
            ring = [point for row in cuts for point in row]
        polygons.append(np.array(ring)[:, kept])
    return polygons, crossed


def last_pose(result, frame, index):
    """Where a tool stands in a frame; one that has left: where it last stood."""
    time = frame.attrs["time"]
    poses = [f["tools"][index] for f in result["frames"].values() if f.attrs["time"] <= time]
    there = [pose for pose in poses if pose.attrs["present"]]
    return (there or poses)[-1]


def tool_lines(result, frame, axis, at):
    """(segments of the tools with a surface that are there, of those that have left,
    (point, normal) of the rigid planes)."""
    segments, left, planes = [], [], []
    for index in sorted(result["tools"], key=int):
        shape, pose = result["tools"][index], last_pose(result, frame, index)
        present = frame["tools"][index].attrs["present"]
        if "facets" in shape:
            points, facets = pose["points"][:], shape["facets"][:]
            lines = list(points[facets][:, :, :2]) if axis is None else cut(points, facets, axis, at)[0]
            (segments if present else left).extend(lines)
        else:
            point = pose["position"][:] + pose["rotation"][:] @ shape["plane_point"][:]
            normal = pose["rotation"][:] @ shape["plane_normal"][:]
            kept = [0, 1] if axis is None else [i for i in range(3) if i != axis]
            if np.linalg.norm(normal[kept]) > 0.5:
                planes.append((point[kept], normal[kept]))
    return segments, left, planes


def where_to_cut(result, points, axis):
    """Beside the plane of symmetry of a half or quarter; else half way, a little off, where a mesh has its nodes."""
    at = points[:, "xyz".index(axis)]
    for body in result["bodies"].values():
        for group in body["sets"].values():
            if group.attrs["name"] == "symmetry_" + axis:
                return at[group["nodes"][:]].mean()
    return at.min() + 0.5003 * (at.max() - at.min())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser)
    parser.add_argument("--axis", choices=list("xyz"), default="y", help="3D: the cut is normal to this axis")
    parser.add_argument("--at", type=float, help="3D: where to cut, in metres; default: beside the set symmetry_AXIS of a half or quarter, else half way through the blank")
    options = parser.parse_args()

    with opened(options.result) as result:
        frame = pick_frame(result, options)
        points, elements = frame["positions"][:], result["topology/elements"][:]
        values, label = read_on(frame, result["topology"], options.field, elements, np.arange(len(elements)))
        axis, at, names = None, 0.0, "xy"
        if result.attrs["dimension"] == 2:
            if options.at is not None:
                sys.exit(f"--at: given {options.at}; the result is a section itself, there is nothing to cut")
            polygons = list(points[elements][:, :, :2])
        else:
            axis = "xyz".index(options.axis)
            names = "xyz".replace(options.axis, "")
            low, high = points[:, axis].min(), points[:, axis].max()
            at = where_to_cut(result, points, options.axis) if options.at is None else options.at
            if low - NEAR * (high - low) <= at <= high + NEAR * (high - low):  # on an end: a little inside
                at = float(np.clip(at, low + NEAR * (high - low), high - NEAR * (high - low)))
            polygons, crossed = cut(points, elements, axis, at)
            values = values[crossed]
            if not polygons:
                sys.exit(f"--at: given {at}; the blank lies between {low:.6g} and {high:.6g} m")
        segments, left, planes = tool_lines(result, frame, axis, at)
        turned = result.attrs["axisymmetric"]
        heading = title(result, frame)
        if axis is not None:
            heading += f", cut at {options.axis} = {1e3 * at:.4g} mm"

    polygons = [1e3 * polygon for polygon in polygons]
    corners = np.concatenate(polygons)
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 0.08 * (high - low).max()
    extent = high - low + 2 * margin
    figure, axes = plt.subplots(figsize=(8, float(np.clip(8 * extent[1] / extent[0], 2.8, 9)) + 0.4), layout="constrained")
    blank = PolyCollection(polygons, array=np.ma.masked_invalid(values), cmap=matplotlib.colormaps["turbo"].copy(), edgecolors="face", linewidths=0.2, zorder=2)
    blank.cmap.set_bad("0.85")  # inside, where a field of the surface is not known
    if options.range:
        blank.set_clim(*options.range)
    elif options.field == "plastic_strain":
        blank.set_clim(0, max(values.max(), 1e-12))
    axes.add_collection(blank)
    axes.add_collection(LineCollection([1e3 * np.asarray(s) for s in segments], colors="0.25", linewidths=1.4, zorder=3))
    if left:
        axes.add_collection(LineCollection([1e3 * np.asarray(s) for s in left], colors="0.7", linewidths=1.0, zorder=1))
        axes.plot([], [], color="0.7", linewidth=1.0, label="tools that have left")
        axes.legend(frameon=False, loc="best", fontsize=9)
    for point, normal in planes:
        along = np.array([-normal[1], normal[0]])
        axes.axline(1e3 * point, 1e3 * point + along, color="0.25", linewidth=1.4, zorder=3)
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_aspect("equal")
    axes.set_xlabel("radius x [mm]" if turned else f"{names[0]} [mm]")
    axes.set_ylabel(f"{names[1]} [mm]")
    axes.set_title(heading, fontsize=10)
    figure.colorbar(blank, ax=axes, label=label, shrink=0.8)
    output = options.output or os.path.join(os.path.dirname(options.result), "section.png")
    write_picture(figure, output, dpi=150, bbox_inches="tight")


main()
