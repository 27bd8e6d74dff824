#!/usr/bin/python3
"""How near to a crack flow brings a body: against closed forms, through operations, and what a run tells of it.

usage: damage_test.py FORMING_OFFLINE
"""
import math
import sys
import unittest

import h5py
import numpy

from scene_run import SceneRun, body, scene

YIELD, LENGTH, SPEED = 150e6, 0.010, 20.0
SHAPES = ((3, 'fine'), (3, 'one_point'), (3, 'coarse'), (2, 'fine'), (2, 'one_point'))


def bar(damage, dimension=3, pattern='fine', speed=SPEED, **fields):
    """A bar whose ends part, or meet, at that speed while it moves evenly between; in plane strain too."""
    part = body('plate' if dimension == 3 else 'strip', {'hardening': {'curve': 'perfect', 'yield_stress': YIELD}, 'damage': damage})
    part['blank'].update(pattern=pattern, cells_along=6, cells_through=2)
    if dimension == 3:
        part['blank'].update(width=0.002, cells_across=2)
    rate = speed / LENGTH
    sideways = rate / 2 if dimension == 3 else rate
    part['initial_velocity_field'] = [f'{rate}*(x-{LENGTH / 2})', f'{-sideways}*y'] + ([f'{-sideways}*z'] if dimension == 3 else [])
    part['boundaries'] = [{'set': side, 'kind': 'velocity', 'axes': ['x'], 'times': [0.0], 'velocities': [[way * speed / 2, 0, 0]]} for side, way in (('left', -1), ('right', 1))]
    return dict(part, **fields)


class Damage(SceneRun):
    def frames(self, name='out'):
        with h5py.File(self.path(name + '/result.h5')) as result:
            return [{key: frame[key][:] for key in ('damage', 'plastic_strain')} for frame in (result['frames'][key] for key in sorted(result['frames']))]

    def test_of_a_bar_in_tension_and_compression(self):
        """Per plastic strain: Y, 1, exp(1/2) in tension; in plane strain sigma_1 = 2/sqrt(3) sigma_e and sigma_m = sigma_1/2; nothing where sigma_1 is 0, exp(-1/2) of voids."""
        plane = 2 / math.sqrt(3)
        for dimension, pattern in SHAPES:
            first, mean = (1, 1 / 3) if dimension == 3 else (plane, plane / 2)
            for criterion, scale, pulled, pressed in (('cockcroft_latham', YIELD, first, 0), ('normalized_cockcroft_latham', 1, first, 0), ('rice_tracey', 1, math.exp(1.5 * mean), math.exp(-1.5 * mean))):
                for speed, expected in ((SPEED, pulled), (-SPEED, pressed)):
                    with self.subTest(dimension=dimension, pattern=pattern, criterion=criterion, speed=speed):
                        summary = self.run_scene(scene(bar({'criterion': criterion}, dimension, pattern, speed), dimension=dimension, duration=1e-4))
                        last = self.frames()[-1]
                        strain = last['plastic_strain']
                        self.assertGreater(strain.min(), 0.15)
                        numpy.testing.assert_allclose(last['damage'] / strain / scale, expected, atol=0.03)
                        self.assertAlmostEqual(last['damage'].mean() / strain.mean() / scale, expected, delta=0.01)
                        told = summary['damage'][0]
                        self.assertEqual((told['body'], told['criterion'], told['unit'], told['critical']), ('body', criterion, 'Pa' if scale == YIELD else '1', None))
                        self.assertAlmostEqual(told['max'] / last['damage'].max(), 1, delta=1e-6)
                        self.assertEqual(told['max'], float(self.history()[-1]['max_damage_body' + ('_Pa' if scale == YIELD else '')]))
                        self.assertEqual(summary['warnings'], [])

    def test_it_is_the_same_however_often_files_are_written(self):
        found = []
        for frames in (2, 50):
            data = scene(bar({'criterion': 'rice_tracey'}), dimension=3, duration=1e-4)
            data['output']['frames'] = frames
            self.run_scene(data)
            found.append(self.frames()[-1]['damage'])
        self.assertTrue((found[0] == found[1]).all())

    def test_a_part_takes_it_along(self):
        """Pulled in two operations, trimmed and turned between them: what is left has all of it."""
        for dimension, pattern in SHAPES:
            with self.subTest(dimension=dimension, pattern=pattern):
                first = scene(bar({}, dimension, pattern), dimension=dimension, duration=5e-5)
                first['output']['formed'] = True
                self.run_scene(first, 'first')
                kept = self.frames('first')[-1]
                part = bar({}, dimension, pattern)
                del part['blank'], part['initial_velocity_field'], part['boundaries']
                part.update(formed={'url': 'first/formed.h5', 'turn_deg': [0.0, 0.0, 30.0]}, trim=[{'choose': 'box', 'min': [-1, -1, -1], 'max': [0.0, 1, 1]}])
                self.run_scene(scene(part, dimension=dimension), 'second')
                left = self.frames('second')[0]
                self.assertGreater(len(left['damage']), 0)
                self.assertLess(len(left['damage']), len(kept['damage']))
                where = {strain: damage for strain, damage in zip(kept['plastic_strain'], kept['damage'])}
                for strain, damage in zip(left['plastic_strain'], left['damage']):
                    self.assertAlmostEqual(damage, where[strain], delta=1e-6)
                after = self.frames('second')[-1]
                self.assertTrue((after['damage'] >= left['damage']).all())

    def test_a_critical_value_is_told_once_with_its_place(self):
        for critical, told in ((0.1, 1), (10.0, 0)):
            for frames in (2, 20):
                data = scene(bar({'critical': critical}), dimension=3, duration=1e-4)
                data['output']['frames'] = frames
                warnings = [each for each in self.run_scene(data)['warnings'] if 'cracks by its criterion' in each]
                self.assertEqual(len(warnings), told, warnings)
                if told:
                    self.assertIn('critical is 0.1', warnings[0])
                    self.assertIn('(normalized_cockcroft_latham)', warnings[0])

    def test_bodies_without_it_have_none(self):
        other = bar({}, initial_velocity=[0.0, 0.0, 0.0])
        del other['material']['damage'], other['initial_velocity_field'], other['boundaries']
        other['name'], other['blank']['origin'] = 'other', [0.1, 0.0, 0.0]
        self.assertEqual(len(self.run_scene(scene(bar({}), other, dimension=3))['damage']), 1)
        damage = self.frames()[-1]['damage']
        self.assertTrue(numpy.isfinite(damage[:len(damage) // 2]).all())
        self.assertTrue(numpy.isnan(damage[len(damage) // 2:]).all())
        self.assertEqual(self.run_scene(scene(other, dimension=3))['damage'], [])
        with h5py.File(self.path('out/result.h5')) as result:
            self.assertNotIn('damage', result['frames/000000'])

    def test_what_makes_no_sense_is_refused(self):
        for damage, material, word in (({'criterion': 'cockroft'}, {}, 'cockcroft_latham'),
                                       ({'critical': -1.0}, {}, 'material.damage.critical'),
                                       ({}, {'hardening': None}, 'damage without hardening')):
            part = bar(damage)
            for key, value in material.items():
                if value is None:
                    del part['material'][key]
            self.assertIn(word, self.refused(scene(part, dimension=3)))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
