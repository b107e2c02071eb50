#!/usr/bin/env bash
# measure_beside.sh [PROGRAM [FOLDER]]: solves a cube of 1016 vertices by every method, alone and beside one busy process
# for each core, and prints the seconds of each stage and how many times as long they take there. The processors are
# shared then, so that twice as long is what is to be expected.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/bin/elastolab}")
folder=${2:-build/beside}
runs=${RUNS:-3}
mkdir -p "$folder"
cat > "$folder/cube.json" << 'END'
{"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 13}, "method": "fem",
 "fixed": {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-9}},
 "handles": [{"select": {"box": {"min": [0.95, 0.6, -1], "max": [2, 2, 2]}}, "translate": [0.1, 0.02, 0]}]}
END

# seconds METHOD: those of the stages and of the whole, the fastest of the runs.
seconds() {
  for ((run = 0; run < runs; ++run)); do
    local began; began=$(date +%s.%N)
    "$program" solve "$folder/cube.json" --method "$1" --quiet --displacements "$folder/u.csv" --report "$folder/r.json"
    awk -v began="$began" -v ended="$(date +%s.%N)" 'BEGIN { printf "whole %.3f\n", ended - began }'
    python3 - "$folder/r.json" << 'END'
import json, sys
for stage, seconds in json.load(open(sys.argv[1]))["seconds"].items():
    if isinstance(seconds, (int, float)): print(stage.replace(" ", "-"), f"{seconds:.3f}")
END
  done | awk '!($1 in least) { order[++n] = $1; least[$1] = $2 } $2 < least[$1] { least[$1] = $2 }
              END { for (i = 1; i <= n; ++i) print order[i], least[order[i]] }'
}
methods=${METHODS:-fem quadratic-fem linear-bem constant-bem galerkin-bem}
for method in $methods; do seconds "$method" > "$folder/$method-alone"; done
busy=()
for ((i = 0; i < $(nproc); ++i)); do
  (while :; do :; done) &
  busy+=($!)
done
trap 'kill "${busy[@]}" 2> /dev/null || true' EXIT
for method in $methods; do seconds "$method" > "$folder/$method-beside"; done
printf '%-14s %-16s %8s %8s %6s\n' method stage alone beside times
for method in $methods; do
  join -j 1 <(sort "$folder/$method-alone") <(sort "$folder/$method-beside") |
    awk -v method="$method" '$1 == "whole" || $2 + $3 > 0.05 {
      printf "%-14s %-16s %8.3f %8.3f %6.1f\n", method, $1, $2, $3, ($2 > 0 ? $3 / $2 : 0) }'
done
