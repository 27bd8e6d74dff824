#!/usr/bin/python3
"""Where tools start and how they go: on a path, under a force, on a spring, about an axle, each shown by what a mechanician would check.

usage: driven_tools_test.py FORMING_OFFLINE
"""
import math
import sys
import unittest

import h5py
import numpy

from scene_run import ALUMINIUM, SceneRun, body, scene


class DrivenTools(SceneRun):
    def test_tools_approach_what_they_will_touch(self):
        """A holder with a rounded edge comes down on a wavy sheet, a die comes up from far below, a stop comes against the holder."""
        wave = '2e-4*cos(2*pi*x/0.010)'
        sheet = {'name': 'sheet', 'blank': {'shape': 'plate', 'length': 0.010, 'width': 0.004, 'thickness': 0.001, 'cells_along': 20, 'cells_across': 8, 'cells_through': 1},
                 'imperfection': ['0', '0', wave], 'material': dict(ALUMINIUM)}
        holder = {'name': 'holder', 'profile': {'sweep': 'turned', 'start': [0, 0, 0], 'pieces': [{'to': [2e-3, 0, 0]}, {'to': [2.5e-3, 0, 5e-4], 'radius': 5e-4}, {'to': [2.5e-3, 0, 2e-3]}, {'to': [0, 0, 2e-3]}]},
                  'position': [0.005, 0.002, 0.5], 'approach': {'along': [0, 0, -2], 'gap': 3e-5},
                  'motion': {'kind': 'trajectory', 'times': [0, 2e-5], 'rotations_deg': [[0, 0, 0], [0, 0, 10]], 'centre': [0.005, 0.002, 0.5]}}
        die = {'name': 'die', 'normal': [0, 0, 1], 'point': [0, 0, -3], 'approach': {'along': [0, 0, 1]}}
        stop = {'name': 'stop', 'normal': [0, 0, -1], 'position': [0, 0, 7], 'approach': {'along': [0, 0, -1], 'to': ['holder'], 'gap': 1e-3}}
        data = scene(sheet, dimension=3, tools=[holder, die, stop], output={'frames': 1})
        self.run_scene(data)
        row = self.history()[0]
        # Under the flat of 2 mm in radius the wave is highest at its rim, of the bottom the lowest lies in the middle.
        rim = 0.001 + 2e-4 * math.cos(2 * math.pi * 3e-3 / 0.010)
        edge = max(0.001 + 2e-4 * math.cos(2 * math.pi * x / 0.010) - (5e-4 - math.sqrt(max(0, 25e-8 - (3e-3 - x) ** 2))) for x in numpy.linspace(2.5e-3, 3e-3, 51))
        self.assertGreater(edge, rim)
        self.assertAlmostEqual(float(row['tool_holder_position_z_m']), edge + 3e-5, delta=4e-6)
        self.assertAlmostEqual(float(row['tool_die_position_z_m']), 3 - 2e-4, delta=2e-6)
        self.assertAlmostEqual(float(row['tool_stop_position_z_m']), float(row['tool_holder_position_z_m']) + 2e-3 + 1e-3, delta=1e-9)
        with h5py.File(self.path('out/result.h5')) as result:
            self.assertEqual(len(result['frames']), 2)

    def test_an_approach_that_goes_by_is_refused(self):
        punch = {'name': 'punch', 'profile': {'start': [0, 0], 'pieces': [{'to': [1e-3, 0]}, {'to': [1e-3, 1e-3]}, {'to': [0, 1e-3]}]}, 'position': [0.5, 0], 'approach': {'along': [0, -1]}}
        told = self.refused(scene(body(), tools=[punch]))
        self.assertIn('tools[0].approach.along', told)
        self.assertIn('goes by', told)
        punch['approach'] = {'along': [0, -1], 'to': ['bod']}
        self.assertIn('did you mean body', self.refused(scene(body(), tools=[punch])))

    def test_a_gas_spring_pushes_the_more_the_farther_it_is_pushed_back(self):
        """A punch drives a block onto a pad that stands on a spring of preload P and stiffness K: it bears P + K s where it has gone back by s."""
        preload, stiffness = 2e4, 5e7
        block = {'name': 'block', 'blank': {'shape': 'strip', 'length': 0.004, 'thickness': 0.002, 'cells_along': 4, 'cells_through': 2}, 'material': dict(ALUMINIUM)}
        punch = {'name': 'punch', 'normal': [0, -1], 'position': [0, 0.002], 'motion': {'kind': 'trajectory', 'times': [0, 1e-3], 'positions': [[0, 0], [0, -1e-3]]}}
        pad = {'name': 'pad', 'normal': [0, 1], 'motion': {'kind': 'force', 'times': [0], 'forces': [[0, preload]], 'stiffness': stiffness, 'mass': 0.02, 'damping': 2e4}}
        data = scene(block, tools=[punch, pad], duration=1e-3, output={'frames': 1, 'history_interval': 1e-6})
        data['stages'].append({'kind': 'settle', 'limit': 2e-3, 'kinetic_fraction': 1e-8})
        self.run_scene(data)
        last = self.history()[-1]
        back = -float(last['tool_pad_position_y_m'])
        self.assertAlmostEqual(back, 1e-3, delta=2e-5)  # the block itself gives way by the rest
        self.assertAlmostEqual(-float(last['tool_pad_force_y_N_per_m']) / (preload + stiffness * back), 1, delta=2e-3)

        # A spring that swings faster than the cells bounds the step.
        pad['motion'] = dict(pad['motion'], stiffness=1e14, damping=0)
        data['stages'] = [{'kind': 'form', 'duration': 1e-6}]
        summary = self.run_scene(data, 'stiff')
        self.assertAlmostEqual(summary['time_step_s']['first'] / (0.9 * 2 * math.sqrt(0.02 / 1e14)), 1, delta=1e-9)

    def test_a_gas_spring_bottoms_on_its_stop_and_comes_back(self):
        """What goes beyond the stop the block bears between punch and pad, by its stiffness in plane strain."""
        preload, stop, beyond = 2e4, 4e-4, 1e-5
        block = {'name': 'block', 'blank': {'shape': 'strip', 'length': 0.004, 'thickness': 0.002, 'cells_along': 4, 'cells_through': 2}, 'material': dict(ALUMINIUM)}
        punch = {'name': 'punch', 'normal': [0, -1], 'position': [0, 0.002],
                 'motion': {'kind': 'trajectory', 'times': [0, 4e-4, 8e-4, 1.2e-3], 'positions': [[0, 0], [0, -stop - beyond], [0, -stop - beyond], [0, 0]]}}
        pad = {'name': 'pad', 'normal': [0, 1],
               'motion': {'kind': 'force', 'times': [0], 'forces': [[0, preload]], 'guide': [0, 1], 'mass': 0.02, 'damping': 2e4, 'stop_ahead': 1e-9, 'stop_behind': stop}}
        self.run_scene(scene(block, tools=[punch, pad], duration=1.2e-3, output={'frames': 1, 'history_interval': 1e-6}))
        rows = self.history()
        held = [row for row in rows if 6e-4 < float(row['time_s']) < 8e-4]
        for row in held:
            self.assertAlmostEqual(float(row['tool_pad_position_y_m']), -stop, delta=2e-7)  # and its way in a step
        E, nu = ALUMINIUM['youngs_modulus'], ALUMINIUM['poissons_ratio']
        pressed = numpy.mean([-float(row['tool_pad_force_y_N_per_m']) for row in held])
        self.assertAlmostEqual(pressed / (E / (1 - nu**2) * beyond / 0.002 * 0.004), 1, delta=0.03)
        self.assertAlmostEqual(float(rows[-1]['tool_pad_position_y_m']), 0, delta=1e-6)

    def test_a_tool_on_a_spring_goes_back_with_its_other_end(self):
        """It presses, is taken back and off the block again, and nothing warns of a tool that fell."""
        block = {'name': 'block', 'blank': {'shape': 'strip', 'length': 0.004, 'thickness': 0.002, 'cells_along': 4, 'cells_through': 2}, 'material': dict(ALUMINIUM),
                 'boundaries': [{'set': 'bottom', 'kind': 'fixed'}]}
        press = {'name': 'press', 'normal': [0, -1], 'position': [0, 0.002],
                 'motion': {'kind': 'force', 'times': [0, 3e-4, 8e-4], 'forces': [[0, 0]] * 3, 'guide': [0, 1], 'stiffness': 5e7, 'mass': 0.02, 'damping': 2e4,
                            'positions': [[0, 0], [0, -1e-3], [0, 4e-3]]}}
        summary = self.run_scene(scene(block, tools=[press], duration=1e-3, output={'frames': 1, 'history_interval': 1e-5}))
        rows = self.history()
        self.assertAlmostEqual(max(float(row['tool_press_force_y_N_per_m']) for row in rows) / 5e4, 1, delta=0.05)
        self.assertAlmostEqual(float(rows[-1]['tool_press_position_y_m']), 0.006, delta=2e-5)
        self.assertEqual([w for w in summary['warnings'] if 'pressed on the bodies no more' in w], [])

    def test_an_idle_roll_rolls(self):
        """Laid on a strip that is drawn along under it, friction turns it until it rolls; then it holds the strip back no more."""
        speed, radius, force, friction = 2.0, 5e-3, 2e4, 0.2
        strip = {'name': 'strip', 'blank': {'shape': 'strip', 'length': 0.020, 'thickness': 0.002, 'cells_along': 40, 'cells_through': 4},
                 'material': dict(ALUMINIUM), 'initial_velocity': [speed, 0],
                 'boundaries': [{'set': 'bottom', 'kind': 'velocity', 'axes': ['x'], 'times': [0], 'velocities': [[speed, 0]]}]}
        centre = [0.010, 0.002 + radius]
        roll = {'name': 'roll', 'profile': {'chord_error': 1e-8, 'start': [0, -radius], 'pieces': [{'to': [0, radius], 'radius': radius}, {'to': [0, -radius], 'radius': radius}]},
                'position': centre, 'friction': friction,
                'motion': {'kind': 'force', 'times': [0, 1e-4], 'forces': [[0, 0], [0, -force]], 'mass': 1.0, 'centre': centre, 'axle': [0, 0, 1], 'inertia': 1.25e-5}}
        data = scene(strip, tools=[{'name': 'table', 'normal': [0, 1]}, roll], duration=8e-4, output={'frames': 2, 'history_interval': 2e-5})
        tool = self.run_scene(data)['tools'][1]
        rows = self.history()
        turned = [math.radians(float(row['tool_roll_turned_deg'])) for row in rows]
        self.assertAlmostEqual((turned[-1] - turned[-11]) * radius / (speed * 2e-4), 1, delta=0.02)
        self.assertAlmostEqual(math.radians(tool['turned_deg']), turned[-1], delta=1e-6)
        torque = [float(row['tool_roll_moment_z_N_m_per_m']) for row in rows]
        slides = [torque[i] / (radius * float(rows[i]['tool_roll_force_y_N_per_m'])) for i in range(1, len(rows)) if 0.01 < turned[i] < 0.03]
        self.assertGreater(len(slides), 2)
        for found in slides:
            self.assertAlmostEqual(found, friction, delta=0.01 * friction)
        self.assertAlmostEqual(tool['peak_moment'][2] / (friction * radius * tool['peak_force'][1]), 1, delta=0.05)
        self.assertLess(abs(sum(torque[-10:])) / 10, 0.03 * max(torque))
        told = self.refused(dict(data, tools=[dict(data['tools'][0], motion={'kind': 'velocity', 'times': [0], 'axle': [0, 0, 1]})]))
        self.assertIn('of a plane', told)

    def test_an_idle_roll_is_carried_round_without_being_turned(self):
        """Its axle leans, and the head that carries it turns about the vertical: its own spin stays what it was, here 0 and 500 turns/s."""
        lean, yaw, time = math.radians(40), 90.0, 2e-5
        axle, centre = [math.sin(lean), 0.0, math.cos(lean)], [0.005, 0.005, 0.030]
        roll = {'name': 'roll', 'position': centre, 'rotation_deg': [0.0, math.degrees(lean), 0.0],
                'profile': {'sweep': 'turned', 'start': [0, 0, -0.002], 'pieces': [{'to': [0.004, 0, -0.002]}, {'to': [0.004, 0, 0.002]}, {'to': [0, 0, 0.002]}]}}

        def turn(vector):
            angle = math.radians(numpy.linalg.norm(vector))
            if angle == 0:
                return numpy.eye(3)
            x, y, z = math.radians(1) * numpy.array(vector) / angle
            cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            return numpy.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross

        def matrix(x, y, z, w):
            return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])

        told = ({'kind': 'trajectory', 'times': [0, time], 'rotations_deg': [[0, 0, 0], [0, 0, yaw]]},
                {'kind': 'velocity', 'times': [0, time], 'spins_deg_s': [[0, 0, yaw / time], [0, 0, yaw / time]]},
                {'kind': 'force', 'times': [0, time], 'forces': [[0, 0, 1e-6], [0, 0, 1e-6]], 'mass': 1.0, 'rotations_deg': [[0, 0, 0], [0, 0, yaw]]})
        for motion in told:
            for spin in (0.0, 180000.0):
                with self.subTest(kind=motion['kind'], spin=spin):
                    tool = dict(roll, motion=dict(motion, centre=centre, axle=axle, inertia=1.0, initial_spin_deg_s=spin))
                    found = self.run_scene(scene(body('plate', initial_velocity=[0.1, 0, 0]), dimension=3, tools=[tool], duration=time))['tools'][0]
                    self.assertAlmostEqual(found['turned_deg'], spin * time, delta=1e-6)
                    expected = turn([0, 0, yaw]) @ turn(numpy.array(axle) * (spin * time - yaw * math.cos(lean))) @ turn(roll['rotation_deg'])
                    numpy.testing.assert_allclose(matrix(*found['orientation_xyzw']), expected, atol=1e-5)
        for motion in ({'kind': 'velocity', 'times': [0], 'spins_deg_s': [axle]}, {'kind': 'trajectory', 'times': [0, 1], 'rotations_deg': [[0, 0, 0], axle]}):
            self.assertIn('about the axle, about which the tool turns freely', self.refused(scene(body('plate'), dimension=3, tools=[dict(roll, motion=dict(motion, axle=axle))])))

    def test_a_tool_is_pressed_by_a_force_while_it_is_driven_along(self):
        """As a robot does under force control: its force is what it was told, and what it rubs by is friction times that."""
        force, friction, speed, time = 4e4, 0.1, 5.0, 6e-4
        strip = {'name': 'strip', 'blank': {'shape': 'strip', 'length': 0.010, 'thickness': 0.002, 'cells_along': 40, 'cells_through': 4}, 'material': dict(ALUMINIUM),
                 'boundaries': [{'set': 'bottom', 'kind': 'fixed'}]}
        centre, radius = [0.003, 0.007], 0.005
        shoe = {'name': 'shoe', 'position': centre, 'friction': friction,
                'profile': {'start': [0, -radius], 'pieces': [{'to': [0, radius], 'radius': radius}, {'to': [0, -radius], 'radius': radius}]}}
        found = []
        for told in ({'velocities': [[0, 0], [speed, 0], [speed, 0]]}, {'positions': [[0, 0], [speed * 5e-5, 0], [speed * (time - 5e-5), 0]]}):
            motion = dict({'kind': 'force', 'times': [0, 1e-4, time], 'forces': [[0, 0], [0, -force], [0, -force]], 'profile': 'linear', 'mass': 0.05, 'damping': 2e4}, **told)
            data = scene(strip, tools=[dict(shoe, motion=motion)], duration=time, output={'frames': 2, 'history_interval': 1e-5})
            summary = self.run_scene(data)
            rows = self.history()
            along, down = (numpy.array([float(row[f'tool_shoe_force_{axis}_N_per_m']) for row in rows[30:]]) for axis in 'xy')
            self.assertAlmostEqual(down.mean() / force, 1, delta=0.02)
            self.assertAlmostEqual(along.mean() / down.mean(), -friction, delta=0.02 * friction)
            self.assertAlmostEqual(float(rows[-1]['tool_shoe_position_x_m']) - centre[0], speed * (time - 5e-5), delta=1e-9)
            self.assertEqual(summary['contact']['crossings'], 0)
            found.append(along.mean())
        self.assertAlmostEqual(found[0] / found[1], 1, delta=0.005)
        for more, word in (({'velocities': [[0, 1], [0, 1]]}, 'in part along the guide'), ({'positions': [[0, 0], [0, 1e-3]]}, 'in part along the guide'),
                           ({'positions': [[0, 0], [1e-3, 0]], 'velocities': [[1, 0], [1, 0]]}, 'give one of both')):
            motion = dict({'kind': 'force', 'times': [0, time], 'forces': [[0, 0], [0, -force]]}, **more)
            self.assertIn(word, self.refused(scene(strip, tools=[dict(shoe, motion=motion)])))

    def test_a_turning_tool(self):
        """A plane that tips by a trajectory of rotations pushes one end of the strip more than the other."""
        data = scene(body('strip', boundaries=[{'set': 'bottom', 'kind': 'fixed'}]), duration=4e-5, tools=[{
            'name': 'press', 'point': [0.0, 0.002, 0.0], 'normal': [0.0, -1.0, 0.0],
            'motion': {'kind': 'trajectory', 'times': [0.0, 4e-5], 'centre': [0.0, 0.002, 0.0],
                       'positions': [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], 'rotations_deg': [[0.0, 0.0, 0.0], [0.0, 0.0, -0.1]]}}],
            output={'frames': 2, 'probes': [{'name': 'near', 'point': [0.0, 0.002, 0.0]}, {'name': 'far', 'point': [0.010, 0.002, 0.0]}]})
        self.run_scene(data)
        last = self.history()[-1]
        sunk = 0.010 * math.radians(0.1)
        self.assertAlmostEqual(0.002 - float(last['probe_far_position_y_m']), sunk, delta=0.1 * sunk)
        self.assertLess(abs(0.002 - float(last['probe_near_position_y_m'])), 0.15 * sunk)

    def test_a_blank_holder_presses_with_its_force(self):
        """A plate between a table and a block that a force drives: u = F t/(A E) on a plate free to spread; then the block is taken away."""
        side, thickness, force, rise = 0.010, 0.002, 2e4, 2e-4
        block = {'name': 'holder', 'mesh': {'points': [[x * side, y * side, z * side] for x in (-0.1, 1.1) for y in (-0.1, 1.1) for z in (0.0, 0.3)],
                                            'cells': [0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5],
                                            'cell_type': 'triangle', 'unit_scale': 1.0},
                 'position': [0, 0, thickness],
                 'motion': {'kind': 'force', 'profile': 'smooth', 'times': [0, rise], 'forces': [[0, 0, 0], [0, 0, -force]]}}
        case = scene(body('plate'), dimension=3, duration=2.5 * rise, time_step={'damping': 1e5},
                     tools=[{'name': 'table', 'normal': [0, 0, 1]}, block], output={'frames': 3, 'history_interval': rise / 50})
        case['stages'].append({'name': 'open', 'kind': 'withdraw', 'tools': ['holder'], 'displacement': [0, 0, 0.002], 'duration': 1e-4})
        summary = self.run_scene(case)
        self.assertEqual(summary['contact']['crossings'], 0)
        self.assertTrue(any('holder, which a force drives, has the mass of the bodies, 0.000542 kg' in note for note in summary['warnings']), summary['warnings'])
        rows = self.history()
        pressed = [row for row in rows if row['stage'] == 'form'][-1]
        self.assertAlmostEqual(float(pressed['tool_holder_force_z_N']) / force, 1, delta=2e-3)
        self.assertAlmostEqual(float(pressed['tool_table_force_z_N']) / force, -1, delta=2e-3)
        exact = force * thickness / (side * side * ALUMINIUM['youngs_modulus'])
        self.assertAlmostEqual(-float(pressed['tool_holder_position_z_m']) / exact + thickness / exact, 1, delta=0.01)
        self.assertAlmostEqual(float(rows[-1]['tool_holder_position_z_m']) - float(pressed['tool_holder_position_z_m']), 0.002, delta=1e-7)
        with h5py.File(self.path('out/result.h5')) as file:
            heights = [file['frames'][name]['tools/1/position'][2] for name in sorted(file['frames'])]
        self.assertGreater(heights[-1] - heights[0], 0.0019)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
