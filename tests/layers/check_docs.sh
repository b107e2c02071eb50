#!/usr/bin/env bash
# check_docs.sh ROOT: fails when a comment of the sources names a file of ours, a section or a reference of
# docs/formulation.md that is not there, when a Markdown document links to a file that is not there, when one of its
# paragraphs is too long to be read once, or when README.md is longer than a landing page. Prints every such place.
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

while IFS=: read -r file line text; do
  number=$(grep -oE '[0-9]+' <<<"${text##*[}")
  grep -q "^$number\. " docs/formulation.md || complain "$file:$line: docs/formulation.md has no reference [$number]"
done < <(grep -rnoE 'docs/formulation\.md \[[0-9]+\]' --include='*.hpp' --include='*.cpp' src tests)

# A paragraph is a line. A sentence ends where a capital, code or the end of the line follows.
readonly longest=700 most_sentences=4 most_lines=120
while IFS=: read -r file line what; do complain "$file:$line: $what"; done < <(
  awk -v longest=$longest -v most=$most_sentences '
    FNR == 1 { fenced = 0 }
    /^```/ { fenced = !fenced }
    fenced || /^[|]/ { next }
    length($0) > longest { print FILENAME ":" FNR ":a paragraph of " length($0) " characters, over " longest }
    { n = gsub(/[^A-Z. ][.?!]( [A-Z`(*"\[]|$)/, "&") }
    n > most { print FILENAME ":" FNR ":a paragraph of " n " sentences, over " most }
  ' README.md docs/*.md assets/*.md)
lines=$(wc -l <README.md)
[[ $lines -le $most_lines ]] || complain "README.md: $lines lines, over $most_lines"

while IFS=: read -r file line link; do
  [[ $link == *://* || -e $(dirname "$file")/$link ]] || complain "$file:$line: links to $link, which is not there"
done < <(grep -noE '\]\([^)# ]+' README.md docs/*.md assets/*.md /dev/null | sed 's|](||')

echo "$failures findings"
[[ $failures -eq 0 ]]
