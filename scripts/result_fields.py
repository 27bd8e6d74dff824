#!/usr/bin/env python3
"""What the plots read of a result.h5: a frame, and a field of it per node, element or facet."""
import argparse
import contextlib
import re
import sys

import h5py
import numpy as np

COMPONENTS = {3: ("x", "y", "z"), 6: ("xx", "yy", "zz", "xy", "yz", "zx")}
NAMES = {"plastic_strain": "equivalent plastic strain", "mises": "von Mises stress", "volume_ratio": "volume ratio V/V0", "damage": "damage",
         "surface_strain": "largest principal strain of the surface",
         "surface_strain_minor": "smallest principal strain in the surface", "limit_ratio": "part of the forming limit",
         "membrane_strain": "largest principal strain of the middle", "membrane_strain_minor": "smallest principal strain of the middle"}
ON_SURFACE_FACETS = ("surface_strain", "surface_strain_minor", "membrane_strain", "membrane_strain_minor")
ON_SURFACE_NODES = ("contact_pressure", "contact_gap", "contact_slip")
ON_NODES = ("positions", "velocities", "thickness", "thinning", "limit_ratio", *ON_SURFACE_NODES)  # the others: on elements
SHOWN_IN = {"Pa": ("MPa", 1e-6), "m": ("mm", 1e3)}


@contextlib.contextmanager
def opened(path):
    """The result.h5 at `path`; what is missing or damaged in it ends the program with a sentence."""
    try:
        with h5py.File(path, "r") as result:
            for group in ("frames", "topology", "bodies", "tools"):
                if group not in result:
                    sys.exit(f"{path}: has no group {group}, so it is not the result.h5 of a run")
            yield result
    except (OSError, KeyError) as error:
        sys.exit(f"{path}: cannot be read as the result.h5 of a run: {error}")


def write_picture(figure, path, **options):
    try:
        figure.savefig(path, **options)
    except (OSError, ValueError) as error:
        sys.exit(f"--output: given {path}; {error}")
    print(path)


class Ends(argparse.Action):
    """Two numbers, the lower one first."""

    def __call__(self, parser, options, ends, option=None):
        if not ends[0] < ends[1]:
            parser.error(f"{option}: given {ends[0]:g} {ends[1]:g}; give the lower end first, and two that differ")
        setattr(options, self.dest, ends)


def add_frame_options(parser):
    parser.add_argument("result", help="result.h5 of a run")
    parser.add_argument("--frame", type=int, default=-1, help="number of the frame, negative: from the end; default: the last")
    parser.add_argument("--time", type=float, help="instead of --frame: the frame nearest to this time, in seconds")
    parser.add_argument("--output", help="PNG to write; default: beside the result")


def add_options(parser):
    parser._negative_number_matcher = re.compile(r"-\.?\d")  # or -3e8 is taken for an option, before Python 3.14
    add_frame_options(parser)
    parser.add_argument("--field", default="plastic_strain",
                        help="any field of the frame: plastic_strain, mises, contact_gap, stress.xx, velocities.z ...")
    parser.add_argument("--range", type=float, nargs=2, action=Ends, metavar=("LOW", "HIGH"), help="ends of the colours, in the unit of the legend")


def pick_frame(result, options):
    names = sorted(result["frames"])
    if not names:
        sys.exit("the result holds no frames yet")
    if options.time is not None:
        return min(result["frames"].values(), key=lambda frame: abs(frame.attrs["time"] - options.time))
    if not -len(names) <= options.frame < len(names):
        sys.exit(f"--frame: given {options.frame}; the result holds the frames 0 to {len(names) - 1}")
    return result["frames"][names[options.frame]]


def read_field(frame, wanted):
    """(values, label with its unit); wanted: the name of a dataset, with .component where it has several."""
    name, _, component = wanted.partition(".")
    fields = [key for key, item in frame.items() if hasattr(item, "shape")]
    if name not in fields:
        sys.exit(f"--field: given {wanted}; the frame holds {', '.join(fields)}")
    values = frame[name][:].astype(float)
    if values.ndim == 2:
        columns = COMPONENTS[values.shape[1]]
        if component not in columns:
            sys.exit(f"--field: given {wanted}; give one of {', '.join(f'{name}.{c}' for c in columns)}")
        values = values[:, columns.index(component)]
    elif component:
        sys.exit(f"--field: given {wanted}; {name} has no components")
    unit = frame[name].attrs["unit"]
    unit, scale = SHOWN_IN.get(unit, (unit, 1.0))
    label = NAMES.get(name, name.replace("_", " ")) + (f" {component}" if component else "")
    return scale * values, label + ("" if unit == "1" else f" [{unit}]")


def read_on(frame, topology, wanted, cells, cell_element):
    """(the field's value on each of `cells`, rows of nodes; its label). cell_element: the element
    that each cell is or belongs to. What lives on nodes is the mean of the cell's nodes, and of
    contact that of its surface nodes: nan inside the body, and of thickness outside of sheets."""
    values, label = read_field(frame, wanted)
    name = wanted.partition(".")[0]
    if name in ON_SURFACE_FACETS:
        if len(cells[0]) != topology["surface"].shape[1]:
            sys.exit(f"--field: given {wanted}, a field of the surface: scripts/plot_surface.py shows it in 3D")
        return values, label
    if name not in ON_NODES:
        return values[cell_element], label
    if name in ON_SURFACE_NODES:
        inside = np.ones(len(values), bool)
        inside[topology["surface"][:]] = False
        values[inside] = np.nan
    corners = values[cells]
    known = np.isfinite(corners)
    return np.where(known, corners, 0).sum(axis=1) / np.where(known.any(axis=1), known.sum(axis=1), np.nan), label


def title(result, frame):
    return f"{result.attrs['scene']}, {frame.attrs['stage']}, t = {1e3 * frame.attrs['time']:.4g} ms"
