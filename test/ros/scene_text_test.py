#!/usr/bin/python3
"""Goals that are the text of a scene, and what the server says of a goal beside its numbers."""
import json
import os
import sys

import h5py
import rospy
import yaml
from actionlib_msgs.msg import GoalStatus
from forming_sim.msg import ResultCode, RunStatus, SimulateFormingGoal

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scenes  # noqa: E402
from support import Followed, ServerTest, goal_of, run  # noqa: E402


class SceneTextTest(ServerTest):
    def read(self, *names):
        with open(self.path(os.path.join(*names)), 'rb') as file:
            return file.read()

    def test_a_goal_may_be_the_text_of_a_scene(self):
        scene = scenes.pressed_strip()
        text = '# as its author wrote it\n' + yaml.safe_dump(scene)
        state, of_text = Followed(SimulateFormingGoal(scene_text=text, output_directory=self.path('text'))).result()
        self.assertEqual(state, GoalStatus.SUCCEEDED, of_text.message)
        self.assertEqual(of_text.summary.scene, 'pressed strip')
        self.assertEqual(run(scene, output_directory=self.path('message'))[0], GoalStatus.SUCCEEDED)
        self.assertEqual(self.read('text', 'history.csv'), self.read('message', 'history.csv'))
        with h5py.File(self.path('text/result.h5'), 'r') as result:
            self.assertEqual(result['scene_text'][()].decode(), text)

    def test_a_goal_goes_on_with_the_parts_of_another(self):
        first = scenes.pulled_strip()
        first['output']['formed'] = True
        state, result = run(first, output_directory=self.path('first'))
        self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
        self.assertIn('formed.h5', result.files)
        with h5py.File(self.path('first/result.h5'), 'r') as file:
            frame = file['frames'][sorted(file['frames'])[-1]]
            positions, strain = frame['positions'][:], frame['plastic_strain'][:]
        strip = first['bodies'][0]
        second = {'name': 'trimmed', 'dimension': 2, 'bodies': [{
            'name': 'strip', 'material': strip['material'], 'formed': {'url': self.path('first/formed.h5'), 'shift': [0.0, 0.25, 0.0]},
            'trim': [{'choose': 'plane', 'point': [0.005, 0.0, 0.0], 'normal': [1.0, 0.0, 0.0]}]}],
            'stages': [{'kind': 'settle', 'limit': 1e-3}], 'output': {'frames': 2}}
        state, result = run(second, output_directory=self.path('second'))
        self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
        self.assertNotIn('formed.h5', result.files)
        with h5py.File(self.path('second/result.h5'), 'r') as file:
            start, kept = file['topology/initial_positions'][:], file['frames/000000/plastic_strain'][:]
        self.assertLess(len(start), len(positions))
        for place in start - [0.0, 0.25, 0.0]:
            self.assertLess(abs(positions - place).max(axis=1).min(), 1e-12)
        self.assertTrue(set(kept) <= set(strain))
        second['bodies'][0]['formed']['url'] = 'first/formed.h5'
        state, result = run(second, output_directory=self.path('third'))
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertEqual(result.faults[0].field, 'bodies[0].formed.url')

    def test_a_text_beside_a_scene_says_the_same(self):
        scene = scenes.pressed_strip()
        other = scenes.pressed_strip()
        other['bodies'][0]['material']['density'] *= 2
        for text, told in ((yaml.safe_dump(other), 'density'), ('garbage: [', 'line 1')):
            state, result = run(scene, scene_text=text)
            self.assertEqual(state, GoalStatus.REJECTED)
            self.assertEqual([fault.field for fault in result.faults], ['scene_text'])
            self.assertIn(told, result.faults[0].given)
        text = '# the same\n' + yaml.safe_dump(scene)
        state, result = run(scene, scene_text=text, output_directory=self.path('same'))
        self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
        with h5py.File(self.path('same/result.h5'), 'r') as file:
            self.assertEqual(file['scene_text'][()].decode(), text)

    def test_faults_of_a_text_are_those_of_a_file(self):
        scene = scenes.pressed_strip()
        scene['bodies'][0]['blank']['lenght'] = scene['bodies'][0]['blank'].pop('length')
        state, result = Followed(SimulateFormingGoal(scene_text=yaml.safe_dump(scene))).result()
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertEqual(result.code, ResultCode.INVALID_SCENE)
        fields = {fault.field: fault for fault in result.faults}
        self.assertIn('bodies[0].blank.lenght', fields)
        self.assertRegex(fields['bodies[0].blank.lenght'].given, 'line [0-9]+')
        state, result = Followed(SimulateFormingGoal(scene_text='bodies: [')).result()
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertEqual(result.code, ResultCode.INVALID_SCENE)
        self.assertEqual(len(result.faults), 1)
        self.assertIn('line 1', result.message + result.faults[0].given)

    def test_warnings_come_with_the_result(self):
        scene = scenes.pressed_strip()
        scene['tools'].append({'name': 'idle', 'point': [0.0, -0.5, 0.0], 'normal': [0.0, 1.0, 0.0]})
        _, result = run(scene, output_directory=self.path('run'))
        self.assertEqual(list(result.summary.warnings), json.loads(result.summary.json)['warnings'])
        self.assertTrue(any(w.startswith('tool idle has touched nothing') for w in result.summary.warnings), result.summary.warnings)
        self.assertEqual(result.summary.kinetic_over_internal_forming, json.loads(result.summary.json)['energy_J']['kinetic_over_internal_forming'])

    def test_status_tells_what_is_prepared_and_what_was_refused(self):
        heard = []
        subscriber = rospy.Subscriber('/forming_server/status', RunStatus, heard.append, queue_size=100)
        self.addCleanup(subscriber.unregister)

        def hear(which):
            for _ in range(200):
                if any(which(status) for status in heard):
                    return
                rospy.sleep(0.05)
            self.fail('not heard; of %d messages the last is\n%s' % (len(heard), heard[-1] if heard else ''))

        hear(lambda s: True)  # connected: the last status is latched
        Followed(goal_of(scenes.pressed_strip(), output_directory=self.path('run'))).result()
        hear(lambda s: s.running and s.stage == 'preparing' and s.scene == 'pressed strip' and s.eta_s < 0)
        hear(lambda s: not s.running and s.code == ResultCode.SUCCESS)
        wrong = scenes.pressed_strip()
        wrong['name'] = 'wrong'
        wrong['bodies'][0]['material']['density'] = -1.0
        Followed(goal_of(wrong)).result()
        hear(lambda s: s.scene == 'wrong' and not s.running and s.code == ResultCode.INVALID_SCENE)
        wrong['name'] = 'wrong text'
        Followed(SimulateFormingGoal(scene_text=yaml.safe_dump(wrong))).result()
        hear(lambda s: s.scene == 'wrong text' and not s.running and s.code == ResultCode.INVALID_SCENE)


if __name__ == '__main__':
    import rostest
    rospy.init_node('scene_text_test')
    rostest.rosrun('forming_sim', 'scene_text', SceneTextTest)
