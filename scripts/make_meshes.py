#!/usr/bin/python3
"""Makes the mesh files of the flanging scene in 3D, in millimetres, into meshes/.

    scripts/make_meshes.py [FOLDER]

sheet_strip.msh  the sheet: 20 x 10 x 0.93 along x, y, z, hexahedra by gmsh
die.stl          below the sheet: flat top, an edge of radius 1 at x = 10, vertical wall
punch.stl        above the sheet, beside the wall: it moves down and folds the sheet

It needs the command gmsh (Debian package gmsh) and numpy.
"""
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

LENGTH, WIDTH, THICKNESS = 20.0, 10.0, 0.93
CELLS_ACROSS, CELLS_THROUGH = 5, 3
BEND = (8.0, 14.0)                  # x between which cells are evenly short
CELLS = (12, 20, 10)                # before, in and after the bend
GROWTH = (1.137, 1.0, 1.145)        # from cell to cell, away from the bend

EDGE_RADIUS = 1.0                   # of die and punch
DIE_WALL = 10.0                     # x of the die's vertical wall
CLEARANCE = 0.1                     # between folded sheet and punch
TOOL_WIDTH = (-2.0, 12.0)           # y of both tools
ARC_FACETS = 16                     # for 90 degrees


def sheet_geometry():
    """The .geo text of the sheet: a line of three pieces, swept along y and z."""
    before, inside, after = CELLS
    return f"""
Point(1) = {{0, 0, 0}}; Point(2) = {{{BEND[0]}, 0, 0}}; Point(3) = {{{BEND[1]}, 0, 0}}; Point(4) = {{{LENGTH}, 0, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}};
Transfinite Curve{{1}} = {before + 1} Using Progression {1 / GROWTH[0]};
Transfinite Curve{{2}} = {inside + 1};
Transfinite Curve{{3}} = {after + 1} Using Progression {GROWTH[2]};
bottom[] = {{}}; front[] = {{}}; back[] = {{}}; top[] = {{}}; sheet[] = {{}};
For i In {{1:3}}
  across[] = Extrude{{0, {WIDTH}, 0}}{{ Curve{{i}}; Layers{{{CELLS_ACROSS}}}; Recombine; }};
  bottom[] += across[1];
EndFor
For i In {{0:2}}
  up[] = Extrude{{0, 0, {THICKNESS}}}{{ Surface{{bottom[i]}}; Layers{{{CELLS_THROUGH}}}; Recombine; }};
  top[] += up[0]; sheet[] += up[1];
EndFor
e = 1e-3;
Physical Volume("sheet") = {{sheet[]}};
Physical Surface("bottom") = {{bottom[]}};
Physical Surface("top") = {{top[]}};
Physical Surface("clamped") = Surface In BoundingBox{{-e, -e, -e, e, {WIDTH} + e, {THICKNESS} + e}};
Physical Surface("free_end") = Surface In BoundingBox{{{LENGTH} - e, -e, -e, {LENGTH} + e, {WIDTH} + e, {THICKNESS} + e}};
Physical Surface("front") = Surface In BoundingBox{{-e, -e, -e, {LENGTH} + e, e, {THICKNESS} + e}};
Physical Surface("back") = Surface In BoundingBox{{-e, {WIDTH} - e, -e, {LENGTH} + e, {WIDTH} + e, {THICKNESS} + e}};
"""


def write_msh(path, text):
    """Meshes the .geo text with gmsh."""
    with tempfile.TemporaryDirectory() as folder:
        geometry = pathlib.Path(folder) / "body.geo"
        geometry.write_text(text)
        subprocess.run(["gmsh", "-3", "-format", "msh41", str(geometry), "-o", str(path)],
                       check=True, stdout=subprocess.DEVNULL)


def arc(centre, start_deg, end_deg, radius=EDGE_RADIUS, facets=ARC_FACETS):
    angles = np.radians(np.linspace(start_deg, end_deg, facets + 1))
    return [(centre[0] + radius * np.cos(a), centre[1] + radius * np.sin(a)) for a in angles]


def die_section():
    """x, z of the die, counter-clockwise as seen from the front (-y); the first
    corner is the one opposite the rounded edge."""
    return [(-2, -12), (DIE_WALL, -12),
            *arc((DIE_WALL - EDGE_RADIUS, -EDGE_RADIUS), 0, 90), (-2, 0)]


def punch_section():
    face = DIE_WALL + THICKNESS + CLEARANCE
    centre = (face + EDGE_RADIUS, THICKNESS + EDGE_RADIUS)
    return [(24, 8), (face, 8), *arc(centre, 180, 270), (24, THICKNESS)]


def sweep(rings):
    """The closed surface through rings of corners, one ring after the other; the first and
    the last are closed by convex faces. Corners on an axis are the same in all rings. Triangles n x 3 x 3."""
    first, last = np.asarray(rings[0]), np.asarray(rings[-1])
    triangles = []
    for i in range(1, len(first) - 1):
        triangles += [(first[0], first[i], first[i + 1]), (last[0], last[i + 1], last[i])]
    for near, far in zip(np.asarray(rings[:-1]), np.asarray(rings[1:])):
        for i in range(len(near)):
            j = (i + 1) % len(near)
            triangles += [(near[i], far[i], far[j]), (near[i], far[j], near[j])]
    triangles = np.array(triangles)
    edges = triangles[:, 1:] - triangles[:, :1]
    return triangles[np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) > 0]


def straight(section):
    """A section in x, z swept over the tools' width."""
    return sweep([[(x, y, z) for x, z in section] for y in TOOL_WIDTH])


def turned(section, start_deg, end_deg, facets):
    """A convex section in r, z, counter-clockwise as seen from -y, turned about the z axis."""
    angles = [math.radians((start_deg + end_deg) / 2 + (end_deg - start_deg) * (i / facets - 0.5)) for i in range(facets + 1)]
    return sweep([[(r * math.cos(a), r * math.sin(a), z) for r, z in section] for a in angles])


def write_stl(path, triangles):
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    lines = [f"solid {path.stem}"]
    for normal, corners in zip(normals, triangles):
        lines.append("facet normal {:.7g} {:.7g} {:.7g}".format(*(normal + 0.0)))
        lines.append("  outer loop")
        lines += ["    vertex {:.9g} {:.9g} {:.9g}".format(*(corner + 0.0)) for corner in corners]
        lines += ["  endloop", "endfacet"]
    lines.append(f"endsolid {path.stem}")
    path.write_text("\n".join(lines) + "\n")


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "meshes"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    write_msh(folder / "sheet_strip.msh", sheet_geometry())
    write_stl(folder / "die.stl", straight(die_section()))
    write_stl(folder / "punch.stl", straight(punch_section()))
    for name in ("sheet_strip.msh", "die.stl", "punch.stl"):
        print(folder / name, (folder / name).stat().st_size, "bytes")


if __name__ == "__main__":
    main()
