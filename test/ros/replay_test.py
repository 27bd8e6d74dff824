#!/usr/bin/python3
"""The topics of a run, recorded in a bag and kept in a result file, can be seen again."""
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from xmlrpc.client import ServerProxy

import rosbag
import rosgraph
import rospy
from forming_sim.msg import ResultCode, RunStatus, SimulateFormingGoal
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scenes  # noqa: E402
from support import Client, executable  # noqa: E402

TOPICS = ['deformed_mesh', 'plastic_strain', 'plastic_strain_topology', 'status', 'tool_forces/press']


def subscribed(topics):
    """Waits until somebody else listens to all the topics."""
    master = rosgraph.Master(rospy.get_name())
    rate = rospy.Rate(50)
    while not rospy.is_shutdown():
        listening = {topic for topic, nodes in master.getSystemState()[1] if nodes}
        if listening.issuperset(topics):
            return
        rate.sleep()


def connected(node, topic):
    """Waits until somebody gets what the node publishes on the topic."""
    master = rosgraph.Master(rospy.get_name())
    rate = rospy.Rate(50)
    while not rospy.is_shutdown():
        links = ServerProxy(master.lookupNode(node)).getBusInfo(rospy.get_name())[2]
        if any(link[2] == 'o' and link[4] == topic for link in links):
            return
        rate.sleep()


class ReplayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.mkdtemp(prefix='forming_sim_')
        cls.bag = os.path.join(cls.directory, 'run.bag')
        names = ['/forming_server/' + topic for topic in TOPICS]
        recorder = subprocess.Popen(['rosrun', 'rosbag', 'record', '--lz4', '-O', cls.bag] + names)
        subscribed(names)
        client = Client()
        assert client.wait_for_server(rospy.Duration(20))
        goal = SimulateFormingGoal(scene=scenes.message(scenes.pressed_strip(4e-5)), output_directory=cls.directory)
        # Forces have a topic once there was a run with the tool: the second one is heard from its start.
        for _ in range(2):
            client.send_goal(goal)
            assert client.wait_for_result(rospy.Duration(30))
            assert client.get_result().code == ResultCode.SUCCESS, client.get_result().message
            connected('/forming_server', '/forming_server/tool_forces/press')
        recorder.send_signal(signal.SIGINT)
        recorder.wait(20)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.directory)

    def test_bag_holds_the_run(self):
        last_strain, meshes, largest_force, counts = 0, 0, 0, set()
        with rosbag.Bag(self.bag) as bag:
            found = set(bag.get_type_and_topic_info().topics)
            for topic, message, _ in bag.read_messages():
                if topic.endswith('deformed_mesh'):
                    meshes += 1
                    counts.add(tuple(len(m.points) for m in message.markers if m.ns in ('sheet', 'tools')))
                    for marker in message.markers:
                        for p in marker.points:
                            self.assertTrue(p.x == p.x and p.y == p.y and p.z == p.z)
                if topic.endswith('/press'):
                    largest_force = max(largest_force, message.wrench.force.y)
                if topic.endswith('/plastic_strain'):
                    last_strain = max(message.values)
        for topic in TOPICS:
            self.assertIn('/forming_server/' + topic, found)
        self.assertGreaterEqual(meshes, 2)
        self.assertEqual(len(counts), 1, 'the number of triangles stays constant')
        self.assertGreater(last_strain, 0)
        self.assertGreater(largest_force, 0)

    def wait_for_last(self, topic, reached):
        """The first message for which reached(message) holds."""
        found, event = [], threading.Event()

        def on_message(message):
            if reached(message) and not event.is_set():
                found.append(message)
                event.set()
        subscriber = rospy.Subscriber(topic, MarkerArray if 'mesh' in topic else RunStatus, on_message, queue_size=100)
        self.addCleanup(subscriber.unregister)
        return found, event

    def test_bag_plays(self):
        found, event = self.wait_for_last('/again/forming_server/deformed_mesh', lambda m: any(k.ns == 'sheet' for k in m.markers))
        player = subprocess.Popen(['rosrun', 'rosbag', 'play', '-q', '--delay', '1', '--prefix', 'again', self.bag])
        self.addCleanup(player.kill)
        self.assertTrue(event.wait(20))
        self.assertEqual(player.wait(20), 0)
        self.assertGreater(len([m for m in found[0].markers if m.ns == 'sheet'][0].points), 0)

    def test_result_file_plays_to_its_end(self):
        meshes, mesh_event = self.wait_for_last('/replayer/deformed_mesh', lambda m: any(k.ns == 'sheet' for k in m.markers))
        states, state_event = self.wait_for_last('/replayer/status', lambda s: s.progress == 1)
        player = subprocess.Popen([executable('forming_replay'), os.path.join(self.directory, 'result.h5'),
                                   '__name:=replayer', '_duration:=1'])
        self.addCleanup(player.kill)
        self.assertTrue(mesh_event.wait(20))
        self.assertTrue(state_event.wait(20))
        self.assertAlmostEqual(states[0].time_s, 4e-5, delta=1e-9)
        self.assertEqual([t.name for t in states[0].tools], ['press'])
        self.assertGreater(states[0].max_plastic_strain, 0)
        player.send_signal(signal.SIGINT)
        self.assertEqual(player.wait(10), 0)

    def test_beside_a_server_it_asks_for_a_name_of_its_own(self):
        play = [executable('forming_replay'), os.path.join(self.directory, 'result.h5'), '_duration:=1']
        refused = subprocess.run(play + ['__name:=second', '_topics:=forming_server'], stderr=subprocess.PIPE, text=True, timeout=20)
        self.assertEqual(refused.returncode, 1, refused.stderr)
        self.assertIn('parameter /second/topics: given /forming_server; a node publishes there already', refused.stderr)
        states, event = self.wait_for_last('/apart/status', lambda s: s.progress == 1)
        player = subprocess.Popen(play + ['__name:=third', '_topics:=apart'])
        self.addCleanup(player.kill)
        self.assertTrue(event.wait(20))
        # What the file does not tell is no number.
        self.assertTrue(math.isnan(states[0].energies.kinetic) and math.isnan(states[0].dt_s) and math.isnan(states[0].tools[0].peak_force.y))
        self.assertNotEqual(states[0].tools[0].force.y, 0)
        self.assertFalse(math.isnan(states[0].tools[0].moment.z))
        player.send_signal(signal.SIGINT)
        self.assertEqual(player.wait(10), 0)

    def test_launched_beside_a_server_it_leaves_it_alone(self):
        launch = subprocess.run(['roslaunch', 'forming_sim', 'replay.launch', 'rviz:=false', 'file:=' + os.path.join(self.directory, 'result.h5')],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=40)
        self.assertIn('a node publishes there already', launch.stdout)
        client = Client()
        self.assertTrue(client.wait_for_server(rospy.Duration(20)))
        goal = SimulateFormingGoal(scene=scenes.message(scenes.pressed_strip(1e-5)), output_directory=os.path.join(self.directory, 'after'))
        client.send_goal(goal)
        self.assertTrue(client.wait_for_result(rospy.Duration(30)))
        self.assertEqual(client.get_result().code, ResultCode.SUCCESS)

    def test_a_file_that_is_none_is_told(self):
        path = os.path.join(self.directory, 'summary.json')
        player = subprocess.run([executable('forming_replay'), path, '__name:=none'], stderr=subprocess.PIPE, text=True, timeout=20)
        self.assertEqual(player.returncode, 1)
        self.assertIn(path, player.stderr)


if __name__ == '__main__':
    import rostest
    rospy.init_node('replay_test')
    rostest.rosrun('forming_sim', 'replay', ReplayTest)
