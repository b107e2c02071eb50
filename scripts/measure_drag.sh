#!/usr/bin/env bash
# measure_drag.sh [PROGRAM [FOLDER]]: replays one drag on cubes of 98 to 5048 vertices for each method, in the viewer with
# real OpenGL (on a virtual display if there is none), and prints the medians of what a frame of it costs. The timings of
# every frame are left in FOLDER (default: build/drag). Linear BEM takes a minute or two to precompute the largest cube,
# constant BEM, with two triangles a vertex, ten minutes and 8 GB.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/bin/elastolab}")
folder=${2:-build/drag}
mkdir -p "$folder"

# A press in the middle of the window's scene and 300 small moves, one a frame.
{
  echo '{"elastolab_interaction":1,"window":[1280,800]}'
  awk 'BEGIN {
    x = 800; y = 400
    event("cursor", x, y, "false"); event("button", x, y, "true")
    for (i = 1; i <= 300; ++i) event("cursor", x + 80 * sin(0.02 * i), y - 40 * sin(0.05 * i), "false")
    event("button", x, y, "false")
  }
  function event(kind, x, y, pressed) {
    printf "{\"seconds\":0,\"events\":[[\"%s\",%.3f,%.3f,0,%s,false,0]]}\n", kind, x, y, pressed
  }'
} > "$folder/drag.log"

# median COLUMN FILE: of the frames of the drag.
median() {
  awk -F, -v column="$1" '$7 == "ready" && $6 > 0 { print $column }' "$2" | sort -g |
    awk '{ v[NR] = $1 } END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}

printf '%-13s %9s %10s %10s %10s %10s %8s\n' method vertices update_ms upload_ms draw_ms frame_ms frames
measure() {  # METHOD CELLS
  local csv=$folder/$1-$2.csv scene=$folder/cube-$2.json
  cat > "$scene" << END
{"elastolab": 1, "mesh": {"primitive": "cube", "resolution": $2}, "method": "$1",
 "fixed": {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-9}}}
END
  tests/support/with_display.sh "$program" view "$scene" --hidden --replay "$folder/drag.log" --timings "$csv"
  printf '%-13s %9d %10.4f %10.4f %10.3f %10.3f %8d\n' "$1" "$((6 * $2 * $2 + 2))" \
    "$(median 8 "$csv")" "$(median 9 "$csv")" "$(median 10 "$csv")" "$(median 12 "$csv")" \
    "$(awk -F, '$7 == "ready" && $6 > 0' "$csv" | wc -l)"
}
for method in fem linear-bem constant-bem; do
  for cells in 4 13 29; do measure "$method" "$cells"; done
done
