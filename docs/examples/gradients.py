"""Gradients of a loss with respect to the motion of a handle, by the transposed columns: where to put a handle so that
a vertex comes where it is wanted.

    python3 gradients.py
"""

import numpy as np

import elastolab as el


class PulledCube:
    """A cube, one face fixed, the opposite one a handle with three parameters of shift and three of turn."""

    def __init__(self, resolution=6):
        self.surface = el.Surface.primitive("cube", resolution)
        x = self.surface.vertices
        fixed, handle = np.flatnonzero(x[:, 0] == 0), np.flatnonzero(x[:, 0] == 1)
        body = el.precompute(self.surface, method="galerkin-bem").constrain(fixed, handle)
        about = x[handle] - x[handle].mean(0)
        basis = [np.broadcast_to(axis, about.shape) for axis in np.eye(3)] + [np.cross(axis, about) for axis in np.eye(3)]
        self.response = body.drag_response([0, 0, 0], np.array(basis))

    def loss(self, parameters, vertices, wanted):
        """Half the squared distance of some vertices from where they are wanted, and its gradient."""
        away = (self.surface.vertices + self.response.displace(parameters))[vertices] - wanted
        columns = self.response.columns[:, vertices]
        return 0.5 * np.sum(away**2), np.tensordot(columns, away, 2)


def fit(cube, vertices, wanted, steps=12):
    """Conjugate gradients: the loss is quadratic, so that six steps suffice but for rounding."""
    parameters, losses, direction, before = np.zeros(6), [], np.zeros(6), 1.0
    for _ in range(steps):
        value, gradient = cube.loss(parameters, vertices, wanted)
        losses.append(value)
        size = gradient @ gradient
        direction, before = size / before * direction - gradient, size
        along = np.tensordot(direction, cube.response.columns[:, vertices], 1)
        if not np.any(along):
            break
        parameters = parameters - gradient @ direction / np.sum(along**2) * direction
    return parameters, losses


def main():
    cube = PulledCube()
    vertices = np.argsort(np.linalg.norm(cube.surface.vertices - [0.5, 0.5, 1], axis=1))[:3]
    wanted = cube.surface.vertices[vertices] + [0.05, 0, 0.02]
    parameters, losses = fit(cube, vertices, wanted)
    print("shift", parameters[:3].round(4), "turn", parameters[3:].round(4), f"loss {losses[0]:.2e} -> {losses[-1]:.2e}")


if __name__ == "__main__":
    main()
