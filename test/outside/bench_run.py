"""A run of forming_bench, whose program is the first word of the command line, and the rows that it writes."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

BENCH = sys.argv[1] if len(sys.argv) > 1 else ''


def run_bench(*words):
    return subprocess.run([BENCH, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


class BenchRun(unittest.TestCase):
    """`words` are run once for all tests of a class."""
    words = ()

    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.mkdtemp(prefix='forming_sim_')
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        cls.run_ = run_bench(*cls.words, '--output', cls.directory)
        if cls.run_.returncode != 0:
            raise AssertionError(cls.run_.stderr)
        with open(os.path.join(cls.directory, cls.words[0] + '.json')) as file:
            cls.rows = json.load(file)

    def of_case(self, quantity):
        return {row['case']: row for row in self.rows if row['quantity'] == quantity}
