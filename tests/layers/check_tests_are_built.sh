#!/usr/bin/env bash
# check_tests_are_built.sh TESTS: fails when a *_test.cpp is named by no CMakeLists.txt of its folder or one above it.
set -euo pipefail
cd "$1"
# Every word of a CMakeLists.txt that ends like a test, as a path from here.
named() {
  find . -name CMakeLists.txt -exec awk '
    { folder = FILENAME; sub(/^\.\//, "", folder); sub(/CMakeLists\.txt$/, "", folder); gsub(/[()]/, " ")
      for (i = 1; i <= NF; i++) if ($i ~ /_test\.cpp$/) print folder $i }' {} + | sort -u
}
tests=$(find . -name '*_test.cpp' -printf '%P\n' | sort)
missing=$(comm -23 <(printf '%s' "${tests:+$tests$'\n'}") <(named))
[[ -z $missing ]] || sed 's/$/: is in no build/' <<< "$missing"
echo "$(grep -c . <<< "$tests") test sources, $(grep -c . <<< "$missing") findings"
[[ -z $missing && -n $tests ]]
