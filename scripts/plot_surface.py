#!/usr/bin/env python3
"""Draws a field over the deformed surface of a 3D run, from its result.h5. With a field
like contact_gap or contact_pressure one sees where the bodies touch."""
import argparse
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from result_fields import add_options, opened, pick_frame, read_on, title, write_picture

LIGHT = np.array([0.3, -0.6, 0.75])


def drawn_facets(result, wanted):
    """Which facets of the surface belong to a body of `wanted`; to any, where it is empty."""
    names = {result["bodies"][i].attrs["name"]: int(i) for i in result["bodies"]}
    for name in wanted:
        if name not in names:
            sys.exit(f"--body: given {name}; the result holds {', '.join(names)}")
    body = result["topology/body"][:][result["topology/surface_element"][:]]
    return np.isin(body, [names[name] for name in wanted]) if wanted else np.ones(len(body), bool)


def fill(axes, points):
    """Draws as large as shows all the points, in true proportions."""
    sides = np.maximum(np.ptp(points, axis=0), 1e-9)
    axes.set_box_aspect(sides)
    x, y, _ = proj3d.proj_transform(*points.T, axes.get_proj())
    pixels = axes.transData.transform(np.column_stack([x, y]))
    across = np.abs(pixels - axes.bbox.get_points().mean(axis=0)).max(axis=0)  # from the middle, where that of the box is
    axes.set_box_aspect(sides, zoom=0.5 * min(np.divide([axes.bbox.width, axes.bbox.height], np.maximum(across, 1))))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_options(parser)
    parser.add_argument("--body", action="append", default=[], help="draw this body; can be given again; default: all")
    parser.add_argument("--view", type=float, nargs=2, default=(20, -60), metavar=("ELEVATION", "AZIMUTH"), help="degrees")
    options = parser.parse_args()

    with opened(options.result) as result:
        if result.attrs["dimension"] != 3:
            sys.exit(f"{options.result}: is of dimension 2, a section without a surface to look at: scripts/plot_section.py shows it")
        frame, topology = pick_frame(result, options), result["topology"]
        points, facets = 1e3 * frame["positions"][:], topology["surface"][:]
        values, label = read_on(frame, topology, options.field, facets, topology["surface_element"][:])
        drawn = drawn_facets(result, options.body)
        heading = title(result, frame)

    triangles, values = points[facets[drawn]], values[drawn]
    low, high = options.range or (np.nanmin(values), np.nanmax(values))
    colours = plt.cm.ScalarMappable(plt.Normalize(low, high if high > low else low + 1), "turbo")
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    shade = 0.75 + 0.25 * normals @ (LIGHT / np.linalg.norm(LIGHT))
    faces = colours.to_rgba(values)
    faces[:, :3] *= shade[:, None]

    figure = plt.figure(figsize=(9, 7))
    axes = figure.add_subplot(projection="3d", proj_type="ortho")
    axes.add_collection3d(Poly3DCollection(triangles, facecolors=faces, edgecolors=faces, linewidths=0.2))
    corners = triangles.reshape(-1, 3)
    for set_limits, column in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), corners.T):
        set_limits(column.min(), column.max())
    axes.view_init(*options.view)
    fill(axes, corners)
    axes.set_axis_off()
    axes.set_title(heading, fontsize=10)
    figure.colorbar(colours, ax=axes, label=label, shrink=0.6)
    output = options.output or os.path.join(os.path.dirname(options.result), "surface.png")
    write_picture(figure, output, dpi=150, bbox_inches="tight")


main()
