"""What the tests of files share: a folder, the program that is named first on the command line, and tables of it."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

PROGRAM = sys.argv.pop(1)


def plane(x):
    return {"plane": {"point": [x, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-6}}


class ProgramCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def solve(self, description, *options):
        (self.folder / "scene.json").write_text(json.dumps(description))
        subprocess.run([PROGRAM, "solve", "scene.json", "--quiet", *options], cwd=self.folder, check=True)

    def columns(self, table, first, last):
        """These columns of a table that the program wrote, and those between them."""
        with open(self.folder / table, encoding="utf-8") as file:
            rows = list(csv.reader(file))
        begin, end = rows[0].index(first), rows[0].index(last) + 1
        return np.array([[float(x) for x in row[begin:end]] for row in rows[1:]])
