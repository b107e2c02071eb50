#!/usr/bin/env bash
# check_reference.sh PROGRAM ROOT: fails when docs/reference.md lacks an option of --help, a study, a key of a report, a
# column of a table, a key of scene files, a shortcut or a gesture, in the section where it belongs. Prints each of them.
# shellcheck disable=SC2016  # the backticks are Markdown
set -euo pipefail
program=$1 root=$2
reference=$root/docs/reference.md
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0 checked=0
complain() { echo "$1"; failures=$((failures + 1)); }

# section HEADING: what is under this heading of the reference, with its subsections; options without their values.
section() {
  awk -v heading="$1" '
    /^```/ { fenced = !fenced }
    !fenced && /^#+ / { match($0, /^#+/); if (on && RLENGTH <= level) exit }
    $0 == heading { on = 1; level = RLENGTH }
    on' "$reference" | sed -E 's/`(--[a-z-]+) [^`]*`/`\1`/g'
}
# require WHAT HEADING: every line of the input, of which there is one at least, stands in that section.
require() {
  local text line n=0
  text=$(section "$2")
  while read -r line; do
    n=$((n + 1))
    [[ $text == *"$line"* ]] || complain "$1 $line is not in the section \"$2\""
  done
  [[ $n -gt 0 ]] || complain "no $1 was found for the section \"$2\""
  checked=$((checked + n))
}
code() { sed 's/.*/`&`/'; }                                   # words as code
keys_of() { grep -oE '"[a-z_ ]+":' | tr -d '":' | sort -u; }  # of JSON
options_of() { "$program" "$1" --help | grep -oE -- '--[a-z][a-z-]+' | grep -vx -- --help | sort -u; }

for command in view solve info feel bench thumbnail; do
  require "option" "## \`elastolab $command\`" < <(options_of "$command" | code)
done
require "study" '## `elastolab bench`' < <(sed -nE 's/^ +\{"([a-z-]+)", ".*/\1/p' "$root/src/study/studies.cpp" | code)

cat >"$folder/scene.json" <<'END'
{ "elastolab": 1, "mesh": { "primitive": "cube", "resolution": 3 }, "method": "galerkin-bem",
  "fixed": [{ "name": "left", "select": { "plane": { "point": [0, 0, 0], "normal": [1, 0, 0], "tolerance": 0.01 } } },
            { "select": { "sphere": { "center": [0.333, 0.333, 1], "radius": 0.1 } } }],
  "handles": [{ "name": "right", "translate": [0.1, 0, 0],
                "select": { "plane": { "point": [1, 0, 0], "normal": [1, 0, 0], "tolerance": 0.01 } } }] }
END
"$program" solve "$folder/scene.json" --quiet --proxy always --proxy-vertices 100 --report "$folder/report.json" \
  --displacements "$folder/u.csv" --fields "$folder/fields.csv" --forces "$folder/forces.csv"
"$program" info "$folder/scene.json" --json --proxy always --proxy-vertices 100 >"$folder/info.json"
require "key" '### Report' < <(keys_of <"$folder/report.json" | code)
require "key" '## `elastolab info`' < <(keys_of <"$folder/info.json" | grep -vxE 'largest_distance|closed_holes|open_holes' | code)
require "row of columns" '## Files that are written' < <(head -qn 1 "$folder"/*.csv | code)
require "row of columns" '### Files of the viewer' < <(
  sed -nE '/<< "[a-z_]+,/,/\\n"/p' "$root/src/app/window/timings.cpp" "$root/src/app/probes.cpp" | tr -d '\n' |
    grep -oE '"[a-z_," ]*\\n"' | sed -E 's/"|\\n//g; s/ //g' | code)

readonly scene_reader=$root/src/scene/file/scene_reader.cpp
require "key" '## Scene files' < <(tr -d '\n' <"$scene_reader" | grep -oE 'require_keys\(\{[^}]*\}' |
  grep -oE '"[a-z_]+"' | tr -d '"' | sort -u | code)
require "primitive" '## Scene files' < <(sed -nE 's/^        \{"([a-z-]+)",$/\1/p' \
  "$root/src/mesh/primitive_names.cpp" | code)
# The keys by what they do, since methods' keys and pairs share a row.
readonly shortcuts=$root/src/app/shortcuts.cpp
require "shortcut" '### Keys' < <(sed -nE 's/^ *\{GLFW_KEY_[^"]*"[^"]+", "([^"]+)".*/\1/p' "$shortcuts")
require "gesture" '### Mouse' < <(sed -n '/gesture_help(Navigation/,/^}/p' "$shortcuts" | sed -nE 's/^ *\{+"([^"]+)", .*/\1/p')
require "option" '## Building and testing' < <(sed -nE 's/^(option\(|set\()(ELASTOLAB_[A-Z]+) .*/\2/p' \
  "$root/CMakeLists.txt" | code)

echo "$checked entries, $failures findings"
[[ $failures -eq 0 ]]
