"""What OpenBLAS and OpenMP read when they are loaded; what the user has set is respected. Imported before they are."""

import os


def _fitting_kernels():
    """OpenBLAS 0.3.21 does not know recent processors and falls back to slow kernels: the best that this one can run."""
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
            flags = next((line.split() for line in file if line.startswith("flags")), [])
    except OSError:
        return None
    if {"avx512f", "avx512dq", "avx512cd", "avx512bw", "avx512vl"} <= set(flags):
        return "SkylakeX"
    return "Haswell" if {"avx2", "fma"} <= set(flags) else None


_kernels = _fitting_kernels()
if _kernels:
    os.environ.setdefault("OPENBLAS_CORETYPE", _kernels)
os.environ.setdefault("OMP_WAIT_POLICY", "passive")
os.environ.setdefault("OPENBLAS_THREAD_TIMEOUT", "12")
