"""One's own mesh from an array, and how the answer converges: a bar that is pulled, in steps of refinement.

    python3 own_mesh.py [PICTURE.png]
"""

import sys

import numpy as np

import elastolab as el


def bar(n):
    """The surface of the bar 3 x 1 x 1 as arrays: 3n x n x n squares, two triangles each."""
    counts, numbers, vertices, triangles = np.array([3 * n, n, n]), {}, [], []

    def vertex(place):
        if tuple(place) not in numbers:
            numbers[tuple(place)] = len(vertices)
            vertices.append(np.array(place) / n)
        return numbers[tuple(place)]

    for axis in range(3):
        across, along = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, counts[axis]):
            for i in range(counts[across]):
                for j in range(counts[along]):
                    corners = np.zeros((4, 3), int)
                    corners[:, axis] = end
                    corners[:, across] = i + np.array([0, 1, 1, 0])
                    corners[:, along] = j + np.array([0, 0, 1, 1])
                    a, b, c, d = (vertex(corner) for corner in (corners if end else corners[::-1]))
                    triangles += [(a, b, c), (a, c, d)]
    return np.array(vertices), np.array(triangles)


def force(n, method):
    """Force that stretches the bar, its ends clamped, by a tenth of its length."""
    surface = el.Surface(*bar(n), name="bar")
    assert surface.report.usable_for_fem and abs(surface.report.volume - 3) < 1e-12
    x = surface.vertices[:, 0]
    body = el.precompute(surface, el.Material(1.0, 0.3), method=method).constrain(np.flatnonzero(x == 0), np.flatnonzero(x == 3))
    reactions = body.reactions([0.3, 0, 0])
    return reactions.forces[np.isin(reactions.vertices, body.handles), 0].sum()


def errors(methods=("fem", "linear-bem", "galerkin-bem"), sizes=(1, 2, 4), reference=8):
    """Relative errors of the force, against quadratic FEM on a fine mesh."""
    truth = force(reference, "quadratic-fem")
    return {method: [abs(force(n, method) / truth - 1) for n in sizes] for method in methods}


def main():
    sizes = (1, 2, 4)
    found = errors(sizes=sizes)
    for method, error in found.items():
        print(f"{method:14}", " ".join(f"{100 * e:7.3f} %" for e in error))
    if len(sys.argv) > 1:
        import matplotlib

        matplotlib.use("svg" if sys.argv[1].endswith(".svg") else "agg")
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
        for method, error in found.items():
            axes.loglog(1 / np.array(sizes), error, "o-", label=method)
        axes.set(xlabel="mesh size", ylabel="relative error of the force", xticks=[1 / n for n in sizes])
        axes.set_xticklabels([f"1/{n}" for n in sizes])
        axes.minorticks_off()
        axes.legend()
        figure.savefig(sys.argv[1])


if __name__ == "__main__":
    main()
