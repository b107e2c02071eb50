#!/usr/bin/env bash
# outside_project_test.sh SOURCE BUILD: installs the library of a build, and compiles and runs what docs/library.md shows
# as a project of its own.
set -euo pipefail
source=$1 build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

block() {  # LANGUAGE: the last block of this language on the page
  awk -v fence="\`\`\`$1" '$0 == fence { on = 1; text = ""; next } $0 == "```" { on = 0 } on { text = text $0 "\n" } END { printf "%s", text }' \
    "$source/docs/library.md"
}

cmake --install "$build" --prefix "$folder/installed" --component development >/dev/null
mkdir "$folder/project"
block cmake >"$folder/project/CMakeLists.txt"
block cpp >"$folder/project/pull.cpp"
lines=$(sed -n '/^int main/,$p' "$folder/project/pull.cpp" | wc -l)
[[ $lines -gt 20 && $lines -le 42 ]] || { echo "The example has $lines lines."; exit 1; }
cmake -S "$folder/project" -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/installed" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS="-std=c++20 -O0" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
cmake --build "$folder/build" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
said=$("$folder/build/pull")
echo "$said"
[[ $said =~ ^"largest displacement 0.1, force "([0-9.e+]+)$ ]]
# A bar of this length would take 1e4; the held ends stiffen it.
awk -v force="${BASH_REMATCH[1]}" 'BEGIN { exit !(force > 1.0e4 && force < 1.3e4) }'
