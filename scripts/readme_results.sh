#!/usr/bin/env bash
# readme_results.sh: copies what the studies found from their reports in assets/results into docs/results.md.
# shellcheck disable=SC2016  # the backticks are Markdown
set -euo pipefail
cd "$(dirname "$0")/.."
results=assets/results

# opening STUDY: the findings before the first heading, after the command.
opening() { awk '/^```/ { ++fences; next } fences > 1 && /^##/ { exit } fences > 1' "$results/$1/README.md"; }
# section STUDY HEADING: what is under a heading, its own headings aside.
section() { awk -v heading="## $2" '$0 == heading { on = 1; next } on && /^##/ { exit } on' "$results/$1/README.md"; }
# machine STUDY: where it was measured.
machine() { sed -n 3p "$results/$1/README.md"; }

heading() {  # LEVEL STUDY TITLE FOLDER_OF_RESULTS
  printf '\n%s %s\n\n`elastolab bench %s --out %s/%s` ([report](%s/%s/README.md)). %s\n\n' \
    "$1" "$3" "$2" "$results" "$2" "$4" "$2" "$(machine "$2")"
}

plot() { printf '\n![%s](%s/%s)\n' "$1" "../$results" "$2"; }

write_results() {
  local from=../$results
  printf '# What the studies found\n\nCopied by `scripts/readme_results.sh` from the reports, which have more tables, plots and every number.\n'
  heading '##' paper 'Do the claims of the paper hold?' "$from"
  section paper "Does the paper's claim hold?"
  plot 'Fig. 4: precomputation' paper/fig4-precomputation.svg
  heading '##' error 'Run time against error' "$from"
  section error 'In short'
  section error 'Who is fastest at a given error'
  plot 'Who is fastest at a given error' error/error-frontier-bending.svg
  printf '\n### Organic bodies\n\n'
  section error 'Organic bodies'
  printf "\n### Poisson's ratio\n\n"
  section error "Poisson's ratio"
  printf '\n### Orders\n\n'
  section error 'Orders'
  heading '##' stability 'What breaks each method' "$from"
  opening stability
  heading '##' scale 'How cost grows' "$from"
  opening scale
  heading '##' skip 'What is saved by skipping' "$from"
  opening skip
}

write_results | cat -s >docs/results.md
