#!/usr/bin/python3
"""forming_bench speed on its smallest blocks: rows and files are whole and make sense. No time decides anything.

usage: bench_speed_test.py FORMING_BENCH
"""
import csv
import math
import os
import sys
import unittest

from bench_run import BenchRun, run_bench

STAGES = ('cells_ns', 'pressure_ns', 'nodes_ns', 'time_step_ns')
FAMILIES = {'4 crossed triangles', '2 triangles', 'free triangles', 'axisymmetric, 4 crossed triangles', 'axisymmetric, 2 triangles',
            '24 tetrahedra', '6 tetrahedra', 'free tetrahedra', 'one-point quadrilaterals', 'one-point hexahedra'}
MOTIONS = ('elastic', 'forming', 'full flow')
HARDENED = ('4 crossed triangles', 'axisymmetric, 4 crossed triangles', '24 tetrahedra', 'one-point hexahedra')  # by other curves too
CURVES = ('linear', 'swift', 'table')
PERFECT = 'forming, perfect'  # of every family, in layers
ONE_POINT = {family for family in FAMILIES if family.startswith('one-point')}


class Speed(BenchRun):
    words = ('speed', 'short')

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        with open(os.path.join(cls.directory, 'speed.csv')) as file:
            cls.lines = list(csv.DictReader(file))

    def test_every_family_in_every_motion_on_one_thread_and_two(self):
        one_layer = {(line['elements'], line['motion'], line['threads']) for line in self.lines if line['layers'] == '1'}
        bent = {(family, 'forming and bending', '1') for family in ONE_POINT}
        hardened = {(family, f'forming, {curve}', '1') for family in HARDENED for curve in CURVES} | {(family, PERFECT, '1') for family in FAMILIES}
        self.assertEqual(one_layer, {(family, motion, threads) for family in FAMILIES for motion in MOTIONS for threads in '12'} | bent | hardened)
        for layers in ('2', '3', '5', '10'):
            self.assertEqual({(line['elements'], line['motion']) for line in self.lines if line['layers'] == layers},
                             {(family, motion) for family in FAMILIES for motion in ('forming', PERFECT)})

    def test_a_further_layer_is_what_the_step_takes_longer(self):
        one = {(line['elements'], line['motion']): float(line['whole_ns']) for line in reversed(self.lines) if (line['layers'], line['threads']) == ('1', '1')}
        for line in self.lines:
            layers = int(line['layers'])
            if layers == 1:
                self.assertEqual(line['further_layer_over_first'], '')
            else:
                longer = (float(line['whole_ns']) / one[line['elements'], line['motion']] - 1) / (layers - 1)
                self.assertAlmostEqual(float(line['further_layer_over_first']), longer, delta=1e-9)

    def test_the_stages_make_the_whole(self):
        for line in self.lines:
            stages = [float(line[stage]) for stage in STAGES]
            self.assertAlmostEqual(sum(stages) / float(line['whole_ns']), 1, delta=1e-9)
            for stage, time in zip(STAGES, stages):
                if stage == 'pressure_ns' and not line['elements'].startswith('free'):
                    self.assertLess(time, float(line['whole_ns']))
                else:
                    self.assertGreater(time, 0, (stage, line))
            for share in ('one_thread_over_this', 'of_bandwidth'):
                self.assertTrue(0 < float(line[share]) < math.inf, line)

    def test_bytes_and_operations_are_those_of_the_motion(self):
        """Both are counted, not measured: they are the same on any machine and any number of threads."""
        of = {(line['elements'], line['motion'], line['threads']): line for line in self.lines if line['layers'] == '1'}
        five = {line['elements']: line for line in self.lines if (line['layers'], line['motion']) == ('5', 'forming')}
        for family in FAMILIES:
            elastic, forming, flow = (of[family, motion, '1'] for motion in MOTIONS)
            self.assertEqual(forming['bytes'], of[family, 'forming', '2']['bytes'])
            self.assertEqual(forming['bytes'], flow['bytes'])
            if family in ONE_POINT:
                bent = of[family, 'forming and bending', '1']
                self.assertEqual(forming['bytes'], bent['bytes'])
                self.assertEqual(bent['operations'], '')  # what flows across a cell is not counted
            self.assertLess(float(elastic['bytes']), float(forming['bytes']), 'what yields writes its memory')
            self.assertLess(float(elastic['operations']), float(forming['operations']), 'what yields has more to find')
            self.assertLessEqual(float(forming['operations']), float(flow['operations']))
            items = 4 if family.endswith(('triangles', 'quadrilaterals')) else 6
            # Read and written: four further layers of G and the plastic strain.
            self.assertGreaterEqual(float(five[family]['bytes']) - float(forming['bytes']), 4 * 2 * (items + 1) * 8)

    def test_the_machine_and_the_table(self):
        machine = [row for row in self.rows if row['case'].startswith('this machine')]
        self.assertEqual(len(machine), 4)
        self.assertTrue(all(row['found'] > 0 for row in machine))
        for family in FAMILIES:
            self.assertIn(f'| {family} | full flow | 1 | ', self.run_.stdout)
        with open(os.path.join(self.directory, 'speed_growth.png'), 'rb') as file:
            self.assertEqual(file.read(8), b'\x89PNG\r\n\x1a\n')

    def test_a_word_that_is_not_there(self):
        run = run_bench('speed', 'fast')
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('given fast; right is nothing, large', run.stderr)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
