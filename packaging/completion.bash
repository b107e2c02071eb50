# Completion of elastolab for bash: words come from the program's own --help.
_elastolab() {
  local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} program=${COMP_WORDS[0]}
  if [[ $COMP_CWORD -eq 1 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" --help 2>/dev/null | sed -n '/^Subcommands:/,$s/^  \([a-z][a-z-]*\) .*/\1/p') --help --version" -- "$current")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" "$command" --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]+')" -- "$current")
  elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == --method ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" "$command" --help 2>/dev/null | sed -nE 's/.*--method [^{]*\{([^}]*)\}.*/\1/p' | tr ',' ' ')" -- "$current")
  fi
}
complete -o default -F _elastolab elastolab
