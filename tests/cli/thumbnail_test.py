"""Thumbnails, read by VTK: thumbnail_test.py PROGRAM [unittest's arguments]."""

import json
import subprocess
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from program_case import PROGRAM, ProgramCase



class Thumbnail(ProgramCase):
    def run_program(self, *words):
        return subprocess.run([PROGRAM, "thumbnail", *words], cwd=self.folder, capture_output=True, text=True,
                              env={"PATH": "/usr/bin:/bin"}, check=False)

    def picture(self, *words):
        """Rows from the top, columns, red green blue opacity."""
        run = self.run_program(*words)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        reader = vtkPNGReader()
        reader.SetFileName(str(self.folder / words[1]))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, 4)[::-1].astype(int)

    def scene(self, mesh):
        (self.folder / "scene.json").write_text(json.dumps({
            "elastolab": 1, "mesh": mesh, "method": "fem", "handles": [],
            "material": {"young_modulus": 1, "poisson_ratio": 0.3}}))

    def test_what_it_shows_is_not_overwritten(self):
        self.scene({"primitive": "cube", "resolution": 1})
        before = (self.folder / "scene.json").read_text()
        run = self.run_program("scene.json", "./scene.json")
        self.assertEqual(run.returncode, 2)
        self.assertIn("is an input", run.stderr)
        self.assertEqual((self.folder / "scene.json").read_text(), before)

    def test_a_cube_shows_three_faces_and_fills_the_picture(self):
        self.scene({"primitive": "cube", "resolution": 3})
        pixels = self.picture("scene.json", "cube.png", "--size", "96")
        self.assertEqual(pixels.shape, (96, 96, 4))
        opaque = pixels[..., 3] == 255
        rows, columns = np.nonzero(opaque)
        self.assertGreater(max(np.ptp(rows), np.ptp(columns)), 0.88 * 96)
        # The outline of a unit cube from this direction has the area |x| + |y| + |z| of the direction.
        a, h = -1.0, 0.45
        direction = np.abs([np.cos(h) * np.cos(a), np.cos(h) * np.sin(a), np.sin(h)])
        height = np.cos(h) + np.sin(h) * (abs(np.cos(a)) + abs(np.sin(a)))
        width = abs(np.sin(a)) + abs(np.cos(a))
        pixel = max(height, width) / (0.92 * 96)
        self.assertAlmostEqual((pixels[..., 3] / 255).sum() * pixel**2 / direction.sum(), 1, 1)
        shades, counts = np.unique(pixels[opaque][:, 0], return_counts=True)
        self.assertEqual((counts > 300).sum(), 3)
        self.assertTrue((pixels[[0, 0, -1, -1], [0, -1, 0, -1], 3] == 0).all())

    def test_what_is_in_front_hides_what_is_behind(self):
        # Two squares, one above the other, seen from above: as two meshes they differ, as one the upper is seen.
        square = [(0, 0), (1, 0), (1, 1), (0, 1)]

        def obj(name, *heights):
            lines = [f"v {x} {y} {z + 0.2 * x * tilt}" for z, tilt in heights for x, y in square]
            for k in range(len(heights)):
                lines += [f"f {4 * k + 1} {4 * k + 2} {4 * k + 3}", f"f {4 * k + 1} {4 * k + 3} {4 * k + 4}"]
            (self.folder / name).write_text("\n".join(lines) + "\n")

        obj("both.obj", (0.0, 0), (0.1, 5))
        obj("reversed.obj", (0.1, 5), (0.0, 0))
        np.testing.assert_array_equal(self.picture("both.obj", "a.png"), self.picture("reversed.obj", "b.png"))

    def test_what_cannot_be_drawn_leaves_no_file(self):
        (self.folder / "bad.obj").write_text("f 1 2 3\n")
        run = self.run_program("bad.obj", "bad.png")
        self.assertEqual(run.returncode, 1)
        self.assertIn("bad.obj", run.stderr)
        self.assertEqual(self.run_program("bad.obj", "bad.png", "--size", "9").returncode, 2)
        self.assertFalse((self.folder / "bad.png").exists())


if __name__ == "__main__":
    unittest.main()
