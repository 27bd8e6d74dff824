#!/usr/bin/python3
"""What begins with a stage (`since`) and counts its times from there.

usage: since_test.py FORMING_OFFLINE
"""
import copy
import subprocess
import sys
import unittest

import h5py
import numpy

from scene_run import OFFLINE, SceneRun, body, scene

BEGIN = 1.1e-4  # of the stage `work`, s
LENGTH = 2e-4   # of it, s


def moving_scene():
    """A plate that everything a scene has over times acts on, all of it from the stage `work` on."""
    plate = body('plate', boundaries=[
        {'set': 'left', 'kind': 'fixed', 'until': 'work'},
        {'set': 'left', 'kind': 'velocity', 'since': 'work', 'times': [0.0, LENGTH / 2, LENGTH], 'velocities': [[0.0, 0.0, 0.0], [0.2, 0.0, 0.1], [0.0, 0.0, 0.0]],
         'spins_deg_s': [[0.0, 0.0, 0.0], [0.0, 4e3, 0.0], [0.0, 0.0, 0.0]], 'centre': [0.0, 0.0, 0.001]}],
        pressures=[{'set': 'top', 'since': 'work', 'times': [0.0, LENGTH], 'values': [0.0, 5e6]}],
        loads=[{'set': 'right', 'kind': 'traction', 'since': 'work', 'times': [0.0, LENGTH], 'tractions': [[0.0, 0.0, 0.0], [3e6, 0.0, -2e6]]}])
    motions = [
        {'kind': 'trajectory', 'times': [0.0, LENGTH], 'positions': [[0.0, 0.0, 0.0], [0.0, 0.0, 1e-4]]},
        {'kind': 'velocity', 'times': [0.0, LENGTH / 2, LENGTH], 'velocities': [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.5]],
         'spins_deg_s': [[0.0, 0.0, 0.0], [2e3, 0.0, 0.0], [0.0, 2e3, 0.0]]},
        {'kind': 'force', 'times': [0.0, LENGTH], 'forces': [[0.0, 0.0, 0.0], [0.0, 0.0, -500.0]], 'mass': 1e-3}]
    tools = []
    for i, (motion, x, y) in enumerate(zip(motions, (.006, .008, .005), (.002, .007, .005))):
        side = 1 if motion['kind'] == 'force' else -1
        radius, height = 1.5e-3, .001 + side * (.001 + 1.5e-3 + 1e-5)
        tools.append({'name': 'tool%d' % i, 'position': [x, y, height], 'motion': dict(motion, since='work'),
                      'profile': {'sweep': 'turned', 'start': [0.0, 0.0, -radius], 'pieces': [{'to': [radius, 0.0, 0.0], 'radius': radius}, {'to': [0.0, 0.0, radius], 'radius': radius}]}})
    data = scene(plate, dimension=3, tools=tools, time_step={'maximum': 5e-8})  # so that all runs take the same steps
    data['stages'] = [{'kind': 'form', 'name': 'wait', 'duration': BEGIN}, {'kind': 'form', 'name': 'work', 'duration': LENGTH}, {'kind': 'form', 'name': 'after', 'duration': 5e-5}]
    data['output'] = {'frames': 6, 'checkpoint_interval': 2e-4}
    return data


def courses(data):
    plate = data['bodies'][0]
    return plate['boundaries'][1:] + plate['pressures'] + plate['loads'] + [tool['motion'] for tool in data['tools']]


def block(name, y, side, motion=None):
    """A flat tool above (side 1) or below the middle of a strip."""
    tool = {'name': name, 'position': [0.005, y], 'profile': {'start': [-0.002, 0.0], 'pieces': [{'to': to} for to in ([0.002, 0.0], [0.002, 0.002 * side], [-0.002, 0.002 * side], [-0.002, 0.0])]}}
    return dict(tool, motion=motion) if motion else tool


class Since(SceneRun):
    def positions(self, name, frame=-1):
        with h5py.File(self.path(name + '/result.h5'), 'r') as result:
            frames = result['frames']
            last = frames[sorted(frames)[frame]]
            return last.attrs['time'], last['positions'][:]

    def test_it_is_the_same_as_times_that_count_from_the_start(self):
        later = moving_scene()
        told = copy.deepcopy(later)
        for course in courses(told):
            del course['since']
            course['times'] = [t + BEGIN for t in course['times']]
        told['bodies'][0]['boundaries'].pop(0)  # the other one holds while its velocity is 0
        self.run_scene(later, 'later')
        self.run_scene(told, 'told')
        start, end, same = self.positions('later', 0)[1], self.positions('later')[1], self.positions('told')[1]
        moved = numpy.abs(end - start).max()
        self.assertGreater(moved, 5e-5)
        self.assertLess(numpy.abs(end - same).max(), 1e-9 * moved)

    def test_nothing_acts_before(self):
        self.run_scene(moving_scene())
        for frame in range(3):
            time, there = self.positions('out', frame)
            self.assertLessEqual(time, BEGIN)
            self.assertEqual(numpy.abs(there - self.positions('out', 0)[1]).max(), 0)

    def test_a_run_goes_on_from_a_checkpoint_within_the_stage(self):
        self.run_scene(moving_scene())
        time, end = self.positions('out')
        run = subprocess.run([OFFLINE, self.path('scene.yaml'), '--output', self.path('on'), '--quiet', '--threads', '2', '--resume', self.path('out/checkpoint.h5')])
        self.assertEqual(run.returncode, 0)
        again, same = self.positions('on')
        self.assertEqual(time, again)
        self.assertTrue(numpy.array_equal(end, same))

    def test_it_waits_for_a_stage_that_ends_at_rest(self):
        """A cantilever is bent, rests, is bent on from there, and cut free; when it rests is not known before."""
        def bend(stage):
            return {'kind': 'velocity', 'set': 'right', 'axes': ['y'], 'since': stage, 'times': [0.0, 1e-4, 2e-4], 'velocities': [[0.0, 0.0], [-1.0, 0.0], [0.0, 0.0]], 'profile': 'smooth'}
        strip = body('strip', boundaries=[{'set': 'left', 'kind': 'fixed'}, dict(bend('first'), velocities=[[0.0, 0.0], [0.0, -1.0], [0.0, 0.0]], until='second'),
                                          dict(bend('second'), velocities=[[0.0, 0.0], [0.0, -1.0], [0.0, 0.0]], until='free')])
        data = scene(strip)
        data['stages'] = [{'kind': 'form', 'name': 'first', 'duration': 2e-4}, {'kind': 'settle', 'name': 'rest', 'limit': 5e-3, 'kinetic_fraction': 1e-8},
                          {'kind': 'form', 'name': 'second', 'duration': 2e-4}, {'kind': 'settle', 'name': 'held', 'limit': 5e-3, 'kinetic_fraction': 1e-8},
                          {'kind': 'settle', 'name': 'free', 'limit': 2e-2, 'kinetic_fraction': 1e-8}]
        data['output'] = {'frames': 40, 'probes': [{'name': 'tip', 'set': 'right'}]}
        summary = self.run_scene(data)
        ends = {stage['name']: stage['end_time_s'] for stage in summary['stages']}
        self.assertLess(ends['rest'], 4e-3)
        rows = self.history()
        self.assertEqual(summary['warnings'], [])
        at = lambda stage: min(rows, key=lambda row: abs(float(row['time_s']) - ends[stage]))  # noqa: E731
        y = {stage: float(at(stage)['probe_tip_position_y_m']) - float(rows[0]['probe_tip_position_y_m']) for stage in ends}
        for stage, there in (('first', -1e-4), ('rest', -1e-4), ('second', -2e-4), ('held', -2e-4), ('free', 0)):
            self.assertAlmostEqual(y[stage], there, delta=1e-7, msg=stage)

    def test_what_takes_hold_of_a_moving_body_does_work(self):
        """The end of a flying strip is stopped: what its nodes had is lost, and the rest swings on."""
        strip = body('strip', initial_velocity=[5.0, 0.0], boundaries=[{'set': 'left', 'kind': 'fixed', 'since': 'caught'}])
        data = scene(strip)
        data['stages'] = [{'kind': 'form', 'name': 'fly', 'duration': 2e-5}, {'kind': 'form', 'name': 'caught', 'duration': 5e-5}]
        data['output'] = {'frames': 4, 'history_interval': 1e-6, 'probes': [{'name': 'end', 'set': 'left'}]}
        summary = self.run_scene(data)
        mass = 2710 * 0.010 * 0.002
        self.assertLess(summary['energy_J']['balance_error'], 1e-4)
        self.assertAlmostEqual(summary['energy_J']['initial'], 0.5 * mass * 25, delta=1e-9)
        self.assertAlmostEqual(summary['energy_J']['work'], -0.5 * mass * 25 / 10 / 3, delta=1e-4)  # a third of the first of ten cells
        rows = self.history()
        given = sum((float(b['time_s']) - float(a['time_s'])) * float(b['probe_end_reaction_force_x_N_per_m'] or 0) for a, b in zip(rows, rows[1:]))
        self.assertAlmostEqual(mass * 5 + given, summary['bodies'][0]['momentum'][0], delta=1e-6 * mass * 5)

    def test_what_a_boundary_takes_over_does_not_fade(self):
        """Nodes under a tool, held along x by one boundary and from the last stage on in both directions by another."""
        strip = body('strip', material={'hardening': {'curve': 'linear', 'yield_stress': 100e6, 'modulus': 500e6}}, sets=[{'name': 'middle', 'choose': 'box', 'min': [0.0039, 0.0019, 0.0], 'max': [0.0061, 0.0021, 0.0]}],
                     boundaries=[{'set': 'middle', 'kind': 'fixed', 'axes': ['x'], 'until': 'swap'}, {'set': 'middle', 'kind': 'fixed', 'since': 'swap'},
                                 {'set': 'right', 'kind': 'velocity', 'axes': ['x'], 'times': [0.0, 1e-4, 2e-4], 'velocities': [[0.0, 0.0], [0.3, 0.0], [0.0, 0.0]]}])
        data = scene(strip, tools=[block('top', 0.00201, 1, {'kind': 'trajectory', 'times': [0.0, 2e-4], 'positions': [[0.0, 0.0], [0.0, -2.5e-5]]}), block('bottom', -1e-5, -1)])
        data['stages'] = [{'kind': 'form', 'name': 'press', 'duration': 2e-4}, {'kind': 'settle', 'name': 'rest', 'limit': 5e-3}, {'kind': 'settle', 'name': 'swap', 'limit': 5e-3}]
        data['output'] = {'frames': 4, 'history_interval': 2e-6, 'probes': [{'name': 'held', 'set': 'middle'}]}
        begin = self.run_scene(data)['stages'][1]['end_time_s']
        pushed = [float(row['probe_held_reaction_force_y_N_per_m']) for row in self.history() if float(row['time_s']) > begin + 4e-6]
        self.assertGreater(len(pushed), 3)
        self.assertLess(pushed[-1], -5e4)
        for push in pushed:
            self.assertAlmostEqual(push / pushed[-1], 1, delta=0.05)

    def test_a_tool_that_is_pushed_along_its_way_does_not_stop(self):
        data = scene(body('strip'), tools=[block('top', 0.00201, 1, {'kind': 'trajectory', 'times': [0.0, 1e-4], 'positions': [[0.0, 0.0], [0.0, -3e-5]]}),
                                           block('bottom', -1e-5, -1, {'kind': 'trajectory', 'since': 'go', 'times': [0.0, 1e-4], 'positions': [[0.0, 0.0], [0.0, -5e-5]], 'stop_force': 1000.0})])
        data['stages'] = [{'kind': 'form', 'name': 'press', 'duration': 1.5e-4}, {'kind': 'form', 'name': 'go', 'duration': 1e-4}]
        bottom = self.run_scene(data)['tools'][1]
        self.assertIsNone(bottom['stopped_s'])
        self.assertAlmostEqual(bottom['position'][1], -6e-5, delta=1e-9)
        data['stages'][0]['until_stopped'] = 'bottom'
        self.assertIn('has begun to move', self.refused(data))

    def test_since_the_first_stage_is_from_the_start_on(self):
        found = []
        for since in ({}, {'since': 'first'}):
            strip = body('strip', boundaries=[dict({'set': 'left', 'kind': 'symmetric', 'normal': [1, 0]}, **since)])
            data = scene(strip, tools=[{'name': 'table', 'normal': [0, 1]}], gravity=[0, -1e5, 0], stages=[{'kind': 'form', 'name': 'first', 'duration': 2e-5}])
            self.run_scene(data)
            found.append(self.positions('out')[1])
        self.assertTrue(numpy.array_equal(*found))

    def test_faults(self):
        data = moving_scene()
        data['bodies'][0]['boundaries'][0]['until'] = 'after'  # held while it should move
        self.assertIn('bodies[0].boundaries[1]: given a boundary on set "left"', self.refused(data))
        # Equal velocities if the settle stage took its limit, which it need not.
        twice = [{'set': 'left', 'kind': 'velocity', 'axes': ['x'], 'times': [1e-3, 1.1e-3, 1.2e-3], 'velocities': [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]},
                 {'set': 'left', 'kind': 'velocity', 'axes': ['x'], 'times': [0.0, 1e-4, 2e-4], 'velocities': [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]], 'since': 'last'}]
        data = scene(body('strip', boundaries=twice))
        data['stages'] = [{'kind': 'settle', 'name': 'rest', 'limit': 1e-3}, {'kind': 'form', 'name': 'last', 'duration': 2e-4}]
        self.assertIn('let the one go (until)', self.refused(data))
        data['stages'][0]['ends'] = 'limit'
        self.run_scene(data)
        # The first has come to rest before the other takes hold.
        data = scene(body('strip', boundaries=[dict(twice[0], times=[0.0, 1e-5, 2e-5]), {'set': 'left', 'kind': 'fixed', 'since': 'last'}]))
        data['stages'] = [{'kind': 'form', 'name': 'first', 'duration': 5e-5}, {'kind': 'form', 'name': 'last', 'duration': 1e-5}]
        self.run_scene(data)
        data = moving_scene()
        data['bodies'][0]['boundaries'][1].update(since='after', until='work')
        data['bodies'][0]['pressures'][0]['since'] = 'works'
        data['tools'][0]['motion']['since'] = 'after'
        data['stages'][1] = {'kind': 'withdraw', 'name': 'work', 'duration': 1e-4, 'tools': ['tool0']}
        said = self.refused(data)
        for part in ("boundaries[1].until: given 'work'", 'name a stage after that of since, after', "pressures[0].since: given 'works'", 'the stages are wait, work, after',
                     "tools[0].motion.since: given 'after'", 'name a stage before work, which takes the tool away'):
            self.assertIn(part, said)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
