#!/usr/bin/env bash
# check_tests_are_built.sh TESTS: fails when a *_test.cpp is named by no CMakeLists.txt of its folder or one above it.
set -euo pipefail
cd "$1"
failures=0 n_tests=0
while read -r file; do
  n_tests=$((n_tests + 1))
  folder=$(dirname "$file") found=0
  while [[ $found -eq 0 && $folder != . ]]; do
    relative=${file#"$folder"/}
    if [[ -f $folder/CMakeLists.txt ]] && grep -qE "(^|[[:space:](])${relative//./\\.}([[:space:])]|$)" "$folder/CMakeLists.txt"; then found=1; fi
    folder=$(dirname "$folder")
  done
  if [[ $found -eq 0 ]]; then echo "$file: is in no build"; failures=$((failures + 1)); fi
done < <(find . -name '*_test.cpp' -printf '%P\n' | sort)
echo "$n_tests test sources, $failures findings"
[[ $failures -eq 0 && $n_tests -gt 0 ]]
