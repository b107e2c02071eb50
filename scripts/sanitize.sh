#!/usr/bin/env bash
# sanitize.sh [address|thread] [--quick|LAYER...]: builds and runs the test suite under the address and undefined-behaviour
# sanitizers, or under the thread sanitizer (clang, whose OpenMP runtime tells the sanitizer of its barriers).
# Suppressions, for libraries that are not ours, are in tests/sanitizers.
#   LAYER    the tests of these layers alone, without those that carry the label "slow"
#   --quick  the layers that need no window, no study and no program
set -euo pipefail
cd "$(dirname "$0")/.."
begin=$SECONDS preset=asan layers=()
for argument in "$@"; do
  case $argument in
    address) preset=asan ;;
    thread) preset=tsan ;;
    --quick) layers=(base elasticity mesh deform fem scene) ;;
    *)
      if [[ ! -d tests/$argument ]]; then
        echo "usage: scripts/sanitize.sh [address|thread] [--quick|LAYER...]" >&2
        exit 2
      fi
      layers+=("$argument") ;;
  esac
done
if [[ $preset == tsan ]]; then scripts/install.sh clang libomp-dev; else scripts/install.sh; fi
if [[ ${#layers[@]} -eq 0 ]]; then
  scripts/build.sh "$preset"
  exec ctest --preset "$preset"
fi

TARGETS="${layers[*]/%/_test}" scripts/build.sh "$preset" -DELASTOLAB_UNITY=ON
built=$((SECONDS - begin))
export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export LSAN_OPTIONS=suppressions=$PWD/tests/sanitizers/lsan.supp
export TSAN_OPTIONS=suppressions=$PWD/tests/sanitizers/tsan.supp:halt_on_error=1:ignore_noninstrumented_modules=1
code=0
for layer in "${layers[@]}"; do
  ctest --test-dir "build/$preset/tests/$layer" --label-exclude slow --parallel "$(nproc)" --output-on-failure \
    >"build/$preset/$layer.log" 2>&1 || { code=$?; cat "build/$preset/$layer.log"; }
  echo "$preset, $layer: $(grep -E '^[0-9]+% tests passed' "build/$preset/$layer.log")"
done
echo "Built in $built s, tested in $((SECONDS - begin - built)) s ($preset)."
exit "$code"
