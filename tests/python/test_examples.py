"""The examples of docs/examples, and the figures that they find."""

import importlib
import pathlib
import sys

import numpy as np
import pytest

import elastolab as el

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples"))


def test_methods_agree_where_they_are_compared():
    rows = importlib.import_module("compare_methods").compare(5)
    best = rows["quadratic-fem"][3]
    for method, (*_, u) in rows.items():
        limit = 0.2 if method == "constant-bem" else 0.05  # it shows a vertex at the mean of its triangles
        assert np.linalg.norm(u - best) < limit * np.linalg.norm(best), method


def test_ones_own_mesh_converges():
    found = importlib.import_module("own_mesh").errors(methods=("fem", "galerkin-bem"), sizes=(1, 2), reference=4)
    for method, (coarse, fine) in found.items():
        assert fine < 0.75 * coarse and fine < 0.1, method


def test_a_gradient_is_that_of_finite_differences_and_leads_there():
    gradients = importlib.import_module("gradients")
    cube = gradients.PulledCube(3)
    vertices = np.argsort(np.linalg.norm(cube.surface.vertices - [0.5, 0.5, 1], axis=1))[:2]
    wanted = cube.surface.vertices[vertices] + [0.05, 0, 0.02]
    at, step = np.linspace(-0.1, 0.1, 6), 1e-6
    _, gradient = cube.loss(at, vertices, wanted)
    differences = [(cube.loss(at + e, vertices, wanted)[0] - cube.loss(at - e, vertices, wanted)[0]) / (2 * step)
                   for e in step * np.eye(6)]
    np.testing.assert_allclose(gradient, differences, atol=1e-8 * np.linalg.norm(gradient) + 1e-10)
    _, losses = gradients.fit(cube, vertices, wanted)
    assert losses[-1] < 0.01 * losses[0]


def test_random_deformations_are_answers_with_their_estimates(tmp_path):
    distributed = pytest.importorskip("distributed")
    module = importlib.import_module("random_deformations")
    columns, better = module.responses(4)
    with distributed.Client(n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None) as client:
        client.upload_file(module.__file__)
        files = module.generate(client, tmp_path, 1010, columns, better)
    assert len(files) == 2
    last = np.load(files[1])
    assert last["displacements"].shape == (10, len(columns[0]), 3) and last["displacements"].dtype == np.float32
    cube = el.Surface.primitive("cube", 4)
    x = cube.vertices
    fixed, handle = np.flatnonzero(x[:, 0] == 0), np.flatnonzero(x[:, 0] == 1)
    about = x[handle] - x[handle].mean(0)
    motion = last["parameters"][3]
    values = motion[:3] + np.cross(motion[3:], about)
    u, best = (el.precompute(cube, method=m).constrain(fixed, handle).displace(values) for m in ("galerkin-bem", "quadratic-fem"))
    np.testing.assert_allclose(last["displacements"][3], u, atol=1e-6)
    estimate = np.linalg.norm(u - best, axis=1).max() / np.linalg.norm(best, axis=1).max()
    assert abs(last["estimates"][3] / estimate - 1) < 1e-4
    assert np.all(np.load(files[0])["estimates"] < 0.3)
