#!/usr/bin/env bash
# test.sh [--werror] [--quick]: installs what is missing, builds everything and runs all tests; needs no display.
#   --werror  warnings are errors
#   --quick   leaves out tests that carry the label "slow"
set -euo pipefail
cd "$(dirname "$0")/.."
begin=$SECONDS
options=(-DELASTOLAB_WERROR=OFF) selection=()
for argument in "$@"; do
  case $argument in
    --werror) options=(-DELASTOLAB_WERROR=ON) ;;
    --quick) selection=(--label-exclude slow) ;;
    *) echo "usage: scripts/test.sh [--werror] [--quick]" >&2; exit 2 ;;
  esac
done

scripts/install.sh
scripts/build.sh release "${options[@]}"
built=$((SECONDS - begin))
code=0
mkdir -p build/release
ctest --preset release --parallel "$(nproc)" --progress "${selection[@]}" >build/release/ctest.log 2>&1 || code=$?
if [[ $code -ne 0 ]]; then cat build/release/ctest.log; fi

echo "Installed and built in $built s, tested in $((SECONDS - begin - built)) s, $((SECONDS - begin)) s in all."
grep -E '^[0-9]+% tests passed|^Total Test time|^No tests' build/release/ctest.log || true
# An entry of ctest runs some of the tests of a program.
count() { grep -ch "^\[ *$1 *\] .* (.* ms)$" build/release/Testing/Temporary/LastTest.log || true; }
echo "In them $(count OK) tests of googletest passed, $(count SKIPPED) were skipped, $(count FAILED) failed."
exit "$code"
