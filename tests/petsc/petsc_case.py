"""What the tests of elastolab-petsc share: scenes, and runs on several processes in a folder of their own."""

import json
import os
import pathlib
import tempfile
import unittest

ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def face(x):
    return {"plane": {"point": [x, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-6}}


CUBE = {"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 5},
        "material": {"young_modulus": 1e5, "poisson_ratio": 0.3}}
PULLED = {**CUBE, "fixed": face(0), "gravity": [0, 0, -9.81], "density": 500,
          "handles": [{"name": "right", "select": face(1), "translate": [0.2, 0, 0.1]}]}
# Nothing holds this one: two vertices move apart, and it takes the smallest motion.
TURNED = {**CUBE, "handles": [{"name": "edge", "select": {"vertices": [0, 1]},
                               "displacements": [[0, 0.1, 0], [0.05, 0.1, 0.02]]}]}


def on(processes, program, *options):
    """The command line of a run on so many processes; options are of mpirun."""
    return ["mpirun", "--oversubscribe", "-n", str(processes), *options, program]


class PetscCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, scene):
        (self.folder / "scene.json").write_text(json.dumps(scene))

    def report(self, name):
        return json.loads((self.folder / name).read_text())
