"""elastolab-petsc on two and four processes against elastolab solve.

solve_test.py PROGRAM PETSC_PROGRAM
"""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

PROGRAM, PETSC_PROGRAM = sys.argv.pop(1), sys.argv.pop(1)
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
TOLERANCE = 1e-8  # relative to the largest value of a table


def face(x):
    return {"plane": {"point": [x, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-6}}


CUBE = {"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 5},
        "material": {"young_modulus": 1e5, "poisson_ratio": 0.3}}
PULLED = {**CUBE, "fixed": face(0), "gravity": [0, 0, -9.81], "density": 500,
          "handles": [{"name": "right", "select": face(1), "translate": [0.2, 0, 0.1]}]}
# Nothing holds this one: two vertices move apart, and it takes the smallest motion.
TURNED = {**CUBE, "handles": [{"name": "edge", "select": {"vertices": [0, 1]},
                               "displacements": [[0, 0.1, 0], [0.05, 0.1, 0.02]]}]}


class Petsc(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_solve(self, program, name, scene, *options):
        (self.folder / "scene.json").write_text(json.dumps(scene))
        outputs = ["--displacements", f"{name}.csv", "--forces", f"{name}-forces.csv", "--fields", f"{name}-fields.csv",
                   "--report", f"{name}.json"]
        subprocess.run([*program, "solve", "scene.json", *outputs, *options], cwd=self.folder, check=True,
                       env=ENVIRONMENT, timeout=200, stdout=subprocess.DEVNULL)

    def numbers(self, table):
        with open(self.folder / table, encoding="utf-8") as file:
            rows = list(csv.reader(file))[1:]
        return np.array([[float(x) for x in row if x.lstrip("+-")[:1].isdigit()] for row in rows])

    def assert_same(self, table, other):
        expected, found = self.numbers(table), self.numbers(other)
        self.assertEqual(expected.shape, found.shape)
        worst = np.abs(found - expected).max() / np.abs(expected).max()
        self.assertLess(worst, TOLERANCE, other)

    def compare(self, scene, processes, method, engine):
        with self.subTest(processes=processes, method=method, engine=engine):
            self.run_solve([PROGRAM], "one", scene, "--method", method)
            launch = ["mpirun", "--oversubscribe", "-n", str(processes), PETSC_PROGRAM]
            self.run_solve(launch, "all", scene, "--method", method, "--engine", engine)
            self.assert_same("one.csv", "all.csv")
            self.assert_same("one-fields.csv", "all-fields.csv")
            if scene is TURNED:  # forces add up to nothing: their imbalance, and its warning, are rounding
                self.assertLess(np.abs(self.numbers("all-forces.csv")).max(), TOLERANCE * 1e5)
                return
            self.assert_same("one-forces.csv", "all-forces.csv")
            one, all_ = (json.loads((self.folder / f"{name}.json").read_text()) for name in ("one", "all"))
            self.assertEqual(one.keys(), all_.keys())
            self.assertEqual(one["warnings"], all_["warnings"])
            self.assertEqual(one["degrees_of_freedom"], all_["degrees_of_freedom"])
            self.assertLess(all_["residual"], 1e-9)
            for kind, estimate in one["error_estimate"].items():
                self.assertEqual(estimate is None, all_["error_estimate"][kind] is None)
                if estimate is not None:
                    self.assertAlmostEqual(estimate, all_["error_estimate"][kind], delta=TOLERANCE)
            np.testing.assert_allclose(all_["condition_estimate"], one["condition_estimate"], rtol=1e-5)

    def test_solves_as_one_process_does(self):
        for processes in 2, 4:
            for method in "fem", "quadratic-fem":
                for engine in "auto", "mumps", "gamg":
                    self.compare(PULLED, processes, method, engine)

    def test_takes_the_smallest_motion_of_a_free_body(self):
        for method in "fem", "quadratic-fem":
            for engine in "mumps", "gamg":
                self.compare(TURNED, 2, method, engine)

    def test_refuses_other_methods(self):
        (self.folder / "scene.json").write_text(json.dumps(PULLED))
        done = subprocess.run(["mpirun", "--oversubscribe", "-n", "2", PETSC_PROGRAM, "solve", "scene.json", "--method",
                               "linear-bem"], cwd=self.folder, check=False, env=ENVIRONMENT, timeout=100,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("Choose fem or quadratic-fem", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
