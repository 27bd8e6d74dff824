"""What the tests of the service share."""
import os
import shutil
import subprocess
import sys
import threading

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus

import scenes
from forming_sim.msg import SimulateFormingAction, SimulateFormingGoal

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'outside'))
from own_directory import OwnDirectory  # noqa: E402

LIMIT = rospy.Duration(60)


def executable(name):
    return subprocess.check_output(['catkin_find', '--first-only', '--libexec', 'forming_sim', name], text=True).strip()


class Client(actionlib.SimpleActionClient):
    """Follows goals. actionlib's own drops what comes before its send_goal has returned, and then waits for ever."""

    def __init__(self, server='/forming_server'):
        self._sent = threading.Event()
        super().__init__(server + '/simulate_forming', SimulateFormingAction)

    def send_goal(self, *args, **keywords):
        self._sent.clear()
        super().send_goal(*args, **keywords)
        self._sent.set()

    def _handle_transition(self, handle):
        self._sent.wait()
        super()._handle_transition(handle)

    def _handle_feedback(self, handle, feedback):
        self._sent.wait()
        super()._handle_feedback(handle, feedback)


class Followed:
    """A goal with the feedback it got; waits on state, never on time."""

    def __init__(self, goal):
        self.client = Client()
        assert self.client.wait_for_server(LIMIT), 'no server'
        self.feedback = []
        self.first = threading.Event()
        self.active = threading.Event()
        self.client.send_goal(goal, active_cb=self.active.set, feedback_cb=self._on_feedback)

    def _on_feedback(self, feedback):
        self.feedback.append(feedback.status)
        self.first.set()

    def wait_running(self):
        assert self.first.wait(30), 'no feedback: ' + str(self.client.get_goal_status_text())
        # Feedback may overtake the status; rospy's client gives a goal up as lost when it cancels it before that.
        assert self.active.wait(30), 'not active: ' + str(self.client.get_goal_status_text())
        assert self.client.get_state() == GoalStatus.ACTIVE, self.client.get_goal_status_text()

    def result(self):
        assert self.client.wait_for_result(LIMIT), 'no result'
        return self.client.get_state(), self.client.get_result()


def goal_of(scene, **fields):
    return SimulateFormingGoal(scene=scenes.message(scene), **fields)


def run(scene, **fields):
    return Followed(goal_of(scene, **fields)).result()


class ServerTest(OwnDirectory):
    """Leaves nothing of what a server wrote where it chose the place."""

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(rospy.get_param('/forming_server/output_root'), ignore_errors=True)
