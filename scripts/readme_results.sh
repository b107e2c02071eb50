#!/usr/bin/env bash
# readme_results.sh: copies what the studies found from their reports in assets/results into README.md, between the lines
# "<!-- results -->" and "<!-- end of results -->".
set -euo pipefail
cd "$(dirname "$0")/.."
results=assets/results

# opening STUDY: the findings before the first heading, after the command.
opening() { awk '/^```/ { ++fences; next } fences > 1 && /^##/ { exit } fences > 1' "$results/$1/README.md"; }
# section STUDY HEADING: what is under a heading, its own headings aside.
section() { awk -v heading="## $2" '$0 == heading { on = 1; next } on && /^##/ { exit } on' "$results/$1/README.md"; }
# machine STUDY: where it was measured.
machine() { sed -n 3p "$results/$1/README.md"; }

heading() {  # STUDY TITLE
  printf '\n### %s\n\n`elastolab bench %s --out %s/%s` ([report](%s/%s/README.md)). %s\n\n' \
    "$2" "$1" "$results" "$1" "$results" "$1" "$(machine "$1")"
}

write_results() {
  heading paper 'Do the claims of the paper hold?'
  section paper "Does the paper's claim hold?"
  printf '![Fig. 4: precomputation](%s/paper/fig4-precomputation.svg)\n' "$results"
  heading error 'Run time against error'
  section error 'In short'
  section error 'Who is fastest at a given error' | grep -vE '^\| [a-z-]*irregular|^\| [a-z-]+ \| 0\.49 '
  printf '![Who is fastest at a given error](%s/error/error-frontier-bending.svg)\n' "$results"
  heading stability 'What breaks each method'
  opening stability
  heading scale 'How cost grows'
  opening scale
  heading skip 'What is saved by skipping'
  opening skip
}

write_results | cat -s > README.results
awk '
  /^<!-- results -->$/ { print; while ((getline line < "README.results") > 0) print line; inside = 1; next }
  /^<!-- end of results -->$/ { inside = 0 }
  !inside' README.md > README.new
rm README.results
mv README.new README.md
