#!/usr/bin/python3
"""The plots of a result as a user asks for them: every field, on a section and on a surface.

usage: plots_test.py FORMING_OFFLINE SCRIPTS
"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

OFFLINE, SCRIPTS = sys.argv[1:3] if len(sys.argv) > 2 else ('', '')

SCENE = '''
name: pressed_plate
dimension: 3
bodies:
  - name: plate
    blank: {shape: plate, length: 4e-3, width: 2e-3, thickness: 1e-3, cells_along: 4, cells_across: 2, cells_through: 1}
    material: {density: 2710, youngs_modulus: 70e9, poissons_ratio: 0.3, forming_limit: {minor_strains: [-0.2, 0], major_strains: [0.4, 0.2]}}
tools:
  - {name: floor, normal: [0, 0, 1], friction: 0.1}
  - name: press
    point: [0, 0, 1e-3]
    normal: [0, 0, -1]
    motion: {kind: trajectory, times: [0, 1e-5], positions: [[0, 0, 0], [0, 0, -1e-6]]}
stages:
  - {kind: form, duration: 1e-5}
output: {frames: 2}
'''


class Plots(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.mkdtemp(prefix='forming_sim_')
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        scene = os.path.join(cls.directory, 'scene.yaml')
        with open(scene, 'w') as file:
            file.write(SCENE)
        subprocess.run([OFFLINE, scene, '--output', cls.directory], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.result = os.path.join(cls.directory, 'result.h5')

    def plot(self, script, *words):
        picture = os.path.join(self.directory, 'plot.png')
        run = subprocess.run(['/usr/bin/python3', os.path.join(SCRIPTS, script), self.result, *words, '--output', picture],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if run.returncode == 0:
            with open(picture, 'rb') as file:
                self.assertEqual(file.read(8), b'\x89PNG\r\n\x1a\n')
            os.remove(picture)
        return run

    def test_fields_of_nodes_elements_and_components(self):
        for script in ('plot_section.py', 'plot_surface.py'):
            for field in ('plastic_strain', 'mises', 'stress.zz', 'velocities.z', 'contact_gap', 'contact_pressure', 'contact_slip', 'thinning'):
                run = self.plot(script, '--field', field)
                self.assertEqual(run.returncode, 0, f'{script} {field}: {run.stderr}')
        run = self.plot('plot_surface.py', '--field', 'surface_strain', '--body', 'plate', '--range', '0', '0.1')
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_ends_of_the_colours_may_be_negative_and_stand_in_order(self):
        self.assertEqual(self.plot('plot_section.py', '--field', 'stress.zz', '--range', '-3e8', '3e8').returncode, 0)
        for ends in (('1', '-1'), ('5', '5')):
            run = self.plot('plot_section.py', '--range', *ends)
            self.assertNotEqual(run.returncode, 0)
            self.assertIn('the lower end first', run.stderr)

    def test_the_forming_limit_diagram(self):
        curve = os.path.join(self.directory, 'limit.csv')
        with open(curve, 'w') as file:
            file.write('minor,major\n-0.5,1e-9\n0.5,1e-9\n')
        run = self.plot('plot_forming_limit.py', '--limit', curve)
        self.assertEqual(run.returncode, 0, run.stderr)
        # Pressed from above it grows sideways, all over.
        self.assertIn('beyond the limit: 100 % of the sheet', run.stdout)
        # That of the scene, by the strains of the middle.
        run = self.plot('plot_forming_limit.py')
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn('beyond the limit: 0 % of the sheet', run.stdout)
        run = self.plot('plot_forming_limit.py', '--set', 'side')
        self.assertEqual(run.returncode, 1)
        self.assertIn('back, bottom, front, left, right, top', run.stderr)
        with open(curve, 'w') as file:
            file.write('minor,major\n0,many\n')
        self.assertIn('not two numbers', self.plot('plot_forming_limit.py', '--limit', curve).stderr)

    def test_files_that_are_none_are_named(self):
        wrong = os.path.join(self.directory, 'wrong.h5')
        with open(wrong, 'wb') as file:
            file.write(b'\xff\xfe no result at all')
        empty = os.path.join(self.directory, 'empty.h5')
        h5py.File(empty, 'w').close()
        for script in ('plot_section.py', 'plot_surface.py', 'plot_forming_limit.py', 'plot_force.py', 'print_summary.py'):
            for path in (os.path.join(self.directory, 'nothing.h5'), wrong, empty, self.directory if script != 'print_summary.py' else wrong):
                run = subprocess.run(['/usr/bin/python3', os.path.join(SCRIPTS, script), path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                self.assertEqual(run.returncode, 1, script)
                self.assertNotIn('Traceback', run.stderr, script)
                self.assertIn(path, run.stderr, script)

    def test_what_is_not_there_is_named(self):
        for script, words, said in (('plot_section.py', ('--field', 'strain'), 'plastic_strain'),
                                    ('plot_section.py', ('--field', 'stress'), 'stress.xx'),
                                    ('plot_section.py', ('--field', 'mises.xx'), 'no components'),
                                    ('plot_section.py', ('--field', 'surface_strain'), 'plot_surface.py'),
                                    ('plot_section.py', ('--frame', '7'), '0 to 2'),
                                    ('plot_surface.py', ('--body', 'sheet'), 'plate')):
            run = self.plot(script, *words)
            self.assertEqual(run.returncode, 1, run.stdout)
            self.assertIn(said, run.stderr)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
