#!/usr/bin/python3
"""What tools do to bodies, and bodies to each other: contact as a scene says it, each shown by what a mechanician would check.

usage: tools_test.py FORMING_OFFLINE
"""
import math
import subprocess
import sys
import unittest

import h5py
import numpy
import yaml

from scene_run import ALUMINIUM, OFFLINE, SceneRun, body, scene


CUBE = [[x, y, z] for z in (2.0, 5.0) for y in (-1.0, 11.0) for x in (-1.0, 11.0)]  # millimetres, on the plate
FACETS = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]


def cube_files():
    """The same cube in every format."""
    points = '\n'.join('%g %g %g' % tuple(p) for p in CUBE)
    stl = 'solid c\n' + ''.join('facet normal 0 0 0\nouter loop\n' + ''.join('vertex %g %g %g\n' % tuple(CUBE[i]) for i in f) + 'endloop\nendfacet\n'
                                for f in FACETS) + 'endsolid c\n'
    obj = ''.join('v %g %g %g\n' % tuple(p) for p in CUBE) + ''.join('f %d %d %d\n' % tuple(i + 1 for i in f) for f in FACETS)
    ply = ('ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face 12\n'
           'property list uchar int vertex_indices\nend_header\n' + points + '\n' + ''.join('3 %d %d %d\n' % f for f in FACETS))
    dae = ('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><up_axis>Z_UP</up_axis></asset>'
           '<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="24">' + points.replace('\n', ' ') +
           '</float_array><technique_common><accessor source="#a" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>'
           '<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
           '<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>' + ' '.join('%d %d %d' % f for f in FACETS) +
           '</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/>'
           '</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>')
    return {'cube.stl': stl, 'cube.obj': obj, 'cube.ply': ply, 'cube.dae': dae}


class Tools(SceneRun):
    def lifted(self, *more):
        """A clamped strip that a rounded tool lifts at its end."""
        strip = {'name': 'strip', 'blank': {'shape': 'strip', 'length': 0.010, 'thickness': 0.001, 'cells_along': 20, 'cells_through': 2},
                 'material': dict(ALUMINIUM), 'boundaries': [{'set': 'left', 'kind': 'fixed'}]}
        lifter = {'name': 'lifter', 'profile': {'start': [9.5e-3, -5e-3], 'pieces': [
            {'to': [9.5e-3, -0.5e-3]}, {'to': [8.5e-3, -0.5e-3], 'radius': 0.5e-3}, {'to': [8.5e-3, -5e-3]}]},
            'motion': {'kind': 'trajectory', 'times': [0, 3e-4], 'positions': [[0, 0], [0, 0.05e-3]]}}
        data = scene(strip, tools=[lifter], duration=3e-4)
        data['stages'] += list(more) + [{'kind': 'settle', 'limit': 2e-3}]
        return self.run_scene(data)

    def test_a_body_comes_to_rest_on_a_tool_that_stays(self):
        summary = self.lifted()
        energy = summary['energy_J']
        self.assertGreater(energy['elastic'], 0.03)
        self.assertLess(energy['kinetic'], 1e-5 * energy['elastic'])

    def test_a_body_that_returns_to_its_shape_comes_to_rest_and_contact_gave_it_nothing(self):
        summary = self.lifted({'kind': 'withdraw', 'displacement': [0, -0.1e-3], 'duration': 3e-4})
        energy = summary['energy_J']
        self.assertLess(energy['elastic'], 1e-9)
        most = max(float(row['work_J_per_m']) for row in self.history())
        self.assertGreater(most, 0.03)
        self.assertGreater(energy['contact'], -1e-6 * most)
        self.assertLess(energy['contact'], 1e-3 * most)

    def test_every_tool_format_is_the_same_tool(self):
        found = {}
        for name, text in cube_files().items():
            with open(self.path(name), 'w') as file:
                file.write(text)
            data = scene(body('plate', boundaries=[{'set': 'bottom', 'kind': 'fixed', 'axes': ['z']}]), dimension=3, tools=[{
                'name': 'cube', 'mesh': {'url': name, 'unit_scale': 0.001},
                'motion': {'kind': 'velocity', 'times': [0.0, 5e-6], 'velocities': [[0.0, 0.0, 0.0], [0.0, 0.0, -5.0]]}}])
            found[name] = self.run_scene(data, name + '.out')['tools'][0]['peak_force']
            self.assertGreater(found[name][2], 100)
        for name in found:
            numpy.testing.assert_allclose(found[name], found['cube.stl'], rtol=1e-9, err_msg=name)

    def test_a_press_fit(self):
        """A hub is opened by pressure, a shaft that is too thick for it is put in, and the pressure goes: Lame's pressure, and so much more as the layer is of the interference."""
        inner, outer, interference, modulus = 0.01, 0.02, 1e-5, 2.1e11
        steel = {'density': 7850, 'youngs_modulus': modulus, 'poissons_ratio': 0.3}
        shaft = {'name': 'shaft', 'blank': {'shape': 'strip', 'origin': [0, -0.011], 'length': inner, 'thickness': 0.01, 'cells_along': 8, 'cells_through': 8}, 'material': steel,
                 'boundaries': [{'set': 'bottom', 'kind': 'trajectory', 'axes': ['y'], 'times': [0, 1e-3, 3e-3], 'positions': [[0, 0], [0, 0], [0, 0.011]], 'until': 'rest'}]}
        hub = {'name': 'hub', 'blank': {'shape': 'strip', 'origin': [inner - interference, 0], 'length': outer - inner + interference, 'thickness': 0.01, 'cells_along': 8, 'cells_through': 8},
               'material': steel, 'boundaries': [{'set': 'right', 'kind': 'fixed', 'axes': ['y'], 'until': 'rest'}],
               'pressures': [{'set': 'left', 'times': [0, 1e-3, 3e-3, 4e-3], 'values': [0, 2e8, 2e8, 0], 'profile': 'smooth'}]}
        lame = modulus * interference / inner * (outer ** 2 - inner ** 2) / (2 * outer ** 2)  # of one material, the shaft solid
        for layer in (0, 5e-8):
            data = scene(shaft, hub, axisymmetric=True, contact={'layer': layer} if layer else {}, output={'frames': 1, 'probes': [{'name': 'shaft', 'body': 'shaft', 'set': 'right'}]})
            data['stages'] = [{'kind': 'form', 'duration': 4e-3}, {'kind': 'settle', 'name': 'rest', 'limit': 3e-3, 'kinetic_fraction': 1e-7}]
            summary = self.run_scene(data)
            h0 = summary['contact']['h0_m']
            self.assertAlmostEqual(h0, layer or 5e-7, delta=1e-3 * h0)
            pressure = -float(self.history()[-1]['probe_shaft_stress_xx_Pa'])
            self.assertAlmostEqual(pressure / lame, 1 + h0 / interference, delta=0.01)
            self.assertEqual(summary['contact']['crossings'], 0)

    def test_a_strike_keeps_coulombs_law(self):
        """Thrown at a plane at 45 degrees: of what keeps the swings of sliding bodies down it feels nothing."""
        blank = {'shape': 'strip', 'origin': [0, 1e-5], 'length': 0.01, 'thickness': 0.01, 'cells_along': 10, 'cells_through': 10}
        plane = {'name': 'plane', 'point': [0, 0, 0], 'normal': [0, 1], 'friction': 0.1}
        for pattern in ('one_point', 'fine'):
            for hardening in (None, {'curve': 'linear', 'yield_stress': 2e7, 'modulus': 1e9}):
                block = body(material={'hardening': hardening} if hardening else None, blank=dict(blank, pattern=pattern), initial_velocity=[3, -3])
                ratio = {}
                for swing in ('damped', 'free'):
                    summary = self.run_scene(scene(block, tools=[plane], duration=3e-5, contact={'swing': swing}, output={'frames': 1, 'history_interval': 1e-7}))
                    self.assertEqual(summary['contact']['crossings'], 0)
                    rows = self.history()
                    times = [float(row['time_s']) for row in rows]
                    along, across = (sum(float(row['tool_plane_force_%s_N_per_m' % axis]) * (time - before) for row, time, before in zip(rows[1:], times[1:], times)) for axis in 'xy')
                    ratio[swing] = along / -across
                    self.assertEqual(float(rows[-1]['tool_plane_force_y_N_per_m']), 0, 'it has left the plane')
                self.assertAlmostEqual(ratio['damped'], ratio['free'], delta=1e-9)
                if not hardening:  # one that flows slips back here and there
                    self.assertAlmostEqual(ratio['damped'], 0.1, delta=2e-4)

    def test_an_edge_flush_with_a_clamped_end_ends_the_run_by_the_name_of_the_node(self):
        """What presses there has no lever on the nodes beside the clamp; the run once went on with forces without bound."""
        strip = {'name': 'strip', 'blank': {'shape': 'strip', 'length': 0.008, 'thickness': 0.001, 'cells_along': 6, 'cells_through': 3}, 'material': dict(ALUMINIUM),
                 'boundaries': [{'set': 'left', 'kind': 'fixed'}]}
        for motion in ({'kind': 'force', 'times': [0, 3e-5], 'forces': [[0, 0], [0, -48e3]], 'mass': 1.4e-4}, {'kind': 'trajectory', 'times': [0, 2e-5], 'positions': [[0, 0], [0, -1e-4]]}):
            for edge in (0.0, 1e-6, -1e-5):
                block = {'name': 'block', 'profile': {'closed': True, 'start': [edge, 0.003], 'pieces': [{'to': [edge, 0.001]}, {'to': [0.0048, 0.001]}, {'to': [0.0048, 0.003]}]}, 'motion': motion}
                with open(self.path('scene.yaml'), 'w') as file:
                    yaml.safe_dump(scene(strip, tools=[block], duration=4e-5), file)
                run = subprocess.run([OFFLINE, self.path('scene.yaml'), '--output', self.path('out'), '--quiet'], stderr=subprocess.PIPE, text=True)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertIn('tool block runs over node', run.stderr)
                self.assertIn('which is held or driven against it', run.stderr)

    def test_bodies_that_stick_to_each_other_in_a_plane_of_symmetry(self):
        """Of two strips that are bent about it, the boundaries bear what bends them and no more, whether they are tied or stick, and friction gives nothing."""
        def strip(name, y):
            return {'name': name, 'blank': {'shape': 'strip', 'origin': [0, y], 'length': 0.01, 'thickness': 0.001, 'cells_along': 10, 'cells_through': 2, 'pattern': 'one_point'},
                    'material': dict(ALUMINIUM, hardening={'curve': 'linear', 'yield_stress': 150e6, 'modulus': 300e6}), 'boundaries': [{'set': 'left', 'kind': 'symmetric', 'normal': [1, 0, 0]}]}
        circle = {'start': [0, -0.002], 'pieces': [{'to': [0, 0.002], 'radius': 0.002}, {'to': [0, -0.002], 'radius': 0.002}]}
        tools = [{'name': 'die', 'profile': circle, 'position': [0.008, -0.002]},
                 {'name': 'punch', 'profile': circle, 'position': [0, 0.004], 'motion': {'kind': 'trajectory', 'times': [0, 4e-4], 'positions': [[0, 0], [0, -0.002]]}}]
        most = {}
        for kind in ('sticking', 'tied'):
            data = scene(strip('lower', 0.0), strip('upper', 0.001), tools=tools, duration=4e-4, contact={'pairs': [{'first': 'lower', 'second': 'upper', 'kind': kind}]},
                         output={'frames': 2, 'history_interval': 1e-5, 'probes': [{'name': each, 'body': each, 'set': 'left'} for each in ('lower', 'upper')]})
            energy = self.run_scene(data)['energy_J']
            self.assertGreater(energy['friction'], -1e-3 * energy['work'])
            most[kind] = max(abs(float(row[f'probe_{each}_reaction_force_x_N_per_m'])) for row in self.history() for each in ('lower', 'upper'))
        self.assertLess(most['sticking'], 1.5 * most['tied'])

    def test_work_is_what_tools_do_where_pairs_come_and_go(self):
        """A facetted ball right over a node: its corners and edges press by turns, and what each pushes as it comes is no work of the ball."""
        plate = {'name': 'plate', 'blank': {'shape': 'plate', 'length': 0.01, 'width': 0.01, 'thickness': 0.002, 'cells_along': 4, 'cells_across': 4, 'cells_through': 2, 'pattern': 'one_point'},
                 'material': dict(ALUMINIUM, hardening={'curve': 'linear', 'yield_stress': 150e6, 'modulus': 300e6}), 'boundaries': [{'set': 'bottom', 'kind': 'fixed'}]}
        r, rings, around = 0.004, 6, 12
        points = [[0, 0, -r]] + [[r * math.sin(a) * math.cos(b), r * math.sin(a) * math.sin(b), -r * math.cos(a)] for a in (math.pi / rings * i for i in range(1, rings)) for b in (2 * math.pi / around * j for j in range(around))] + [[0, 0, r]]
        top, at = len(points) - 1, lambda i, j: 1 + i * around + j % around
        facets = [corner for j in range(around) for corner in (0, at(0, j + 1), at(0, j), top, at(rings - 2, j), at(rings - 2, j + 1))]
        for i in range(rings - 2):
            for j in range(around):
                facets += [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j)]
        ball = {'name': 'ball', 'mesh': {'unit_scale': 1.0, 'points': points, 'cell_type': 'triangle', 'cells': facets}, 'position': [0.005, 0.005, 0.002 + r],
                'motion': {'kind': 'trajectory', 'times': [0, 1e-4], 'positions': [[0, 0, 0], [0, 0, -2e-4]]}}
        energy = self.run_scene(scene(plate, dimension=3, tools=[ball], duration=1e-4, output={'frames': 2, 'history_interval': 5e-7}))['energy_J']
        rows = self.history()
        done = sum(-float(row['tool_ball_force_z_N']) * (float(row['tool_ball_position_z_m']) - float(before['tool_ball_position_z_m'])) for before, row in zip(rows, rows[1:]))
        self.assertAlmostEqual(energy['work'] / done, 1, delta=0.02)
        self.assertLess(abs(energy['contact']), 0.05 * energy['work'])

    def test_contact_pressure_adds_up_to_the_tool_force(self):
        for kind, speed in (('sliding', -1.0), ('tied', -1.0), ('tied', 1.0)):
            with self.subTest(kind=kind, speed=speed):
                plate = body('plate', boundaries=[{'set': 'bottom', 'kind': 'fixed', 'axes': ['z']}])
                data = scene(plate, dimension=3, tools=[{
                    'name': 'press', 'point': [0.0, 0.0, 0.002], 'normal': [0.0, 0.0, -1.0],
                    'motion': {'kind': 'velocity', 'times': [0.0, 5e-6], 'velocities': [[0.0, 0.0, 0.0], [0.0, 0.0, speed]]}}])
                data['contact'] = {'pairs': [{'first': plate['name'], 'second': 'press', 'kind': kind}]}
                out = '%s%+g' % (kind, speed)
                self.run_scene(data, out)
                with h5py.File(self.path(out + '/result.h5')) as result:
                    last = result['frames'][sorted(result['frames'])[-1]]
                    pressure, facets = last['contact_pressure'][:], result['topology/surface'][:]
                    start, now = result['topology/initial_positions'][:], last['positions'][:]
                    area = numpy.zeros(len(now))
                    for a, b, c in facets:  # those that touch with all their nodes, as they are now
                        if min(start[[a, b, c], 2]) > 0.0019:
                            area[[a, b, c]] += numpy.linalg.norm(numpy.cross(now[b] - now[a], now[c] - now[a])) / 6
                    force = last['tools/0/force'][2]
                self.assertGreater(-speed * force, 1000)  # below 0: a tie that pulls
                self.assertAlmostEqual((pressure * area).sum(), force, delta=1e-3 * abs(force))
                self.assertEqual(abs(pressure[start[:, 2] < 0.0019]).max(), 0)

    def test_contact_pressure_is_that_of_the_face_that_touches_now(self):
        """A block that is pressed to half its height without friction: force over what its top has become, the same at edges and corners."""
        for pattern in ('one_point', 'fine'):
            with self.subTest(pattern=pattern):
                block = body('plate', boundaries=[{'set': name, 'kind': 'symmetric', 'normal': normal} for name, normal in
                                                  (('bottom', [0, 0, 1]), ('left', [1, 0, 0]), ('front', [0, 1, 0]))],
                             material={'hardening': {'curve': 'perfect', 'yield_stress': 2e8}})
                block['blank'] = {'shape': 'plate', 'length': 0.002, 'width': 0.002, 'thickness': 0.002, 'cells_along': 3, 'cells_across': 3, 'cells_through': 3,
                                  'pattern': pattern}
                data = scene(block, dimension=3, tools=[{'name': 'press', 'point': [0.0, 0.0, 0.002], 'normal': [0.0, 0.0, -1.0],
                                                         'motion': {'kind': 'trajectory', 'times': [0.0, 1e-3], 'positions': [[0.0, 0.0, 0.0], [0.0, 0.0, -0.001]]}}])
                data['stages'] = [{'kind': 'form', 'duration': 1e-3}]
                self.run_scene(data)
                with h5py.File(self.path('out/result.h5')) as result:
                    start, last = result['topology/initial_positions'][:], result['frames'][sorted(result['frames'])[-1]]
                    pressure = last['contact_pressure'][:][start[:, 2] > 0.00199]
                self.assertLess(abs(pressure - 2e8).max(), 6e6)

    def test_a_body_that_tools_hold_keeps_their_forces_while_it_settles(self):
        """Pressed and pulled along by friction, without sliding: damping, which changes all the time, neither lets go of it nor makes energy."""
        block = body('strip', boundaries=[{'set': 'bottom', 'kind': 'fixed'}])
        data = scene(block, tools=[{'name': 'ram', 'point': [0.0, 0.002], 'normal': [0.0, -1.0], 'friction': 0.3, 'motion': {
            'kind': 'trajectory', 'times': [0.0, 1e-4, 2e-4], 'positions': [[0.0, 0.0], [0.0, -4e-6], [1e-6, -4e-6]]}}])
        data['stages'] = [{'kind': 'form', 'duration': 2.5e-4}, {'kind': 'settle', 'limit': 1e-3, 'kinetic_fraction': 1e-11}]
        data['output'] = {'frames': 2, 'history_interval': 1e-5}
        summary = self.run_scene(data)
        self.assertEqual(summary['status']['name'], 'success')
        rows = self.history()
        formed, rest = [r for r in rows if r['stage'] == 'form'][-1], rows[-1]
        self.assertEqual(rest['stage'], 'settle')
        for quantity in ('tool_ram_force_x_N_per_m', 'tool_ram_force_y_N_per_m'):
            self.assertAlmostEqual(float(rest[quantity]), float(formed[quantity]), delta=2e-4 * abs(float(formed[quantity])))
        taken = [float(r['damping_J_per_m']) for r in rows]
        self.assertGreater(taken[-1], 0)
        self.assertEqual(taken, sorted(taken))
        self.assertLess(abs(float(rest['contact_J_per_m']) - float(formed['contact_J_per_m'])), 1e-3 * float(formed['contact_J_per_m']))

    def test_a_wall_that_presses_around_the_axis_is_not_idle(self):
        """What is radial cancels in the force of an axisymmetric tool; still it has touched."""
        plug = body('strip', boundaries=[{'set': 'bottom', 'kind': 'fixed', 'axes': ['y']},
                                         {'set': 'top', 'kind': 'velocity', 'axes': ['y'], 'times': [0.0], 'velocities': [[0.0, -1.0, 0.0]]}])
        data = scene(plug, axisymmetric=True, tools=[{'name': 'wall', 'point': [0.010, 0.0], 'normal': [-1.0, 0.0]},
                                                     {'name': 'far', 'point': [0.020, 0.0], 'normal': [-1.0, 0.0]}])
        summary = self.run_scene(data)
        idle = [w for w in summary['warnings'] if 'has touched nothing' in w]
        self.assertEqual(len(idle), 1, idle)
        self.assertIn('tool far ', idle[0])
        wall = summary['tools'][0]
        self.assertGreater(wall['peak_radial_force'], 0)
        self.assertEqual(wall['peak_force'][0], 0)

    def test_a_body_that_is_shut_in_tells_that_its_layers_are_flat(self):
        """Rubber with nowhere to go bears far more than the stiffness of its layers, which is its Young's modulus; E is M less h0 a side."""
        rubber = {'name': 'plug', 'blank': {'shape': 'strip', 'length': 0.01, 'thickness': 0.01, 'cells_along': 4, 'cells_through': 4},
                  'material': {'density': 1000.0, 'youngs_modulus': 1e7, 'poissons_ratio': 0.4999}}
        strain, duration = 0.01, 2e-3
        tools = [{'name': 'floor', 'point': [0.0, 0.0], 'normal': [0.0, 1.0]}, {'name': 'wall', 'point': [0.01, 0.0], 'normal': [-1.0, 0.0]},
                 {'name': 'ram', 'point': [0.0, 0.01], 'normal': [0.0, -1.0],
                  'motion': {'kind': 'trajectory', 'times': [0.0, duration], 'positions': [[0.0, 0.0], [0.0, -strain * 0.01]]}}]
        young, nu = 1e7, 0.4999
        exact = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) * -math.log(1 - strain) * math.pi * 0.01**2  # J = 1 - strain; K ln J / J is no more than a per cent from it
        pressed = {}
        for name, contact in (('as_it_is', {}), ('stiff', {'stiffness': 1.7e10})):
            summary = self.run_scene(scene(rubber, axisymmetric=True, tools=[dict(t) for t in tools], duration=duration, contact=contact), name + '.out')
            pressed[name] = summary['tools'][2]['peak_force'][1] / exact
            outward = float(self.history(name + '.out')[-1]['tool_wall_radial_force_N'])
            self.assertAlmostEqual(outward / (2 * summary['tools'][2]['peak_force'][1]), 1, delta=0.03)  # 2 pi R h p is twice pi R^2 p
            told = [w for w in summary['warnings'] if 'contact layers were pressed to' in w]
            self.assertEqual(len(told), 1 if name == 'as_it_is' else 0, summary['warnings'])
        print('    shut in rubber, force over the exact one:', pressed)
        self.assertAlmostEqual(pressed['stiff'], 1, delta=0.05)
        self.assertLess(pressed['as_it_is'], 0.95)

    def test_pairs_of_the_contact(self):
        """Two strips, one on the other: tied they move as one; sliding the upper stays behind, and its slip says by how much."""
        ends = {}
        for kind in ('tied', 'frictionless', 'sliding'):
            upper = body('strip', boundaries=[{'set': 'top', 'kind': 'fixed', 'axes': ['y']}])
            upper['name'], upper['blank']['origin'] = 'upper', [0.0, 0.002, 0.0]
            upper['blank']['cells_along'] = 7
            lower = body('strip', boundaries=[{'set': 'bottom', 'kind': 'velocity', 'axes': ['x', 'y'], 'times': [0.0, 1e-5],
                                              'velocities': [[0.0, 0.0, 0.0], [10.0, 0.05, 0.0]]}])
            data = scene(lower, duration=5e-5)
            data['bodies'].append(upper)
            pair = {'first': lower['name'], 'second': 'upper', 'kind': kind}
            if kind == 'sliding':
                pair['friction'] = 0.2
            data['contact'] = {'pairs': [pair]}
            self.run_scene(data, kind)
            with h5py.File(self.path(kind + '/result.h5')) as result:
                last = result['frames'][sorted(result['frames'])[-1]]
                x, start = last['positions'][:], result['topology/initial_positions'][:]
                half = len(start) - 8 * 3 - 7 * 2
                on = [n for n in range(half, len(start)) if abs(start[n, 1] - start[half:, 1].min()) < 1e-6 and start[n, 0] > 0.001]
                ends[kind] = (x - start)[on, 0].mean()
                gap = last['contact_gap'][:]
                self.assertEqual(last['contact_gap'].attrs['unit'], 'm')
                self.assertEqual('contact_slip' in last, kind == 'sliding')
                if kind == 'sliding':
                    below = (x - start)[:half][start[:half, 1] > 0.0019, 0].mean()
                    self.assertAlmostEqual(last['contact_slip'][:][on].mean(), below - ends[kind], delta=0.1 * below)
                if kind != 'tied':
                    self.assertLess(gap[on].max(), 1e-5)
                    self.assertGreater(gap[on].min(), 0)
        self.assertAlmostEqual(ends['tied'], 4.5e-4, delta=5e-5)
        self.assertLess(abs(ends['frictionless']), 1e-6)
        self.assertGreater(ends['sliding'], 10 * abs(ends['frictionless']))
        self.assertLess(ends['sliding'], ends['tied'])

    def test_what_ties_hold_twice_is_held_once(self):
        """A block on a bed, tied to it and to a wall at its side, which moves: the corner is told to be in two places. Then a folding machine, whose plates part at a strip's middle cell."""
        def box(least, greatest):
            (x, y), (u, v) = least, greatest
            return {'start': [x, y, 0.0], 'pieces': [{'to': [float(a), float(b), 0.0]} for a, b in ((u, y), (u, v), (x, v))], 'closed': True}
        bed = {'name': 'bed', 'profile': box((-0.01, -0.01), (0.02, 0.0))}
        wall = {'name': 'wall', 'profile': box((-0.01, -0.0001), (0.0, 0.03)), 'motion': {'kind': 'trajectory', 'times': [0, 2e-4], 'positions': [[0, 0, 0], [0, 2e-5, 0]]}}
        block = body(blank={'shape': 'strip', 'length': 0.01, 'thickness': 0.02, 'cells_along': 4, 'cells_through': 8})
        ties = {'pairs': [{'first': 'body', 'second': tool, 'kind': 'tied'} for tool in ('bed', 'wall')]}
        corner = self.run_scene(scene(block, tools=[bed, wall], contact=ties, duration=2e-4), 'corner')
        plates = [{'name': 'bed', 'profile': box((-0.03, -0.01), (0.0, 0.0))},
                  {'name': 'wall', 'profile': box((0.0, -0.01), (0.03, 0.0)), 'motion': {'kind': 'trajectory', 'times': [0, 2e-4], 'positions': [[0, 0, 0], [0, 0, 0]], 'rotations_deg': [[0, 0, 0], [0, 0, 0.2]]}}]
        strip = body(blank={'shape': 'strip', 'origin': [-0.0205, 0.0], 'length': 0.041, 'thickness': 0.002, 'cells_along': 41, 'cells_through': 2})
        fold = self.run_scene(scene(strip, tools=plates, contact=ties, duration=2e-4), 'fold')
        for run in (corner, fold):
            energy = run['energy_J']
            self.assertAlmostEqual(energy['work'] / (energy['elastic'] + energy['kinetic']), 1, delta=0.01)
        self.assertTrue(any('body and tool wall are tied, and part where other ties' in w for w in corner['warnings']), corner['warnings'])
        # What has parted stays parted when the bed leaves: it would snap shut.
        leaving = scene(block, tools=[bed, wall], contact=ties, duration=2e-4)
        leaving['stages'] += [{'kind': 'withdraw', 'tools': ['bed'], 'duration': 1e-5}, {'kind': 'settle', 'limit': 5e-3}]
        energy = self.run_scene(leaving, 'leaving')['energy_J']
        self.assertAlmostEqual(energy['work'], corner['energy_J']['work'], delta=0.1 * corner['energy_J']['work'])
        # What has parted stays parted when the bed leaves: it would snap shut.
        leaving = scene(block, tools=[bed, wall], contact=ties, duration=2e-4)
        leaving['stages'] += [{'kind': 'withdraw', 'tools': ['bed'], 'duration': 1e-5}, {'kind': 'settle', 'limit': 5e-3}]
        energy = self.run_scene(leaving, 'leaving')['energy_J']
        self.assertAlmostEqual(energy['work'], corner['energy_J']['work'], delta=0.1 * corner['energy_J']['work'])

    def test_bodies_that_touch_are_parted_and_push_each_other(self):
        lower, upper = body('strip'), body('strip', initial_velocity=[0.0, -5.0, 0.0])
        lower['boundaries'] = [{'set': 'bottom', 'kind': 'fixed'}]
        upper['name'] = 'upper'
        upper['blank'] = dict(upper['blank'], origin=[0.001, 0.002, 0.0], cells_along=7)
        summary = self.run_scene(scene(lower, upper))
        self.assertEqual(summary['contact']['crossings'], 0)
        self.assertTrue(any('body upper touches another body' in note for note in summary['warnings']), summary['warnings'])
        self.assertGreater(summary['bodies'][1]['momentum'][1], 0, 'it should have bounced')

    def test_a_joint_of_two_tools_that_stand_flush_is_no_edge(self):
        """A pressed block slides over it as over one tool, however many layers it goes in a step; where one part sinks the other keeps its edge."""
        def part(name, low, high, **more):
            points = [[x, y, z] for z in (-0.004, 0.0) for y in (-0.004, 0.010) for x in (low, high)]
            return dict({'name': name, 'friction': 0.3, 'mesh': {'points': points, 'cells': [corner for facet in FACETS for corner in facet], 'cell_type': 'triangle', 'unit_scale': 1.0}}, **more)
        block = {'name': 'b', 'material': dict(ALUMINIUM), 'blank': {'shape': 'plate', 'pattern': 'one_point', 'length': 0.006, 'width': 0.006, 'thickness': 0.002, 'cells_along': 6, 'cells_across': 6, 'cells_through': 2},
                 'boundaries': [{'set': 'top', 'kind': 'velocity', 'axes': ['x', 'y'], 'profile': 'smooth', 'times': [0, 2e-5, 8e-5], 'velocities': [[0, 0, 0], [0, 0, 0], [20, 0, 0]]}],
                 'pressures': [{'set': 'top', 'profile': 'smooth', 'times': [0, 2e-5], 'values': [0, 20e6]}]}
        sinks = {'kind': 'trajectory', 'profile': 'linear', 'times': [0, 8e-5, 1.4e-4, 3e-4], 'positions': [[0, 0, 0], [0, 0, 0], [0, 0, -0.001], [0, 0, -0.001]]}
        forces = {}
        for case, tools in (('one', [part('one', -0.001, 0.020)]), ('two', [part('left', -0.001, 0.007), part('right', 0.007, 0.020)]),
                            ('sinking', [part('left', -0.001, 0.007, motion=sinks), part('right', 0.007, 0.020)])):
            summary = self.run_scene(scene(block, dimension=3, duration=1.6e-4, tools=tools, output={'frames': 2, 'history_interval': 5e-7}))
            self.assertEqual(summary['contact']['crossings'], 0, case)
            forces[case] = [sum(float(row['tool_%s_force_x_N' % tool['name']]) for tool in tools) for row in self.history() if float(row['time_s']) > 9e-5]
        for case in ('one', 'two'):
            self.assertAlmostEqual(min(forces[case]) / 216, 1, delta=0.005)
            self.assertAlmostEqual(max(forces[case]) / 216, 1, delta=0.005)
        self.assertGreater(max(forces['sinking']), 2 * 216)

    def test_a_layer_below_the_rounding_of_places_is_refused(self):
        data = scene(body('strip'), tools=[{'name': 'table', 'normal': [0, 1]}], contact={'layer': 1e-16})
        with open(self.path('scene.yaml'), 'w') as file:
            yaml.safe_dump(data, file)
        run = subprocess.run([OFFLINE, self.path('scene.yaml'), '--output', self.path('out'), '--quiet'], stderr=subprocess.PIPE, text=True)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn('contact.layer: given 1e-16 m; give at least 2.22e-14 m', run.stderr)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
