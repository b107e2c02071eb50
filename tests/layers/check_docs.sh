#!/usr/bin/env bash
# check_docs.sh ROOT: fails when a comment of the sources names a file of ours or a section of docs/formulation.md that
# is not there, or a Markdown document links to a file that is not there. Prints every such place.
set -euo pipefail
cd "$1"

failures=0
complain() { echo "$1"; failures=$((failures + 1)); }

# Files that comments name: "mesh/checks/check.hpp" (from src or tests), "tests/fem/assembly_test.cpp".
while IFS=: read -r file line name; do
  [[ -e $name || -e src/$name || -e tests/$name ]] || complain "$file:$line: names $name, which is not there"
done < <(grep -rnE '//' --include='*.hpp' --include='*.cpp' src tests | sed -E 's|^([^:]*:[0-9]+):.*//|\1:|' |
  awk -F: '{ rest = substr($0, length($1 ":" $2 ":") + 1)
             while (match(rest, /[a-z0-9_]+(\/[a-z0-9_]+)+\.(hpp|cpp|sh|md)/)) {
               print $1 ":" $2 ":" substr(rest, RSTART, RLENGTH); rest = substr(rest, RSTART + RLENGTH) } }')

while IFS=: read -r file line text; do
  section=${text##* }
  grep -q "^## $section\. " docs/formulation.md || complain "$file:$line: docs/formulation.md has no section $section"
done < <(grep -rnoE 'docs/formulation\.md section [0-9]+' --include='*.hpp' --include='*.cpp' src tests)

while IFS=: read -r file line link; do
  [[ $link == *://* || -e $(dirname "$file")/$link ]] || complain "$file:$line: links to $link, which is not there"
done < <(grep -noE '\]\([^)# ]+' README.md docs/*.md assets/*.md /dev/null | sed 's|](||')

echo "$failures findings"
[[ $failures -eq 0 ]]
