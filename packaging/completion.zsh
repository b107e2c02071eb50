#compdef elastolab
# Completion of elastolab for zsh: words come from the program's own --help.
local program=${words[1]} command=${words[2]}
if (( CURRENT == 2 )); then
  compadd -- ${(f)"$($program --help 2>/dev/null | sed -n '/^Subcommands:/,$s/^  \([a-z][a-z-]*\) .*/\1/p')"} --help --version
elif [[ ${words[CURRENT]} == -* ]]; then
  compadd -- ${(f)"$($program $command --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]+')"}
else
  _files
fi
