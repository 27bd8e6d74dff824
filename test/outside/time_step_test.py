#!/usr/bin/python3
"""time_step.limit and time_step.raise_to, as a user meets them: the summary, the refusals, a resumed run.

usage: time_step_test.py FORMING_OFFLINE
"""
import copy
import csv
import json
import subprocess
import sys
import unittest

import yaml

from own_directory import OwnDirectory

OFFLINE = sys.argv[1] if len(sys.argv) > 1 else ''

# A strip of 10 x 2 quadrilaterals, one column of which is a tenth as wide; pulled beyond yield.
WIDE = [0, 1, 2, 3, 4, 5, 5.1, 6.1, 7.1, 8.1, 9.1]
SCENE = {
    'name': 'sliver', 'dimension': 2,
    'bodies': [{
        'name': 'sheet',
        'mesh': {'unit_scale': 1.0, 'points': [[1e-3 * x, 1e-3 * y, 0.0] for y in range(3) for x in WIDE], 'cell_type': 'quadrilateral', 'pattern': 'one_point',
                 'cells': [n for row in range(2) for c in range(10) for n in (11 * row + c, 11 * row + c + 1, 11 * row + c + 12, 11 * row + c + 11)]},
        'material': {'density': 2710.0, 'youngs_modulus': 70.5e9, 'poissons_ratio': 0.34,
                     'hardening': {'curve': 'linear', 'yield_stress': 200e6, 'modulus': 500e6}},
        'sets': [{'name': name, 'choose': 'box', 'min': [at - 1e-6, -1.0, -1.0], 'max': [at + 1e-6, 1.0, 1.0]}
                 for name, at in (('held', 0.0), ('pulled', 9.1e-3))],
        'boundaries': [{'set': 'held', 'kind': 'fixed'},
                       {'set': 'pulled', 'kind': 'velocity', 'axes': ['x'], 'times': [0.0, 2e-5, 6e-5, 8e-5],
                        'velocities': [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0, 0.0, 0.0]]}]}],
    'stages': [{'kind': 'form', 'duration': 8e-5}],
    'output': {'frames': 2}}


class TimeStep(OwnDirectory):
    def call(self, time_step, name='out', *more, **changes):
        data = dict(copy.deepcopy(SCENE), time_step=time_step, **changes)
        with open(self.path('scene.yaml'), 'w') as file:
            yaml.safe_dump(data, file)
        return subprocess.run([OFFLINE, self.path('scene.yaml'), '--output', self.path(name), '--threads', '1', *more],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def summary(self, name='out'):
        with open(self.path(name + '/summary.json')) as file:
            return json.load(file)

    def run_scene(self, time_step, name='out', *more):
        run = self.call(time_step, name, *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.said = run.stdout
        summary = self.summary(name)
        self.assertLess(summary['energy_J']['balance_error'], 2e-3)
        return summary

    def test_each_limit_takes_fewer_steps_and_finds_the_same(self):
        steps, plastic = [], []
        for limit in ('element', 'node', 'global'):
            summary = self.run_scene({'limit': limit}, limit)
            self.assertEqual(summary['options']['time_step']['limit'], limit)
            self.assertIsNone(summary['options']['raised_step'])
            steps.append(summary['steps'])
            plastic.append(summary['energy_J']['plastic'])
        self.assertGreater(steps[0], 2 * steps[1])
        self.assertGreater(steps[1], steps[2])
        self.assertEqual(summary['time_step_s']['limited_by'], 'the whole mesh')
        cost = summary['options']['time_step']
        self.assertGreaterEqual(cost['estimates'], 1)
        self.assertGreater(cost['share_of_longer_steps'], 0.95)
        for found in plastic[1:]:
            self.assertAlmostEqual(found, plastic[0], delta=0.005 * plastic[0])

    def test_the_whole_mesh_is_the_default_and_nodes_where_a_law_forbids_it(self):
        self.assertEqual(self.run_scene({})['options']['time_step']['limit'], 'global')
        bodies = copy.deepcopy(SCENE['bodies'])
        bodies[0]['material']['law'] = 'classical'
        self.assertEqual(self.call({}, 'classical', bodies=bodies).returncode, 0)
        self.assertEqual(self.summary('classical')['options']['time_step']['limit'], 'node')

    def test_mass_for_the_few_is_told(self):
        plain = self.run_scene({'limit': 'element'}, 'plain')
        want = 3.5 * plain['time_step_s']['first']
        summary = self.run_scene({'limit': 'element', 'raise_to': want}, 'raised')
        self.assertGreaterEqual(summary['time_step_s']['first'], want * (1 - 1e-9))
        self.assertLess(summary['steps'], 0.3 * plain['steps'])
        raised = summary['options']['raised_step']
        more = summary['bodies'][0]['mass'] - plain['bodies'][0]['mass']
        self.assertGreater(more, 0)
        self.assertAlmostEqual(raised['added_mass_kg'], more, delta=1e-9 * more + 1e-12)
        self.assertAlmostEqual(raised['bodies'][0]['added_mass_kg'], more, delta=1e-9 * more + 1e-12)
        self.assertAlmostEqual(raised['fraction'], more / plain['bodies'][0]['mass'], delta=1e-9)
        self.assertLess(raised['fraction'], 0.05)
        self.assertTrue(5e-3 <= raised['most']['position'][0] <= 5.1e-3 + 1e-9, raised['most'])
        self.assertEqual(summary['options']['mass_scaling']['added_mass_kg'], 0)
        self.assertEqual(len([w for w in summary['warnings'] if 'time_step.raise_to has added' in w]), 1)
        self.assertIn('time_step.raise_to has added', self.said)
        self.assertAlmostEqual(summary['energy_J']['plastic'], plain['energy_J']['plastic'], delta=0.01 * plain['energy_J']['plastic'])

    def test_too_much_mass_is_refused_before_the_run(self):
        run = self.call({'raise_to': 1e-6})
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('time_step.raise_to', run.stderr)
        self.assertIn('raise_limit', run.stderr)
        fault, = self.summary()['faults']
        self.assertEqual(fault['field'], 'time_step.raise_to')
        right = float(fault['remedy'].split('give at most ')[1].split(',')[0])
        self.run_scene({'raise_to': 0.99 * right}, 'right')

    def test_the_whole_mesh_bears_more_than_the_cells_around_a_node(self):
        """A crossed cell has a node of its own, to which no neighbour lends mass."""
        bodies = copy.deepcopy(SCENE['bodies'])
        bodies[0]['mesh']['pattern'] = 'fine'
        steps = {}
        for limit in ('node', 'global'):
            self.assertEqual(self.call({'limit': limit}, limit, bodies=bodies).returncode, 0)
            steps[limit] = self.summary(limit)['steps']
        self.assertGreater(steps['node'], 1.8 * steps['global'])

    def test_what_does_not_fit_is_a_fault(self):
        run = self.call({'raise_to': 2e-7, 'maximum': 1e-7})
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('give at most time_step.maximum', run.stderr)
        run = self.call({'limit': 'mesh'})
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('global', run.stderr)
        bodies = copy.deepcopy(SCENE['bodies'])
        bodies[0]['material']['law'] = 'classical'
        run = self.call({'limit': 'global'}, 'out', bodies=bodies)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('classical', run.stderr)
        self.assertIn('time_step.limit', run.stderr)

    def test_a_resumed_run_is_that_of_one_piece(self):
        step = {'limit': 'global', 'raise_to': 5e-8}
        whole = self.run_scene(step, 'whole')
        output = dict(SCENE['output'], checkpoint_interval=3e-5)
        self.assertEqual(self.call(step, 'parts', output=output).returncode, 0)
        unbroken = self.summary('parts')
        self.assertEqual(self.call(step, 'later', '--resume', self.path('parts/checkpoint.h5'), output=output).returncode, 0)
        later = self.summary('later')
        self.assertGreater(later['resumed_at_s'], 0)
        for summary in (unbroken, later):
            self.assertEqual(summary['steps'], whole['steps'])
            self.assertEqual(summary['energy_J']['plastic'], whole['energy_J']['plastic'])
            self.assertEqual(summary['options'], whole['options'])

    def test_the_peak_of_kinetic_over_internal_energy(self):
        """The grip rests when the stage ends: the peak lies above the ratio at its end, and above what is there once it moves at full speed."""
        summary = self.run_scene({})
        stage, = summary['stages']
        energy = summary['energy_J']
        self.assertEqual(energy['kinetic_over_internal_forming'], stage['kinetic_over_internal_peak'])
        self.assertGreater(stage['kinetic_over_internal_peak'], 3 * stage['kinetic_over_internal'])
        with open(self.path('out/history.csv')) as file:
            rows = [{key: float(row[key + '_J_per_m']) for key in ('kinetic', 'elastic', 'plastic')} for row in csv.DictReader(file)]
        internal = [row['elastic'] + row['plastic'] for row in rows]

        def largest(share):
            return max(row['kinetic'] / i for row, i in zip(rows, internal) if i >= share * internal[-1])
        self.assertGreaterEqual(stage['kinetic_over_internal_peak'], largest(0.01) * (1 - 1e-6))
        self.assertLessEqual(stage['kinetic_over_internal_peak'], largest(0.0098) * (1 + 1e-6))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
