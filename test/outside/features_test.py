#!/usr/bin/python3
"""What a scene can say of bodies, each shown by what a mechanician would check.

usage: features_test.py FORMING_OFFLINE
"""
import math
import shutil
import subprocess
import sys
import time
import unittest

import h5py
import numpy
import yaml

from scene_run import ALUMINIUM, OFFLINE, SceneRun, body, scene


class Features(SceneRun):
    def test_a_tube_under_pressure_widens_as_lame_says(self):
        inner, outer, pressure, modulus = 9e-3, 10e-3, 1e7, 70.5e9
        for portion, pattern in (('quarter', 'fine'), ('half', 'one_point')):
            tube = {'name': 'tube', 'blank': {'shape': 'tube', 'radius': outer, 'thickness': outer - inner, 'length': 4e-3, 'portion': portion, 'pattern': pattern,
                                              'cells_around': 64, 'cells_along': 4, 'cells_through': 2},
                    'material': dict(ALUMINIUM, youngs_modulus=modulus, poissons_ratio=0.3),
                    'boundaries': [{'set': 'symmetry_x', 'kind': 'symmetric', 'normal': [1, 0, 0]}, {'set': 'start', 'kind': 'symmetric', 'normal': [0, 0, 1]}],
                    'pressures': [{'set': 'inside', 'times': [0, 1e-4], 'values': [0, pressure], 'profile': 'smooth'}]}
            if portion == 'quarter':
                tube['boundaries'].append({'set': 'symmetry_y', 'kind': 'symmetric', 'normal': [0, 1, 0]})
            else:
                tube['sets'] = [{'name': 'line', 'choose': 'plane', 'point': [0, 0, 0], 'normal': [0, 1, 0]}]
                tube['boundaries'].append({'set': 'line', 'kind': 'fixed', 'axes': ['y']})
            data = scene(tube, dimension=3, duration=1e-4, output={'frames': 1, 'probes': [{'name': 'out', 'point': [outer, 0, 2e-3]}]})
            data['stages'].append({'kind': 'settle', 'limit': 2e-3, 'kinetic_fraction': 1e-8})
            summary = self.run_scene(data)
            widened = float(self.history()[-1]['probe_out_position_x_m']) - outer
            exact = 2 * pressure * inner ** 2 * outer / (modulus * (outer ** 2 - inner ** 2))
            self.assertAlmostEqual(widened / exact, 1, delta=0.006, msg=portion)
            # Its wall thins by the radial strain: from inside u_a - u_b.
            inside = pressure * inner / (modulus * (outer ** 2 - inner ** 2)) * (0.7 * inner ** 2 + 1.3 * outer ** 2)
            thinned = 1 - summary['thickness_m']['min'] / summary['thickness_m']['initial']
            self.assertAlmostEqual(thinned * (outer - inner) / (inside - exact), 1, delta=0.05, msg=portion)

    def test_the_same_run_gives_the_same_files(self):
        data = scene(body('plate', initial_velocity=[1, 0, 0]), dimension=3, output={'frames': 2, 'formed': True})
        self.run_scene(data, 'first')
        second = int(time.time())  # which HDF5 would keep
        while int(time.time()) == second:
            pass
        self.run_scene(data, 'second')
        for file in ('result.h5', 'formed.h5', 'history.csv', 'result.xdmf'):
            with open(self.path('first/' + file), 'rb') as one, open(self.path('second/' + file), 'rb') as other:
                self.assertEqual(one.read(), other.read(), file)

    def test_gravity(self):
        fall = self.run_scene(scene(body('plate'), dimension=3, gravity=[1.0, 2.0, -10.0]))['bodies'][0]
        self.assertAlmostEqual(fall['mass'], 2710 * 2e-7, delta=1e-12)
        numpy.testing.assert_allclose(fall['momentum'], fall['mass'] * 2e-5 * numpy.array([1, 2, -10]), rtol=0.01)

    def test_spin_carries_no_stress_and_keeps_its_momentum(self):
        turns = 3 * 360 / 1e-3  # three turns in a millisecond
        data = scene(body('strip', initial_spin_deg_s=[0.0, 0.0, turns], spin_centre=[0.005, 0.001, 0.0], initial_velocity=[2.0, 0.0, 0.0]),
                     duration=1e-3)
        after = self.run_scene(data)
        strip = after['bodies'][0]
        inertia = strip['mass'] * (0.010**2 + 0.002**2) / 12
        expected = inertia * math.radians(turns)
        about_centre = strip['angular_momentum'][2] - numpy.cross(strip['centre'], strip['momentum'])[2]
        self.assertAlmostEqual(about_centre, expected, delta=0.02 * expected)
        self.assertAlmostEqual(strip['momentum'][0], 2 * strip['mass'], delta=1e-9 * strip['mass'])
        with h5py.File(self.path('out/result.h5')) as result:
            last = result['frames'][sorted(result['frames'])[-1]]
            # rho omega^2 (L/2)^2 / 2: what the turning itself pulls
            pull = 2710 * math.radians(turns)**2 * 0.005**2 / 2
            self.assertLess(numpy.abs(last['stress'][:]).max(), 4 * pull)

    def test_a_column_leans_as_its_imperfection_starts_it(self):
        """Of the shape of the first mode, it grows by 1/(1 - P/P_cr), P_cr = pi^2 E' I/(4 L^2); a perfect column stays straight under more than that."""
        length, thickness, lean = 0.02, 1e-3, 2e-5
        blank = {'shape': 'strip', 'length': length, 'thickness': thickness, 'cells_along': 40, 'cells_through': 4}
        critical = math.pi**2 * ALUMINIUM['youngs_modulus'] / (1 - ALUMINIUM['poissons_ratio']**2) * thickness**3 / 12 / (4 * length**2)
        imperfect = ['0', f'{lean}*(1-cos(pi*x/{2 * length}))']
        for part, formulas in ((0.5, imperfect), (1.1, [])):
            column = body('strip', blank=blank, imperfection=formulas, boundaries=[{'set': 'left', 'kind': 'fixed'}],
                          loads=[{'set': 'right', 'kind': 'force', 'times': [0, 1e-3], 'forces': [[0, 0], [-part * critical, 0]], 'profile': 'smooth'}])
            data = scene(column, duration=1e-3, output={'frames': 2, 'probes': [{'name': 'tip', 'point': [length, thickness / 2]}]})
            data['stages'].append({'kind': 'settle', 'limit': 0.05, 'kinetic_fraction': 1e-8})
            self.run_scene(data)
            rows = self.history()
            first, last = (float(rows[i]['probe_tip_position_y_m']) for i in (0, -1))
            if formulas:
                self.assertAlmostEqual(first, thickness / 2 + lean, delta=1e-9)
                self.assertAlmostEqual((last - thickness / 2) * (1 - part) / lean, 1, delta=0.02)
            else:
                self.assertLess(abs(last - thickness / 2), 1e-9)
        self.assertIn('on the axis', self.refused(scene(body('strip', imperfection=['1e-5', '0'])) | {'axisymmetric': True}))
        self.assertIn('turn cells over', self.refused(scene(body('strip', imperfection=['-2*x', '0']))))
        self.assertIn('in their plane of symmetry', self.refused(scene(body('strip', imperfection=['1e-5*y', '0'], boundaries=[
            {'set': 'left', 'kind': 'symmetric', 'normal': [1, 0]}]))))

    def half_swing(self, cells, third, period, name):
        """The time after which a corner of the swinging cube is back in its place, and how far it was, over that of the shape."""
        speed, wave = 0.02, {a: {'s': f'sin(pi/2*{a})', 'c': f'cos(pi/2*{a})'} for a in 'xyz'}
        blank = {'shape': 'plate', 'length': 1.0, 'width': 1.0, 'thickness': 1.0, 'cells_along': cells, 'cells_across': cells, 'cells_through': cells, 'pattern': 'one_point'}
        faces = {'left': 'x', 'right': 'x', 'front': 'y', 'back': 'y', 'bottom': 'z', 'top': 'z'}
        held = [{'set': face, 'kind': 'fixed', 'axes': [axis] if face in ('left', 'front', 'bottom') else [a for a in 'xyz' if a != axis]} for face, axis in faces.items()]
        field = [f'{factor * speed}*' + '*'.join(wave[b]['s' if a == b else 'c'] for b in 'xyz') for a, factor in zip('xyz', (1, 1, third))]
        cube = {'name': 'cube', 'blank': blank, 'material': {'density': 1100.0, 'youngs_modulus': 17e6, 'poissons_ratio': 0.3},
                'initial_velocity_field': field, 'boundaries': held}
        self.run_scene(scene(cube, dimension=3, duration=0.6 * period, output={'frames': 2, 'history_interval': period / 400, 'probes': [
            {'name': 'corner', 'point': [1, 0, 0]}]}), name)
        rows = self.history(name)
        times, moved = [float(row['time_s']) for row in rows], [float(row['probe_corner_position_x_m']) - 1 for row in rows]
        back = next(i for i in range(2, len(moved)) if moved[i] <= 0)
        return times[back] - (times[back] - times[back - 1]) * moved[back] / (moved[back] - moved[back - 1]), max(moved) / (speed * period / (2 * math.pi))

    def test_a_cube_swings_as_its_formulas_start_it(self):
        """The swinging cube with the velocity of its shape, A = B = 1: periods of 29.954 ms (C = -2) and 16.011 ms (C = 1), of second order."""
        for third, period in ((-2, 29.954e-3), (1, 16.011e-3)):
            errors = []
            for cells in (6, 12):
                half, reach = self.half_swing(cells, third, period, f'out{third}_{cells}')
                errors.append(2 * half / period - 1)
            self.assertAlmostEqual(reach, 1, delta=0.01)
            self.assertLess(abs(errors[1]), 0.005)
            self.assertAlmostEqual(errors[0] / errors[1], 4, delta=0.4)

    def test_a_stretched_sheet_thins_by_what_it_is_stretched(self):
        """In plane strain, nearly without volume change: 1 - exp(-e) is gone of the thickness, and the strain of the surface is e along, 0 across."""
        strip = {'name': 'strip', 'blank': {'shape': 'strip', 'length': 0.02, 'thickness': 0.001, 'cells_along': 20, 'cells_through': 2},
                 'material': dict(ALUMINIUM, hardening={'curve': 'swift', 'strength': 500e6, 'prestrain': 0.01, 'exponent': 0.25}),
                 'boundaries': [{'set': 'left', 'kind': 'fixed', 'axes': ['x']}, {'set': 'bottom', 'kind': 'symmetric', 'normal': [0, 1]},
                                {'set': 'right', 'kind': 'velocity', 'axes': ['x'], 'times': [0, 2e-4, 4e-4], 'profile': 'smooth', 'velocities': [[0, 0], [10, 0], [0, 0]]}]}
        table = {'name': 'table', 'normal': [0, 1], 'point': [0, -0.01]}
        block = {'name': 'no_sheet', 'mesh': {'points': [[1, 0, 0], [1.01, 0, 0], [1, 0.01, 0]], 'cells': [0, 1, 2], 'cell_type': 'triangle', 'unit_scale': 1}, 'material': ALUMINIUM}
        summary = self.run_scene(scene(strip, block, duration=4.5e-4, tools=[table], time_step={'damping': 2e4}))
        strain = math.log(1.1)
        thinning = 1 - math.exp(-strain)
        self.assertAlmostEqual(summary['thinning']['max'] / thinning, 1, delta=0.05)
        self.assertAlmostEqual(summary['thinning']['max'], 1 - summary['thickness_m']['min'] / summary['thickness_m']['initial'], delta=1e-9)
        self.assertEqual(summary['thinning']['where']['body'], 'strip')
        self.assertGreater(summary['thinning']['where']['position'][1], 0.5 * summary['thickness_m']['min'])  # on top
        self.assertAlmostEqual(float(self.history()[-1]['max_thinning']), summary['thinning']['at_end']['max'], delta=1e-9)
        with h5py.File(self.path('out/result.h5')) as result:
            last = result['frames'][sorted(result['frames'])[-1]]
            sheet = slice(0, len(last['thinning']) - 3)
            self.assertTrue(numpy.isnan(last['thinning'][-3:]).all())
            self.assertAlmostEqual(last['thinning'][sheet].mean() / thinning, 1, delta=0.05)
            x = last['positions'][sheet]
            top = result['bodies/0/sets']
            nodes = next(group['nodes'][:] for group in top.values() if group.attrs['name'] == 'top')
            self.assertTrue(numpy.allclose(last['thickness'][:][nodes], x[nodes, 1], rtol=1e-5))
            owner = result['topology/body'][:][result['topology/surface_element'][:]]
            along = numpy.isin(result['topology/surface'][:], nodes).all(axis=1) & (owner == 0)
            self.assertTrue(numpy.allclose(last['surface_strain'][:][along], strain, rtol=0.05))
            self.assertTrue((last['surface_strain_minor'][:][along] == 0).all())

    def test_a_rolled_sheet_shrinks_by_its_r_values(self):
        """Pulled along the rolling direction and across it: strain of the width over that of the thickness, and the force."""
        r0, r45, r90 = 0.7, 1.5, 1.6
        F, G, H = r0 / (r90 * (1 + r0)), 1 / (1 + r0), r0 / (1 + r0)
        for pattern in ('coarse', 'one_point'):
            for rolling, r, square in (([1, 0, 0], r0, G + H), ([0, 1, 0], r90, F + H)):
                plate = body('plate', {'hardening': {'curve': 'perfect', 'yield_stress': 150e6},
                                       'anisotropy': {'r0': r0, 'r45': r45, 'r90': r90, 'rolling_direction': rolling}})
                plate['blank'].update(pattern=pattern, cells_along=2, cells_across=2)
                plate['boundaries'] = [{'set': name, 'kind': 'symmetric', 'normal': normal} for name, normal in (('left', [1, 0, 0]), ('front', [0, 1, 0]), ('bottom', [0, 0, 1]))]
                plate['boundaries'].append({'set': 'right', 'kind': 'velocity', 'axes': ['x'], 'profile': 'smooth', 'times': [0, 1e-4, 3e-4, 4e-4], 'velocities': [[0, 0, 0], [3, 0, 0], [3, 0, 0], [0, 0, 0]]})
                data = scene(plate, dimension=3, duration=5e-4, time_step={'damping': 5e3})
                data['output']['probes'] = [{'name': name, 'set': name} for name in ('right', 'back', 'top')]
                self.run_scene(data)
                first, last = self.history()[0], self.history()[-1]
                strain = {axis: math.log(float(last[f'probe_{name}_position_{axis}_m']) / float(first[f'probe_{name}_position_{axis}_m'])) for name, axis in (('right', 'x'), ('back', 'y'), ('top', 'z'))}
                stress = 150e6 / math.sqrt(square)
                elastic = 0.34 * stress / 70.5e9
                self.assertAlmostEqual((strain['y'] + elastic) / (strain['z'] + elastic), r, delta=0.01 * r)
                area = 0.010 * 0.002 * math.exp(strain['y'] + strain['z'])
                self.assertAlmostEqual(abs(float(last['probe_right_reaction_force_x_N'])) / (stress * area), 1, delta=0.003)

    def test_a_fast_pull_is_borne_at_the_yield_stress_of_its_rate(self):
        """A bar whose ends part at 20 m/s while it moves evenly between; the scene may stand for a slower pull."""
        laws = (({'law': 'cowper_symonds', 'reference_rate': 6500.0, 'exponent': 4.0}, lambda rate: 1 + (rate / 6500)**0.25),
                ({'law': 'johnson_cook', 'reference_rate': 1.0, 'coefficient': 0.015}, lambda rate: 1 + 0.015 * math.log(rate)),
                ({'law': 'power', 'reference_rate': 0.1, 'exponent': 0.02}, lambda rate: (10 * rate)**0.02))
        for pattern in ('fine', 'one_point'):
            for law, factor in laws:
                for speed_up in (1.0, 100.0):
                    with self.subTest(pattern=pattern, law=law['law'], speed_up=speed_up):
                        bar = body('plate', {'hardening': {'curve': 'perfect', 'yield_stress': 150e6}, 'rate_dependence': dict(law, speed_up=speed_up)})
                        bar['blank'].update(pattern=pattern, width=0.002, cells_along=6, cells_across=2, cells_through=2)
                        bar['initial_velocity_field'] = ['2000*(x-0.005)', '-1000*y', '-1000*z']
                        bar['boundaries'] = [{'set': side, 'kind': 'velocity', 'axes': ['x'], 'times': [0.0], 'velocities': [[way, 0, 0]]} for side, way in (('left', -10.0), ('right', 10.0))]
                        self.run_scene(scene(bar, dimension=3, duration=5e-5, output={'frames': 2, 'probes': [{'name': 'middle', 'point': [0.005, 0.001, 0.001]}]}))
                        rows = self.history()
                        found = [float(row['probe_middle_stress_xx_Pa']) / (150e6 * factor(20 / (0.010 + 20 * float(row['time_s'])) / speed_up)) for row in rows[len(rows) // 2:]]
                        self.assertAlmostEqual(numpy.mean(found), 1, delta=0.002)
                        self.assertAlmostEqual(max(found), 1, delta=0.01)

    def test_strains_at_which_metal_parts_are_told(self):
        for squeezed, told in ((0.6, False), (0.945, True)):
            block = body('strip', {'hardening': {'curve': 'perfect', 'yield_stress': 100e6}})
            block['blank'].update(length=0.001, thickness=0.001, cells_along=2)
            block['boundaries'] = [{'set': name, 'kind': 'symmetric', 'normal': normal} for name, normal in (('left', [1, 0, 0]), ('bottom', [0, 1, 0]))]
            block['boundaries'].append({'set': 'top', 'kind': 'velocity', 'axes': ['y'], 'times': [0.0], 'velocities': [[0, -10, 0]]})
            warnings = self.run_scene(scene(block, duration=1e-4 * squeezed))['warnings']
            self.assertEqual(any('nothing parts here' in each for each in warnings), told, warnings)

    def test_corners_of_tools_that_cells_are_too_large_for_are_told(self):
        """A punch of 10 mm pressed into a billet of twice that width in a container: with a sharp edge the cells round it, with a radius of a cell and more they follow it."""
        width, radius = 0.005, 1e-3
        sharp = {'start': [-0.002, 0.01], 'pieces': [{'to': [width, 0.01]}, {'to': [width, 0.03]}]}
        rounded = {'start': [-0.002, 0.01], 'pieces': [{'to': [width - radius, 0.01]}, {'to': [width, 0.01 + radius], 'radius': radius}, {'to': [width, 0.03]}]}
        for profile, told in ((sharp, True), (rounded, False)):
            billet = body('strip', {'hardening': {'curve': 'perfect', 'yield_stress': 200e6}}, boundaries=[{'set': 'left', 'kind': 'symmetric', 'normal': [1, 0, 0]}])
            billet['blank'].update(length=0.01, thickness=0.01, cells_along=12, cells_through=12)
            tools = [{'name': 'punch', 'profile': profile, 'motion': {'kind': 'trajectory', 'times': [0, 6e-4], 'positions': [[0, 0], [0, -0.0025]]}},
                     {'name': 'floor', 'normal': [0, 1]}, {'name': 'wall', 'point': [0.01, 0], 'normal': [-1, 0]}]
            warnings = self.run_scene(scene(billet, tools=tools, duration=6e-4, output={'frames': 20}))['warnings']
            self.assertEqual([each for each in warnings if 'spanned a corner of tool punch' in each] != [], told, warnings)

    def test_a_settle_stage_says_why_it_does_not_end(self):
        """What flies is told, and what swings is not taken for it."""
        def why(part, **fields):
            data = scene(part, duration=1e-5, **fields)
            data['stages'].append({'kind': 'settle', 'limit': 5e-5})
            with open(self.path('scene.yaml'), 'w') as file:
                yaml.safe_dump(data, file)
            run = subprocess.run([OFFLINE, self.path('scene.yaml'), '--output', self.path('out'), '--quiet'], stderr=subprocess.PIPE, text=True)
            self.assertEqual(run.returncode, 1)
            return run.stderr
        self.assertIn('body body goes as a whole, with', why(body('strip'), gravity=[0, -9.81]))
        swings = why(body('strip', boundaries=[{'set': 'left', 'kind': 'fixed'}], initial_velocity_field=['0', '5*(x/0.01)^2']))
        self.assertIn('a longer limit lets them come to rest', swings)
        pulled = body('strip', boundaries=[{'set': 'left', 'kind': 'trajectory', 'times': [0, 1], 'positions': [[0, 0], [1, 0]], 'profile': 'linear'}])
        self.assertIn('a motion, a pressure or a load still changed', why(pulled))

    def test_a_rate_dependence_says_what_it_misses(self):
        for rate, hardening, word in (({'law': 'cowper_symonds', 'reference_rate': 40.0}, True, 'rate_dependence.exponent'),
                                      ({'law': 'cowper_symonds', 'reference_rate': 40.0, 'exponent': 0.2}, True, 'at least 1'),
                                      ({'law': 'power', 'reference_rate': 1.0, 'exponent': 20.0}, True, 'at most 1'),
                                      ({'law': 'johnson_cook', 'reference_rate': 0.0, 'coefficient': 0.01}, True, 'rate_dependence.reference_rate'),
                                      ({'law': 'johnson_cook', 'reference_rate': 1.0, 'coefficient': 0.01}, False, 'without hardening')):
            material = dict({'rate_dependence': rate}, **({'hardening': {'curve': 'perfect', 'yield_stress': 150e6}} if hardening else {}))
            self.assertIn(word, self.refused(scene(body('strip', material))))
        for field, value in (('rate_dependence', {'law': 'johnson_cook', 'reference_rate': 1.0, 'coefficient': 0.01}), ('anisotropy', {'r0': 0.7})):
            self.assertIn(field + ' without hardening', self.refused(scene(body('strip', {field: value, 'layers': [{'weight': 1.0}]}))))

    def test_directions_that_no_section_can_follow_are_told(self):
        strip = body('strip', {'hardening': {'curve': 'perfect', 'yield_stress': 150e6}, 'anisotropy': {'r0': 0.7, 'rolling_direction': [1, 0, 1]}})
        with open(self.path('scene.yaml'), 'w') as file:
            yaml.safe_dump(scene(strip), file)
        said = subprocess.run([OFFLINE, '--validate', self.path('scene.yaml')], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
        self.assertIn('anisotropy.rolling_direction', said)
        self.assertIn('in the plane x-y or along z', said)
        strip['material']['anisotropy']['rolling_direction'] = [0, 0, 1]
        self.run_scene(scene(strip))

    def test_a_pressure_pulse(self):
        data = scene(body('plate', pressures=[{'set': 'top', 'times': [0.0, 1e-5, 2e-5], 'values': [0.0, 1e6, 0.0]}]), dimension=3)
        plate = self.run_scene(data)['bodies'][0]
        impulse = -1e6 * 1e-5 * 1e-4  # mean pressure, time, area
        self.assertAlmostEqual(plate['momentum'][2], impulse, delta=0.02 * abs(impulse))

    def test_one_point_cells_beside_simplices_and_resumed(self):
        """A block of one-point cells falls on one of simplices, in 2D and 3D; a run that is cut in two gives the same numbers."""
        plastic = {'hardening': {'curve': 'linear', 'yield_stress': 50e6, 'modulus': 1e9}}
        for shape, dimension, parts, down in (('strip', 2, 2, [0, -40.0, 0]), ('plate', 3, 6, [0, 0, -40.0])):
            low, high = body(shape, plastic), body(shape, plastic, initial_velocity=down)
            high['name'] = 'high'
            high['blank'].update(pattern='one_point', origin=[1.3e-3, 2.05e-3, 0] if dimension == 2 else [1.3e-3, 0.7e-3, 2.05e-3])
            data = scene(low, high, dimension=dimension, duration=1.5e-5, time_step={'linear_viscosity': 0.06, 'mass_scaling': 1.5, 'safety': 0.4})  # small steps for the blow
            data['output'].update(frames=6, checkpoint_interval=5e-6)
            whole = self.run_scene(data, 'whole')
            with h5py.File(self.path('whole/result.h5')) as result:
                of_high = result['topology/body'][:] == 1
                last = result['frames'][sorted(result['frames'])[-1]]
                strain = last['plastic_strain'][:][of_high].reshape(-1, parts)
                final = last['positions'][:]
            self.assertGreater(strain.max(), 1e-4)
            self.assertTrue((strain == strain[:, :1]).all())  # one value a cell
            momentum = sum(numpy.array(b['momentum']) for b in whole['bodies'])
            mass = whole['bodies'][1]['mass']
            numpy.testing.assert_allclose(momentum, mass * numpy.array(down), atol=1e-9 * mass * 40)
            resumed = subprocess.run([OFFLINE, self.path('scene.yaml'), '--output', self.path('again'), '--quiet', '--threads', '2',
                                      '--resume', self.path('whole/checkpoint.h5')], stderr=subprocess.PIPE, text=True)
            self.assertEqual(resumed.returncode, 0, resumed.stderr)
            with h5py.File(self.path('again/result.h5')) as result:
                last = result['frames'][sorted(result['frames'])[-1]]
                self.assertTrue((last['positions'][:] == final).all())
            shutil.rmtree(self.path('whole')), shutil.rmtree(self.path('again'))

    def test_a_ring_of_quadrilaterals_from_a_file(self):
        """A mesh of gmsh turned about the axis: one-point cells under inner pressure widen as Lame's cylinder."""
        radial, axial, inner, outer, pressure = 10, 2, 10.0, 20.0, 1e6  # millimetres, Pa
        node = lambda i, j: 1 + j * (radial + 1) + i
        points = ['%d %g %g 0' % (node(i, j), inner + (outer - inner) * i / radial, j) for j in range(axial + 1) for i in range(radial + 1)]
        lines = [(1, node(0, j + 1), node(0, j)) for j in range(axial)]
        lines += [(tag, node(i, j), node(i + 1, j)) for tag, j in ((2, 0), (3, axial)) for i in range(radial)]
        elements = ['%d 1 2 %d %d %d %d' % (n + 1, tag, tag, a, b) for n, (tag, a, b) in enumerate(lines)]
        elements += ['%d 3 2 4 4 %d %d %d %d' % (len(lines) + 1 + j * radial + i, node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1))
                     for j in range(axial) for i in range(radial)]
        with open(self.path('ring.msh'), 'w') as file:
            file.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 1 "inside"\n1 2 "low"\n1 3 "high"\n2 4 "ring"\n$EndPhysicalNames\n'
                       '$Nodes\n%d\n%s\n$EndNodes\n$Elements\n%d\n%s\n$EndElements\n' % (len(points), '\n'.join(points), len(elements), '\n'.join(elements)))
        ring = {'name': 'ring', 'mesh': {'url': 'ring.msh', 'unit_scale': 1e-3, 'pattern': 'one_point'}, 'material': dict(ALUMINIUM),
                'boundaries': [{'set': name, 'kind': 'symmetric', 'normal': [0, 1]} for name in ('low', 'high')],
                'pressures': [{'set': 'inside', 'times': [0.0, 4e-4], 'values': [0.0, pressure]}]}
        data = scene(ring, duration=5e-4, axisymmetric=True, time_step={'damping': 2e4})
        data['output']['probes'] = [{'name': 'wall', 'set': 'inside'}]
        summary = self.run_scene(data)
        mass = ALUMINIUM['density'] * math.pi * (0.020 ** 2 - 0.010 ** 2) * 0.002
        self.assertAlmostEqual(summary['bodies'][0]['mass'], mass, delta=1e-9 * mass)
        moved = float(self.history()[-1]['probe_wall_position_x_m']) - 0.010
        nu, a, b = ALUMINIUM['poissons_ratio'], 0.010, 0.020
        exact = (1 + nu) / ALUMINIUM['youngs_modulus'] * pressure * a * a / (b * b - a * a) * ((1 - 2 * nu) * a + b * b / a)
        self.assertAlmostEqual(moved, exact, delta=0.01 * exact)
        self.assertEqual(summary['elements'], 2 * radial * axial)  # a cell appears as its two triangles

    def pressed_plate(self, pattern, **fields):
        """A plate between frictionless planes of symmetry, so that what presses its top evenly makes one state of stress."""
        plate = body('plate', boundaries=[{'set': name, 'kind': 'symmetric', 'normal': normal} for name, normal in
                                          (('bottom', [0, 0, 1]), ('left', [1, 0, 0]), ('right', [1, 0, 0]), ('front', [0, 1, 0]), ('back', [0, 1, 0]))])
        plate['blank']['pattern'] = pattern
        return dict(plate, **fields)

    def test_an_even_pressure_presses_evenly(self):
        """Also on hexahedra that stay whole: every corner of a face gets a fourth."""
        lame = ALUMINIUM['youngs_modulus'] * (1 - 0.34) / (1 + 0.34) / (1 - 2 * 0.34)
        for pattern in ('one_point', 'fine', 'coarse'):
            with self.subTest(pattern=pattern):
                data = scene(self.pressed_plate(pattern, pressures=[{'set': 'top', 'times': [0.0, 1e-4], 'values': [0.0, 1e8], 'profile': 'smooth'}]), dimension=3)
                data['stages'] = [{'kind': 'form', 'duration': 1e-4}, {'kind': 'settle', 'limit': 5e-3, 'kinetic_fraction': 1e-9}]
                self.run_scene(data)
                with h5py.File(self.path('out/result.h5')) as result:
                    start, last = result['topology/initial_positions'][:], result['frames'][sorted(result['frames'])[-1]]
                    sunk = (start - last['positions'][:])[start[:, 2] > 0.0019, 2]
                    stress = last['stress'][:, 2]
                exact = 0.002 * 1e8 / lame
                self.assertLess(numpy.ptp(sunk), 1e-4 * exact)
                self.assertAlmostEqual(sunk.mean(), exact, delta=2e-3 * exact)  # of small strains
                self.assertLess(abs(stress + 1e8).max(), 1e5)

    def test_hardening_curves(self):
        """The strip is drawn out slowly; in plane strain it flows at 2/sqrt(3) of its yield stress."""
        curves = {
            'perfect': ({'curve': 'perfect', 'yield_stress': 200e6}, lambda p: 200e6),
            'linear': ({'curve': 'linear', 'yield_stress': 200e6, 'modulus': 1e9}, lambda p: 200e6 + 1e9 * p),
            'voce': ({'curve': 'voce', 'yield_stress': 192.1e6, 'saturation_stress': 429.8e6, 'rate': 8.504},
                     lambda p: 429.8e6 - 237.7e6 * math.exp(-8.504 * p)),
            'swift': ({'curve': 'swift', 'strength': 500e6, 'prestrain': 0.01, 'exponent': 0.2}, lambda p: 500e6 * (0.01 + p)**0.2),
            'table': ({'curve': 'table', 'plastic_strains': [0.0, 0.02, 0.1], 'stresses': [200e6, 250e6, 300e6]},
                      lambda p: numpy.interp(p, [0.0, 0.02, 0.1], [200e6, 250e6, 300e6]))}
        for name, (hardening, sigma) in curves.items():
            with self.subTest(curve=name):
                data = scene(body('strip', {'hardening': hardening}, boundaries=[
                    {'set': 'left', 'kind': 'fixed', 'axes': ['x']}, {'set': 'bottom', 'kind': 'symmetric', 'normal': [0.0, 1.0, 0.0]},
                    {'set': 'right', 'kind': 'velocity', 'axes': ['x'], 'profile': 'smooth', 'times': [0.0, 1e-4, 2e-4, 3e-4],
                     'velocities': [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]]}]),
                    duration=3e-4, output={'frames': 2, 'probes': [{'name': 'middle', 'point': [0.005, 0.001, 0.0]}]})
                self.run_scene(data, name)
                # The greatest: the stop at the end lets a wave of relief run through.
                stress = max(float(row['probe_middle_stress_xx_Pa']) for row in self.history(name))
                with h5py.File(self.path(name + '/result.h5')) as result:
                    p = result['frames'][sorted(result['frames'])[-1]]['plastic_strain'][:].mean()
                self.assertGreater(p, 0.03)
                expected = 2 / math.sqrt(3) * sigma(p)
                self.assertAlmostEqual(stress, expected, delta=0.02 * expected)

    def test_options_are_told_with_what_they_took(self):
        pulled = body('strip', boundaries=[
            {'set': 'left', 'kind': 'fixed'}, {'set': 'right', 'kind': 'velocity', 'axes': ['x'], 'times': [0.0, 5e-6],
                                               'velocities': [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0]]}])
        plain = self.run_scene(scene(pulled), 'plain')
        self.assertEqual(plain['energy_J']['damping'], 0)
        scaled = self.run_scene(scene(pulled, time_step={'mass_scaling': 4.0}), 'scaled')
        self.assertAlmostEqual(plain['steps'] / scaled['steps'], 2, delta=0.05)
        self.assertAlmostEqual(scaled['options']['mass_scaling']['added_mass_kg'], 3 * plain['bodies'][0]['mass'], delta=1e-9)
        for option, field in (({'linear_viscosity': 0.06, 'quadratic_viscosity': 1.2}, 'bulk_viscosity'), ({'damping': 1e5}, 'damping')):
            told = self.run_scene(scene(pulled, time_step=option), field)
            self.assertGreater(told['options'][field]['dissipated_J'], 0)
            self.assertAlmostEqual(told['options'][field]['dissipated_J'], told['energy_J']['damping'], delta=1e-12)

    def test_a_bar_is_twisted_and_let_go(self):
        """T = G (pi/2) R^4 theta/L, at both ends alike, and less by the polygon of its section; let go, it is straight again."""
        radius, length, degrees, turn = 0.01, 0.01, 0.05, 2e-4
        bar = {'shape': 'bar', 'radius': radius, 'length': length, 'cells_along': 4, 'cells_radius': 4, 'pattern': 'one_point'}
        held = [{'set': 'bottom', 'kind': 'fixed'},
                {'set': 'top', 'kind': 'velocity', 'axes': ['x', 'y'], 'times': [0, turn / 2, turn], 'profile': 'smooth',
                 'spins_deg_s': [[0, 0, 0], [0, 0, 2 * degrees / turn], [0, 0, 0]], 'until': 'settle'}]
        case = scene({'name': 'bar', 'blank': bar, 'material': ALUMINIUM, 'boundaries': held}, dimension=3, duration=1.2 * turn,
                     time_step={'damping': 2e4},
                     output={'frames': 2, 'history_interval': turn / 20, 'probes': [
                         {'name': 'top', 'set': 'top'}, {'name': 'bottom', 'set': 'bottom'}, {'name': 'rim', 'point': [radius, 0, length]}]})
        case['stages'].append({'kind': 'settle', 'limit': 5e-3})
        self.run_scene(case)
        rows = self.history()
        twisted = [row for row in rows if row['stage'] == 'form'][-1]
        shear = ALUMINIUM['youngs_modulus'] / 2 / (1 + ALUMINIUM['poissons_ratio'])
        exact = shear * math.pi / 2 * radius**4 * math.radians(degrees) / length
        moment = [float(twisted[f'probe_{end}_reaction_moment_z_N_m']) for end in ('top', 'bottom')]
        polygon = 1 - (2 * math.pi / 16)**2 / 3  # its polar moment over the circle's
        self.assertAlmostEqual(moment[0] / (polygon * exact), 1, delta=2e-3)
        self.assertAlmostEqual(moment[1] / moment[0], -1, delta=1e-3)
        self.assertAlmostEqual(float(twisted['probe_rim_position_y_m']), radius * math.sin(math.radians(degrees)), delta=1e-11)
        self.assertIn('probe_top_reaction_force_x_N', rows[0])
        self.assertEqual(float(rows[-1]['probe_top_reaction_moment_z_N_m']), 0)
        self.assertLess(abs(float(rows[-1]['probe_rim_position_y_m'])), 0.02 * radius * math.radians(degrees))

    def test_the_bore_of_a_tube_from_points(self):
        """A ring under pressure inside, in plane strain (Lame): u(a) = (1 + nu) p a/E (a^2/(b^2 - a^2)) (1 - 2 nu + b^2/a^2)."""
        inner, outer, pressure, rise, along, around = 0.01, 0.02, 1e7, 4e-4, 8, 16
        points, cells = [], []
        for j in range(around + 1):
            for i in range(along + 1):
                r, angle = inner + (outer - inner) * i / along, math.pi / 2 * j / around
                points.append([r * math.cos(angle) if j < around else 0, r * math.sin(angle), 0])
        for j in range(around):
            for i in range(along):
                first = j * (along + 1) + i
                cells += [first, first + 1, first + along + 2, first + along + 1]
        ring = {'name': 'ring', 'mesh': {'points': points, 'cells': cells, 'cell_type': 'quadrilateral', 'unit_scale': 1}, 'material': ALUMINIUM,
                'sets': [{'name': 'bore', 'choose': 'cylinder', 'radius': inner}, {'name': 'x', 'choose': 'plane', 'normal': [1, 0]},
                         {'name': 'y', 'choose': 'plane', 'normal': [0, 1]}],
                'boundaries': [{'set': 'x', 'kind': 'symmetric', 'normal': [1, 0]}, {'set': 'y', 'kind': 'symmetric', 'normal': [0, 1]}],
                'pressures': [{'set': 'bore', 'times': [0, rise], 'values': [0, pressure], 'profile': 'smooth'}]}
        self.run_scene(scene(ring, duration=1.1 * rise, output={'frames': 2, 'probes': [
            {'name': 'a', 'point': [inner, 0]}, {'name': 'cut', 'set': 'y'}]}))
        rows = self.history()
        nu, square = ALUMINIUM['poissons_ratio'], inner**2 / (outer**2 - inner**2)
        exact = (1 + nu) * pressure * inner / ALUMINIUM['youngs_modulus'] * square * (1 - 2 * nu + outer**2 / inner**2)
        self.assertAlmostEqual((float(rows[-1]['probe_a_position_x_m']) - inner) / exact, 1, delta=0.02)
        # Half the ring pulls on the cut with p a.
        self.assertAlmostEqual(float(rows[-1]['probe_cut_reaction_force_y_N_per_m']) / (-pressure * inner), 1, delta=0.02)


    def test_a_sliver_that_flexes_is_followed(self):
        """Between two cubes whose faces have other diagonals lies a tetrahedron 3e-8 m thick: it bears nothing until it has changed by a fifth, and is stiff then."""
        thick = 3e-8
        points, cells = [], []

        def node(point):
            points.append(point)
            return len(points) - 1
        corner = {(i, j, k): node([i * 1e-3, j * 1e-3, k * 1e-3]) for i in range(3) for j in range(2) for k in range(2)}
        points[corner[1, 0, 0]][0] -= thick
        for i in (0, 1):
            middle = node([(i + 0.5) * 1e-3, 0.5e-3, 0.5e-3])
            quads = [[(i, 0, 0), (i, 0, 1), (i, 1, 1), (i, 1, 0)], [(i + 1, 0, 0), (i + 1, 1, 0), (i + 1, 1, 1), (i + 1, 0, 1)], [(i, 0, 0), (i + 1, 0, 0), (i + 1, 0, 1), (i, 0, 1)],
                     [(i, 1, 0), (i, 1, 1), (i + 1, 1, 1), (i + 1, 1, 0)], [(i, 0, 0), (i, 1, 0), (i + 1, 1, 0), (i + 1, 0, 0)], [(i, 0, 1), (i + 1, 0, 1), (i + 1, 1, 1), (i, 1, 1)]]
            for quad in quads:
                a, b, c, d = (corner[q] for q in quad)
                if i == 1 and quad[0] == (1, 0, 0) and quad[2] == (1, 1, 1):
                    a, b, c, d = b, c, d, a  # the other diagonal
                cells += [a, b, c, middle, a, c, d, middle]
        a, b, c, d = corner[1, 0, 0], corner[1, 1, 0], corner[1, 1, 1], corner[1, 0, 1]
        cells += [a, c, b, d]

        def volume(t):
            p = numpy.array([points[n] for n in t])
            return numpy.linalg.det(p[1:] - p[0]) / 6
        cells = [n for t in (cells[k:k + 4] for k in range(0, len(cells), 4)) for n in (t if volume(t) > 0 else [t[0], t[2], t[1], t[3]])]
        for speed in (2e5, 2e6):  # of .025 and .25 m/s at the corners
            part = {'name': 'cubes', 'mesh': {'points': points, 'cells': cells, 'cell_type': 'tetrahedron', 'unit_scale': 1.0}, 'material': dict(ALUMINIUM),
                    'initial_velocity_field': [f'{speed}*(y-5e-4)*(z-5e-4)', '0', '0']}
            summary = self.run_scene(scene(part, dimension=3, duration=2e-5, time_step={'limit': 'global'}))
            self.assertLess(summary['energy_J']['balance_error'], 0.005)
            self.assertLess(summary['steps'], 8e3 if speed < 1e6 else 3e4)  # by nodes it takes 2e4


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
