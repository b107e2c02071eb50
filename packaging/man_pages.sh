#!/usr/bin/env bash
# man_pages.sh PROGRAM FOLDER: writes elastolab.1 and a page for each of its commands, from what --help says.
set -euo pipefail
program=$1 folder=$2
mkdir -p "$folder"
version=$("$program" --version)

plain() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\\([.']\\)/\\\\\&\\1/"; }
# page NAME SUMMARY COMMAND...: to FOLDER/NAME.1
page() {
  local name=$1 summary=$2
  shift 2
  {
    printf '.TH %s 1 "" "%s" "Elastolab"\n.SH NAME\n%s \\- %s\n' "${name^^}" "$version" "$(plain <<<"$name")" "$(plain <<<"$summary")"
    printf '.SH SYNOPSIS\n%s\n' "$("$@" --help | sed -n 's/^Usage: //p' | plain)"
    printf '.SH DESCRIPTION\n.nf\n'
    "$@" --help | sed '/^Usage: /d' | fold -sw 92 | plain
    printf '.fi\n.SH SEE ALSO\nThe reference in /usr/share/doc/elastolab.\n'
  } | gzip -9n >"$folder/$name.1.gz"
}

page elastolab "elastic bodies by finite and boundary elements" "$program"
while read -r command summary; do
  page "elastolab-$command" "$summary" "$program" "$command"
done < <("$program" --help | sed -n '/^Subcommands:/,$s/^  \([a-z].*\)/\1/p')
for helper in import tetgen wrap; do
  printf '.so man1/elastolab.1\n' | gzip -9n >"$folder/elastolab-$helper.1.gz"
done
