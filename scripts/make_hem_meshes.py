#!/usr/bin/python3
"""Makes the mesh files of the curved hem (scenes/hem_curved.yaml), in millimetres, into meshes/.

    scripts/make_hem_meshes.py [FOLDER]

All of them are sections in r, z turned about the z axis: the sheets over a sector of
16 degrees, the tools over 20. The outer face of the flange stands at r = 30.

hem_outer.msh        outer panel, flat, 0.93 thick, r from 23 to 34.5
hem_inner.msh        inner panel, 1 thick, on the outer one, with a square edge at r = 28.4
hem_anvil.stl        below the outer panel
hem_die.stl          on the outer panel while it is flanged, over the inner panel's place
hem_flange_punch.stl ring outside the anvil: it moves up and folds the flange
hem_steel.stl        pre-hem steel: a cone of 45 degrees that comes down on the flange
hem_punch.stl        flat: it closes the hem

It needs the command gmsh (Debian package gmsh) and numpy.
"""
import math
import pathlib
import sys

from make_meshes import arc, turned, write_msh, write_stl

SECTOR_DEG, TOOL_DEG = 16.0, 20.0
TOOL_FACETS, ARC_FACETS = 10, 8     # round the z axis; in 90 degrees of an edge
OUTER, INNER = 0.93, 1.0            # thicknesses
WALL = 30.0 - OUTER                 # of the die: inner face of the standing flange
HEIGHT = 12.0                       # of the tools

# Pieces of the radius: (to, cells, growth from cell to cell), from r = 23.
FROM = 23.0
OUTER_PIECES = ((28.0, 7, 1 / 1.22), (32.0, 12, 1.0), (34.5, 6, 1.0))
INNER_PIECES = ((28.4, 9, 1 / 1.12),)


def panel_geometry(pieces, low, thickness, cells_through, cells_around):
    """The .geo text of a panel: a line along r, swept along z, turned about the z axis."""
    half = math.radians(SECTOR_DEG / 2)
    radii = [FROM] + [piece[0] for piece in pieces]
    lines = [f"Point({i + 1}) = {{{r * math.cos(half)}, {-r * math.sin(half)}, {low}}};" for i, r in enumerate(radii)]
    for i, (_, cells, growth) in enumerate(pieces, start=1):
        lines += [f"Line({i}) = {{{i}, {i + 1}}};", f"Transfinite Curve{{{i}}} = {cells + 1} Using Progression {growth};"]
    e = 1e-3
    box = "{{-50, -50, {0}, 50, 50, {1}}}"
    return "\n".join(lines) + f"""
start[] = {{}}; end[] = {{}}; panel[] = {{}};
For i In {{1:{len(pieces)}}}
  up[] = Extrude{{0, 0, {thickness}}}{{ Curve{{i}}; Layers{{{cells_through}}}; Recombine; }};
  start[] += up[1];
EndFor
For i In {{0:{len(pieces) - 1}}}
  round[] = Extrude{{{{0, 0, 1}}, {{0, 0, 0}}, {2 * half}}}{{ Surface{{start[i]}}; Layers{{{cells_around}}}; Recombine; }};
  end[] += round[0]; panel[] += round[1];
EndFor
Physical Volume("panel") = {{panel[]}};
Physical Surface("start") = {{start[]}};
Physical Surface("end") = {{end[]}};
Physical Surface("bottom") = Surface In BoundingBox{box.format(low - e, low + e)};
Physical Surface("top") = Surface In BoundingBox{box.format(low + thickness - e, low + thickness + e)};
"""


def anvil():
    return [(22, -HEIGHT), (29.97, -HEIGHT), *arc((29.67, -0.3), 0, 90, 0.3, ARC_FACETS), (22, 0)]


def die():
    return [(22, HEIGHT), (22, OUTER), *arc((WALL - 0.5, OUTER + 0.5), 270, 360, 0.5, ARC_FACETS), (WALL, HEIGHT)]


def flange_punch():                 # 0.1 beside the flange's outer face
    return [(36, -HEIGHT), (36, 0), *arc((31.1, -1.0), 90, 180, 1.0, ARC_FACETS), (30.1, -HEIGHT)]


def steel():                        # its cone on r + z = 39 at the start
    return [(31, 8), (38, 8), (38, 18), (21, 18)]


def punch():
    return [(22, 8.5), (34, 8.5), (34, 8.5 + HEIGHT), (22, 8.5 + HEIGHT)]


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "meshes"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    write_msh(folder / "hem_outer.msh", panel_geometry(OUTER_PIECES, 0, OUTER, 3, 7))
    write_msh(folder / "hem_inner.msh", panel_geometry(INNER_PIECES, OUTER, INNER, 2, 6))
    for section in (anvil, die, flange_punch, steel, punch):
        write_stl(folder / f"hem_{section.__name__}.stl", turned(section(), -TOOL_DEG / 2, TOOL_DEG / 2, TOOL_FACETS))
    for path in sorted(folder.glob("hem_*")):
        print(path, path.stat().st_size, "bytes")


if __name__ == "__main__":
    main()
