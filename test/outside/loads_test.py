#!/usr/bin/python3
"""Loads that keep their direction, against what theory says of them.

usage: loads_test.py FORMING_OFFLINE
"""
import math
import subprocess
import sys
import unittest

import yaml

from scene_run import ALUMINIUM, OFFLINE, SceneRun, body, scene

E, NU = ALUMINIUM['youngs_modulus'], ALUMINIUM['poissons_ratio']


def load(of, at, value, time, kind='traction'):
    return {'set': of, 'kind': kind, 'times': [0.0, time], 'profile': 'smooth', {'traction': 'tractions', 'force': 'forces'}[kind]: [[0.0] * len(value), value], **at}


def at_rest(*bodies, time, limit, probes, **fields):
    """A scene in which the loads have come by `time`, and which ends at rest."""
    data = scene(*bodies, duration=time, **fields)
    data['stages'].append({'kind': 'settle', 'limit': limit, 'kinetic_fraction': 1e-9})
    data['output']['probes'] = probes
    return data


class Loads(SceneRun):
    def moved(self, probe, axis):
        rows = self.history()
        return float(rows[-1][f'probe_{probe}_position_{axis}_m']) - float(rows[0][f'probe_{probe}_position_{axis}_m'])

    def test_a_traction_stretches_a_strip_and_a_force_as_much(self):
        """In plane strain by (1 - nu^2)/E times the traction, the force per metre of width of it over the height."""
        held = {'boundaries': [{'set': 'left', 'kind': 'fixed', 'axes': ['x']}, {'set': 'bottom', 'kind': 'symmetric', 'normal': [0, 1]}]}
        found = []
        for pattern in ('fine', 'one_point'):
            for pull in (load('right', {}, [7e6, 0.0], 1e-4), load('right', {}, [7e6 * 0.002, 0.0], 1e-4, 'force')):
                strip = body('strip', loads=[pull], **held)
                strip['blank']['pattern'] = pattern
                self.run_scene(at_rest(strip, time=1e-4, limit=2e-3, probes=[{'name': 'end', 'set': 'right'}]))
                found.append(self.moved('end', 'x'))
        for stretch in found:
            self.assertAlmostEqual(stretch / (7e6 * (1 - NU**2) / E * 0.010), 1, delta=1e-3)
        self.assertAlmostEqual(found[0], found[1], delta=1e-5 * found[0])

    def test_a_force_on_an_edge_bends_a_bar(self):
        """F L^3/(3 E I), and the shear of Timoshenko beside it; an edge has no face."""
        L, h = 0.03, 0.003
        bar = {'name': 'bar', 'material': ALUMINIUM, 'blank': {'shape': 'plate', 'length': L, 'width': h, 'thickness': h, 'cells_along': 20, 'cells_across': 4, 'cells_through': 4,
                         'pattern': 'one_point'},
               'sets': [{'name': 'edge', 'choose': 'box', 'min': [L * 0.999, -1, h * 0.49], 'max': [1, 1, h * 0.51]}],
               'boundaries': [{'set': 'left', 'kind': 'fixed', 'axes': ['x']},
                              {'set': 'line', 'kind': 'fixed'}], 'loads': [load('edge', {}, [0.0, 0.0, -2.0], 1e-3, 'force')]}
        bar['sets'].append({'name': 'line', 'choose': 'box', 'min': [-1, -1, h * 0.49], 'max': [1e-6, 1, h * 0.51]})
        self.run_scene(at_rest(bar, dimension=3, time=1e-3, limit=2e-2, probes=[{'name': 'tip', 'set': 'edge'}]))
        inertia, shear = h**4 / 12, E / (2 * (1 + NU)) * h * h * 5 / 6
        self.assertAlmostEqual(self.moved('tip', 'z') / (-2 * (L**3 / (3 * E * inertia) + L / shear)), 1, delta=3e-3)

    def test_a_ring_grows_under_what_pulls_outward(self):
        """Lame's thick tube, kept at its length; the same as a force summed around the circle."""
        a, b, T = 0.05, 0.06, 5e6
        grown = (1 + NU) / E * T * a**2 / (b**2 - a**2) * ((1 - 2 * NU) * a + b**2 / a)
        for pull in (load('left', {}, [T, 0.0], 2e-4), load('left', {}, [T * 2 * math.pi * a * 0.004, 0.0], 2e-4, 'force')):
            ring = {'name': 'ring', 'material': ALUMINIUM, 'loads': [pull],
                    'blank': {'shape': 'strip', 'origin': [a, 0], 'length': b - a, 'thickness': 0.004, 'cells_along': 10, 'cells_through': 2},
                    'boundaries': [{'set': s, 'kind': 'fixed', 'axes': ['y']} for s in ('bottom', 'top')]}
            self.run_scene(at_rest(ring, axisymmetric=True, time=2e-4, limit=5e-3, probes=[{'name': 'inside', 'set': 'left'}]))
            self.assertAlmostEqual(self.moved('inside', 'x') / grown, 1, delta=2e-3)

    def test_a_load_keeps_its_direction(self):
        """A bar that turns about a pin under a dead load swings as a pendulum does: energy, and the lowest point."""
        bar = body('strip', sets=[{'name': 'pin', 'choose': 'box', 'min': [-1, 0.0009, -1], 'max': [1e-9, 0.0011, 1]}],
                   boundaries=[{'set': 'pin', 'kind': 'fixed'}], loads=[{'set': 'right', 'kind': 'force', 'times': [0.0], 'forces': [[0.0, -2e3]]}])
        data = scene(bar, duration=1e-3)
        data['output'].update(history_interval=1e-6, probes=[{'name': 'end', 'set': 'right'}])
        summary = self.run_scene(data)
        lowest = min(float(row['probe_end_position_y_m']) for row in self.history())
        self.assertAlmostEqual(lowest - 0.001, -0.010, delta=2e-5)
        self.assertLess(summary['energy_J']['balance_error'], 1e-3)

    def test_cooks_membrane(self):
        """The upper right corner rises by 6.95 +- .1 mm (published) under a shear traction of .3125 GPa that rises in 5 ms."""
        n = 16
        points = [[48 * i / n, 44 * i / n + j / n * (44 - 28 * i / n)] for j in range(n + 1) for i in range(n + 1)]
        cells = [k for j in range(n) for i in range(n) for c in [j * (n + 1) + i] for k in (c, c + 1, c + n + 2, c + n + 1)]
        material = {'density': 7800.0, 'youngs_modulus': 206.9e9, 'poissons_ratio': 0.29,
                    'hardening': {'curve': 'voce', 'yield_stress': 450e6, 'saturation_stress': 715e6, 'rate': 16.93, 'modulus': 129.24e6}}
        plane = {'choose': 'plane', 'normal': [1, 0]}
        panel = {'name': 'panel', 'material': material, 'mesh': {'points': points, 'cells': cells, 'cell_type': 'quadrilateral', 'unit_scale': 1e-3},
                 'sets': [{'name': 'wall', 'point': [0, 0], **plane}, {'name': 'end', 'point': [0.048, 0], **plane}],
                 'boundaries': [{'set': 'wall', 'kind': 'fixed'}], 'loads': [load('end', {}, [0.0, 0.3125e9], 5e-3)]}
        for pattern, within in (('fine', 0.1), ('one_point', 0.15)):
            panel['mesh']['pattern'] = pattern
            data = scene(panel, duration=6e-3, time_step={'damping': 6e3})
            data['output']['probes'] = [{'name': 'corner', 'point': [0.048, 0.060]}]
            self.run_scene(data)
            self.assertAlmostEqual(1e3 * self.moved('corner', 'y'), 6.95, delta=within)

    def test_faults_and_notes(self):
        def told(one, dimension=3):
            with open(self.path('scene.yaml'), 'w') as file:
                yaml.safe_dump(scene(body('plate', loads=[one], sets=[{'name': 'corner', 'choose': 'box', 'min': [-1, -1, -1], 'max': [1e-6, 1e-6, 1e-6]}]), dimension=dimension), file)
            return subprocess.run([OFFLINE, '--validate', self.path('scene.yaml')], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
        for one, sentence in ((load('topp', {}, [0.0, 0.0, 1e6], 1e-5), 'top'),
                              (load('corner', {}, [0.0, 0.0, 1e6], 1e-5), 'on none of this one can a traction act'),
                              (load('top', {'tractions': [[0, 0, 1]]}, [0.0, 0.0, 1e6], 1e-5), 'loads[0].tractions'),
                              (load('top', {'forces': [[0, 0, 1], [0, 0, 2]]}, [0.0, 0.0, 1e6], 1e-5), 'loads[0].forces'),
                              (load('top', {}, [0.0, 0.0, 1e6], 1.0), 'the load on set top of body body goes on to 1 s')):
            self.assertIn(sentence, told(one))
        self.assertNotIn('loads', told(load('corner', {}, [0.0, 0.0, 5.0], 1e-5, 'force')))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
