"""Calls with odd arguments: an answer or an exception, never a crash. The calls are the same each time."""

import inspect
import os
import random

import numpy as np

import elastolab as el

N_CALLS = int(os.environ.get("ELASTOLAB_ODD_CALLS", "4000"))


class Lying:
    def __len__(self):
        return -1

    def __getitem__(self, i):
        raise RuntimeError("no item")

    def __array__(self, *_):
        return "no array"

    def __index__(self):
        raise OverflowError("no index")

    def __fspath__(self):
        return 7

    def __call__(self, *_):
        raise LookupError("no call")


def odd_things(rng):
    """Something that some argument may be, or may not."""
    n = rng.choice([0, 1, 2, 3, 8, 26, 27, 56])
    reals = np.random.default_rng(rng.getrandbits(32))
    cyclic = []
    cyclic.append(cyclic)
    return rng.choice([
        lambda: None, lambda: True, lambda: 0, lambda: -1, lambda: 2**31, lambda: 2**63, lambda: 10**400, lambda: 1e308,
        lambda: float("nan"), lambda: float("inf"), lambda: 0.3, lambda: 1j, lambda: "", lambda: "fem", lambda: "full",
        lambda: "\0", lambda: "\ud800", lambda: b"bytes", lambda: "cube", lambda: [], lambda: [[]], lambda: {}, lambda: set(),
        lambda: [1, [2]], lambda: object(), lambda: Lying(), lambda: cyclic, lambda: range(n), lambda: rng.sample(range(56), n),
        lambda: reals.normal(size=(n, 3)), lambda: reals.normal(size=3), lambda: reals.normal(size=n),
        lambda: reals.normal(size=(2, n, 3)), lambda: reals.normal(size=(n, 3)).astype(np.float16),
        lambda: np.full((n, 3), np.nan), lambda: np.zeros((n, 3), complex), lambda: np.zeros((n, 3), object),
        lambda: reals.integers(-1, 60, (n, 3)), lambda: reals.integers(0, 8, (n, 3)).astype(np.uint8),
        lambda: np.zeros((n, 0)), lambda: np.zeros((0, n, 3)), lambda: np.asfortranarray(np.zeros((n, 3))),
        lambda: np.lib.stride_tricks.as_strided(np.zeros(3), (n, 3), (0, 8)), lambda: np.array(7), lambda: np.zeros((56, 3)),
        lambda: np.array([2**64 - 1, 0, 1], np.uint64), lambda: np.array(["1", "2", "3"]), lambda: np.zeros(3, "M8[s]"),
        lambda: {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}}, lambda: {"sphere": Lying()}, lambda: {1: 2},
        lambda: print, lambda: lambda *_: None, lambda: el.Material(3.0, 0.2), lambda: el.Surface, lambda: "/dev/null/x.obj",
    ])()


def subjects():
    """Everything that can be called, by what it is called on."""
    cube = el.Surface.primitive("cube", 3)
    model = el.precompute(cube, method="fem")
    body = model.constrain(fixed=[0, 1, 2, 3], handles=[20, 21])
    response = body.drag_response([0, 0, 0], np.ones((3, 2, 3)))
    scene = el.Scene({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 2}, "method": "fem",
                      "material": {"young_modulus": 1.0, "poisson_ratio": 0.3}, "handles": []})
    objects = [cube, model, body, response, scene, el.Proxy(cube, 50)]
    calls = [getattr(o, name) for o in objects for name in dir(o) if not name.startswith("_")]
    makers = [el.Surface, el.Surface.primitive, el.Surface.load, el.Material, el.Scene, el.Scene.parse, el.Scene.load,
              el.precompute, el.predict, el.solve, el.Deformer, el.Model, el.DragResponse, el.set_threads]
    return [call for call in calls if callable(call)] + makers


WORDS = ["vertices", "triangles", "values", "out", "handles", "fixed", "method", "mode", "update", "progress", "points",
         "basis", "parameters", "material", "size", "name", "file", "selector", "deformed", "checks", "fill"]


def test_odd_calls_raise_and_nothing_else(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rng = random.Random(20)
    calls, n_answers = subjects(), 0
    threads = el.thread_count()
    assert len(calls) > 30
    for _ in range(N_CALLS):
        call = rng.choice(calls)
        arguments = [odd_things(rng) for _ in range(rng.choice([0, 1, 1, 2, 2, 3]))]
        words = {word: odd_things(rng) for word in rng.sample(WORDS, rng.choice([0, 0, 0, 1, 2]))}
        try:
            call(*arguments, **words)
            n_answers += 1
        except (ValueError, TypeError, LookupError, OverflowError, RuntimeError, OSError, MemoryError, AttributeError):
            pass
        assert not inspect.isabstract(type(call))
    el.set_threads(threads)
    assert n_answers > N_CALLS / 100, "some calls have a meaning"
    cube = el.Surface.primitive("cube", 3)
    assert np.isfinite(el.precompute(cube, method="fem").constrain([0, 1, 2], [9]).displace([0.1, 0, 0])).all()
