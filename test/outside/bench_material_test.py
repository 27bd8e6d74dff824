#!/usr/bin/python3
"""forming_bench material and calibrate from the outside: closed forms through files, and wrong files answered with a sentence.

usage: bench_material_test.py FORMING_BENCH
"""
import csv
import math
import os
import subprocess
import sys
import tempfile
import unittest

import yaml

BENCH = sys.argv.pop(1) if len(sys.argv) > 1 else ''

E, NU, Y = 70.5e9, 0.34, 192.1e6
LAW = {'density': 2710.0, 'youngs_modulus': E, 'poissons_ratio': NU, 'hardening': {'curve': 'perfect', 'yield_stress': Y}}


class BenchMaterial(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), 'w') as file:
            file.write(text)
        return self.path(name)

    def run_bench(self, *words):
        return subprocess.run([BENCH, *words, '--output', self.path('out')], capture_output=True, text=True, timeout=60)

    def drive(self, law, history):
        """Rows of material.csv as numbers."""
        done = self.run_bench('material', self.write('law.yaml', law if isinstance(law, str) else yaml.safe_dump(law)),
                              self.write('history.csv', history))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path('out/material.csv'), newline='') as file:
            return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]

    def refused(self, law, history, *parts):
        done = self.run_bench('material', self.write('law.yaml', law if isinstance(law, str) else yaml.safe_dump(law)),
                              self.write('history.csv', history))
        self.assertEqual(done.returncode, 1, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    # ---- closed forms

    def test_tension_with_free_sides_yields_at_the_yield_stress(self):
        rows = self.drive(LAW, 'time,e11\n0,0\n1,0.05\n2,-0.05\n')
        self.assertEqual([row['time'] for row in rows], [0, 1, 2])
        self.assertAlmostEqual(rows[1]['stress_11_Pa'] / Y, 1, delta=1e-8)
        self.assertAlmostEqual(rows[2]['stress_11_Pa'] / Y, -1, delta=1e-8)
        self.assertLess(abs(rows[1]['stress_22_Pa']), 1)
        self.assertAlmostEqual(rows[1]['F11'], math.exp(0.05), delta=1e-14)
        self.assertAlmostEqual(rows[1]['plastic_strain'], 0.05 - Y / E, delta=5e-5)  # first order in steps of 1e-3
        self.assertAlmostEqual(rows[1]['J'] - 1, Y * (1 - 2 * NU) / E, delta=1e-6)
        self.assertAlmostEqual(rows[2]['work_J_m3'] / (rows[2]['stored_energy_J_m3'] + rows[2]['dissipation_J_m3']), 1, delta=2e-3)

    def test_elastic_shear(self):
        law = {k: v for k, v in LAW.items() if k != 'hardening'}
        rows = self.drive(law, 'F11,F22,F33,F12\n1,1,1,0\n1,1,1,0.3\n')
        mu = E / (2 * (1 + NU))
        self.assertAlmostEqual(rows[1]['stress_12_Pa'] / (mu * 0.3), 1, delta=1e-9)
        self.assertAlmostEqual(rows[1]['stress_11_Pa'] / (mu * 0.09 * 2 / 3), 1, delta=1e-9)
        self.assertEqual(rows[1]['plastic_strain'], 0)

    def test_calibrated_layers_drive_as_a_law(self):
        points = ''.join('%.15g,%g\n' % (p + s * 1e6 / E, s) for p, s in zip([0, .002, .01, .03], [160, 180, 210, 250]))
        done = self.run_bench('calibrate', self.write('curve.csv', 'true_strain,true_stress_MPa\n' + points), 'E=70.5e9', 'nu=0.34')
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path('out/layers.yaml')) as file:
            layers = file.read()
        rows = self.drive('density: 2710\n' + layers, 'e11\n%.15g\n' % (.01 + 210e6 / E))
        self.assertAlmostEqual(rows[0]['stress_11_Pa'] / 210e6, 1, delta=2e-3)  # small strain against finite

    # ---- wrong files

    def test_faults_of_a_law_name_its_own_lines(self):
        self.refused('density: 2710\nyoungs_modulus: 70.5e9\npoissons_ratio: 0.7\nhardning: {}\n', 'e11\n0\n',
                     'material.poissons_ratio: given 0.7 (line 3)', 'material.hardning', '(line 4)')
        self.refused('density: [2710\n', 'e11\n0\n', 'not YAML', 'line 2')
        self.refused('', 'e11\n0\n', 'material: given nothing')

    def test_faults_of_a_history_name_line_column_and_value(self):
        for history, parts in (('e11\n0\nnan\n', ('line 3, column e11', '"nan"', 'finite number')),
                               ('e11\n0\nabc\n', ('line 3, column e11', '"abc"')),
                               ('e11\n', ('no rows',)), ('', ('is empty',)), ('time\n0\n', ('F11',)),
                               ('G11\n1\n', ('column G11',)), ('e11,F12\n0,0\n', ('not both',)),
                               ('F11,F22,F33\n1,1\n', ('line 2', 'given 2 values')),
                               ('F11,F22,F33\n1,1,1\n\n-1,1,1\n', ('line 4', 'determinant', '-1')),
                               ('F11\n1\n-1\n', ('line 3', 'determinant')),
                               ('time,e11\n1,0\n0,0\n', ('line 3, column time',))):
            with self.subTest(history):
                self.refused(LAW, history, *parts)

    def test_faults_of_a_curve_name_the_point(self):
        curve = self.write('curve.csv', 'true_strain,true_stress_Pa\n0.002,141e6\n0.01,150e6\n0.02,170e6\n')
        done = self.run_bench('calibrate', curve, 'E=70.5e9', 'nu=0.34')
        self.assertEqual(done.returncode, 1)
        self.assertIn('line 3', done.stderr)
        self.assertIn('slope', done.stderr)
        done = self.run_bench('calibrate', curve, 'E=70.5e9')
        self.assertIn('nu is missing', done.stderr)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[1:])
