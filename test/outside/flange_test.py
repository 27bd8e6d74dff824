#!/usr/bin/python3
"""The shipped flange, run as a user runs it, against what a bend of that radius must show.

usage: flange_test.py FORMING_OFFLINE SCENES
"""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

OFFLINE, SCENES = sys.argv[1:3] if len(sys.argv) > 2 else ('', '')


class Flange(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.mkdtemp(prefix='forming_sim_')
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        subprocess.run([OFFLINE, os.path.join(SCENES, 'flange.yaml'), '--output', cls.directory, '--quiet'], check=True)
        with open(os.path.join(cls.directory, 'summary.json')) as file:
            cls.summary = json.load(file)

    def test_nothing_crosses_and_the_energy_is_kept(self):
        self.assertEqual(self.summary['status']['name'], 'success')
        self.assertEqual(self.summary['contact']['crossings'], 0)
        self.assertLess(self.summary['energy_J']['balance_error'], 0.01)
        self.assertLess(self.summary['energy_J']['kinetic_over_internal_formed'], 0.05)

    def test_strain_of_a_tight_bend(self):
        """Outer fibre: .5 ln(1 + t/r), t .93 mm, r 1 mm; equivalent 2/sqrt(3) of it."""
        strain = self.summary['surface_strain']['at_end_of_forming']
        self.assertAlmostEqual(strain['max'], 0.329, delta=0.15 * 0.329)
        x, y, _ = strain['where']['position']
        self.assertLess(numpy.hypot(x - 9e-3, y + 1e-3), 2.2e-3, 'the strain is greatest in the bend')
        self.assertAlmostEqual(self.summary['plastic_strain']['max'], 0.380, delta=0.15 * 0.380)

    def test_springback(self):
        springback = self.summary['springback']
        self.assertAlmostEqual(springback['angle_deg_formed'], -90, delta=2)
        self.assertTrue(1 < springback['change_deg'] < 8, springback)
        self.assertLess(springback['kinetic_over_internal'], 1e-6)

    def test_a_tool_that_touches_is_backed_off_and_told(self):
        for tool in ('die', 'pad', 'punch'):
            self.assertTrue(any('tool ' + tool in note and 'backed off' in note for note in self.summary['warnings']), tool)

    def test_files_agree(self):
        with open(os.path.join(self.directory, 'history.csv')) as file:
            last = list(csv.DictReader(file))[-1]
        self.assertEqual(int(last['step']), self.summary['steps'])
        self.assertAlmostEqual(float(last['plastic_J_per_m']), self.summary['energy_J']['plastic'], delta=1e-9 * self.summary['energy_J']['plastic'])
        with h5py.File(os.path.join(self.directory, 'result.h5')) as result:
            frame = result['frames'][sorted(result['frames'])[-1]]
            self.assertAlmostEqual(float(frame['plastic_strain'][:].max()), self.summary['plastic_strain']['max'], delta=1e-6)
            self.assertEqual(frame['positions'].shape[0], self.summary['nodes'])


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
