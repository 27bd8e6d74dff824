#!/usr/bin/python3
"""A body of hexahedra, pyramids and wedges side by side, from a .msh file.

usage: mixed_mesh_test.py FORMING_OFFLINE
"""
import math
import random
import sys
import unittest

import h5py

from scene_run import ALUMINIUM, SceneRun

SIDE, CELLS = 0.01, 3
HEX_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
HEXAHEDRON, WEDGE, PYRAMID = 5, 6, 7  # as gmsh counts them


def mixed_mesh():
    """A cube: along x a layer of hexahedra, one of pyramids and one of wedges; inner nodes are shaken."""
    shake = random.Random(1)
    number = lambda i, j, k: (i * (CELLS + 1) + j) * (CELLS + 1) + k + 1  # noqa: E731
    every = range(CELLS + 1)
    points = {number(i, j, k): [SIDE * m / CELLS + (shake.uniform(-.06, .06) * SIDE if all(0 < n < CELLS for n in (i, j, k)) else 0) for m in (i, j, k)]
              for i in every for j in every for k in every}
    cells = []
    for i in range(CELLS):
        for j in range(CELLS):
            for k in range(CELLS):
                c = [number(i + a, j + b, k + e) for e in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                if i == 0:
                    cells.append((HEXAHEDRON, c))
                elif i == 1:
                    middle = max(points) + 1
                    points[middle] = [sum(points[n][m] for n in c) / 8 for m in range(3)]
                    cells += [(PYRAMID, [c[n] for n in reversed(face)] + [middle]) for face in HEX_FACES]
                else:
                    cells += [(WEDGE, [c[n] for n in corners]) for corners in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
    lines = ['$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$Nodes', str(len(points))]
    lines += [' '.join([str(n)] + ['%.17g' % x for x in points[n]]) for n in sorted(points)]
    lines += ['$EndNodes', '$Elements', str(len(cells))]
    lines += [' '.join(map(str, [e + 1, kind, 2, 1, 1] + corners)) for e, (kind, corners) in enumerate(cells)]
    return '\n'.join(lines + ['$EndElements', ''])


class MixedMesh(SceneRun):
    def test_it_is_stretched_evenly(self):
        with open(self.path('mixed.msh'), 'w') as file:
            file.write(mixed_mesh())
        plane = lambda name, axis, at=0.0: {'name': name, 'choose': 'plane', 'point': [at * (m == axis) for m in range(3)], 'normal': [int(m == axis) for m in range(3)]}  # noqa: E731
        held = [{'set': name, 'kind': 'symmetric', 'normal': [int(m == axis) for m in range(3)]} for axis, name in enumerate(('x0', 'y0', 'z0'))]
        pulled = {'set': 'x1', 'kind': 'velocity', 'axes': ['x'], 'times': [0, 1e-3, 2e-3], 'velocities': [[0, 0, 0], [0.5, 0, 0], [0, 0, 0]], 'profile': 'smooth'}
        block = {'name': 'block', 'mesh': {'url': 'mixed.msh', 'unit_scale': 1.0}, 'material': dict(ALUMINIUM, hardening={'curve': 'linear', 'yield_stress': 200e6, 'modulus': 1e9}),
                 'sets': [plane('x0', 0), plane('y0', 1), plane('z0', 2), plane('x1', 0, SIDE)], 'boundaries': held + [pulled]}
        self.run_scene({'name': 'mixed', 'dimension': 3, 'bodies': [block], 'output': {'frames': 2},
                        'stages': [{'kind': 'form', 'duration': 2e-3}, {'kind': 'settle', 'limit': 1e-2, 'kinetic_fraction': 1e-9}]})
        with h5py.File(self.path('out/result.h5')) as result:
            last = result['frames'][sorted(result['frames'])[-1]]
            stress, flowed = last['stress'][:], last['plastic_strain'][:]
        self.assertEqual(len(stress), 9 * 24 + 9 * 6 * 8 + 9 * 2 * 14)
        E = ALUMINIUM['youngs_modulus']
        expected = (math.log(1.05) - 200e6 / E) / (1 + 1e9 / E)  # plastic strain: log strain less stress over E
        self.assertAlmostEqual(flowed.mean() / expected, 1, delta=5e-3)
        for of_element in stress:
            for found, right in zip(of_element, (200e6 + 1e9 * flowed.mean(), 0, 0, 0, 0, 0)):
                self.assertAlmostEqual(found, right, delta=1e-4 * 200e6)
        self.assertLess(flowed.std(), 1e-4 * expected)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
