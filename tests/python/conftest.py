import csv
import json
import os
import subprocess

import numpy as np
import pytest

PROGRAM = os.environ["ELASTOLAB_PROGRAM"]

LEFT = {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-6}}
RIGHT = {"plane": {"point": [1, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-6}}

TOP = {"plane": {"point": [0, 0, 1], "normal": [0, 0, 1], "tolerance": 1e-6}}


def cube_scene(method="linear-bem", resolution=4):
    """A unit cube, its left face fixed, its right face moved by (0.1, 0, 0.05)."""
    return {
        "elastolab": 1,
        "mesh": {"primitive": "cube", "resolution": resolution},
        "material": {"young_modulus": 1000.0, "poisson_ratio": 0.3},
        "method": method,
        "fixed": LEFT,
        "handles": [{"name": "right", "select": RIGHT, "translate": [0.1, 0, 0.05]}],
    }


def table(file):
    """A CSV file: its numbers, without the first column, and that column."""
    with open(file, encoding="utf-8") as text:
        rows = list(csv.reader(text))[1:]
    return np.array([[float(x) for x in row[1:]] for row in rows]), [row[0] for row in rows]


@pytest.fixture
def program(tmp_path):
    """Runs `elastolab solve` on a scene: the folder with u.csv, f.csv and r.json."""

    def run(scene, *options):
        (tmp_path / "scene.json").write_text(json.dumps(scene))
        outputs = ["--displacements", "u.csv", "--forces", "f.csv", "--report", "r.json"]
        subprocess.run([PROGRAM, "solve", "scene.json", "--quiet", *outputs, *options], cwd=tmp_path, check=True)
        return tmp_path

    return run
