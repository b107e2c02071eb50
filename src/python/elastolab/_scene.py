"""Scenes as the program's files have them."""

import copy
import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile

from elastolab import _core  # type: ignore[attr-defined]  # compiled


class Scene:
    """A scene as a scene file says it: `data` is a dict with the keys of docs/reference.md, to be read and changed.

    data  such a dict, copied; a wrong one raises SceneError, naming the JSON path
    file  where the scene is from: relative names of meshes start at its folder
    """

    def __init__(self, data, *, file="scene.json"):
        self.file = pathlib.Path(file)
        self.data = json.loads(_core._normal_text(_text(data), str(self.file)))

    @classmethod
    def load(cls, file):
        """Reads a scene file."""
        file = pathlib.Path(file)
        try:
            text = file.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise _core.SceneError(f"{file}: cannot be read ({_reason(error)}). Check the name.") from None
        return cls._of_text(text, file)

    @classmethod
    def parse(cls, text, *, file="scene.json"):
        """A scene from the text of a scene file."""
        return cls._of_text(text, pathlib.Path(file))

    @classmethod
    def _of_text(cls, text, file):
        scene = cls.__new__(cls)
        scene.file = file
        scene.data = json.loads(_core._normal_text(text, str(file)))
        return scene

    @property
    def text(self):
        """The text of its scene file. Raises SceneError where `data` are no scene."""
        return _core._normal_text(_text(self.data), str(self.file))

    def save(self, file):
        """Writes a scene file; relative names of meshes go on to mean the same files."""
        data, file = copy.deepcopy(self.data), pathlib.Path(file)
        name = _mesh_file(data)
        if name is not None and not os.path.isabs(name):
            where = (self.file.parent / name).resolve()
            data["mesh"]["file"] = os.path.relpath(where, file.parent.resolve())
        _core._save_text(_text(data), str(file), file)

    def solve(self, *, method="", mode="", tractions="", update="", elements="", rims=0, checks=True, progress=None):
        """Solves it, as `elastolab solve` does: a Solution. Words that are left empty are the scene's or the program's.

        checks    residual, error estimates and the error of linear theory: up to some times the solve, of small bodies
                  some tenths of a second
        progress  called with a stage and a fraction; what it raises ends the computation
        """
        return _core._solve_text(_text(self.data), self.file, method, mode, tractions, update, elements, rims, checks,
                                 progress)

    def __eq__(self, other):
        return isinstance(other, Scene) and self.data == other.data

    __hash__ = None  # type: ignore[assignment]  # data may change

    def __repr__(self):
        return f"<elastolab.Scene {self.data.get('mesh') if isinstance(self.data, dict) else self.data!r}>"


def solve(scene, *, method="", mode="", tractions="", update="", elements="", rims=0, checks=True, progress=None):
    """Solves a Scene, or a scene file: a Solution. See Scene.solve."""
    scene = scene if isinstance(scene, Scene) else Scene.load(scene)
    return scene.solve(method=method, mode=mode, tractions=tractions, update=update, elements=elements, rims=rims,
                       checks=checks, progress=progress)


def show(scene):
    """Opens the viewer on a Scene, or a scene file, waits until it is closed, and gives the scene back as it was left."""
    scene = scene if isinstance(scene, Scene) else Scene.load(scene)
    with tempfile.TemporaryDirectory(prefix="elastolab-") as folder:
        before, after = pathlib.Path(folder, "scene.json"), pathlib.Path(folder, "left.json")
        scene.save(before)
        command = [str(_program()), "view", str(before), "--scene-out", str(after), *_extra_arguments()]
        run = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
        if run.returncode != 0 or not after.exists():
            raise _core.Error(run.stderr.strip() or "elastolab view: it ended without a scene. Try it in a terminal.")
        left = Scene.load(after)
    name = _mesh_file(left.data)
    if name is not None:
        left.data["mesh"]["file"] = str((after.parent / name).resolve())
    left.file = scene.file
    return left


def _extra_arguments():
    """For tests, which close the window by themselves."""
    return os.environ.get("ELASTOLAB_VIEW_ARGUMENTS", "").split()


def _program():
    """The program: $ELASTOLAB_PROGRAM, the one of the build that this module belongs to, or the one on the path."""
    named = os.environ.get("ELASTOLAB_PROGRAM")
    if named:
        return named
    of_build = pathlib.Path(_core.__file__).resolve().parents[2] / "bin" / "elastolab"
    if of_build.exists():
        return of_build
    found = shutil.which("elastolab")
    if found is None:
        raise _core.Error("elastolab: the program is not on the path. Install it, or set ELASTOLAB_PROGRAM.")
    return found


def _path_of_what_is_not_finite(data, path=""):
    """JSON path of the first number that is not finite, for which JSON has no word; None where all are."""
    if isinstance(data, float):
        return None if math.isfinite(data) else path
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, (list, tuple)) else ()
    found = (_path_of_what_is_not_finite(item, f"{path}/{key}") for key, item in items)
    return next((path for path in found if path is not None), None)


def _plain(value):
    """Numbers and arrays of NumPy as those of JSON."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is none of JSON")


def _text(data):
    try:
        text = json.dumps(data, default=_plain)
        path = _path_of_what_is_not_finite(json.loads(text)) if "NaN" in text or "Infinity" in text else None
        if path is not None:
            raise _core.SceneError(f"data: {path}: must be a finite number. Correct it.")
        return text
    except _core.SceneError:
        raise
    except (TypeError, ValueError, RecursionError) as error:
        raise TypeError(f"data: is no scene ({error}). Give dicts, lists, texts and numbers.") from None


def _mesh_file(data):
    mesh = data.get("mesh") if isinstance(data, dict) else None
    name = mesh.get("file") if isinstance(mesh, dict) else None
    return name if isinstance(name, str) else None


def _reason(error):
    return error.strerror if isinstance(error, OSError) and error.strerror else str(error)
