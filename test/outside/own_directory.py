"""A test with a directory of its own."""
import os
import shutil
import tempfile
import unittest


class OwnDirectory(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.mkdtemp(prefix='forming_sim_')
        self.addCleanup(shutil.rmtree, self.directory)

    def path(self, name):
        return os.path.join(self.directory, name)
