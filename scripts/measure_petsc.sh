#!/usr/bin/env bash
# measure_petsc.sh PROGRAM [PROCESSES [CELLS...]]: iterations, seconds and memory of elastolab-petsc against unknowns, on
# cubes of a structured grid (docs/clusters.md), as CSV. The factor is measured up to 40 cells: beyond that it takes
# minutes.
set -euo pipefail
program=$1 processes=${2:-2}
shift $(($# < 2 ? $# : 2))
[[ $# -gt 0 ]] || set -- 15 31 45 68 99
launch() { mpirun --oversubscribe -n "$processes" "$program" grow "$@"; }
[[ $(id -u) -ne 0 ]] || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
heading=(--heading)
for cells in "$@"; do
  launch --engine gamg --cells "$cells" "${heading[@]}"
  heading=()
  if [[ $cells -le 40 ]]; then launch --engine mumps --cells "$cells"; fi
done
