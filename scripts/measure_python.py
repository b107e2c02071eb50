#!/usr/bin/python3
"""measure_python.py: what a frame of a drag costs in Python beside the same in C++, on the cube of 1016 vertices, and how
many samples of 6-parameter motions a second a core makes of it. Needs the module on PYTHONPATH."""

import time

import numpy as np

import elastolab as el


def least_seconds(call, rounds=20, n=1000):
    """Of one call, the least of several rounds."""
    least = np.inf
    for _ in range(rounds):
        begin = time.perf_counter()
        for _ in range(n):
            call()
        least = min(least, (time.perf_counter() - begin) / n)
    return least


def main():
    el.set_threads(1)
    cube = el.Surface.primitive("cube", 13)
    x = cube.vertices
    fixed, handle = np.flatnonzero(x[:, 0] == 0), np.flatnonzero(x[:, 0] == 1)
    body = el.precompute(cube, method="fem").constrain(fixed, handle)
    about = x[handle] - x[handle].mean(0)
    motions = [np.broadcast_to(axis, about.shape) for axis in np.eye(3)] + [np.cross(axis, about) for axis in np.eye(3)]
    out = np.empty(x.shape)
    print(f"{cube.n_vertices} vertices")
    for k in (3, 6):
        response, parameters = body.drag_response([0, 0, 0], np.array(motions[:k])), np.full(k, 0.1)
        alone = response._frame_seconds()
        python = least_seconds(lambda: response.displace(parameters, out))
        print(f"{k} parameters: {1e6 * alone:.2f} us in C++, {1e6 * python:.2f} us from Python, "
              f"overhead {1e6 * (python - alone):.2f} us")


if __name__ == "__main__":
    main()
