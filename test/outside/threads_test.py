#!/usr/bin/python3
"""One scene with one thread and with two, and in two parts: the same result.h5, bit for bit.

The plate is large enough that two threads share its loops.

usage: threads_test.py FORMING_OFFLINE
"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy
import yaml

OFFLINE = sys.argv[1] if len(sys.argv) > 1 else ''

PLATE = {
    'name': 'plate', 'dimension': 3,
    'bodies': [{
        'name': 'plate',
        'blank': {'shape': 'plate', 'length': 0.015, 'width': 0.015, 'thickness': 0.002,
                  'cells_along': 30, 'cells_across': 30, 'cells_through': 2},
        'material': {'density': 2710.0, 'youngs_modulus': 70.5e9, 'poissons_ratio': 0.34,
                     'hardening': {'curve': 'linear', 'yield_stress': 192.1e6, 'modulus': 1e9}},
        'boundaries': [{'set': 'left', 'kind': 'fixed'}, {'set': 'right', 'kind': 'fixed'}]}],
    'tools': [{'name': 'punch', 'friction': 0.1,
               'mesh': {'unit_scale': 0.001, 'cell_type': 'triangle',
                        'points': [[4.1, 4.2, 2], [9.3, 4.1, 2], [6.7, 9.1, 2], [6.5, 6.4, 8]],
                        'cells': [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]},
               'motion': {'kind': 'velocity', 'times': [0.0, 2e-6], 'velocities': [[0.0, 0.0, 0.0], [0.3, 0.0, -10.0]]}}],
    'stages': [{'kind': 'form', 'duration': 5e-5}],
    'output': {'frames': 5, 'checkpoint_interval': 3e-5}}


class Threads(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.mkdtemp(prefix='forming_sim_')
        self.addCleanup(shutil.rmtree, self.directory)
        with open(self.path('plate.yaml'), 'w') as file:
            yaml.safe_dump(PLATE, file)

    def path(self, name):
        return os.path.join(self.directory, name)

    def run_plate(self, name, *options):
        subprocess.run([OFFLINE, self.path('plate.yaml'), '--output', self.path(name), '--quiet', *options], check=True)
        return self.path(name + '/result.h5')

    def assert_same(self, one, other):
        with h5py.File(one) as a, h5py.File(other) as b:
            last_a, last_b = (file['frames'][sorted(file['frames'])[-1]] for file in (a, b))
            self.assertGreater(last_a['plastic_strain'][:].max(), 0.01, 'the plate should have yielded')
            self.assertNotEqual(last_a['tools/0/force'][2], 0)
            for name in last_a:
                if isinstance(last_a[name], h5py.Dataset):
                    numpy.testing.assert_array_equal(last_a[name][()], last_b[name][()], err_msg=name)
            numpy.testing.assert_array_equal(last_a['tools/0/force'][()], last_b['tools/0/force'][()])

    def test_threads(self):
        one = self.run_plate('one', '--threads', '1')
        for threads in ('2', '3'):
            self.assert_same(one, self.run_plate('with' + threads, '--threads', threads))

    def test_a_resumed_run(self):
        whole = self.run_plate('whole', '--threads', '2')
        resumed = self.run_plate('resumed', '--threads', '1', '--resume', self.path('whole/checkpoint.h5'))
        self.assert_same(whole, resumed)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
