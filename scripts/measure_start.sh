#!/usr/bin/env bash
# measure_start.sh [PROGRAM [FOLDER]]: starts the viewer on five bodies, presses on each as soon as its window is there and
# pulls on until the chosen method answers, and prints when the window, the body, its first answer, its first motion and
# the exact one were seen [s since the process began]: quiet, then beside one busy process for each core. Needs xdotool
# and, without a display, Xvfb. Timelines are left in FOLDER (default: build/start).
set -euo pipefail
cd "$(dirname "$0")/.."
[[ ${1:-} == --inside ]] && shift || exec tests/support/with_display.sh "$0" --inside "$@"
program=$(realpath "${1:-build/release/bin/elastolab}")
folder=${2:-build/start}
patience=${PATIENCE:-60}  # seconds for each body
mkdir -p "$folder"
export XDG_STATE_HOME=$(realpath "$folder")/state  # recent files and copies are not those of the person

# scene CELLS: a cube of so many cells, its left face fixed.
scene() {
  cat > "$folder/cube-$1.json" << END
{"elastolab": 1, "mesh": {"primitive": "cube", "resolution": $1}, "method": "galerkin-bem",
 "fixed": {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-9}}}
END
}
scene 18
scene 85

at() { awk -F, -v event="$1" '$1 == event { print $2 }' "$2" 2> /dev/null; }

# start NAME [ARGUMENT...]
start() {
  local csv=$folder/$1.csv
  rm -rf "$csv" "$XDG_STATE_HOME"  # what a viewer that was killed had kept would be offered first
  "$program" view --timeline "$csv" --size 1280x800 "${@:2}" > "$folder/$1.log" 2>&1 &
  local viewer=$! window moves
  local -i end=$((SECONDS + patience))
  # Looks are few and moves are made by one process, as each new process takes time from the viewer: `search --sync`
  # looks twice a second only, a loop without pauses took a quarter of two cores.
  until window=$(xdotool search --onlyvisible --pid "$viewer" 2> /dev/null | tail -1 | grep .); do
    if ((SECONDS >= end)) || ! kill -0 "$viewer" 2> /dev/null; then
      echo "$1: no window. What the viewer said: $(cat "$folder/$1.log")" >&2
      exit 1
    fi
    sleep 0.03
  done
  xdotool mousemove --window "$window" 860 400 mousedown 1
  local early=
  [[ -n $(at loaded "$csv") ]] || early=yes
  local -i round=0 step
  end=$((SECONDS + patience))
  while [[ -z $(at exact "$csv") ]] && ((SECONDS < end)); do
    # A press before there was anything to press on is repeated, as a person would: when the body is seen, and later
    # twice a second.
    if [[ -n $early && -n $(at loaded "$csv") ]] ||
      { [[ -n $(at answer "$csv") && -z $(at moved "$csv") ]] && ((round % 5 == 4)); }; then
      early=
      xdotool mouseup 1 mousedown 1
    fi
    round+=1
    moves=()
    for step in 1 2; do
      moves+=(mousemove --window "$window" $((860 + 3 * ((2 * round + step) % 20) + 5)) 390 sleep 0.05)
    done
    xdotool "${moves[@]}"
  done
  printf '%-9s' "$1"
  for event in window loaded answer moved exact; do printf ' %8s' "$(at "$event" "$csv" | grep . || echo -)"; done
  echo
  xdotool mouseup 1
  kill "$viewer" 2> /dev/null || true
  wait "$viewer" 2> /dev/null || true
}

bodies() {
  start cube
  start rabbit assets/meshes/rabbit.obj
  start heart assets/scenes/heart.json
  start cube-18 "$folder/cube-18.json"
  start cube-85 "$folder/cube-85.json"
}
printf '%-9s %8s %8s %8s %8s %8s\n' body window loaded answer moved exact
bodies
busy=()
for ((i = 0; i < $(nproc); ++i)); do
  (while :; do :; done) &
  busy+=($!)
done
trap 'kill "${busy[@]}" 2> /dev/null || true' EXIT
echo "beside ${#busy[@]} busy processes:"
bodies
