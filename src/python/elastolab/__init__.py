"""Elastic bodies by finite and boundary elements, as fast as one can pull them.

    import elastolab as el
    cube = el.Surface.primitive("cube", 10)
    model = el.precompute(cube, el.Material(1e5, 0.3), method="galerkin-bem")
    left, right = (cube.vertices[:, 0] == x for x in (0, 1))
    body = model.constrain(fixed=left.nonzero()[0], handles=right.nonzero()[0])
    u = body.displace([0.2, 0, 0])                   # (n_vertices, 3)

Lengths are in the unit of the mesh, Young's modulus is a force per length squared, forces come out in that unit of force.
"""

from elastolab import _threads  # noqa: F401  settles how OpenBLAS and OpenMP start, before they are loaded
from elastolab._core import (
    Defect,
    Deformer,
    DragResponse,
    Error,
    ErrorEstimate,
    Load,
    Material,
    MeshError,
    MeshReport,
    Model,
    Proxy,
    Reaction,
    Reactions,
    SceneError,
    Solution,
    SolveError,
    Surface,
    __version__,
    blas_kernels,
    methods,
    precompute,
    predict,
    set_threads,
    thread_count,
)
from elastolab._scene import Scene, show, solve

__all__ = [
    "Defect",
    "Deformer",
    "DragResponse",
    "Error",
    "ErrorEstimate",
    "Load",
    "Material",
    "MeshError",
    "MeshReport",
    "Model",
    "Proxy",
    "Reaction",
    "Reactions",
    "Scene",
    "SceneError",
    "Solution",
    "SolveError",
    "Surface",
    "__version__",
    "blas_kernels",
    "methods",
    "precompute",
    "predict",
    "set_threads",
    "show",
    "solve",
    "thread_count",
]
