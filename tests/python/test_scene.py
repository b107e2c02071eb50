import base64
import json
import os
import re

import numpy as np
import pytest

import elastolab as el
from conftest import cube_scene, table


@pytest.mark.parametrize("keys", [("material", "young_modulus"), ("handles", 0, "translate", 1)])
def test_a_number_that_is_not_finite_is_named_by_its_path(keys):
    data = cube_scene("fem")
    inner = data
    for key in keys[:-1]:
        inner = inner[key]
    inner[keys[-1]] = float("inf")
    with pytest.raises(el.SceneError, match="data: /" + "/".join(map(str, keys)) + ": must be a finite number"):
        el.Scene(data)


def test_a_scene_is_read_changed_solved_and_written(tmp_path, program):
    (tmp_path / "in.json").write_text(json.dumps(cube_scene("fem")))
    scene = el.Scene.load(tmp_path / "in.json")
    scene.data["method"] = "galerkin-bem"
    scene.data["handles"][0]["translate"] = [0, 0.2, 0]
    scene.save(tmp_path / "out.json")
    assert el.Scene.load(tmp_path / "out.json") == scene
    solution = scene.solve()
    folder = program(scene.data)
    expected, _ = table(folder / "u.csv")
    report = json.loads((folder / "r.json").read_text())
    np.testing.assert_allclose(solution.displacement, expected[:, 3:], atol=1e-9)
    assert solution.error_estimate == pytest.approx(report["error_estimate"]["displacement"], rel=1e-6)
    assert solution.residual < 1e-8 and solution.warnings == report["warnings"]
    forces, names = table(folder / "f.csv")
    assert [r.name for r in solution.reactions] == names
    for reaction, row in zip(solution.reactions, forces):
        np.testing.assert_allclose(np.r_[reaction.force, reaction.moment], row, atol=1e-7 * abs(forces).max())


def test_choices_that_mean_nothing_to_a_method_are_told():
    solution = el.Scene(cube_scene("fem")).solve(rims=1, tractions="restricted")
    assert [w for w in solution.warnings if w.endswith("and was ignored.")] == [
        "tractions: applies to linear-bem only, and was ignored.",
        "rims: applies to galerkin-bem only, and was ignored."]
    with pytest.warns(UserWarning, match="elements: applies to nonlinear-fem only"):
        el.precompute(el.Surface.primitive("cube", 2), method="fem", elements="linear")


def test_a_mesh_keeps_its_file_when_a_scene_moves_to_another_folder(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    el.Surface.primitive("cube", 3).save(tmp_path / "a" / "cube.obj")
    data = {**cube_scene("fem"), "mesh": {"file": "cube.obj"}}
    scene = el.Scene(data, file=tmp_path / "a" / "scene.json")
    scene.save(tmp_path / "b" / "scene.json")
    moved = el.Scene.load(tmp_path / "b" / "scene.json")
    assert moved.data["mesh"]["file"] == os.path.join("..", "a", "cube.obj")
    np.testing.assert_array_equal(moved.solve().displacement, scene.solve().displacement)


def test_a_proxy_stands_for_an_open_surface(tmp_path):
    cube = el.Surface.primitive("cube", 5)
    inside_the_top = np.flatnonzero((cube.vertices[cube.triangles].min(1) > [0.3, 0.3, 0.9]).all(1))
    el.Surface(cube.vertices, np.delete(cube.triangles, inside_the_top[:1], 0)).save(tmp_path / "open.obj")
    scene = el.Scene({**cube_scene("linear-bem"), "mesh": {"file": "open.obj"}}, file=tmp_path / "scene.json")
    solution = scene.solve()
    assert solution.proxy is not None and solution.displacement.shape == (cube.n_vertices, 3)
    assert set(solution.fields()) == {"displacement", "von_mises", "traction", "stress"}
    scene.data["proxy"] = {"use": "never"}
    with pytest.raises(el.MeshError, match="open.obj: "):
        scene.solve()


def test_outputs_are_written_by_the_ending_of_their_name(tmp_path):
    solution = el.Scene(cube_scene("quadratic-fem", 2)).solve(checks=False)
    for name in ("a.obj", "a.ply", "a.stl", "a.vtp", "a.vtu", "a.csv"):
        solution.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 500
    deformed = el.Surface.load(tmp_path / "a.obj")
    np.testing.assert_allclose(deformed.vertices, solution.vertices + solution.displacement, atol=1e-15)
    with pytest.raises(el.Error, match="a.xyz"):
        solution.save(tmp_path / "a.xyz")


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"method": "x"}, "/method"),
        ({"surprise": 1}, "surprise"),
        ({"material": {"young_modulus": 0, "poisson_ratio": 0.3}}, "/material/young_modulus"),
        ({"handles": [{"select": {"vertices": [999]}, "translate": [0, 0, 0]}]}, "/handles/0/select"),
    ],
)
def test_a_wrong_scene_is_refused_with_the_place(change, text):
    with pytest.raises(el.SceneError, match=text):
        el.Scene({**cube_scene(), **change}).solve()


def test_data_that_are_no_json_are_a_type_error():
    scene = el.Scene(cube_scene())
    scene.data["method"] = object()
    with pytest.raises(TypeError, match="data: is no scene"):
        scene.text
    scene.data = scene.data["handles"]
    scene.data.append(scene.data)
    with pytest.raises(TypeError, match="data: is no scene"):
        scene.solve()


def test_the_viewer_gives_back_the_scene_as_it_was_left(monkeypatch):
    monkeypatch.setenv("ELASTOLAB_VIEW_ARGUMENTS", "--hidden --frames 3 --method fem")
    left = el.show(el.Scene(cube_scene("linear-bem", 3)))
    assert left.data["method"] == "fem" and left.data["mesh"] == {"primitive": "cube", "resolution": 3}
    monkeypatch.setenv("ELASTOLAB_VIEW_ARGUMENTS", "--no-such-option")
    with pytest.raises(el.Error, match="no-such-option"):
        el.show(el.Scene(cube_scene()))


def figure_of(page):
    """What a figure for browsers holds: columns of displacement and stress, as its script reads them."""
    data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S).group(1))

    def reals(text, *shape):
        return np.frombuffer(base64.b64decode(text), np.float32).reshape(*shape)

    handle = data["handles"][0]
    return (reals(data["displacement"], -1, 3), reals(data["stress"], -1, 6), reals(handle["displacement"], 6, -1, 3),
            reals(handle["stress"], 6, -1, 6))


@pytest.mark.parametrize("method", ["fem", "linear-bem"])
def test_a_figure_of_a_loaded_body_is_right_when_its_handle_is_pulled(tmp_path, method):
    data = {**cube_scene(method, 3), "gravity": [0, 0, -9.81], "density": 3.0}
    el.Scene(data).solve(checks=False).save(tmp_path / "figure.html")
    u, stress, columns, stress_columns = figure_of((tmp_path / "figure.html").read_text())
    data["handles"][0]["translate"] = [0.3, -0.1, 0.05]
    pulled = el.Scene(data).solve(checks=False)
    np.testing.assert_allclose(u + 0.2 * columns[0] - 0.1 * columns[1], pulled.displacement, atol=1e-6)
    expected = pulled.fields()["stress"]
    np.testing.assert_allclose(stress + 0.2 * stress_columns[0] - 0.1 * stress_columns[1], expected,
                               atol=1e-5 * abs(expected).max())


def test_facts_of_an_equilibrium_are_those_of_nonlinear_fem():
    large, small = (el.Scene(cube_scene(method, 2)).solve(checks=False) for method in ("nonlinear-fem", "fem"))
    assert large.iterations > 0 and large.energy > 0 and large.largest_stretch > 1
    assert small.iterations is None and small.energy is None and small.largest_stretch is None


def test_numbers_of_numpy_are_numbers_of_scenes():
    data = cube_scene("fem", 2)
    data["handles"][0]["select"] = {"vertices": np.array([26, 25])}
    data["material"]["young_modulus"] = np.float32(2.0)
    data["handles"][0]["translate"] = np.array([0.1, 0.0, 0.0])
    scene = el.Scene(data)
    assert scene.data["handles"][0]["select"]["vertices"] == [26, 25]
    assert el.Surface.primitive("cube", 2).select({"vertices": [np.int64(3)]}).tolist() == [3]
    data["handles"][0]["translate"] = np.array([np.nan, 0.0, 0.0])
    with pytest.raises(el.SceneError, match="/handles/0/translate/0: must be a finite number"):
        el.Scene(data)


def test_a_solution_says_what_it_can_be_saved_as(tmp_path):
    with pytest.raises(el.Error, match=".vtp, .vtu, .csv, .html or .glb"):
        el.Scene(cube_scene("fem", 2)).solve(checks=False).save(tmp_path / "body.xyz")


def test_a_figure_needs_a_linear_method_and_a_handle(tmp_path):
    with pytest.raises(el.Error, match="a figure needs a linear method"):
        el.Scene(cube_scene("nonlinear-fem", 2)).solve(checks=False).save(tmp_path / "figure.html")
    alone = {**cube_scene("fem", 2), "handles": []}
    with pytest.raises(el.Error, match="there is no handle to pull"):
        el.Scene(alone).solve(checks=False).save(tmp_path / "figure.html")
    assert not (tmp_path / "figure.html").exists()
