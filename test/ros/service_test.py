#!/usr/bin/python3
"""The service as a client sees it: success, rejections, busy, cancels, services."""
import json
import math
import os
import subprocess
import sys
import threading
import time

import h5py
import numpy
import rospy
import yaml
from actionlib_msgs.msg import GoalID, GoalStatus
from forming_sim.msg import (ContactFields, PlasticStrain, PlasticStrainTopology, ResultCode, RunStatus, SimulateFormingActionGoal,
                             SimulateFormingActionResult)
from forming_sim.srv import EstimateRun, ValidateScene
from geometry_msgs.msg import WrenchStamped
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scenes  # noqa: E402
from support import LIMIT, Client, Followed, ServerTest, executable, goal_of, run  # noqa: E402

ACTION = '/forming_server/simulate_forming'


class ServiceTest(ServerTest):
    # ---- success

    def test_success_with_feedback_files_and_topics(self):
        followed = Followed(goal_of(scenes.pressed_strip(), output_directory=self.path('run')))
        state, result = followed.result()
        self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
        self.assertEqual(result.code, ResultCode.SUCCESS)
        self.assertNotEqual(ResultCode.SUCCESS, 0)
        self.assertEqual(result.faults, [])
        self.assertGreaterEqual(len(followed.feedback), 1)
        status = followed.feedback[-1]
        self.assertEqual(status.scene, 'pressed strip')
        self.assertGreater(status.dt_s, 0)
        self.assertEqual([t.name for t in status.tools], ['press'])
        self.assertEqual(status.crossings, 0)
        self.assertGreater(status.min_thickness_m, 0)
        for name in ('result.h5', 'result.xdmf', 'surface.xdmf', 'history.csv', 'summary.json'):
            self.assertIn(name, result.files)
            self.assertGreater(os.path.getsize(os.path.join(result.directory, name)), 0)
        summary = json.loads(result.summary.json)
        self.assertEqual(summary['steps'], result.summary.steps)
        self.assertEqual(summary['elements'], 80)
        self.assertGreater(result.summary.steps, 100)
        self.assertGreater(result.summary.tools[0].peak_force.y, 0)  # the strip pushes the press up
        self.assertTrue(result.summary.tools[0].present and math.isnan(result.summary.tools[0].stopped_s))
        self.assertTrue(math.isfinite(result.summary.energies.balance_error))
        # What a viewer that comes late still sees.
        markers = rospy.wait_for_message('/forming_server/deformed_mesh', MarkerArray, 10)
        sheet = [m for m in markers.markers if m.ns == 'sheet'][0]
        self.assertEqual(len(sheet.points), 3 * 80)
        self.assertEqual(len(sheet.points), len(sheet.colors))
        self.assertEqual(sheet.action, Marker.ADD)
        self.assertEqual(sheet.header.frame_id, 'forming_world')
        topology = rospy.wait_for_message('/forming_server/plastic_strain_topology', PlasticStrainTopology, 10)
        self.assertEqual(len(topology.elements), 3 * 80)
        status = rospy.wait_for_message('/forming_server/status', RunStatus, 10)
        self.assertFalse(status.running)
        # Where the press touches: on the top of the strip.
        contact = rospy.wait_for_message('/forming_server/contact', ContactFields, 10)
        self.assertEqual(len(contact.nodes), len(contact.pressure))
        self.assertEqual(len(contact.nodes), len(contact.gap))
        pressed = [topology.nodes[n].y for n, pressure in zip(contact.nodes, contact.pressure) if pressure > 0]
        self.assertGreater(len(pressed), 0)
        self.assertEqual(min(pressed), max(node.y for node in topology.nodes))
        self.assertEqual(status.code, ResultCode.SUCCESS)

    def test_a_press_that_stops_under_its_force_says_when(self):
        scene = scenes.pressed_strip()
        scene['tools'][0]['motion']['stop_force'] = 2e5
        scene['stages'][0]['until_stopped'] = 'press'
        result = run(scene)[1]
        self.assertEqual(result.code, ResultCode.SUCCESS, result.message)
        press = result.summary.tools[0]
        self.assertEqual(press.stopped_s, result.summary.sim_time_s)
        self.assertGreaterEqual(press.peak_force.y, 2e5)
        status = rospy.wait_for_message('/forming_server/status', RunStatus, 10)
        self.assertEqual(status.tools[0].stopped_s, press.stopped_s)

    def test_server_chooses_a_directory_of_its_own_for_each_run(self):
        first = run(scenes.pulled_strip())[1]
        second = run(scenes.pulled_strip())[1]
        self.assertNotEqual(first.directory, second.directory)
        self.assertTrue(os.path.exists(os.path.join(first.directory, 'result.h5')))

    def test_action_client_and_offline_give_the_same_files_with_any_threads(self):
        scene = scenes.pressed_strip()
        with open(self.path('scene.yaml'), 'w') as file:
            yaml.safe_dump(scene, file)
        code, _ = run(scene, output_directory=self.path('action'), threads=2)
        self.assertEqual(code, GoalStatus.SUCCEEDED)
        subprocess.check_call([executable('forming_offline'), self.path('scene.yaml'), '--output', self.path('offline'), '--threads', '1'],
                              timeout=60)
        client = subprocess.run([executable('forming_client'), self.path('scene.yaml'), '--output', self.path('client')],
                                stdout=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(client.returncode, 0)
        self.assertIn('result.h5', client.stdout)
        for other in ('offline', 'client'):
            self.assert_same_results(self.path('action'), self.path(other))
        with h5py.File(self.path('offline/result.h5')) as a, h5py.File(self.path('client/result.h5')) as b:
            self.assertEqual(a['scene_text'][()], b['scene_text'][()])

    def assert_same_results(self, one, other):
        compared = []
        with h5py.File(os.path.join(one, 'result.h5')) as a, h5py.File(os.path.join(other, 'result.h5')) as b:
            def compare(name, item):
                if isinstance(item, h5py.Dataset) and name != 'scene_text':
                    numpy.testing.assert_array_equal(item[()], b[name][()], err_msg=name)
                    compared.append(name)
            a.visititems(compare)
        self.assertGreater(len([n for n in compared if n.startswith('frames/')]), 10)
        with open(os.path.join(one, 'history.csv')) as a, open(os.path.join(other, 'history.csv')) as b:
            self.assertEqual(a.read(), b.read())

    # ---- rejections

    def assert_rejected(self, scene, *fields, code=ResultCode.INVALID_SCENE, **goal):
        state, result = run(scene, **goal)
        self.assertEqual(state, GoalStatus.REJECTED, result.message)
        self.assertEqual(result.code, code, result.message)
        found = [fault.field for fault in result.faults]
        for field in fields:
            self.assertIn(field, found, result.message)
        for fault in result.faults:
            self.assertTrue(fault.given and fault.remedy, fault)
        return result

    def test_all_faults_come_back_together(self):
        scene = scenes.pressed_strip()
        scene['bodies'][0]['material']['density'] = float('nan')
        scene['bodies'][0]['material']['poissons_ratio'] = 0.5
        scene['bodies'][0]['boundaries'][0]['kind'] = 'glued'
        scene['tools'][0]['friction'] = -1.0
        scene['stages'][0]['duration'] = 0.0
        result = self.assert_rejected(
            scene, 'bodies[0].material.density', 'bodies[0].material.poissons_ratio', 'bodies[0].boundaries[0].kind',
            'tools[0].friction', 'stages[0].duration')
        self.assertEqual(len(result.faults), 5, result.message)

    def test_an_empty_goal_is_rejected(self):
        self.assert_rejected({}, 'name', 'dimension', 'bodies', 'stages')

    def test_a_missing_set_is_rejected(self):
        scene = scenes.pulled_strip()
        scene['bodies'][0]['boundaries'][0]['set'] = 'nowhere'
        self.assert_rejected(scene, 'bodies[0].boundaries[0].set')

    def solid(self, tool_mesh):
        scene = scenes.pulled_strip()
        scene['dimension'] = 3
        scene['bodies'][0]['blank'] = {
            'shape': 'plate', 'length': 0.01, 'width': 0.01, 'thickness': 0.001,
            'cells_along': 2, 'cells_across': 2, 'cells_through': 1, 'pattern': 'coarse'}
        scene['tools'] = [{'name': 'die', 'mesh': dict({'unit_scale': 1.0}, **tool_mesh)}]
        return scene

    def test_meshes_that_cannot_be_used_are_rejected(self):
        empty = self.path('empty.stl')
        with open(empty, 'w') as file:
            file.write('solid nothing\nendsolid nothing\n')
        for url in ('file:///nowhere/die.stl', 'file://' + empty, 'die.stl'):
            state, result = run(self.solid({'url': url}))
            self.assertEqual(state, GoalStatus.REJECTED, url)
            self.assertTrue(any(f.field.startswith('tools[0].mesh') for f in result.faults), result.message)

    def test_a_body_that_starts_inside_a_tool_is_rejected(self):
        scene = scenes.pressed_strip()
        scene['tools'][0]['point'] = [0.0, 0.0005, 0.0]
        state, result = run(scene)
        self.assertEqual(state, GoalStatus.REJECTED, result.message)
        self.assertEqual(result.code, ResultCode.INITIAL_PENETRATION, result.message)

    def test_faults_of_the_goal_beside_its_scene(self):
        scene = scenes.pulled_strip()
        self.assert_rejected(scene, 'threads', threads=-1)
        self.assert_rejected(scene, 'threads', threads=2**31 - 1)
        self.assert_rejected(dict(scene, name='a\0b'), 'name')
        self.assert_rejected(scene, 'resume', code=ResultCode.RESUME_ERROR, resume='/nowhere/checkpoint.h5')
        self.assert_rejected(scene, 'resume', code=ResultCode.RESUME_ERROR, resume='http://nowhere/checkpoint.h5')
        self.assert_rejected(scene, 'output_directory', code=ResultCode.OUTPUT_ERROR, output_directory='/proc/nowhere')
        self.assert_rejected(scene, 'output_directory', code=ResultCode.OUTPUT_ERROR, output_directory='ftp://nowhere/runs')
        self.assert_rejected(scene, 'output_directory', code=ResultCode.OUTPUT_ERROR, output_directory=self.path('a\0b'))
        self.assertEqual(os.listdir(self.directory), [])

    def test_long_names_and_urls_of_directories(self):
        scene = scenes.pulled_strip()
        scene['name'] = 300 * 'n'
        self.assertEqual(run(scene)[1].code, ResultCode.SUCCESS)
        result = run(scenes.pulled_strip(), output_directory='file://' + self.path('two%20words'))[1]
        self.assertEqual(result.directory, self.path('two words'))
        self.assertTrue(os.path.exists(self.path('two words/result.h5')))

    def test_what_belongs_together_has_one_stamp(self):
        names = ('status', 'plastic_strain', 'contact', 'tool_forces/press')
        kinds = (RunStatus, PlasticStrain, ContactFields, WrenchStamped)
        run(scenes.pressed_strip())  # then the tool has its topic
        stamps, wrenches, states, poses = {name: set() for name in names}, {}, {}, {}

        def keep(message, name):
            stamps[name].add(message.header.stamp)
            if name == 'status':
                states[message.header.stamp] = message
            if name == 'tool_forces/press':
                wrenches[message.header.stamp] = message
        listeners = [rospy.Subscriber('/forming_server/' + name, kind, keep, name, queue_size=1000) for name, kind in zip(names, kinds)]
        frames = rospy.Subscriber('/tf', TFMessage, lambda m: poses.update((t.header.stamp, t) for t in m.transforms), queue_size=1000)
        for listener in listeners + [frames]:
            self.addCleanup(listener.unregister)
        while any(listener.get_num_connections() == 0 for listener in listeners + [frames]):
            rospy.sleep(0.02)
        followed = Followed(goal_of(scenes.pressed_strip()))
        self.assertEqual(followed.result()[1].code, ResultCode.SUCCESS)
        last = max(status.header.stamp for status in followed.feedback)
        deadline = time.time() + 10
        while time.time() < deadline and not (all(last in times for times in stamps.values()) and last in poses):
            rospy.sleep(0.02)
        for name in names:
            self.assertIn(last, stamps[name], name)
        tool, wrench, pose = states[last].tools[0], wrenches[last].wrench, poses[last]
        self.assertEqual(pose.header.frame_id, 'forming_world')
        self.assertEqual(pose.child_frame_id, 'forming_world/press')
        self.assertEqual(pose.transform.translation.y, tool.pose.position.y)
        # About the origin of the frame in which it is told.
        self.assertNotEqual(tool.force.y, 0)
        about_origin = tool.moment.z + tool.pose.position.x * tool.force.y - tool.pose.position.y * tool.force.x
        self.assertAlmostEqual(wrench.torque.z, about_origin, delta=1e-9 * abs(tool.force.y))

    def test_unknown_parameters_are_told(self):
        rospy.set_param('/spelt/publish_rte', 5)
        self.addCleanup(rospy.delete_param, '/spelt')
        server = subprocess.Popen([executable('forming_server'), '__name:=spelt'], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(server.kill)
        told = ''
        while 'publish_rte' not in told:
            line = server.stdout.readline()
            self.assertTrue(line, told)
            told += line
        self.assertIn('did you mean publish_rate?', told)
        server.terminate()
        server.communicate(timeout=20)

    # ---- one run at a time, cancels

    def test_busy(self):
        running = Followed(goal_of(scenes.long_run(), output_directory=self.path('long')))
        running.wait_running()
        state, result = run(scenes.pulled_strip())
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertEqual(result.code, ResultCode.BUSY)
        self.assertEqual(running.client.get_state(), GoalStatus.ACTIVE)
        running.client.cancel_goal()
        state, result = running.result()
        self.assertEqual((state, result.code), (GoalStatus.PREEMPTED, ResultCode.CANCELLED))

    def test_a_client_that_was_killed_holds_up_no_other(self):
        """The master goes on to name its topics."""
        dead = subprocess.Popen(['rostopic', 'pub', '/forming_server/simulate_forming/goal', 'forming_sim/SimulateFormingActionGoal', '{}'])
        self.addCleanup(dead.kill)
        listened = threading.Event()
        watch = rospy.Subscriber('/forming_server/simulate_forming/goal', SimulateFormingActionGoal, lambda _: listened.set())
        self.addCleanup(watch.unregister)
        self.assertTrue(listened.wait(30))
        dead.kill()
        dead.wait()
        began = time.monotonic()
        for _ in range(6):
            self.assertEqual(run({})[0], GoalStatus.REJECTED)
        self.assertLess(time.monotonic() - began, 9, 'each waits no 2 s')

    def test_a_goal_after_a_cancel_waits_for_it(self):
        running = Followed(goal_of(scenes.long_run(), output_directory=self.path('long')))
        running.wait_running()
        after = Client()
        self.assertTrue(after.wait_for_server(LIMIT))
        running.client.cancel_goal()
        after.send_goal(goal_of(scenes.pulled_strip(), output_directory=self.path('after')))
        self.assertTrue(after.wait_for_result(LIMIT))
        self.assertEqual((after.get_state(), after.get_result().code), (GoalStatus.SUCCEEDED, ResultCode.SUCCESS), after.get_result().message)
        self.assertEqual(running.result()[0], GoalStatus.PREEMPTED)

    def test_cancel_at_once(self):
        # Over the action's topics: rospy's client gives a goal up as lost when it cancels it before the first
        # status message that lists it.
        answers = {}
        answered = threading.Condition()

        def on_result(message):
            with answered:
                answers[message.status.goal_id.id] = message
                answered.notify_all()

        goals = rospy.Publisher(ACTION + '/goal', SimulateFormingActionGoal, queue_size=1)
        cancels = rospy.Publisher(ACTION + '/cancel', GoalID, queue_size=1)
        results = rospy.Subscriber(ACTION + '/result', SimulateFormingActionResult, on_result)
        self.addCleanup(results.unregister)
        while min(goals.get_num_connections(), cancels.get_num_connections(), results.get_num_connections()) < 1:
            rospy.sleep(0.01)
        for name in ('first', 'second', 'third', 'fourth', 'fifth'):
            goals.publish(SimulateFormingActionGoal(goal_id=GoalID(id=name), goal=goal_of(scenes.long_run())))
            cancels.publish(GoalID(id=name))
            with answered:
                self.assertTrue(answered.wait_for(lambda: name in answers, 30), 'no result')
            answer = answers[name]
            self.assertIn(answer.status.status, (GoalStatus.PREEMPTED, GoalStatus.RECALLED), answer.status.text)
            # A goal whose cancel overtook it never reached the server's own code.
            self.assertIn(answer.result.code, (ResultCode.CANCELLED, ResultCode.NONE))

    def test_cancel_in_mid_run_then_resume_then_a_new_goal(self):
        followed = Followed(goal_of(scenes.long_run(), output_directory=self.path('long')))
        followed.wait_running()
        before = rospy.get_time()
        followed.client.cancel_goal()
        state, result = followed.result()
        self.assertLess(rospy.get_time() - before, 2)
        self.assertEqual((state, result.code), (GoalStatus.PREEMPTED, ResultCode.CANCELLED))
        self.assertIn('checkpoint.h5', result.files)
        with h5py.File(os.path.join(result.directory, 'result.h5')) as file:
            self.assertGreaterEqual(len(file['frames']), 1)
        with open(os.path.join(result.directory, 'summary.json')) as file:
            steps = json.load(file)['steps']

        resumed = Followed(goal_of(scenes.long_run(), output_directory=self.path('long'),
                                   resume=os.path.join(result.directory, 'checkpoint.h5')))
        resumed.wait_running()
        resumed.client.cancel_goal()
        state, _ = resumed.result()
        self.assertEqual(state, GoalStatus.PREEMPTED)
        self.assertGreaterEqual(resumed.feedback[0].step, steps)

        # Of another scene it is refused before anything is written.
        state, refused = run(scenes.pulled_strip(), output_directory=self.path('other'), resume=os.path.join(result.directory, 'checkpoint.h5'))
        self.assertEqual((state, refused.code), (GoalStatus.REJECTED, ResultCode.RESUME_ERROR))
        self.assertEqual([fault.field for fault in refused.faults], ['resume'])
        self.assertIn('another scene', refused.faults[0].remedy)
        self.assertFalse(os.path.exists(self.path('other')))

        state, result = run(scenes.pulled_strip())
        self.assertEqual((state, result.code), (GoalStatus.SUCCEEDED, ResultCode.SUCCESS))

    def test_a_run_that_cannot_create_its_files_ends_and_the_next_runs(self):
        self.assertEqual(run(scenes.pulled_strip())[1].code, ResultCode.SUCCESS)
        os.makedirs(self.path('taken/result.h5'))
        state, result = run(scenes.long_run(), output_directory=self.path('taken'))  # another mesh than the run before
        self.assertEqual((state, result.code), (GoalStatus.ABORTED, ResultCode.OUTPUT_ERROR), result.message)
        self.assertIn('result.h5', result.message)
        self.assertEqual(result.files, ['summary.json'])
        self.assertEqual(run(scenes.pulled_strip())[1].code, ResultCode.SUCCESS)

    def test_parameters_of_the_wrong_kind_are_told(self):
        for name, given in (('threads', 'two'), ('threads', '2.7'), ('publish_rate', 'fast'), ('colour_by', '5'), ('output_root', '5')):
            server = subprocess.run([executable('forming_server'), '__name:=other', '_%s:=%s' % (name, given)], stderr=subprocess.PIPE, text=True, timeout=30)
            rospy.delete_param('/other/' + name)
            self.assertEqual(server.returncode, 1, server.stderr)
            self.assertIn('parameter /other/%s: given %s; give ' % (name, given), server.stderr)

    # ---- who listens late

    def test_contact_of_an_earlier_run_is_not_taken_for_that_of_the_last(self):
        run(scenes.pressed_strip())
        self.assertGreater(len(rospy.wait_for_message('/forming_server/contact', ContactFields, 10).nodes), 0)
        run(scenes.pulled_strip())  # has no contact
        self.assertEqual(rospy.wait_for_message('/forming_server/contact', ContactFields, 10).nodes, ())

    def test_tools_keep_their_frames_after_the_run(self):
        scene = scenes.pressed_strip()
        scene['tools'][0]['motion'].update(kind='trajectory', positions=[[0, 0, 0], [0, -1e-5, 0]], rotations_deg=[[0, 0, 0], [0, 0, 10]])
        del scene['tools'][0]['motion']['velocities']
        scene['tools'][0]['point'] = [0.0, 0.003, 0.0]  # above the strip, also when it has turned
        result = run(scene)[1]
        self.assertEqual(result.code, ResultCode.SUCCESS, result.message)
        pose = rospy.wait_for_message('/tf', TFMessage, 10).transforms[0]
        self.assertEqual(pose.child_frame_id, 'forming_world/press')
        self.assertEqual(pose.transform.translation.y, result.summary.tools[0].pose.position.y)
        self.assertNotEqual(pose.transform.translation.y, 0)
        turned = result.summary.tools[0].pose.orientation
        for axis in 'xyzw':
            self.assertAlmostEqual(getattr(pose.transform.rotation, axis), getattr(turned, axis), delta=1e-12)
        self.assertAlmostEqual(abs(turned.z), math.sin(math.radians(5)), delta=1e-9)  # half of its 10 degrees

    # ---- services

    def test_validate_scene(self):
        validate = rospy.ServiceProxy('/forming_server/validate_scene', ValidateScene)
        validate.wait_for_service(10)
        good = validate(scene=scenes.message(scenes.pressed_strip()))
        self.assertTrue(good.valid)
        self.assertEqual(good.faults, [])
        scene = scenes.pressed_strip()
        scene['bodies'][0]['material']['density'] = 7.85
        odd = validate(scene=scenes.message(scene))
        self.assertTrue(odd.valid)
        self.assertEqual(len(odd.notes), len(good.notes) + 1, odd.notes)
        self.assertEqual(sum('the density of body' in note for note in odd.notes), 1, odd.notes)
        scene['dimension'] = 7
        scene['tools'][0]['friction'] = 11.0
        bad = validate(scene=scenes.message(scene))
        self.assertFalse(bad.valid)
        for field in ('dimension', 'tools[0].friction'):
            self.assertIn(field, [fault.field for fault in bad.faults])
        as_text = validate(scene_text=yaml.safe_dump(scene))
        self.assertEqual([fault.field for fault in as_text.faults], [fault.field for fault in bad.faults])

    def test_estimate_run(self):
        estimate = rospy.ServiceProxy('/forming_server/estimate_run', EstimateRun)
        estimate.wait_for_service(10)
        answer = estimate(scene=scenes.message(scenes.pressed_strip()), threads=1)
        self.assertTrue(answer.valid)
        self.assertEqual(answer.estimate.elements, 80)
        _, result = run(scenes.pressed_strip())
        self.assertAlmostEqual(answer.estimate.steps / result.summary.steps, 1, delta=0.3)
        self.assertGreater(answer.estimate.wall_time_s, 0)
        self.assertGreater(answer.estimate.memory_bytes, 0)
        as_text = estimate(scene_text=yaml.safe_dump(scenes.pressed_strip()), threads=1)
        self.assertEqual((as_text.valid, as_text.estimate.steps), (True, answer.estimate.steps))
        scene = scenes.pressed_strip()
        scene['dimension'] = 7
        self.assertFalse(estimate(scene=scenes.message(scene), threads=1).valid)
        many = estimate(scene=scenes.message(scenes.pressed_strip()), threads=100000)
        self.assertFalse(many.valid)
        self.assertEqual([fault.field for fault in many.faults], ['threads'])


if __name__ == '__main__':
    import rostest
    rospy.init_node('service_test')
    rostest.rosrun('forming_sim', 'service', ServiceTest)
