#!/usr/bin/python3
"""Makes the mesh files of the flanging scene in 3D, in millimetres, into meshes/.

    scripts/make_meshes.py [FOLDER]

sheet_strip.msh  the sheet: 20 x 10 x 0.93 along x, y, z, hexahedra by gmsh
die.stl          below the sheet: flat top, an edge of radius 1 at x = 10, vertical wall
punch.stl        above the sheet, beside the wall: it moves down and folds the sheet

It needs the command gmsh (Debian package gmsh) and numpy.
"""
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


def write_sheet(path):
    with tempfile.TemporaryDirectory() as folder:
        geometry = pathlib.Path(folder) / "sheet.geo"
        geometry.write_text(sheet_geometry())
        subprocess.run(["gmsh", "-3", "-format", "msh41", str(geometry), "-o", str(path)],
                       check=True, stdout=subprocess.DEVNULL)


def arc(centre, start_deg, end_deg):
    angles = np.radians(np.linspace(start_deg, end_deg, ARC_FACETS + 1))
    return [(centre[0] + EDGE_RADIUS * np.cos(a), centre[1] + EDGE_RADIUS * np.sin(a)) for a in angles]


def die_section():
    """x, z of the die, counter-clockwise as seen from the front (-y); the first
    corner is the one opposite the rounded edge."""
    return [(-2, -12), (DIE_WALL, -12),
            *arc((DIE_WALL - EDGE_RADIUS, -EDGE_RADIUS), 0, 90), (-2, 0)]


def punch_section():
    face = DIE_WALL + THICKNESS + CLEARANCE
    centre = (face + EDGE_RADIUS, THICKNESS + EDGE_RADIUS)
    return [(24, 8), (face, 8), *arc(centre, 180, 270), (24, THICKNESS)]


def sweep(section):
    """The closed surface of a convex section swept over the tools' width, triangles n x 3 x 3."""
    near = [np.array([x, TOOL_WIDTH[0], z]) for x, z in section]
    far = [np.array([x, TOOL_WIDTH[1], z]) for x, z in section]
    triangles = []
    for i in range(1, len(section) - 1):
        triangles += [(near[0], near[i], near[i + 1]), (far[0], far[i + 1], far[i])]
    for i in range(len(section)):
        j = (i + 1) % len(section)
        triangles += [(near[i], far[i], far[j]), (near[i], far[j], near[j])]
    return np.array(triangles)


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
    write_sheet(folder / "sheet_strip.msh")
    write_stl(folder / "die.stl", sweep(die_section()))
    write_stl(folder / "punch.stl", sweep(punch_section()))
    for name in ("sheet_strip.msh", "die.stl", "punch.stl"):
        print(folder / name, (folder / name).stat().st_size, "bytes")


if __name__ == "__main__":
    main()
