#!/usr/bin/env bash
# results.sh [--check | --run [PROGRAM]]: writes the figures of the studies (assets/results) into README.md and
# docs/results.md, where these have a place for them: between "<!-- begin NAME -->" and "<!-- end -->" what block_NAME
# prints, between "<!--=NAME-->" and "<!--/-->" within a line what value_NAME prints. What stands around it is written
# by hand and kept.
#   --check  changes nothing and fails when a document is not what would be written
#   --run    runs all studies before (hours), and the benchmarks that are built (TARGETS=benchmarks scripts/build.sh
#            release) beside PROGRAM (build/release/bin/elastolab)
# All reports must be of one version and one machine; otherwise it fails, unless it only checks.
# shellcheck disable=SC2016  # the backticks are Markdown
set -euo pipefail
cd "$(dirname "$0")/.."
readonly results=assets/results
readonly documents=(README.md docs/results.md)
readonly studies=(paper error stability scale skip large)
readonly benchmarks=(core_benchmark first_answer_benchmark first_pull_benchmark hierarchical_benchmark)

# ---- the reports ------------------------------------------------------------------------------------------------------
# section STUDY HEADING: what is under a heading of its report.
section() { awk -v heading="## $2" '$0 == heading { on = 1; next } on && /^##/ { exit } on' "$results/$1/README.md"; }
# opening STUDY: the findings before the first heading, after the command.
opening() { awk '/^```/ { ++fences; next } fences > 1 && /^##/ { exit } fences > 1' "$results/$1/README.md"; }
# table N: of the text that comes in.
table() { awk -v wanted="$1" '/^\|/ { if (!on) ++n; on = 1; if (n == wanted) print; next } { on = 0 }'; }
# rows PATTERN: the head of the table that comes in, and its rows that match.
rows() { awk -v pattern="$1" 'NR <= 2 || $0 ~ pattern'; }
# columns LIST: these columns of the table that comes in, as cut numbers them.
columns() { sed 's/^| *//; s/ *|$//; s/ | /\t/g' | cut -f "$1" | sed 's/\t/ | /g; s/^/| /; s/$/ |/'; }

# ---- the tables -------------------------------------------------------------------------------------------------------
# csv FILE PROGRAM: an awk program over its rows, in which col["name"] is the number of a column.
csv() {
  awk -F'"' -v OFS='"' '{ for (i = 2; i <= NF; i += 2) gsub(",", ";", $i) } 1' "$results/$1" |
    awk -F, '
      function seconds(s) { return s < 1e-3 ? sprintf("%.3g µs", 1e6 * s) : s < 1 ? sprintf("%.3g ms", 1e3 * s) : sprintf(s < 100 ? "%.3g s" : "%.0f s", s) }
      function bytes(b) { return b < 1e9 ? sprintf("%.0f MB", b / 1e6) : sprintf("%.3g GB", b / 1e9) }
      function percent(x) { return x == "" ? "-" : sprintf(x >= 1 ? "%.0f %%" : "%.2g %%", 100 * x) }
      NR == 1 { for (i = 1; i <= NF; ++i) col[$i] = i; next }
      '"$2"
}
readonly methods='split("galerkin-bem quadratic-fem linear-bem fem constant-bem", method, " "); n_methods = 5;'

# ---- what the documents ask for -----------------------------------------------------------------------------------------
value_machine() { sed -n 3p "$results/paper/README.md"; }

# Who is fastest on the bending bar: the default methods, from the mesh until handles can be dragged.
value_fastest() {
  csv error/error-frontier.csv '
    $col["error"] == "error" && $col["problem"] == "bending" && $col["nu"] == 0.3 && $col["time"] == "ready_s" &&
    $col["fastest_default"] == "yes" && ($col["target"] == 0.01 || $col["target"] == 0.001) {
      printf "%s%s reaches %s after %s", separator, $col["variant"], percent($col["target"]), seconds($col["seconds"])
      separator = ", and "
    }
    END { print "." }'
}
block_fastest_displacements() {
  section error 'Who is fastest at a given error' | table 1 | rows '^[|] [a-z-]+ [|] 0[.]3 [|] 1 % ' | columns 1,4-10
}
block_fastest_forces() {
  section error 'Who is fastest at a given error' | table 2 | rows '^[|] [a-z-]+ [|] 0[.]3 [|] 1 % ' | columns 1,4-10
}

# organic COLUMN TRUTH: this error of each default method on each organic body at a ratio of 0.3.
organic() {
  csv error/error.csv '
    $col["part"] == "organic" && $col["nu"] == 0.3 && $col["variant"] == $col["method"] {
      if (!($col["problem"] in vertices)) body[++n] = $col["problem"]
      vertices[$col["problem"]] = $col["vertices"]
      truth[$col["problem"]] = $col["'"$2"'"]
      error[$col["problem"], $col["method"]] = $col["'"$1"'"]
    }
    END {
      '"$methods"'
      printf "| body | vertices | truth known to |"; for (m = 1; m <= n_methods; ++m) printf " %s |", method[m]
      printf "\n| --- | --- | --- |"; for (m = 1; m <= n_methods; ++m) printf " --- |"
      for (b = 1; b <= n; ++b) {
        printf "\n| %s | %d | %s |", body[b], vertices[body[b]], percent(truth[body[b]])
        for (m = 1; m <= n_methods; ++m) printf " %s |", percent(error[body[b], method[m]])
      }
      print ""
    }'
}
block_organic_displacements() { organic error truth_error; }
block_organic_forces() { organic error_force truth_force_error; }
# By how much the errors of the others exceed that of Galerkin BEM, geometric means over bodies and ratios; without the
# cantilever, whose force is its weight and so exact by some.
value_organic_factors() {
  csv error/error.csv '
    $col["part"] == "organic" && $col["problem"] != "cantilever" && $col["variant"] == $col["method"] {
      key = $col["problem"] " " $col["nu"]; keys[key]
      error[key, $col["method"]] = $col["error"]; force[key, $col["method"]] = $col["error_force"]
    }
    END {
      '"$methods"'
      for (m = 2; m <= n_methods; ++m) {
        sum = sum_force = n = 0
        for (key in keys) {
          sum += log(error[key, method[m]] / error[key, method[1]]); ++n
          sum_force += log(force[key, method[m]] / force[key, method[1]])
        }
        printf "%s%s %.2g and %.2g times", m == 2 ? "" : ", ", method[m], exp(sum / n), exp(sum_force / n)
      }
      print ""
    }'
}
# What thin triangles along the rims leave of the errors of Galerkin BEM, geometric means likewise.
value_finer_rims() {
  csv error/error.csv '
    $col["part"] == "organic" && $col["problem"] != "cantilever" && $col["method"] == "galerkin-bem" {
      rims = $col["variant"] == "galerkin-bem" ? 0 : substr($col["variant"], length("galerkin-bem rims ") + 1)
      key = $col["problem"] " " $col["nu"]; keys[key]
      error[key, rims] = $col["error"]; force[key, rims] = $col["error_force"]
    }
    END {
      for (rims = 1; rims <= 2; ++rims) {
        sum = sum_force = n = 0
        for (key in keys) {
          if (!((key, rims) in error)) continue
          sum += log(error[key, rims] / error[key, 0]); sum_force += log(force[key, rims] / force[key, 0]); ++n
        }
        printf "%s`--rims %d` leaves %.2g of the errors in displacements and %.2g in forces", rims == 1 ? "" : ", ", rims, exp(sum / n), exp(sum_force / n)
      }
      print "."
    }'
}
# Estimates of displacements beside the true error of the worst vertex.
value_estimates() {
  csv error/error.csv '
    $col["part"] == "organic" && $col["estimate"] != "" && $col["error_max"] > 0 {
      ratio = $col["estimate"] / $col["error_max"]; ++n
      if (ratio < 3 && ratio > 1 / 3) ++good
      if ($col["error_max"] > 0.1 && $col["estimate"] < 0.05) ++silent
    }
    END { printf "%d of %d estimates are within a factor of three of the true error of the worst vertex, and %s of an error above 10 %% is below 5 %%.\n", good, n, silent ? silent : "none" }'
}

value_locking() {
  csv error/error.csv '
    $col["part"] == "poisson" && $col["problem"] == "bending" && $col["variant"] == "fem" { error[$col["nu"]] = $col["error"] }
    END { printf "Linear FEM has %.2g times the error of 0.3 at a ratio of 0.49, and %.2g times at 0.4999.\n", error["0.49"] / error["0.3"], error["0.4999"] / error["0.3"] }'
}
block_poisson() { section error "Poisson's ratio" | table 1; }
block_orders() { section error 'Orders' | table 1 | rows '^[|] [a-z-]+ [|] 0[.]3 ' | columns 1,3-9; }

block_paper_claims() { section paper "Does the paper's claim hold?" | table 1 | columns 1-3; }
block_paper_precomputation() { section paper "Does the paper's claim hold?" | table 2; }
block_paper_sets() { section paper "Does the paper's claim hold?" | table 3; }

block_breaks() {
  csv stability/stability.csv '
    $col["outcome"] ~ /^(right|told|refused|silent|failed)$/ { group = $col["group"]; if (!(group in seen)) name[++n] = group; seen[group]; ++count[group, $col["outcome"]] }
    END {
      print "| sweep | right | wrong with a warning | refused | wrong without a word |\n| --- | --- | --- | --- | --- |"
      for (g = 1; g <= n; ++g) printf "| %s | %d | %d | %d | %d |\n", name[g], count[name[g], "right"], count[name[g], "told"], count[name[g], "refused"], count[name[g], "silent"] + count[name[g], "failed"]
    }'
}
value_breaks() { opening stability | grep '^Of ' | head -1; }
value_edits() { opening stability | grep -i 'random edits' | head -1; }

# How far each motion may go before linear theory is off by so much of the largest displacement.
value_linear_theory() {
  csv large/large.csv '
    $col["part"] == "theory" {
      what = $col["what"]; if (!(what in seen)) name[++n] = what; seen[what]
      for (limit = 2; limit <= 10; limit += 8) if (100 * $col["largest_error"] < limit) reach[what, limit] = $col["amount"] " " $col["unit"]
    }
    END {
      for (limit = 2; limit <= 10; limit += 8) {
        printf("%s", limit == 2 ? "Linear theory is off by less than 2 % of the largest displacement up to" : "; by less than 10 % up to")
        for (i = 1; i <= n; ++i) if ((name[i], limit) in reach) printf("%s %s (%s)", i > 1 ? "," : "", reach[name[i], limit], name[i])
      }
      print "."
    }'
}
block_linear_theory() { opening large | table 1 | rows '^[|] [a-z ]+ [|] ((5|20|60|120) degrees|(10|50|200) per cent) '; }

# A small and a large cube, until a handle can be dragged, on demand.
block_ready() {
  csv scale/scale.csv '
    $col["mode"] == "on-demand" && ($col["vertices"] == 1016 || $col["vertices"] == 40346) {
      key = $col["vertices"] " " $col["method"]
      ready[key] = seconds($col["precompute_s"] + $col["set_change_s"])
      memory[key] = bytes($col["with_set_bytes"]); frame[key] = seconds($col["frame_s"])
    }
    END {
      '"$methods"'
      printf "| cube, a face fixed, a patch pulled |"; for (m = 1; m <= n_methods; ++m) printf " %s |", method[m]
      printf "\n| --- |"; for (m = 1; m <= n_methods; ++m) printf " --- |"
      split("1016 40346", size, " ")
      for (s = 1; s <= 2; ++s) for (m = 1; m <= n_methods; ++m) if (!((size[s] " " method[m]) in ready)) ready[size[s] " " method[m]] = memory[size[s] " " method[m]] = frame[size[s] " " method[m]] = "–"
      for (s = 1; s <= 2; ++s) {
        printf "\n| %s vertices: until it can be dragged |", size[s]; for (m = 1; m <= n_methods; ++m) printf " %s |", ready[size[s] " " method[m]]
        printf "\n| peak memory |"; for (m = 1; m <= n_methods; ++m) printf " %s |", memory[size[s] " " method[m]]
        printf "\n| a frame of a drag |"; for (m = 1; m <= n_methods; ++m) printf " %s |", frame[size[s] " " method[m]]
      }
      print ""
    }'
}
block_growth() { opening scale | table 1; }
block_predictions() { opening scale | table 2; }
block_skips() { opening skip | table 1; }

# Medians of Google Benchmark's tables, beside the work that cannot be done without.
block_benchmarks() {
  local name file
  for name in "${benchmarks[@]}"; do
    file=$results/benchmarks/$name.csv
    [[ -s $file ]] || continue
    printf '\n`%s`:\n\n| what | time | work it cannot do without | ratio |\n| --- | --- | --- | --- |\n' "$name"
    sed -n '/^name,/,$p' "$file" | awk -F, '
      NR == 1 { for (i = 1; i <= NF; ++i) { gsub("\"", "", $i); col[$i] = i }; next }
      {
        what = $1; gsub("\"", "", what); sub("/iterations.*", "", what); gsub("_", " ", what)
        ms = ("ms" in col) ? $col["ms"] : $col["real_time"]
        reference = ("reference_ms" in col) ? $col["reference_ms"] : ""
        ratio = ("ratio" in col) ? $col["ratio"] : ""
        printf "| %s | %.3g ms | %s | %s |\n", what, ms, reference == "" ? "" : sprintf("%.3g ms", reference), ratio == "" ? "" : sprintf("%.2g", ratio)
      }'
  done
  file=$results/benchmarks/measure_drag.txt
  [[ ! -s $file ]] || { printf '\n`scripts/measure_drag.sh`:\n\n```\n'; cat "$file"; printf '```\n'; }
  file=$results/benchmarks/accuracy.txt
  [[ ! -s $file ]] || { printf '\nFigures of the accuracy tests:\n\n```\n'; cat "$file"; printf '```\n'; }
}

# ---- plots that no study has --------------------------------------------------------------------------------------------
# draw FILE: a gnuplot script that comes in, to this SVG.
draw() {
  { printf 'set terminal svg size 800,480 font "sans,13" background "white"\nset output "%s"\n' "$1"
    local colour n=0  # those of the studies' plots, in the order of `methods`
    for colour in CC79A7 E69F00 009E73 0072B2 D55E00; do printf 'set linetype %d lc rgb "#%s"\n' $((++n)) "$colour"; done
    cat; } | gnuplot
}
plot_organic() {
  { printf '$data << END\n'
    block_organic_displacements | awk -F' *[|] *' 'NR != 2 { gsub(/ %/, ""); $1 = ""; print $2, $5, $6, $7, $8, $9 }'
    printf 'END\n'
    cat <<'END'
set style data histograms
set style fill solid 0.9 noborder
set logscale y
set format y "%g %%"
set grid ytics
set key outside
set title "Error on organic bodies, rms over the free vertices, Poisson's ratio 0.3"
set xtics rotate by -20
plot for [i = 2:6] $data using i:xtic(1) title columnheader(i) lt i - 1
END
  } | draw "$results/organic.svg"
}
plot_estimates() {
  { for method in galerkin-bem quadratic-fem linear-bem fem constant-bem; do
      printf '$%s << END\n' "${method//-/_}"
      csv error/error.csv '$col["part"] == "organic" && $col["variant"] == "'"$method"'" && $col["estimate"] != "" { print 100 * $col["error_max"], 100 * $col["estimate"] }'
      printf 'END\n'
    done
    cat <<'END'
set logscale xy
set xrange [1:100]
set yrange [1:100]
set grid
set key outside
set xlabel "true error of the worst vertex [%]"
set ylabel "estimate [%]"
set title "What the program says of its errors (lines: exact, and a factor of three)"
plot x with lines lc "grey20" notitle, 3 * x with lines lc "grey70" notitle, x / 3 with lines lc "grey70" notitle, \
  $galerkin_bem title "galerkin-bem" pt 7 lt 1, $quadratic_fem title "quadratic-fem" pt 7 lt 2, $linear_bem title "linear-bem" pt 7 lt 3, \
  $fem title "fem" pt 7 lt 4, $constant_bem title "constant-bem" pt 7 lt 5
END
  } | draw "$results/estimates.svg"
}

# ---- the documents ------------------------------------------------------------------------------------------------------
# filled DOCUMENT: its text with every figure in place.
filled() {
  local folder name
  folder=$(mktemp -d)
  while read -r name; do
    "block_$name" | cat -s >"$folder/block_$name"
    [[ -s $folder/block_$name || $name == benchmarks ]] || { echo "$1: nothing was found for $name" >&2; return 1; }
  done < <(sed -nE 's/^<!-- begin ([a-z_]+) -->$/\1/p' "$1")
  while read -r name; do
    "value_$name" >"$folder/value_$name"
    [[ -s $folder/value_$name ]] || { echo "$1: nothing was found for $name" >&2; return 1; }
  done < <(grep -oE '<!--=[a-z_]+-->' "$1" | sed -E 's/<!--=(.*)-->/\1/')
  awk -v folder="$folder" '
    function text(file,   line, all) { while ((getline line < file) > 0) all = all (all == "" ? "" : "\n") line; close(file); return all }
    /^<!-- begin [a-z_]+ -->$/ { print; block = text(folder "/block_" $3); if (block != "") print "\n" block "\n"; inside = 1; next }
    /^<!-- end -->$/ { inside = 0 }
    inside { next }
    {
      rest = $0; line = ""
      while (match(rest, /<!--=[a-z_]+-->/)) {
        name = substr(rest, RSTART + 5, RLENGTH - 8)
        line = line substr(rest, 1, RSTART + RLENGTH - 1) text(folder "/value_" name)
        rest = substr(rest, RSTART + RLENGTH)
        end = index(rest, "<!--/-->")
        if (!end) { print FILENAME ": <!--=" name "--> has no end" > "/dev/stderr"; exit 1 }
        rest = substr(rest, end)
      }
      print line rest
    }' "$1"
  rm -r "$folder"
}

run_studies() {  # PROGRAM
  local study name tests
  tests=$(dirname "$(dirname "$1")")/tests
  for study in "${studies[@]}"; do "$1" bench "$study" --out "$results/$study" --seed 1; done
  mkdir -p "$results/benchmarks"
  for name in "${benchmarks[@]}"; do
    [[ ! -x $tests/benchmarks/$name ]] ||
      "$tests/benchmarks/$name" --benchmark_format=csv >"$results/benchmarks/$name.csv"
  done
  scripts/measure_drag.sh "$1" >"$results/benchmarks/measure_drag.txt"
  [[ ! -x $tests/methods/methods_test ]] ||
    "$tests/methods/methods_test" --gtest_filter='*Converges*:OrganicBody*' | sed -n 's/^\[ measured \] //p' \
      >"$results/benchmarks/accuracy.txt"
}

require_one_version() {
  local study versions
  versions=$(for study in "${studies[@]}"; do
    sed -n 3p "$results/$study/README.md" | sed "s/; seed.*/: $study/"
  done | sort)
  [[ $(sed 's/: [a-z]*$//' <<<"$versions" | uniq | wc -l) -eq 1 ]] || {
    printf '%s\nThese reports are of different versions or machines. Run them again: scripts/results.sh --run\n' "$versions" >&2
    return 1
  }
}

case ${1:-} in
  --check)
    for document in "${documents[@]}"; do
      filled "$document" | diff -u "$document" - || { echo "$document: run scripts/results.sh"; exit 1; }
    done
    exit ;;
  --run) run_studies "$(realpath "${2:-build/release/bin/elastolab}")" ;;
  "") ;;
  *) echo "usage: scripts/results.sh [--check | --run [PROGRAM]]" >&2; exit 2 ;;
esac
require_one_version
if command -v gnuplot >/dev/null; then plot_organic; plot_estimates; fi
for document in "${documents[@]}"; do
  filled "$document" >"$document.new"
  mv "$document.new" "$document"
done
