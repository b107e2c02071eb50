#!/usr/bin/env python3
"""The references of tests/methods/turned_bodies_test.cpp by other code:

    bar   of 4 x 1 x 1, its end at x = 0 held, the other one turned by 120 degrees about the bar's axis
    ear   of the rabbit in assets/meshes, its feet held, the tip of an ear turned by 60 degrees about the ear's root

Compressible neo-Hookean equilibrium with ten-node tetrahedra by FEniCSx, which differentiates the energy itself and
integrates it with more than four Gauss points; Gmsh fills the body. The test needs neither and reads what was written:

    apt-get install --no-install-recommends python3-dolfinx-real python3-gmsh python3-scipy   # Debian 12: dolfinx 0.5.2
    OMP_NUM_THREADS=1 /usr/bin/python3 scripts/reference_turns.py bar tests/methods/references/twisted_bar.csv
    OMP_NUM_THREADS=1 /usr/bin/python3 scripts/reference_turns.py ear tests/methods/references/turned_ear.csv

The surface is refined by halving edges, which leaves the body as it is: everywhere, and towards the rims of both
patches, where derivatives of the answer are singular. How far the levels' answers lie apart is a scatter between meshes,
and no bound of the last one's error: the finest is not refined further at the rims.
"""

import argparse
import pathlib
import time

import gmsh
import numpy as np
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc
from mpi4py import MPI
from petsc4py import PETSc
from scipy.spatial import cKDTree

POISSON_RATIO = 0.3  # Young's modulus is 1: displacements do not depend on it
EDGES = ((0, 1), (1, 2), (2, 0))
LARGEST = 1.45  # edge, over the wanted one


HELD, TURNED = 1, 2


class Case:
    """A surface, which of its triangles are held, which are turned, and how."""

    def __init__(self, vertices, triangles, held, turned, axis, centre, degrees):
        self.vertices, self.triangles = vertices, triangles
        self.patch = np.zeros(len(triangles), int)
        self.patch[held] = HELD
        self.patch[turned] = TURNED
        self.axis, self.centre, self.degrees = axis, centre, degrees

    def displacements(self, x, degrees):
        """Of the turned patch at points x, by Rodrigues' formula."""
        angle, arm = np.radians(degrees), x - self.centre
        return np.sin(angle) * np.cross(self.axis, arm) + (1 - np.cos(angle)) * np.cross(
            self.axis, np.cross(self.axis, arm))


def inside_triangles(vertices, triangles, selected):
    """Triangles whose three vertices are selected: what a patch is in elastolab."""
    return np.all(selected(vertices)[triangles], axis=1)


def bar():
    """Vertices on a lattice of a sixth, of which those of thirds and halves are part."""
    n, size = np.array([24, 6, 6]), np.array([4.0, 1.0, 1.0])
    number, vertices, triangles = {}, [], []

    def at(index):
        key = tuple(index)
        if key not in number:
            number[key] = len(vertices)
            vertices.append(np.array(key) / n * size)
        return number[key]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, n[axis]):
            for i in range(n[u]):
                for j in range(n[v]):
                    corner = np.zeros(3, int)
                    corner[axis], corner[u], corner[v] = side, i, j
                    a, b, c, d = (at(corner + np.eye(3, dtype=int)[u] * s + np.eye(3, dtype=int)[v] * t)
                                  for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)))
                    faces = [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
                    triangles += [f if side else f[::-1] for f in faces]
    vertices, triangles = np.array(vertices), np.array(triangles)
    return Case(vertices, triangles, inside_triangles(vertices, triangles, lambda x: x[:, 0] < 1e-9),
                inside_triangles(vertices, triangles, lambda x: x[:, 0] > 4 - 1e-9),
                np.array([1.0, 0, 0]), np.array([4.0, 0.5, 0.5]), 120.0)


def ear():
    """The rabbit as it is filed; the ear bends between its root and the tip that is turned."""
    file = pathlib.Path(__file__).parent.parent / "assets" / "meshes" / "rabbit.obj"
    rows = [line.split() for line in file.read_text().splitlines()]
    vertices = np.array([row[1:4] for row in rows if row[:1] == ["v"]], float)
    triangles = np.array([[corner.split("/")[0] for corner in row[1:4]] for row in rows if row[:1] == ["f"]], int) - 1
    return Case(vertices, triangles, inside_triangles(vertices, triangles, lambda x: x[:, 2] <= 0.12),
                inside_triangles(vertices, triangles, lambda x: (x[:, 0] >= 0) & (x[:, 2] >= 2.05)),
                np.array([1.0, 0, 0]), np.array([0.2, -0.26, 1.7]), 60.0)


CASES = {"bar": bar, "ear": ear}


def halve(vertices, triangles, patch, too_long):
    """Halves edges until none is too long: too_long(ends a, ends b) for arrays of them. Where an edge of a triangle is
    halved its longest one is as well, which keeps angles from getting ever smaller. Old vertices come first."""
    while True:
        ends = np.sort(triangles[:, EDGES].reshape(-1, 2), axis=1)
        edges, edge_of = np.unique(ends, axis=0, return_inverse=True)
        edge_of = edge_of.reshape(-1, 3)
        length = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
        marked = too_long(vertices[edges[:, 0]], vertices[edges[:, 1]])
        if not marked.any():
            return vertices, triangles, patch
        longest = np.take_along_axis(edge_of, length[edge_of].argmax(axis=1)[:, None], axis=1)[:, 0]
        while True:
            n_marked = marked.sum()
            marked[longest[marked[edge_of].any(axis=1)]] = True
            if marked.sum() == n_marked:
                break
        middle = np.full(len(edges), -1)
        middle[marked] = len(vertices) + np.arange(n_marked)
        vertices = np.vstack([vertices, vertices[edges[marked]].mean(axis=1)])
        parts, patches = [], []
        for t, at, number in zip(triangles, edge_of, patch):
            first = length[at].argmax()
            t, at = np.roll(t, -first), np.roll(at, -first)  # the longest edge from corner 0 to 1
            m = middle[at]
            if m[0] < 0:
                new = [t]
            else:
                new = [(t[2], t[0], m[0])] if m[2] < 0 else [(m[2], t[0], m[0]), (t[2], m[2], m[0])]
                new += [(t[1], t[2], m[0])] if m[1] < 0 else [(m[1], t[2], m[0]), (t[1], m[1], m[0])]
            parts += new
            patches += [number] * len(new)
        triangles, patch = np.array(parts), np.array(patches)


def rim(case):
    """Points along the edges of both patches, close enough to each other."""
    sides = {}
    for t, number in zip(case.triangles, case.patch):
        for i, j in EDGES:
            sides.setdefault(frozenset((t[i], t[j])), set()).add(number)
    ends = np.array([sorted(edge) for edge, numbers in sides.items() if len(numbers) > 1])
    a, b = case.vertices[ends[:, 0]], case.vertices[ends[:, 1]]
    return np.vstack([a + s * (b - a) for s in np.linspace(0, 1, 65)])


def refined(case, halvings, at_rims):
    """Edges halved so many times, and so many times at the rims, from where they grow with distance."""
    tree = cKDTree(rim(case))
    ends = case.triangles[:, EDGES].reshape(-1, 2)
    edge = np.linalg.norm(case.vertices[ends[:, 0]] - case.vertices[ends[:, 1]], axis=1).mean()

    def too_long(a, b):
        at_rim = np.maximum(edge / 2**at_rims, 0.5 * tree.query(0.5 * (a + b))[0])
        return np.linalg.norm(a - b, axis=1) > LARGEST * np.minimum(edge / 2**halvings, at_rim)

    return halve(case.vertices, case.triangles, case.patch, too_long)


def filled(vertices, triangles):
    """Tetrahedra in a closed surface, whose vertices and triangles are kept."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    surface = gmsh.model.addDiscreteEntity(2)
    gmsh.model.mesh.addNodes(2, surface, np.arange(1, len(vertices) + 1), vertices.ravel())
    gmsh.model.mesh.addElementsByType(surface, 2, [], triangles.ravel() + 1)
    gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop([surface])])
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    numbers, points, _ = gmsh.model.mesh.getNodes()
    place = np.full(int(numbers.max()) + 1, -1)
    place[numbers.astype(int)] = np.arange(len(numbers))
    tetrahedra = place[gmsh.model.mesh.getElementsByType(4)[1].astype(int)]
    gmsh.finalize()
    used, tetrahedra = np.unique(tetrahedra, return_inverse=True)
    cell = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.tetrahedron, 1))
    return mesh.create_mesh(MPI.COMM_SELF, tetrahedra.reshape(-1, 4), points.reshape(-1, 3)[used], cell)


class NoConvergence(Exception):
    """A step was too long."""


class Equilibrium:
    """Newton's method for displacements of ten-node elements, of which those of some nodes are prescribed."""

    def __init__(self, domain):
        self.space = fem.VectorFunctionSpace(domain, ("Lagrange", 2))
        self.u = fem.Function(self.space)
        nu = POISSON_RATIO
        mu, lame = 1 / (2 * (1 + nu)), nu / ((1 + nu) * (1 - 2 * nu))
        F = ufl.Identity(3) + ufl.grad(self.u)
        J = ufl.det(F)
        psi = mu / 2 * (ufl.inner(F, F) - 3) - mu * ufl.ln(J) + lame / 2 * ufl.ln(J) ** 2
        energy = psi * ufl.dx(metadata={"quadrature_degree": 5})
        force = ufl.derivative(energy, self.u, ufl.TestFunction(self.space))
        self.energy, self.force = fem.form(energy), fem.form(force)
        self.tangent = fem.form(ufl.derivative(force, self.u, ufl.TrialFunction(self.space)))
        self.nodes = self.space.tabulate_dof_coordinates()
        self.matrix = petsc.create_matrix(self.tangent)
        self.matrix.setOption(PETSc.Mat.Option.SPD, True)
        self.solver = PETSc.KSP().create(MPI.COMM_SELF)
        self.solver.setType("preonly")
        self.solver.getPC().setType("cholesky")
        self.solver.getPC().setFactorSolverType("mumps")

    def nodes_at(self, points):
        distances, nodes = cKDTree(self.nodes).query(points)
        assert distances.max() < 1e-9, "a point is no node"
        return nodes

    def solve(self, nodes, values, tolerance):
        """Takes nodes to given displacements, and the others to where their forces vanish."""
        rows = (3 * nodes[:, None] + np.arange(3)).ravel().astype(np.int32)
        for iteration in range(12):
            f = petsc.assemble_vector(self.force)
            if not np.isfinite(f.array).all():
                raise NoConvergence  # an element turned inside out
            reactions = np.linalg.norm(f.array[rows])
            f.array[rows] = 0
            if iteration > 0 and np.linalg.norm(f.array) < tolerance * reactions:
                return
            f.scale(-1)
            known = f.duplicate()
            known.array[rows] = values.ravel() - self.u.x.array[rows]
            self.matrix.zeroEntries()
            petsc.assemble_matrix(self.matrix, self.tangent)
            self.matrix.assemble()
            self.matrix.zeroRowsColumns(rows, 1.0, known, f)  # and takes what is known to the right side
            self.solver.setOperators(self.matrix)
            change = f.duplicate()
            self.solver.solve(f, change)
            self.u.x.array[:] += change.array
        raise NoConvergence


def turn(case, equilibrium, held, turned, tolerance=1e-9):
    """From rest, in steps of the turn."""
    degrees, step = 0.0, 10.0
    nodes = np.concatenate([held, turned])
    while degrees < case.degrees:
        target = min(degrees + step, case.degrees)
        moved = case.displacements(equilibrium.nodes[turned], target)
        before = equilibrium.u.x.array.copy()
        try:
            equilibrium.solve(nodes, np.vstack([np.zeros((len(held), 3)), moved]),
                              tolerance if target == case.degrees else 1e-3)
            degrees = target
        except NoConvergence:
            equilibrium.u.x.array[:] = before
            step /= 2
            if step < 0.1:
                raise


def answer(case, halvings, at_rims):
    """Displacements of the case's vertices, and what they were computed with."""
    begin = time.time()
    vertices, triangles, patch = refined(case, halvings, at_rims)
    domain = filled(vertices, triangles)
    equilibrium = Equilibrium(domain)

    def nodes_of(number):
        corners = vertices[triangles[patch == number]]
        return equilibrium.nodes_at(np.unique(
            np.vstack([corners[:, i] for i in range(3)] + [corners[:, e].mean(axis=1) for e in EDGES]), axis=0))

    turn(case, equilibrium, nodes_of(HELD), nodes_of(TURNED))
    n_tetrahedra = domain.topology.index_map(3).size_local
    energy = fem.assemble_scalar(equilibrium.energy)
    print(f"{n_tetrahedra} tetrahedra, {3 * len(equilibrium.nodes)} unknowns, energy {energy:.6g}, "
          f"{time.time() - begin:.0f} s", flush=True)
    u = equilibrium.u.x.array.reshape(-1, 3)[equilibrium.nodes_at(case.vertices)]
    return u, n_tetrahedra, energy


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("case", choices=CASES)
    parser.add_argument("file")
    parser.add_argument("--levels", default="0,0 0,2 1,1", help="halvings of edges, and of those at rims")
    arguments = parser.parse_args()
    case = CASES[arguments.case]()
    answers, apart = [], 0.0
    for level in arguments.levels.split():
        answers.append(answer(case, *map(int, level.split(","))))
        u = answers[-1][0]
        for other, *_ in answers[:-1]:
            apart = np.linalg.norm(u - other) / np.linalg.norm(u)
            print(f"apart: rms {apart:.2e}", flush=True)
    header = (f"FEniCSx (scripts/reference_turns.py), {answers[-1][1]} ten-node tetrahedra, energy "
              f"{answers[-1][2]:.6g}, rms difference to the level before {apart:.1e}\nx,y,z,ux,uy,uz")
    np.savetxt(arguments.file, np.hstack([case.vertices, u]), "%.9g", ",", header=header)


if __name__ == "__main__":
    main()
