"""glTF with morph targets, read back as its specification says: glb_files_test.py PROGRAM [unittest's arguments]."""

import json
import struct
import subprocess
import unittest

import numpy as np

from program_case import PROGRAM, ProgramCase, plane

ACCURACY = 1e-6  # relative: single precision


def scene(translate):
    return {"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 3}, "method": "galerkin-bem", "fixed": plane(0),
            "material": {"young_modulus": 1000.0, "poisson_ratio": 0.3},
            "handles": [{"name": "right", "select": plane(1), "translate": translate}]}


def read_glb(file):
    """The JSON of the file, and its accessors as arrays."""
    data = file.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    chunks, at = [], 12
    while at < length:
        size, kind = struct.unpack_from("<I4s", data, at)
        assert size % 4 == 0
        chunks.append((kind, data[at + 8:at + 8 + size]))
        at += 8 + size
    (json_kind, text), (binary_kind, binary) = chunks
    assert (json_kind, binary_kind) == (b"JSON", b"BIN\0")
    root = json.loads(text)
    assert root["buffers"] == [{"byteLength": len(binary)}]
    arrays = []
    for accessor in root["accessors"]:
        view = root["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
        width = {"VEC3": 3, "SCALAR": 1}[accessor["type"]]
        values = np.frombuffer(binary, kind, width * accessor["count"], view["byteOffset"]).reshape(-1, width)
        assert values.nbytes == view["byteLength"] and view["byteOffset"] % 4 == 0
        if "min" in accessor:
            np.testing.assert_array_equal(values.min(0), np.float32(accessor["min"]))
            np.testing.assert_array_equal(values.max(0), np.float32(accessor["max"]))
        arrays.append(values)
    return root, arrays


class Glb(ProgramCase):
    def test_weighted_targets_are_what_solve_says(self):
        self.solve(scene([0.05, 0, 0]), "--mesh-out", "cube.glb")
        root, arrays = read_glb(self.folder / "cube.glb")
        (mesh,) = root["meshes"]
        (primitive,) = mesh["primitives"]
        names = mesh["extras"]["targetNames"]
        self.assertEqual(names[:2] + names[-1:], ["scene", "right shift x", "right turn z"])
        self.assertEqual(mesh["weights"], [1.0] + [0.0] * 6)
        targets = [arrays[target["POSITION"]] for target in primitive["targets"]]
        rest = arrays[primitive["attributes"]["POSITION"]]
        self.solve(scene([0.15, -0.2, 0.1]), "--displacements", "u.csv")
        start, moved = self.columns("u.csv", "x", "z"), self.columns("u.csv", "ux", "uz")
        np.testing.assert_allclose(rest, start, atol=ACCURACY)
        pulled = targets[0] + 0.1 * targets[1] - 0.2 * targets[2] + 0.1 * targets[3]
        np.testing.assert_allclose(pulled, moved, atol=ACCURACY)
        right = rest[:, 0] == 1
        np.testing.assert_allclose(targets[6][right], np.cross([0, 0, 1], (rest - [1, 0.5, 0.5])[right]), atol=ACCURACY)
        corners = arrays[primitive["indices"]].reshape(-1, 3)
        volume = np.linalg.det(rest[corners].astype(float)).sum() / 6
        self.assertAlmostEqual(volume, 1.0, 6)

    def place(self, file):
        """Positions at rest as a program that shows the file has them, and their targets, turned likewise."""
        root, arrays = read_glb(self.folder / file)
        (node,) = root["nodes"]
        x, y, z, w = node["rotation"]
        turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        (primitive,) = root["meshes"][0]["primitives"]
        rest = arrays[primitive["attributes"]["POSITION"]].astype(float)
        targets = [arrays[target["POSITION"]] @ turn.T for target in primitive["targets"]]
        return rest @ turn.T + node["translation"], targets, root["meshes"][0]["extras"]["targetNames"]

    def test_the_axis_of_the_scene_points_up(self):
        for axis, vertical in enumerate(np.eye(3)):
            description = scene([0.05, 0, 0])
            description["camera"] = {"eye": [5, 4, 3], "target": [0.5, 0.5, 0.5], "up": vertical.tolist(),
                                     "vertical": vertical.tolist()}
            self.solve(description, "--mesh-out", "cube.glb", "--displacements", "u.csv")
            shown, targets, _ = self.place("cube.glb")
            np.testing.assert_allclose(shown[:, 1], self.columns("u.csv", "x", "z")[:, axis], atol=ACCURACY)
            np.testing.assert_allclose(targets[0][:, 1], self.columns("u.csv", "ux", "uz")[:, axis], atol=ACCURACY)

    def test_a_body_far_from_the_origin_keeps_its_shape(self):
        far = np.array([1e7, -2e7, 3e6])
        self.solve(scene([0.05, 0, 0]), "--mesh-out", "cube.obj")
        lines = (self.folder / "cube.obj").read_text().splitlines()
        rest = np.array([[float(x) for x in line.split()[1:]] for line in lines if line.startswith("v ")]) + far
        faces = [line for line in lines if line.startswith("f ")]
        (self.folder / "far.obj").write_text("\n".join(["v %.17g %.17g %.17g" % tuple(v) for v in rest] + faces))
        description = scene([0.05, 0, 0])
        description.update(mesh={"file": "far.obj"}, fixed=plane(far[0]))
        description["handles"][0]["select"] = {"plane": {"point": [far[0] + 1.05, 0, 0], "normal": [1, 0, 0],
                                                         "tolerance": 1e-3}}
        self.solve(description, "--mesh-out", "far.glb")
        shown, targets, _ = self.place("far.glb")
        upright = np.column_stack([rest[:, 0], rest[:, 2], -rest[:, 1]])
        np.testing.assert_allclose(shown, upright, atol=1e-6, rtol=1e-14)
        self.assertEqual(len(np.unique(read_glb(self.folder / "far.glb")[1][0], axis=0)), len(rest))

    def test_of_a_proxy_the_vertices_are_those_of_the_file(self):
        """A sheet, which is simulated as a thin body around it."""
        points = [[i / 8, j / 8, 0] for j in range(9) for i in range(9)]
        faces = [f"f {a} {b} {c}" for j in range(8) for i in range(8)
                 for a, b, c in [(9 * j + i + 1, 9 * j + i + 2, 9 * j + i + 11), (9 * j + i + 1, 9 * j + i + 11, 9 * j + i + 10)]]
        (self.folder / "sheet.obj").write_text("\n".join(["v %g %g %g" % tuple(p) for p in points] + faces))
        description = scene([0, 0, 0.2])
        description.update(mesh={"file": "sheet.obj"}, method="fem")
        self.solve(description, "--mesh-out", "sheet.glb", "--displacements", "u.csv")
        rest, targets, names = self.place("sheet.glb")
        u = self.columns("u.csv", "ux", "uz")
        self.assertEqual(len(rest), 81)
        np.testing.assert_allclose(targets[0][:, 1], u[:, 2], atol=ACCURACY)
        lifted = targets[names.index("right shift z")][:, 1]
        np.testing.assert_allclose(0.2 * lifted, u[:, 2], atol=0.01)

    def test_the_program_reads_its_own_file(self):
        self.solve(scene([0.05, 0, 0]), "--mesh-out", "cube.glb")
        run = subprocess.run([PROGRAM, "info", "--json", "cube.glb"], cwd=self.folder, capture_output=True, check=True)
        facts = json.loads(run.stdout)
        self.assertEqual((facts["vertices"], facts["faces"]), (56, 108))


if __name__ == "__main__":
    unittest.main()
