#!/usr/bin/env bash
# check_bench.sh PROGRAM STUDY: runs the quick study and looks at what it left.
set -euo pipefail
program=$1 study=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$study: $1"; exit 1; }

"$program" bench "$study" --quick --out "$folder/out" --seed 1
cd "$folder/out"
[[ -s $study.csv && -s README.md ]] || fail "table or report is missing"
[[ ! -e $study.partial.csv ]] || fail "the journal is still there"
head -1 "$study.csv" | grep -q 'note,version,cpu,cores,memory_bytes,blas_kernels,threads,seed,quick$' ||
  fail "no provenance"
(( $(wc -l < "$study.csv") > 5 )) || fail "hardly any rows"
grep -q "elastolab bench $study" README.md || fail "the report does not say the command"
! grep -qE '(^|[ |])-?(nan|inf)([ |]|$)' README.md || fail "numbers that are none in the report"
if command -v gnuplot > /dev/null; then
  for script in *.gp; do
    for kind in svg png; do
      [[ $(stat -c %s "${script%.gp}.$kind") -gt 2000 ]] || fail "${script%.gp}.$kind is empty"
    done
  done
fi
# No row of the stress test may be wrong and silent, or end in an error that is none of a person's making.
if [[ $study == stability ]]; then
  bad=$(tail -n +2 "$study.csv" | grep -vE ',(right|told|refused),' | head -3 || true)
  [[ -z $bad ]] || fail "a method is wrong and silent, or failed: $bad"
fi
