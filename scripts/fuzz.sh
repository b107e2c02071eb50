#!/usr/bin/env bash
# fuzz.sh [SECONDS [SEED [OPTIONS OF fuzz_program]]]: feeds mutated meshes, scenes and replays to the program, for a
# minute unless told otherwise, with a seed of the clock's unless told otherwise. Every input that the program does not
# bear is kept in build/fuzz-finds: mend the program and add the file to tests/fuzz/corpus, which the tests replay.
#   scripts/fuzz.sh 600 7                               ten minutes of seed 7
#   scripts/fuzz.sh 1e9 7 --inputs 1 --first 1234       input 1234 of seed 7 again
#   scripts/fuzz.sh 600 7 --only ply                    seeds whose name has this part
#   scripts/fuzz.sh 600 7 --bodies                      bodies made at random, not mutated files
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60} seed=${2:-$(date +%s)}
scripts/install.sh
TARGETS="elastolab fuzz_program" scripts/build.sh release
exec tests/support/with_display.sh build/release/tests/fuzz/fuzz_program --program build/release/bin/elastolab \
  --seeds tests/fuzz/seeds --keep build/fuzz-finds --seconds "$seconds" --seed "$seed" "${@:3}"
