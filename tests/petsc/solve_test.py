"""elastolab-petsc on two and four processes against elastolab solve.

solve_test.py PROGRAM PETSC_PROGRAM
"""

import csv
import subprocess
import sys
import unittest

import numpy as np

from petsc_case import ENVIRONMENT, PULLED, TURNED, PetscCase, on

PROGRAM, PETSC_PROGRAM = sys.argv.pop(1), sys.argv.pop(1)
TOLERANCE = 1e-8  # relative to the largest value of a table


class Petsc(PetscCase):
    def run_solve(self, program, name, scene, *options):
        self.write(scene)
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
            self.run_solve(on(processes, PETSC_PROGRAM), "all", scene, "--method", method, "--engine", engine)
            self.assert_same("one.csv", "all.csv")
            self.assert_same("one-fields.csv", "all-fields.csv")
            one, all_ = self.report("one.json"), self.report("all.json")
            self.assertEqual(one.keys(), all_.keys())
            if scene is TURNED:  # the forces are nothing but rounding, and so is their imbalance
                self.assertLess(np.abs(self.numbers("all-forces.csv")).max(), TOLERANCE * 1e5)
                # On several processes the error of a body that nothing holds is not estimated, and that is said.
                one["warnings"], all_["warnings"] = ([warning for warning in report["warnings"]
                                                      if not any(text in warning for text in (
                                                          "do not balance", "is not estimated", "is too coarse"))]
                                                     for report in (one, all_))
                self.assertTrue(all(value is None for value in all_["error_estimate"].values()))
                one["error_estimate"] = all_["error_estimate"]
            else:
                self.assert_same("one-forces.csv", "all-forces.csv")
            np.testing.assert_allclose(all_["condition_estimate"], one["condition_estimate"], rtol=1e-5)
            self.assertEqual(one["warnings"], all_["warnings"])
            self.assertEqual(one["degrees_of_freedom"], all_["degrees_of_freedom"])
            self.assertLess(all_["residual"], 1e-9)
            for kind, estimate in one["error_estimate"].items():
                self.assertEqual(estimate is None, all_["error_estimate"][kind] is None)
                if estimate is not None:
                    self.assertAlmostEqual(estimate, all_["error_estimate"][kind], delta=TOLERANCE)

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
        self.write(PULLED)
        done = subprocess.run([*on(2, PETSC_PROGRAM), "solve", "scene.json", "--method", "linear-bem"],
                              cwd=self.folder, check=False, env=ENVIRONMENT, timeout=100,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("Choose fem or quadratic-fem", done.stderr)

    def grow(self, processes, *options):
        """The columns of a run of the command grow."""
        done = subprocess.run([*on(processes, PETSC_PROGRAM), "grow", "--heading", *options], check=True,
                              env=ENVIRONMENT, timeout=100, capture_output=True, text=True)
        names, values = csv.reader(done.stdout.splitlines())
        return dict(zip(names, values))

    def test_grows_the_same_cube_on_each_number_of_processes(self):
        for degree in 1, 2:
            nodes = 7 * degree + 1
            expected = None
            for processes in 1, 2, 3:
                for engine in "mumps", "gamg":
                    with self.subTest(degree=degree, processes=processes, engine=engine):
                        row = self.grow(processes, "--cells", "7", "--degree", str(degree), "--engine", engine,
                                        "--tolerance", "1e-12")
                        self.assertEqual(int(row["unknowns"]), 3 * nodes**3)
                        self.assertEqual(int(row["processes"]), processes)
                        self.assertEqual(row["engine"], engine)
                        self.assertEqual(int(row["iterations"]) > 0, engine == "gamg")
                        displacement = float(row["displacement"])
                        expected = expected or displacement
                        self.assertLess(abs(displacement / expected - 1), TOLERANCE)
            # A beam as long as it is thick bends by 4 and shears by 6/5 * 2 (1 + 0.3), per unit of force over E.
            self.assertLess(abs(expected / (4 + 3.12) - 1), 0.15)


if __name__ == "__main__":
    unittest.main(verbosity=2)
