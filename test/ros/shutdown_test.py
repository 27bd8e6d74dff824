#!/usr/bin/python3
"""A server that is stopped in the middle of a run ends, and leaves files that can be read."""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import h5py
import rospy
from forming_sim.msg import ResultCode, SimulateFormingGoal

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scenes  # noqa: E402
from support import Client, executable  # noqa: E402


class ShutdownTest(unittest.TestCase):
    def start(self, name):
        """A server with a run under way: its process, its client, its directory."""
        directory = tempfile.mkdtemp(prefix='forming_sim_')
        self.addCleanup(shutil.rmtree, directory, ignore_errors=True)
        server = subprocess.Popen([executable('forming_server'), '__name:=' + name])
        self.addCleanup(lambda: server.poll() is None and server.kill())
        client = Client('/' + name)
        self.assertTrue(client.wait_for_server(rospy.Duration(20)))
        running = threading.Event()

        def on_feedback(feedback):
            if feedback.status.step > 0:
                running.set()
        client.send_goal(SimulateFormingGoal(scene=scenes.message(scenes.long_run()), output_directory=directory),
                         feedback_cb=on_feedback)
        self.assertTrue(running.wait(30))
        return server, client, directory

    def assert_readable(self, directory):
        with h5py.File(os.path.join(directory, 'result.h5')) as file:
            frames = sorted(file['frames'])
            self.assertGreaterEqual(len(frames), 1)
            self.assertEqual(file['frames'][frames[-1]]['positions'].shape[1], 3)

    def stop_cleanly(self, name, stop):
        server, client, directory = self.start(name)
        stop(server)
        self.assertEqual(server.wait(10), 0)
        self.assert_readable(directory)
        with open(os.path.join(directory, 'summary.json')) as file:
            self.assertEqual(json.load(file)['status']['code'], ResultCode.CANCELLED)
        self.assertTrue(os.path.exists(os.path.join(directory, 'checkpoint.h5')))
        # It tells its client before it goes.
        self.assertTrue(client.wait_for_result(rospy.Duration(5)))
        self.assertEqual(client.get_result().code, ResultCode.CANCELLED)

    def test_interrupt(self):
        self.stop_cleanly('interrupted', lambda server: server.send_signal(signal.SIGINT))

    def test_terminate(self):
        self.stop_cleanly('terminated', lambda server: server.send_signal(signal.SIGTERM))

    def test_hang_up(self):
        self.stop_cleanly('hung_up', lambda server: server.send_signal(signal.SIGHUP))

    def test_rosnode_kill(self):
        self.stop_cleanly('killed_by_name', lambda server: subprocess.check_call(['rosnode', 'kill', '/killed_by_name']))

    def test_kill_without_warning(self):
        server, _, directory = self.start('killed')
        server.kill()
        server.wait(10)
        self.assert_readable(directory)

    def test_idle(self):
        server = subprocess.Popen([executable('forming_server'), '__name:=idle'])
        client = Client('/idle')
        self.assertTrue(client.wait_for_server(rospy.Duration(20)))
        server.send_signal(signal.SIGINT)
        self.assertEqual(server.wait(10), 0)


if __name__ == '__main__':
    import rostest
    rospy.init_node('shutdown_test')
    rostest.rosrun('forming_sim', 'shutdown', ShutdownTest)
