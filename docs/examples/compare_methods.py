"""The paper's comparison in thirty lines: what each method takes to precompute and to update, and how well they agree.

    python3 compare_methods.py [PICTURE.png]
"""

import sys
import time

import numpy as np

import elastolab as el

MOTION = [0.1, 0.0, 0.05]


def seconds(work):
    begin = time.perf_counter()
    result = work()
    return time.perf_counter() - begin, result


def compare(resolution=8):
    """For each method: seconds to precompute, to take a new constrained set and to update, and its displacements."""
    cube = el.Surface.primitive("cube", resolution)
    x = cube.vertices[:, 0]
    fixed, pulled = np.flatnonzero(x == 0), np.flatnonzero(x == 1)
    rows = {}
    for method in ("fem", "quadratic-fem", "constant-bem", "linear-bem", "galerkin-bem"):
        ahead, model = seconds(lambda: el.precompute(cube, el.Material(1e5, 0.3), method=method))
        constrained, body = seconds(lambda: model.constrain(fixed, pulled))
        update, u = seconds(lambda: body.displace(MOTION))
        rows[method] = (ahead, constrained, update, u)
    return rows


def main():
    rows = compare()
    best = rows["quadratic-fem"][3]
    for method, (ahead, constrained, update, u) in rows.items():
        away = np.linalg.norm(u - best) / np.linalg.norm(best)
        print(f"{method:14} {1e3 * ahead:8.1f} ms {1e3 * constrained:8.1f} ms {1e3 * update:8.3f} ms   {100 * away:.2f} % away")
    if len(sys.argv) > 1:
        import matplotlib

        matplotlib.use("svg" if sys.argv[1].endswith(".svg") else "agg")
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(figsize=(7, 3.5), layout="constrained")
        for k, label in enumerate(("precompute", "constrained set", "update")):
            axes.bar(np.arange(len(rows)) + 0.25 * k, [row[k] for row in rows.values()], 0.25, label=label)
        axes.set(yscale="log", ylabel="seconds", xticks=np.arange(len(rows)) + 0.25, xticklabels=list(rows))
        axes.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1))
        figure.savefig(sys.argv[1])


if __name__ == "__main__":
    main()
