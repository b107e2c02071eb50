#!/usr/bin/env bash
# with_display.sh PROGRAM [ARGUMENTS]: runs it, on a virtual display if DISPLAY names none. Listing tests needs none.
set -euo pipefail
if [[ -n ${DISPLAY:-} || " $* " == *" --gtest_list_tests"* ]]; then exec "$@"; fi

# The server itself picks a free number, so any number of tests may start at once. It stays as it is when a program
# leaves it, so that the next one finds it ready.
folder=$(mktemp -d)
mkfifo "$folder/number"
Xvfb -displayfd 3 -screen 0 1920x1200x24 -nolisten tcp -noreset 3<>"$folder/number" 2>"$folder/log" &
server=$!
trap 'kill $server 2>/dev/null || true; wait $server 2>/dev/null || true; rm -rf "$folder"' EXIT
exec 4<>"$folder/number"
read -r -t 60 -u 4 number || { echo "with_display.sh: Xvfb does not start: $(cat "$folder/log")" >&2; exit 1; }
DISPLAY=:$number "$@"
