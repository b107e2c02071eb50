# Completion of elastolab for fish: words come from the program's own --help.
complete -c elastolab -n __fish_use_subcommand -f -a "(elastolab --help 2>/dev/null | sed -n '/^Subcommands:/,\$s/^  \([a-z][a-z-]*\) .*/\1/p')"
complete -c elastolab -n "not __fish_use_subcommand" -a "(elastolab (commandline -opc)[2] --help 2>/dev/null | string match -r -- '--[a-z][a-z-]+')"
