"""However a run of elastolab-petsc ends, all of its processes end, with one line of the first.

endings_test.py PETSC_PROGRAM ALLOCATION_FAULT PETSC_FAULT
"""

import os
import pathlib
import signal
import subprocess
import sys
import unittest

from petsc_case import CUBE, ENVIRONMENT, PULLED, PetscCase, on

PETSC_PROGRAM, ALLOCATION_FAULT, PETSC_FAULT = (sys.argv.pop(1) for _ in range(3))
SECONDS = 30  # in which all processes must be gone; with other work beside it
# Takes much longer than that to solve, with its estimates.
LARGE = {**PULLED, "mesh": {**CUBE["mesh"], "resolution": 40}}
OUTPUT = "displacements.csv"


def processes_of(launcher):
    """The process of each rank below a running mpirun."""
    children = (pathlib.Path(f"/proc/{launcher}/task/{launcher}/children")).read_text().split()
    ranks = {}
    for child in map(int, children):
        variables = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
        ranks.update((int(v.split(b"=")[1]), child) for v in variables if v.startswith(b"OMPI_COMM_WORLD_RANK="))
    return ranks


def runs(process):
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


class Endings(PetscCase):
    def assert_says(self, errors, text):
        """One line of the program, whatever mpirun adds."""
        lines = [line for line in errors.splitlines() if line.startswith("elastolab")]
        self.assertEqual(len(lines), 1, errors)
        self.assertTrue(lines[0].startswith("elastolab-petsc: " + text), errors)

    def solve(self, processes, *options, arguments=()):
        command = [*on(processes, PETSC_PROGRAM, *options), "solve", "scene.json", "--method", "fem", "--quiet",
                   "--displacements", OUTPUT, "--report", "report.json", *arguments]
        return subprocess.run(command, cwd=self.folder, check=False, env=ENVIRONMENT, timeout=SECONDS,
                              capture_output=True, text=True)

    def test_a_failure_while_shares_are_sent_ends_all_processes(self):
        self.write(PULLED)
        self.assertEqual(self.solve(2).returncode, 0)
        (self.folder / OUTPUT).unlink()
        n_nodes = self.report("report.json")["degrees_of_freedom"] // 3
        for processes in 1, 2, 3:
            with self.subTest(processes=processes):
                # Cutting a share marks the nodes that it needs, a byte each.
                done = self.solve(processes, "-x", f"LD_PRELOAD={ALLOCATION_FAULT}", "-x",
                                  f"ELASTOLAB_FAULT=0 {n_nodes}")
                self.assert_says(done.stderr, "The memory that this process may have is used up.")
                self.assertEqual(done.returncode, 1)
                self.assertFalse((self.folder / OUTPUT).exists())

    def test_a_failure_of_one_process_inside_petsc_ends_all_of_them(self):
        self.write(PULLED)
        for process in 0, 1:
            with self.subTest(process=process):
                done = self.solve(2, "-x", f"LD_PRELOAD={PETSC_FAULT}", "-x", f"ELASTOLAB_FAULT={process}",
                                  arguments=["--engine", "mumps"])
                self.assertIn("elastolab-petsc: PETSc: Error in external library (76).", done.stderr)
                self.assertNotEqual(done.returncode, 0)
                self.assertFalse((self.folder / OUTPUT).exists())

    def test_a_failure_leaves_no_object_of_petsc(self):
        self.write(PULLED)
        diverging = "-ksp_type richardson -pc_type none -ksp_richardson_scale 10"
        for processes in 1, 2:
            with self.subTest(processes=processes):
                done = self.solve(processes, "-x", f"PETSC_OPTIONS=-objects_dump {diverging}",
                                  arguments=["--engine", "gamg"])
                self.assert_says(done.stderr, "stiffness matrix: the iteration does not converge")
                self.assertNotIn("never freed", done.stdout)

    def interrupt(self, act):
        """Starts a long run, and acts on mpirun and its processes when conjugate gradients iterate."""
        self.write(LARGE)
        command = [*on(2, PETSC_PROGRAM), "solve", "scene.json", "--method", "fem", "--engine", "gamg", "--quiet",
                   "--displacements", OUTPUT, "--report", "report.json"]
        environment = {**ENVIRONMENT, "PETSC_OPTIONS": "-ksp_monitor"}
        with subprocess.Popen(command, cwd=self.folder, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as launcher:
            for line in launcher.stdout:
                if "KSP Residual norm" in line:
                    break
            processes = processes_of(launcher.pid)
            self.assertEqual(sorted(processes), [0, 1])
            try:
                act(launcher.pid, processes)
                _, errors = launcher.communicate(timeout=SECONDS)
            except subprocess.TimeoutExpired:
                for process in processes.values():
                    os.kill(process, signal.SIGKILL)
                launcher.kill()
                raise
        self.assertFalse(any(runs(process) for process in processes.values()))
        self.assert_says(errors, "Interrupted; no output was written.")
        self.assertNotEqual(launcher.returncode, 0)
        self.assertFalse((self.folder / OUTPUT).exists())

    def test_ctrl_c_ends_all_processes(self):
        self.interrupt(lambda launcher, processes: os.kill(launcher, signal.SIGINT))

    def test_a_signal_to_the_first_process_ends_all(self):
        self.interrupt(lambda launcher, processes: os.kill(processes[0], signal.SIGTERM))

    def test_a_signal_to_another_process_ends_all(self):
        self.interrupt(lambda launcher, processes: os.kill(processes[1], signal.SIGINT))

    def test_a_signal_ends_all_where_one_does_not_go_on(self):
        def act(_, processes):
            os.kill(processes[1], signal.SIGSTOP)
            os.kill(processes[0], signal.SIGINT)
        self.interrupt(act)


if __name__ == "__main__":
    unittest.main(verbosity=2)
