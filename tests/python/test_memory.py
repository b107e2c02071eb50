"""Nothing is left behind by precomputations, answers and failures."""

import gc
import os

import numpy as np

import elastolab as el

N = int(os.environ.get("ELASTOLAB_LEAK_ROUNDS", "150"))


def resident():
    gc.collect()
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def one_round(method):
    cube = el.Surface.primitive("cube", 2)
    body = el.precompute(cube, method=method).constrain(fixed=[0, 1, 2, 3], handles=[20, 21])
    body.displace([0.1, 0, 0])
    body.drag_response([0, 0, 0], np.ones((2, 2, 3))).displace([0.1, 0.2])
    body.reactions([0.1, 0, 0])
    for wrong in ([np.nan] * 3, "x", np.ones((5, 3))):
        try:
            body.displace(wrong)
        except (ValueError, TypeError):
            pass


def test_memory_does_not_grow():
    for method in ("fem", "linear-bem"):
        for _ in range(N // 3):
            one_round(method)
        before = resident()
        for _ in range(N):
            one_round(method)
        grown = resident() - before
        # A round has some 200 kB of arrays; what the allocator keeps for later does not depend on the rounds.
        assert grown < 20_000 * N / 10 + 4e6, f"{method}: {grown / N:.0f} bytes a round"
