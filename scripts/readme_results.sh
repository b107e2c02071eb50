#!/usr/bin/env bash
# readme_results.sh: copies what the studies found from their reports in assets/results: all of it into docs/results.md,
# and the three most telling tables into README.md, between the lines "<!-- results -->" and "<!-- end of results -->".
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
# table N: of the text that comes in.
table() { awk -v wanted="$1" '/^\|/ { if (!on) ++n; on = 1; if (n == wanted) print; next } { on = 0 }'; }
# columns LIST: these columns of the table that comes in, as cut numbers them.
columns() { sed 's/^| *//; s/ *|$//; s/ | /\t/g' | cut -f "$1" | sed 's/\t/ | /g; s/^/| /; s/$/ |/'; }
# table_rows PATTERN: the head of the table that comes in, and its rows that match.
table_rows() { awk -v pattern="$1" 'NR <= 2 || $0 ~ pattern'; }

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

write_readme() {
  heading '###' paper 'Do the claims of the paper hold?' "$results"
  section paper "Does the paper's claim hold?" | table 1 | columns 1-3
  heading '###' error 'Who is fastest to an error of 1 %?' "$results"
  for quantity in 1 2; do
    [[ $quantity == 1 ]] && printf 'Displacements, at a ratio of 0.3:\n\n' || printf '\nForces of the worst patch:\n\n'
    section error 'Who is fastest at a given error' | table "$quantity" | table_rows '^[|] [a-z-]+ [|] 0[.]3 [|] 1 % ' |
      columns 1,4-10
  done
  heading '###' scale 'How cost grows' "$results"
  opening scale | table 1
  printf '\nExponents are those of the growth with the number of surface vertices; memory is the peak beyond what the program held before.\n\n'
}

write_results | cat -s >docs/results.md
write_readme | cat -s >README.results
awk '
  /^<!-- results -->$/ { print; while ((getline line < "README.results") > 0) print line; inside = 1; next }
  /^<!-- end of results -->$/ { inside = 0 }
  !inside' README.md > README.new
rm README.results
mv README.new README.md
