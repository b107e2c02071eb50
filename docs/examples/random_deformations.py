"""Random deformations of a body for learning: motions of a handle, the displacements that follow, and how far each may be
off, as .npz files of a thousand samples. Dask shares the work out: to processes on this machine, or to a cluster.

    python3 random_deformations.py FOLDER [N] [--scheduler ADDRESS]
"""

import argparse
import pathlib
import time

import numpy as np

import elastolab as el

BATCH = 1000


def columns_of(cube, method, handle, fixed):
    """Displacements of all vertices for six motions of the handle, shifts and turns: (6, n, 3)."""
    body = el.precompute(cube, method=method).constrain(fixed, handle)
    about = cube.vertices[handle] - cube.vertices[handle].mean(0)
    basis = [np.broadcast_to(axis, about.shape) for axis in np.eye(3)] + [np.cross(axis, about) for axis in np.eye(3)]
    return body.drag_response([0, 0, 0], np.array(basis)).columns


def responses(resolution=13):
    """Columns of the cube of 1016 vertices, a face fixed and the opposite one a handle; and those of a better method."""
    cube = el.Surface.primitive("cube", resolution)
    fixed, handle = (np.flatnonzero(cube.vertices[:, 0] == x) for x in (0, 1))
    return tuple(columns_of(cube, method, handle, fixed) for method in ("galerkin-bem", "quadratic-fem"))


def sample(columns, better, n, seed):
    """n motions, the displacements for each in single precision, and estimates of their relative errors.

    Answers are linear in the motion, and so are their differences to the better answers: both are sums of columns.
    """
    parameters = np.random.default_rng(seed).normal(scale=0.1, size=(n, 6))

    def largest(of):
        return np.sqrt(np.square(np.tensordot(parameters, of, 1).astype(np.float32)).sum(2).max(1))

    displacements = np.tensordot(parameters, columns, 1).astype(np.float32)
    return parameters, displacements, largest(columns - better) / largest(better)


def write(folder, columns, better, n, seed):
    """A batch as a file of its own; its name."""
    file = pathlib.Path(folder) / f"batch-{seed:05}.npz"
    parameters, displacements, estimates = sample(columns, better, n, seed)
    np.savez(file, parameters=parameters, displacements=displacements, estimates=estimates)
    return str(file)


def generate(client, folder, n, columns, better):
    """Writes n samples, in batches; the names of the files. A cluster needs a folder that all of its machines see."""
    shared = client.scatter([columns, better], broadcast=True)
    sizes = [min(BATCH, n - begin) for begin in range(0, n, BATCH)]
    return client.gather([client.submit(write, folder, *shared, size, seed) for seed, size in enumerate(sizes)])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("n", type=int, nargs="?", default=5000)
    parser.add_argument("--scheduler", help="address of a Dask cluster (default: processes on this machine)")
    options = parser.parse_args()
    from distributed import Client

    options.folder.mkdir(parents=True, exist_ok=True)
    columns, better = responses()
    with Client(options.scheduler) if options.scheduler else Client(processes=True, threads_per_worker=1) as client:
        cores, begin = sum(client.ncores().values()), time.perf_counter()
        files = generate(client, options.folder.resolve(), options.n, columns, better)
        rate = options.n / (time.perf_counter() - begin)
    print(f"{len(files)} files, {rate:.0f} samples a second, {rate / cores:.0f} on each of {cores} cores")


if __name__ == "__main__":
    main()
