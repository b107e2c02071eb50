"""Files for ParaView, read back by VTK itself: vtk_files_test.py PROGRAM [unittest's arguments]."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersGeneral import vtkWarpVector
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
from vtkmodules.vtkCommonDataModel import VTK_QUADRATIC_TETRA, VTK_TETRA

from program_case import ProgramCase, plane

GRADIENT = np.array([[0.01, 0.02, 0.0], [-0.01, 0.03, 0.005], [0.0, 0.01, -0.02]])
YOUNG, POISSON = 7.0, 0.25


def scene(method, handles, fixed=None):
    """A cube of 3 cells along an edge."""
    value = {
        "elastolab": 1,
        "mesh": {"primitive": "cube", "resolution": 3},
        "material": {"young_modulus": YOUNG, "poisson_ratio": POISSON},
        "method": method,
        "handles": handles,
    }
    return value if fixed is None else {**value, "fixed": fixed}


def stretched(method):
    """Every vertex of the surface follows u = GRADIENT x."""
    everything = {"sphere": {"center": [0, 0, 0], "radius": 9}}
    return scene(method, [{"select": everything, "matrix": GRADIENT.tolist()}])


def pulled(method):
    return scene(method, [{"select": plane(1), "translate": [0.1, 0, 0.05]}], plane(0))


def uniform_stress():
    """Hooke's law for GRADIENT, in VTK's order XX YY ZZ XY YZ XZ."""
    strain = (GRADIENT + GRADIENT.T) / 2
    lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    s = lame * np.trace(strain) * np.eye(3) + YOUNG / (1 + POISSON) * strain
    return np.array([s[0, 0], s[1, 1], s[2, 2], s[0, 1], s[1, 2], s[0, 2]])


class Solved(ProgramCase):
    def read(self, description, name, *options):
        """The file that solve writes, as VTK reads it, and rest positions and displacements of the vertices."""
        self.solve(description, "--mesh-out", name, "--displacements", "u.csv", *options)
        reader = vtkXMLPolyDataReader() if name.endswith(".vtp") else vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.folder / name))
        reader.Update()
        return reader.GetOutput(), self.columns("u.csv", "x", "z"), self.columns("u.csv", "ux", "uz")

    def check_facts(self, data):
        facts = data.GetFieldData()
        self.assertEqual(facts.GetAbstractArray("unit_of_displacement").GetValue(0), "L")
        self.assertEqual(facts.GetAbstractArray("unit_of_stress").GetValue(0), "F/L^2")
        self.assertEqual(facts.GetAbstractArray("young_modulus").GetValue(0), YOUNG)
        self.assertEqual(facts.GetAbstractArray("poisson_ratio").GetValue(0), POISSON)

    def check_components(self, attributes):
        stress = attributes.GetArray("stress")
        names = [stress.GetComponentName(i) for i in range(6)]
        self.assertEqual(names, ["XX", "YY", "ZZ", "XY", "YZ", "XZ"])

    def test_a_surface_is_at_rest_and_warps_to_where_it_was_pulled(self):
        for method in ("linear-bem", "fem"):
            data, rest, u = self.read(pulled(method), "out.vtp")
            np.testing.assert_array_equal(vtk_to_numpy(data.GetPoints().GetData()), rest)
            self.assertEqual(data.GetPointData().GetVectors().GetName(), "displacement")
            self.assertEqual(data.GetPointData().GetScalars().GetName(), "von_mises")
            warp = vtkWarpVector()
            warp.SetInputData(data)
            warp.Update()
            np.testing.assert_array_equal(vtk_to_numpy(warp.GetOutput().GetPoints().GetData()), rest + u)
            self.check_facts(data)
            self.check_components(data.GetPointData())

    def test_a_file_says_that_a_proxy_was_simulated(self):
        for name in ("out.vtp", "out.vtu"):
            data, _, _ = self.read(pulled("fem"), name)
            self.assertIsNone(data.GetFieldData().GetAbstractArray("simulated_on"))
            data, _, _ = self.read(pulled("fem"), name, "--proxy", "always", "--proxy-vertices", "40")
            said = data.GetFieldData().GetAbstractArray("simulated_on").GetValue(0)
            self.assertRegex(said, r"^a proxy of \d+ vertices$")

    def test_moved_points_have_no_active_vector(self):
        data, rest, u = self.read(pulled("fem"), "out.vtp", "--deformed")
        np.testing.assert_array_equal(vtk_to_numpy(data.GetPoints().GetData()), rest + u)
        self.assertIsNone(data.GetPointData().GetVectors())
        np.testing.assert_array_equal(vtk_to_numpy(data.GetPointData().GetArray("displacement")), u)

    def test_the_inside_of_a_uniform_stretch_has_its_stress(self):
        stress = uniform_stress()
        for method, cell in (("fem", VTK_TETRA), ("quadratic-fem", VTK_QUADRATIC_TETRA)):
            data, rest, u = self.read(stretched(method), "out.vtu")
            points = vtk_to_numpy(data.GetPoints().GetData())
            np.testing.assert_array_equal(points[: len(rest)], rest)
            displacement = vtk_to_numpy(data.GetPointData().GetVectors())
            np.testing.assert_array_equal(displacement[: len(u)], u)
            np.testing.assert_allclose(displacement, points @ GRADIENT.T, atol=1e-12)
            self.assertEqual({data.GetCellType(i) for i in range(data.GetNumberOfCells())}, {cell})
            for attributes in (data.GetPointData(), data.GetCellData()):
                numbers = vtk_to_numpy(attributes.GetArray("stress"))
                np.testing.assert_allclose(numbers, np.broadcast_to(stress, numbers.shape), atol=1e-9 * abs(stress).max())
                self.check_components(attributes)
            self.check_facts(data)

    def test_a_midpoint_lies_on_its_edge_and_the_cells_fill_the_cube(self):
        data, _, _ = self.read(pulled("quadratic-fem"), "out.vtu")
        points = vtk_to_numpy(data.GetPoints().GetData())
        edges = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]  # of vtkQuadraticTetra
        volume = 0.0
        for i in range(data.GetNumberOfCells()):
            ids = data.GetCell(i).GetPointIds()
            x = points[[ids.GetId(k) for k in range(10)]]
            for k, (a, b) in enumerate(edges):
                np.testing.assert_allclose(x[4 + k], (x[a] + x[b]) / 2, atol=1e-12)
            volume += np.linalg.det(x[1:4] - x[0]) / 6
        self.assertAlmostEqual(volume, 1.0, 12)
        constrained = (points[:, 0] == 1.0) | (points[:, 0] == 0.0)
        moved = np.where(points[constrained, :1] == 1.0, [[0.1, 0, 0.05]], 0.0)
        u = vtk_to_numpy(data.GetPointData().GetVectors())[constrained]
        np.testing.assert_allclose(u, moved, atol=1e-12)


if __name__ == "__main__":
    unittest.main()
