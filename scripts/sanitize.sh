#!/usr/bin/env bash
# sanitize.sh [address|thread]: builds and runs the whole test suite under the address and undefined-behaviour
# sanitizers, or under the thread sanitizer (clang, whose OpenMP runtime tells the sanitizer of its barriers).
# Suppressions, for libraries that are not ours, are in tests/sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
case ${1:-address} in
  address) preset=asan ;;
  thread) preset=tsan ;;
  *) echo "usage: scripts/sanitize.sh [address|thread]" >&2; exit 2 ;;
esac
if [[ $preset == tsan ]]; then scripts/install.sh clang libomp-dev; else scripts/install.sh; fi
scripts/build.sh "$preset"
ctest --preset "$preset"
