"""What the tests of the service share."""
import subprocess
import threading

import actionlib

from forming_sim.msg import SimulateFormingAction


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
