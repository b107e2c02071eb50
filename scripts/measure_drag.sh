#!/usr/bin/env bash
# measure_drag.sh [PROGRAM [FOLDER]]: replays one drag on cubes of 98 to 5048 vertices for each method, in the viewer with
# real OpenGL (on a virtual display if there is none), and prints the medians of what a frame of it costs; then the same
# with the body cut open, coloured by stress, and a probe kept. The timings of every frame are left in FOLDER (default:
# build/drag). Linear BEM takes a minute or two to precompute the largest cube, constant BEM, with two triangles a vertex,
# ten minutes and 8 GB.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/bin/elastolab}")
folder=${2:-build/drag}
mkdir -p "$folder"

# drag PROBED: a press in the middle of the window's scene and 300 small moves, one a frame; if PROBED is 1, a probe is
# kept there before (keys I and V choose the tools).
drag() {
  echo '{"elastolab_interaction":1,"window":[1280,800]}'
  awk -v probed="$1" 'BEGIN {
    x = 800; y = 400
    if (probed) {
      key(73); event("cursor", x, y, "false"); event("button", x, y, "true"); event("button", x, y, "false"); key(86)
      seconds = 2  # later, so that it is no double click
    }
    event("cursor", x, y, "false"); event("button", x, y, "true")
    for (i = 1; i <= 300; ++i) event("cursor", x + 80 * sin(0.02 * i), y - 40 * sin(0.05 * i), "false")
    event("button", x, y, "false")
  }
  function key(code) {
    for (down = 1; down >= 0; --down)
      printf "{\"seconds\":0,\"events\":[[\"key\",0,0,%d,%s,false,0]]}\n", code, down ? "true" : "false"
  }
  function event(kind, x, y, pressed) {
    printf "{\"seconds\":%d,\"events\":[[\"%s\",%.3f,%.3f,0,%s,false,0]]}\n", seconds, kind, x, y, pressed
  }'
}
drag 0 > "$folder/drag.log"
drag 1 > "$folder/drag-cut.log"

# median COLUMN FILE: of the frames of the drag.
median() {
  awk -F, -v column="$1" '$7 == "ready" && $6 > 0 { print $column }' "$2" | sort -g |
    awk '{ v[NR] = $1 } END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}

printf '%-13s %9s %10s %10s %10s %10s %8s\n' method vertices update_ms upload_ms draw_ms frame_ms frames
measure() {  # METHOD CELLS [-cut OPTION...]
  local csv=$folder/$1-$2${3:-}.csv scene=$folder/cube-$2.json
  cat > "$scene" << END
{"elastolab": 1, "mesh": {"primitive": "cube", "resolution": $2}, "method": "$1",
 "fixed": {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-9}}}
END
  tests/support/with_display.sh "$program" view "$scene" --hidden --replay "$folder/drag${3:-}.log" --timings "$csv" \
    "${@:4}"
  printf '%-13s %9d %10.4f %10.4f %10.3f %10.3f %8d\n' "$1" "$((6 * $2 * $2 + 2))" \
    "$(median 8 "$csv")" "$(median 9 "$csv")" "$(median 10 "$csv")" "$(median 12 "$csv")" \
    "$(awk -F, '$7 == "ready" && $6 > 0' "$csv" | wc -l)"
}
for method in fem linear-bem constant-bem; do
  for cells in 4 13 29; do measure "$method" "$cells"; done
done
echo 'cut open along the drag, with the von Mises stress inside, and a probe:'
for method in fem linear-bem; do measure "$method" 13 -cut --cut y --field von-mises; done
