#!/usr/bin/env bash
# tidy.sh [LAYER...]: clang-tidy (.clang-tidy) over the sources of these layers, or of all; any finding fails. It reads
# the unity sources, so that what several of them include is read once.
set -euo pipefail
cd "$(dirname "$0")/.."
begin=$SECONDS
scripts/install.sh clang-tidy
cmake --preset release >/dev/null
layers=${*:-[a-z]+}
mapfile -t sources < <(sed -nE 's|^ *"file": "(.*)",?$|\1|p' build/release/compile_commands.json |
  grep -E "^$PWD/(build/release/)?src/(${layers// /|})/")
code=0
printf '%s\0' "${sources[@]}" |
  xargs -0 -P "$(nproc)" -n 1 clang-tidy -p build/release --quiet --extra-arg=-Wno-unknown-warning-option \
    --extra-arg=-Wno-unused-command-line-argument \
    >build/release/tidy.log 2>&1 || code=1
if [[ $code -ne 0 ]]; then grep -E ' (warning|error): ' build/release/tidy.log | sort -u || tail build/release/tidy.log; fi
echo "clang-tidy: ${#sources[@]} sources in $((SECONDS - begin)) s, $([[ $code -eq 0 ]] && echo no finding || echo findings)."
exit "$code"
