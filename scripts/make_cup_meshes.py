#!/usr/bin/python3
"""Makes the tools of the cup in 3D (scenes/cup_3d.yaml), in millimetres, into meshes/.

    scripts/make_cup_meshes.py [FOLDER]

They are those of scenes/cup.yaml, sections in r, z turned about the z axis, over the quarter
of the blank and 6 degrees more on either side.

cup_die.stl     flat top at z = 0, an edge of radius 5, wall at r = 21.3
cup_holder.stl  flat bottom at z = 1, an edge of radius 2, wall at r = 22
cup_punch.stl   flat bottom at z = 1, an edge of radius 4, wall at r = 20

It needs numpy.
"""
import pathlib
import sys

from make_meshes import arc, turned, write_stl

SECTOR_DEG = (-6.0, 96.0)
SECTOR_FACETS, ARC_FACETS = 34, 9   # round the z axis; in 90 degrees of an edge
OUTER = 46.0                        # radius of die and holder


def die():
    return [(OUTER, -30), (OUTER, 0), *arc((26.3, -5), 90, 180, 5, ARC_FACETS), (21.3, -30)]


def holder():
    return [(OUTER, 10), (22, 10), *arc((24, 3), 180, 270, 2, ARC_FACETS), (OUTER, 1)]


def punch():
    return [(0, 30), (0, 1), *arc((16, 5), 270, 360, 4, ARC_FACETS), (20, 30)]


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "meshes"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    for section in (die, holder, punch):
        path = folder / f"cup_{section.__name__}.stl"
        write_stl(path, turned(section(), *SECTOR_DEG, SECTOR_FACETS))
        print(path, path.stat().st_size, "bytes")


if __name__ == "__main__":
    main()
