"""Scenes of a few small bodies, run by forming_offline, whose path is the first word of the command line."""
import copy
import csv
import json
import subprocess
import sys

import yaml

from own_directory import OwnDirectory

OFFLINE = sys.argv[1] if len(sys.argv) > 1 else ''

ALUMINIUM = {'density': 2710.0, 'youngs_modulus': 70.5e9, 'poissons_ratio': 0.34}


def body(shape='strip', material=None, **fields):
    blank = {'strip': {'shape': 'strip', 'length': 0.010, 'thickness': 0.002, 'cells_along': 10, 'cells_through': 2},
             'plate': {'shape': 'plate', 'length': 0.010, 'width': 0.010, 'thickness': 0.002,
                       'cells_along': 4, 'cells_across': 4, 'cells_through': 1}}[shape]
    return dict({'name': 'body', 'blank': blank, 'material': dict(ALUMINIUM, **(material or {}))}, **fields)


def scene(*bodies, dimension=2, duration=2e-5, **fields):
    return dict({'name': 'case', 'dimension': dimension, 'bodies': copy.deepcopy(list(bodies)),
                 'stages': [{'kind': 'form', 'duration': duration}], 'output': {'frames': 2}}, **fields)


class SceneRun(OwnDirectory):
    def run_scene(self, data, name='out'):
        with open(self.path('scene.yaml'), 'w') as file:
            yaml.safe_dump(data, file)
        run = subprocess.run([OFFLINE, self.path('scene.yaml'), '--output', self.path(name), '--quiet', '--threads', '1'],
                             stderr=subprocess.PIPE, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.path(name + '/summary.json')) as file:
            summary = json.load(file)
        self.assertLess(summary['energy_J']['balance_error'], 0.01)
        return summary

    def refused(self, data):
        """What is told of a scene that has faults."""
        with open(self.path('scene.yaml'), 'w') as file:
            yaml.safe_dump(data, file)
        run = subprocess.run([OFFLINE, '--validate', self.path('scene.yaml')], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(run.returncode, 2, run.stdout)
        return run.stdout

    def history(self, name='out'):
        with open(self.path(name + '/history.csv')) as file:
            return list(csv.DictReader(file))
