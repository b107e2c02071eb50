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

    def test_the_program_reads_its_own_file(self):
        self.solve(scene([0.05, 0, 0]), "--mesh-out", "cube.glb")
        run = subprocess.run([PROGRAM, "info", "--json", "cube.glb"], cwd=self.folder, capture_output=True, check=True)
        facts = json.loads(run.stdout)
        self.assertEqual((facts["vertices"], facts["faces"]), (56, 108))


if __name__ == "__main__":
    unittest.main()
