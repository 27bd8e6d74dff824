#!/usr/bin/python3
"""forming_bench speed-error on a short problem, and stability: rows, files, and what physics says of the errors.

usage: bench_speed_error_test.py FORMING_BENCH
"""
import csv
import json
import os
import shutil
import sys
import tempfile
import unittest

from bench_run import BenchRun, run_bench


class SpeedError(BenchRun):
    words = ('speed-error', 'cube')

    def test_fields_of_the_rows(self):
        periods = self.of_case('period, ms')
        self.assertGreater(len(periods), 12)
        for row in self.rows:
            self.assertEqual(set(row), {'case', 'quantity', 'found', 'expected', 'error', 'wall_time_s', 'holds', 'note'})
        for quantity in ('cells', 'unknowns', 'steps', 'element-steps/s'):
            found = self.of_case(quantity)
            self.assertEqual(set(found), set(periods))
            self.assertTrue(all(row['found'] > 0 for row in found.values()))
        for case, row in periods.items():
            self.assertGreater(row['wall_time_s'], 0)
            self.assertAlmostEqual(row['error'], row['found'] / row['expected'] - 1, delta=1e-12)
            self.assertEqual(row['holds'], abs(row['error']) <= 0.01, case)

    def test_the_error_of_the_period_falls_with_the_square_of_the_cell(self):
        """Linear simplices of second order: half the cell, a quarter of the error; with p per cell or per node."""
        periods = self.of_case('period, ms')
        for swing in ('cube shearing', 'cube breathing', 'cube shearing nu .45'):
            for family in ('24 tetrahedra', '6 tetrahedra', 'free tetrahedra'):
                coarse, fine = (abs(periods[f'{swing}: {family}, {cells} a side']['error']) for cells in (4, 8))
                self.assertGreater(coarse / fine, 3.2, (swing, family))
                self.assertLess(coarse / fine, 5, (swing, family))

    def test_table_csv_and_plots(self):
        self.assertIn('| 24 tetrahedra | 8 a side | 512 |', self.run_.stdout)
        with open(os.path.join(self.directory, 'speed-error.csv')) as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(len(lines), len(self.of_case('period, ms')))
        for line in lines:
            self.assertGreater(float(line['element_steps_per_s']), 0)
        for name in ('speed_error_cube_shearing', 'speed_error_cube_breathing'):
            with open(os.path.join(self.directory, name + '.png'), 'rb') as file:
                self.assertEqual(file.read(8), b'\x89PNG\r\n\x1a\n')

    def test_a_problem_that_is_not_there(self):
        run = run_bench('speed-error', 'cubes')
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('problem cubes is not one of bending, cook', run.stderr)


class Stability(unittest.TestCase):
    def test_fast_impacts_hold(self):
        """Nothing crosses, no energy is gained, and every run comes to its end."""
        directory = tempfile.mkdtemp(prefix='forming_sim_')
        self.addCleanup(shutil.rmtree, directory)
        run = run_bench('stability', 'impact', '--output', directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(os.path.join(directory, 'stability.json')) as file:
            rows = json.load(file)
        self.assertGreater(len(rows), 20)
        for row in rows:
            self.assertTrue(row['holds'], row)
            if row['quantity'] == 'crossings':
                self.assertEqual(row['found'], 0)
            if row['quantity'].startswith('kinetic + elastic'):
                self.assertLess(row['found'], 1)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
