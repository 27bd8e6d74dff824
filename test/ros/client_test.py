#!/usr/bin/python3
"""The program forming_client, against a server: what it finds, tells, cancels and returns."""
import os
import signal
import subprocess
import sys
import threading

import actionlib
import rospy
import yaml
from actionlib_msgs.msg import GoalID
from forming_sim.msg import ResultCode, RunStatus, SimulateFormingAction, SimulateFormingFeedback, SimulateFormingResult

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scenes  # noqa: E402
from support import ServerTest, executable, run  # noqa: E402

ACTION = '/forming_server/simulate_forming'


class ClientTest(ServerTest):
    def test_client_finds_the_server_of_its_namespace(self):
        environment = dict(os.environ, ROS_NAMESPACE='cell')
        server = subprocess.Popen([executable('forming_server'), '_output_root:=' + self.path('root')], env=environment)
        self.addCleanup(server.kill)
        with open(self.path('scene.yaml'), 'w') as file:
            yaml.safe_dump(scenes.pulled_strip(), file)
        client = subprocess.run([executable('forming_client'), self.path('scene.yaml'), '--output=' + self.path('there')], env=environment, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(client.returncode, 0, client.stderr)
        self.assertTrue(os.path.exists(self.path('there/result.h5')))
        server.terminate()
        server.wait(20)

    def test_client_tells_all_faults_and_fails(self):
        scene = scenes.pulled_strip()
        scene['bodies'][0]['boundaries'][0]['set'] = 'nowhere'
        scene['bodies'][0]['boundaries'][1]['set'] = 'neither'
        with open(self.path('bad.yaml'), 'w') as file:
            yaml.safe_dump(scene, file)
        client = subprocess.run([executable('forming_client'), self.path('bad.yaml')], stderr=subprocess.PIPE, text=True,
                                timeout=60)
        self.assertEqual(client.returncode, 2)
        self.assertIn('nowhere', client.stderr)
        self.assertIn('neither', client.stderr)

    def test_client_ends_while_feedback_still_comes(self):
        clients = []

        def talk(goal):
            client = clients[-1]
            result = SimulateFormingResult(code=ResultCode.SUCCESS, message='done')
            goal.set_accepted()
            # What comes while the client is stopped meets it all at once.
            client.send_signal(signal.SIGSTOP)
            goal.set_succeeded(result)
            for _ in range(1000):
                server.publish_feedback(goal.get_goal_status(), SimulateFormingFeedback())
            client.send_signal(signal.SIGCONT)
            while client.poll() is None:  # it may not have listened to results yet
                server.publish_result(goal.get_goal_status(), result)
                rospy.sleep(0.1)

        server = actionlib.ActionServer('/talkative/simulate_forming', SimulateFormingAction, talk, auto_start=False)
        server.start()
        with open(self.path('scene.yaml'), 'w') as file:
            yaml.safe_dump(scenes.pulled_strip(), file)
        for _ in range(5):
            clients.append(subprocess.Popen([executable('forming_client'), self.path('scene.yaml'), '--server', '/talkative'],
                                            stdout=subprocess.PIPE, text=True))
            self.addCleanup(clients[-1].kill)
            output, _ = clients[-1].communicate(timeout=20)
            self.assertEqual(clients[-1].returncode, 0)
            self.assertIn('done', output)

    def test_client_is_cancelled_by_ctrl_c(self):
        with open(self.path('long.yaml'), 'w') as file:
            yaml.safe_dump(scenes.long_run(), file)
        client = subprocess.Popen([executable('forming_client'), self.path('long.yaml')], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        client.stdout.readline()  # its first line of progress
        client.send_signal(2)
        _, errors = client.communicate(timeout=20)
        self.assertEqual(client.returncode, 130, errors)

    def test_client_tells_a_cancel_by_another_from_its_own(self):
        with open(self.path('long.yaml'), 'w') as file:
            yaml.safe_dump(scenes.long_run(), file)
        cancel = rospy.Publisher(ACTION + '/cancel', GoalID, queue_size=1)
        self.addCleanup(cancel.unregister)
        client = subprocess.Popen([executable('forming_client'), self.path('long.yaml')], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        client.stdout.readline()
        while cancel.get_num_connections() == 0:
            rospy.sleep(0.02)
        cancel.publish(GoalID())  # all goals
        _, errors = client.communicate(timeout=20)
        self.assertEqual(client.returncode, 1, errors)

    def test_a_goal_that_is_cancelled_while_it_is_prepared_leaves_the_results_in_its_directory(self):
        directory = self.path('run')
        self.assertEqual(run(scenes.pulled_strip(), output_directory=directory)[1].code, ResultCode.SUCCESS)

        def contents():
            return {name: open(os.path.join(directory, name), 'rb').read() for name in os.listdir(directory)}
        before = contents()
        large = scenes.pulled_strip(cells_along=100000)  # to be meshed takes ten times as long as to ask for the end of it
        large['name'] = 'large'
        large['bodies'][0]['blank']['length'] = 100.0
        with open(self.path('large.yaml'), 'w') as file:
            yaml.safe_dump(large, file)
        prepared = threading.Event()
        listener = rospy.Subscriber('/forming_server/status', RunStatus, lambda m: m.scene == 'large' and m.stage == 'preparing' and prepared.set())
        self.addCleanup(listener.unregister)
        client = subprocess.Popen([executable('forming_client'), self.path('large.yaml'), '--output', directory], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        self.assertTrue(prepared.wait(30))
        client.send_signal(signal.SIGINT)
        _, errors = client.communicate(timeout=60)
        self.assertEqual(client.returncode, 130, errors)
        self.assertIn('before the first step', errors)
        self.assertEqual(contents(), before)


if __name__ == '__main__':
    import rostest
    rospy.init_node('client_test')
    rostest.rosrun('forming_sim', 'client', ClientTest)
