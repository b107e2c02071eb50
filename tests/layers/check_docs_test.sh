#!/usr/bin/env bash
# check_docs.sh finds what it is for, and nothing in a sound tree.
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/check_docs.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{src/mesh,tests/mesh,docs,assets}

expect() {  # CODE TEXT: the exit code, and a line of the output
  local output code=0
  output=$("$check" "$tree") || code=$?
  [[ $code -eq $1 && $output == *"$2"* ]] || { echo "expected $1 \"$2\", got $code: $output"; exit 1; }
}
try() {  # FILE LINE TEXT: the line in the file is a finding with the text
  cp "$tree/$1" "$tree/kept"
  echo "$2" >> "$tree/$1"
  expect 1 "$1:2: $3"
  mv "$tree/kept" "$tree/$1"
}

echo '## 1. The problem' > "$tree/docs/formulation.md"
echo '[mathematics](docs/formulation.md#1-the-problem) and [elsewhere](https://example.org)' > "$tree/README.md"
echo '/// See mesh/a.hpp, tests/mesh/a_test.cpp and docs/formulation.md section 1.' > "$tree/src/mesh/a.hpp"
echo '// Of mesh/a.hpp.' > "$tree/tests/mesh/a_test.cpp"
touch "$tree/assets/README.md"
expect 0 "0 findings"
try src/mesh/a.hpp 'int a;  ///< from mesh/a.hpp and mesh/gone.hpp' 'names mesh/gone.hpp'
try tests/mesh/a_test.cpp '// docs/formulation.md section 2' 'docs/formulation.md has no section 2'
try README.md '![picture](assets/gone.png)' 'links to assets/gone.png'
try docs/formulation.md '[readme](README.md)' 'links to README.md'
try src/mesh/a.hpp '// Source: docs/formulation.md [7]' 'docs/formulation.md has no reference [7]'
try docs/formulation.md "$(printf 'x%.0s' {1..701})" 'a paragraph of 701 characters'
try README.md 'One. Two. Three. Four. Five.' 'a paragraph of 5 sentences'

echo '| One. Two. Three. Four. Five. | a row of a table |' >> "$tree/README.md"
expect 0 "0 findings"
for _ in {1..120}; do echo >> "$tree/README.md"; done
expect 1 "README.md: 122 lines"
