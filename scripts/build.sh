#!/usr/bin/env bash
# build.sh PRESET [CMAKE OPTIONS]: configures build/PRESET and builds all of it, or only the targets in $TARGETS.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake --preset "$preset" "${launcher[@]}" "$@" >/dev/null
cmake --build "build/$preset" ${TARGETS:+--target $TARGETS}
