#!/usr/bin/python3
"""How near to its forming limit a sheet comes: against closed forms, through operations, and what a run tells of it.

usage: forming_limit_test.py FORMING_OFFLINE
"""
import math
import sys
import unittest

import h5py
import numpy

from scene_run import SceneRun, body, scene

CURVE = {'minor_strains': [-0.2, 0.0, 0.2], 'major_strains': [0.4, 0.2, 0.3]}
LENGTH, SPEED = 0.010, 20.0


def stretched(dimension=3, curve=CURVE, speed=SPEED, sideways=-0.5, pattern='fine', **fields):
    """A sheet whose ends part at that speed while it moves evenly between; sideways: its rate across over that along."""
    part = body('plate' if dimension == 3 else 'strip', {'hardening': {'curve': 'perfect', 'yield_stress': 150e6}, 'forming_limit': curve})
    part['blank'].update(pattern=pattern)
    rate = speed / LENGTH
    ends = [('left', 'x', -1), ('right', 'x', 1)]
    field = [f'{rate}*(x-{LENGTH / 2})']
    if dimension == 3:
        field += [f'{sideways * rate}*(y-{LENGTH / 2})', f'{-(1 + sideways) * rate}*z']
        ends += [('front', 'y', -sideways), ('back', 'y', sideways)]
    else:
        field += [f'{-rate}*y']
    part['initial_velocity_field'] = field
    part['boundaries'] = [{'set': side, 'kind': 'velocity', 'axes': [axis], 'times': [0.0],
                           'velocities': [[way * speed / 2 if axis == 'x' else 0, way * speed / 2 if axis == 'y' else 0, 0]]} for side, axis, way in ends]
    return dict(part, **fields)


class FormingLimit(SceneRun):
    def frame(self, name='out', index=-1):
        with h5py.File(self.path(name + '/result.h5')) as result:
            frame = result['frames'][sorted(result['frames'])[index]]
            return {key: frame[key][:] for key in ('membrane_strain', 'membrane_strain_minor', 'limit_ratio')}

    def test_of_a_sheet_that_is_stretched(self):
        """Uniaxially, in plane strain and more across: the curve at the minor strain of each."""
        duration = 1e-4
        major = math.log(1 + SPEED * duration / LENGTH)
        for dimension, sideways, pattern in ((3, -0.5, 'fine'), (3, -0.5, 'one_point'), (3, 0.0, 'coarse'), (3, 0.5, 'fine'), (2, 0.0, 'fine')):
            with self.subTest(dimension=dimension, sideways=sideways, pattern=pattern):
                summary = self.run_scene(scene(stretched(dimension, sideways=sideways, pattern=pattern), dimension=dimension, duration=duration))
                minor = math.log(1 + sideways * SPEED * duration / LENGTH) if dimension == 3 else 0
                limit = numpy.interp(minor, CURVE['minor_strains'], CURVE['major_strains'])
                told = summary['forming_limit'][0]
                self.assertEqual(told['body'], 'body')
                self.assertAlmostEqual(told['max'], major / limit, delta=6e-3)
                self.assertAlmostEqual(told['at_end']['max'], told['max'], delta=1e-9)
                self.assertAlmostEqual(told['where']['time_s'], duration, delta=1e-9)
                self.assertAlmostEqual(float(self.history()[-1]['max_limit_ratio_body']), told['max'], delta=1e-9)
                last = self.frame()
                sides = numpy.isfinite(last['membrane_strain'])
                self.assertTrue(0 < sides.sum() < len(sides))
                numpy.testing.assert_allclose(last['membrane_strain'][sides], major, atol=2e-3)
                numpy.testing.assert_allclose(last['membrane_strain_minor'][sides], minor, atol=2e-3)
                numpy.testing.assert_allclose(last['limit_ratio'], major / limit, atol=1e-2)
                beyond = [w for w in summary['warnings'] if 'beyond its forming limit' in w]
                self.assertEqual((len(beyond), told['beyond']), (1, 1) if major > limit else (0, 0), summary['warnings'])

    def test_the_next_operation_goes_on_from_the_flat_sheet(self):
        part = stretched(3, sideways=0.0)
        first = self.run_scene(scene(part, dimension=3, duration=5e-5, output={'frames': 2, 'formed': True}), 'first')
        second = dict(part, formed={'url': self.path('first/formed.h5')})
        del second['blank'], second['initial_velocity_field'], second['boundaries']
        told = self.run_scene(scene(second, dimension=3), 'second')['forming_limit'][0]
        self.assertGreater(told['max'], 0.99 * first['forming_limit'][0]['max'])
        before, after = self.frame('first'), self.frame('second', 0)
        self.assertGreater(numpy.nanmin(before['membrane_strain']), 0.08)
        for key in before:
            numpy.testing.assert_allclose(after[key], before[key], atol=1e-6)

    def test_without_a_curve_nothing_is_told(self):
        part = stretched(3)
        del part['material']['forming_limit']
        summary = self.run_scene(scene(part, dimension=3, duration=1e-5))
        self.assertEqual(summary['forming_limit'], [])
        with h5py.File(self.path('out/result.h5')) as result:
            self.assertNotIn('limit_ratio', result['frames/000000'])
            self.assertNotIn('forming_limit', result['bodies/0'])

    def test_curves_that_are_none_are_refused(self):
        for curve, words in (({'minor_strains': [0.0, -0.1], 'major_strains': [0.3, 0.4]}, 'strictly increasing'),
                             ({'minor_strains': [0.0, 0.1], 'major_strains': [0.3]}, 'one for each of the 2'),
                             ({'minor_strains': [-20.0, 0.0], 'major_strains': [40.0, 30.0]}, 'at most 3'),
                             ({'minor_strains': [0.0]}, 'major_strains')):
            self.assertIn(words, self.refused(scene(stretched(3, curve), dimension=3)), curve)
        cube = stretched(3)
        del cube['blank'], cube['boundaries'], cube['initial_velocity_field']
        cube['mesh'] = {'points': [[x, y, z] for z in (0, 0.001) for x, y in ((0, 0), (0.001, 0), (0.001, 0.001), (0, 0.001))], 'cells': list(range(8)), 'cell_type': 'hexahedron', 'unit_scale': 1.0}
        told = self.refused(scene(cube, dimension=3))
        self.assertIn('bodies[0].material.forming_limit', told)
        self.assertIn('two sides', told)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
