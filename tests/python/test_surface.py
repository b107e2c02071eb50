import numpy as np
import pytest

import elastolab as el


def test_a_primitive_is_sound_and_its_arrays_cannot_be_written():
    cube = el.Surface.primitive("cube", 3)
    assert (cube.n_vertices, cube.n_triangles) == (56, 108) == (len(cube.vertices), len(cube.triangles))
    assert cube.report.usable_for_fem and cube.report.closed and cube.report.n_solids == 1
    assert cube.report.volume == pytest.approx(1.0, abs=1e-14)
    for array in (cube.vertices, cube.triangles):
        with pytest.raises(ValueError):
            array[0, 0] = 1
    vertices = cube.vertices
    del cube
    assert vertices.min() == 0.0 and vertices.max() == 1.0


def test_triangles_that_face_the_wrong_way_are_turned_and_reported():
    cube = el.Surface.primitive("cube", 2)
    corners = np.array(cube.triangles)
    corners[3] = corners[3, ::-1]
    repaired = el.Surface(cube.vertices, corners, name="mine")
    assert [d.kind for d in repaired.report.defects] == ["inconsistent-orientation"]
    assert repaired.report.defects[0].repaired and repaired.report.usable
    assert repaired.report.volume == pytest.approx(1.0, abs=1e-14)
    assert "mine" in repr(repaired)


def test_an_open_surface_is_reported_refused_and_simulated_by_a_proxy():
    cube = el.Surface.primitive("cube", 3)
    hole = el.Surface(cube.vertices, cube.triangles[1:], name="open")
    (defect,) = (d for d in hole.report.defects if d.fatal)
    assert defect.kind == "open-edges" and defect.count == 3 and defect.places.shape == (3, 3)
    with pytest.raises(el.MeshError, match="open: 3 open edges"):
        el.precompute(hole)
    filled = el.Proxy(hole, fill=True)
    assert filled.surface.report.usable_for_fem and filled.distance.max() == 0.0
    wrapped = el.Proxy(hole, 200)
    assert wrapped.surface.report.usable_for_fem and wrapped.distance.max() < wrapped.edge
    linear = wrapped.surface.vertices @ [1.0, 2.0, 3.0]
    np.testing.assert_allclose(wrapped.carry(linear), hole.vertices @ [1.0, 2.0, 3.0], atol=3 * wrapped.distance.max() + 1e-12)


def test_a_file_is_read_and_written_with_all_digits(tmp_path):
    sphere = el.Surface.primitive("sphere", 3, [0.3])
    sphere.save(tmp_path / "s.obj")
    again = el.Surface.load(tmp_path / "s.obj")
    np.testing.assert_array_equal(again.vertices, sphere.vertices)
    np.testing.assert_array_equal(again.triangles, sphere.triangles)
    with pytest.raises(el.MeshError, match="none.obj"):
        el.Surface.load(tmp_path / "none.obj")


def test_selectors_are_those_of_scene_files():
    cube = el.Surface.primitive("cube", 3)
    left = cube.select({"box": {"min": [0, 0, 0], "max": [0, 1, 1]}})
    np.testing.assert_array_equal(left, np.flatnonzero(cube.vertices[:, 0] == 0))
    corner = cube.select([{"vertices": [7]}, {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}}])
    np.testing.assert_array_equal(np.unique(corner), np.union1d(left, [7]))
    with pytest.raises(el.SceneError, match="select"):
        cube.select([{"select": {"vertices": [7]}}])
    with pytest.raises(el.SceneError, match="radius"):
        cube.select({"sphere": {"center": [0, 0, 0], "radius": "large"}})
    with pytest.raises(el.SceneError, match="cube: selector"):
        cube.select({"sphere": {"center": [9, 9, 9], "radius": 0.1}})


@pytest.mark.parametrize(
    ("vertices", "triangles", "error", "text"),
    [
        ([[0, 0, float("nan")]], [], ValueError, "vertices: number 2 is not finite. Give finite numbers."),
        ([[0, 0]], [], ValueError, r"vertices: has the shape \(1, 2\). Give \(n, 3\)."),
        (["a"], [], TypeError, "vertices: has elements of type <U1. Give real numbers."),
        ([[0, 0, 0]], [[0, 0, 1]], ValueError, "triangles: vertex 1 does not exist; the surface has 1."),
        ([[0, 0, 0]], [[0.5, 0, 0]], TypeError, "triangles: has elements of type float64. Give whole numbers."),
        ([[0, 0, 0]], [[-1, 0, 0]], ValueError, "triangles: vertex -1 does not exist"),
    ],
)
def test_wrong_arrays_are_named(vertices, triangles, error, text):
    with pytest.raises(error, match=text):
        el.Surface(vertices, triangles)
