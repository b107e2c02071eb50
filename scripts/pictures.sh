#!/usr/bin/env bash
# pictures.sh [PROGRAM [PICTURE...]]: takes the pictures of README.md and docs/guide.md again, in assets/pictures (default:
# all). A recorded interaction presses the keys and clicks. Needs ImageMagick.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/bin/elastolab}")
shift || true
wanted=("$@")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# One frame an argument: "key CODE", as GLFW numbers them, or "click X Y".
interaction() {
  echo '{"elastolab_interaction":1,"window":[1280,800]}'
  local words event pressed
  for event in "$@"; do
    read -ra words <<< "$event"
    if [[ ${words[0]} == key ]]; then
      for pressed in true false; do
        echo "{\"seconds\":0,\"events\":[[\"key\",0,0,${words[1]},$pressed,false,0]]}"
      done
    else
      echo "{\"seconds\":0,\"events\":[[\"cursor\",${words[1]},${words[2]},0,false,false,0]]}"
      for pressed in true false; do
        echo "{\"seconds\":0,\"events\":[[\"button\",${words[1]},${words[2]},0,$pressed,false,0]]}"
      done
    fi
  done
  for ((i = 0; i < 4; ++i)); do echo '{"seconds":0,"events":[]}'; done
}

# picture NAME SCENE [--OPTION VALUE...] [EVENT...]
picture() {
  local name=$1 scene=$2 options=()
  shift 2
  [[ ${#wanted[@]} -eq 0 || " ${wanted[*]} " == *" $name "* ]] || return 0
  while [[ ${1:-} == --* ]]; do options+=("$1" "$2"); shift 2; done
  interaction "$@" > "$work/events"
  tests/support/with_display.sh "$program" view "$scene" --hidden --size 1280x800 --replay "$work/events" \
    --screenshot "$work/picture.png" "${options[@]}"
  convert "$work/picture.png" -strip -colors 240 -define png:compression-level=9 "assets/pictures/$name.png"
  echo "assets/pictures/$name.png"
}

# film NAME SCENE METHOD=TITLE=COLOUR...: the pull from rest and back by each method beside the next, as an animated GIF.
film() {
  local name=$1 scene=$2 part method title colour frame font row
  shift 2
  [[ ${#wanted[@]} -eq 0 || " ${wanted[*]} " == *" $name "* ]] || return 0
  font=$(fc-match -f '%{file}' 'Roboto:medium')
  for part in "$@"; do
    tests/support/with_display.sh "$program" view "$scene" --hidden --frames 3 --method "${part%%=*}" --pull-film 20 \
      --picture "$work/${part%%=*}.png" --picture-size 320x400
  done
  for frame in {0001..0020}; do
    row=()
    for part in "$@"; do
      IFS='=' read -r method title colour <<< "$part"
      row+=('(' "$work/$method-$frame.png" -crop 200x240+62+84 +repage -font "$font" -pointsize 15 -fill "$colour"
            -annotate +10+230 "$title" ')')
    done
    convert "${row[@]}" +append "$work/row-$frame.png"
  done
  convert -delay 9 -loop 0 "$work"/row-*.png -layers Optimize -colors 128 "assets/pictures/$name.gif"
  echo "assets/pictures/$name.gif"
}

film pull assets/scenes/rabbit-nod.json 'fem=FEM=#9ec5f0' 'constant-bem=Constant BEM=#e8b98a' 'linear-bem=Linear BEM=#8fd3ab'
picture side-by-side assets/scenes/rabbit-nod.json 'key 67'
picture hand assets/scenes/hand.json
picture section assets/scenes/liver.json --field von-mises --cut x
picture ghosts assets/scenes/rabbit-nod.json 'key 71'
picture probes assets/scenes/hand.json --field von-mises 'key 73' 'click 700 400' 'click 800 560'
picture loads assets/scenes/liver-pressed.json
picture gizmo assets/scenes/rabbit-nod.json 'click 690 540'

# The rabbit as a careless scan has it: holes, and every ninth triangle facing inward.
awk '
  function hole(x, y, z, r) { return (X - x) ^ 2 + (Y - y) ^ 2 + (Z - z) ^ 2 < r * r }
  $1 == "v" { ++n; x[n] = $2; y[n] = $3; z[n] = $4 }
  $1 == "f" {
    split($2, a, "/"); split($3, b, "/"); split($4, c, "/")
    X = (x[a[1]] + x[b[1]] + x[c[1]]) / 3; Y = (y[a[1]] + y[b[1]] + y[c[1]]) / 3; Z = (z[a[1]] + z[b[1]] + z[c[1]]) / 3
    if (hole(-0.27, -0.3, 1.9, 0.12) || hole(0.25, -0.3, 1.75, 0.14) || hole(0.3, -0.62, 1.25, 0.13) ||
        hole(-0.2, -0.6, 0.5, 0.13) || hole(0.5, 0.2, 0.6, 0.2) || hole(-0.3, 0.4, 1.0, 0.15)) next
    if (++faces % 9 == 0) { print $1, $2, $4, $3; next }
  }
  { print }' assets/meshes/rabbit.obj > "$work/scan.obj"
cat > "$work/scan.json" << 'END'
{"elastolab": 1, "mesh": {"file": "scan.obj"}, "method": "galerkin-bem",
 "fixed": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.12]}},
 "handles": [{"name": "ear", "select": {"sphere": {"center": [0.29, -0.22, 2.2], "radius": 0.13}},
              "translate": [0.35, -0.1, -0.3]}]}
END
picture scan "$work/scan.json"

# film NAME SCENE FRAMES: the pull of a scene, there and back, as a small animation.
film() {
  local name=$1 scene=$2 frames=$3
  [[ ${#wanted[@]} -eq 0 || " ${wanted[*]} " == *" $name "* ]] || return 0
  mkdir "$work/film"
  tests/support/with_display.sh "$program" view "$scene" --hidden --frames 2 --picture "$work/film/frame.png" \
    --picture-size 960x540 --pull-film "$frames"
  convert -delay 6 -loop 0 "$work"/film/frame-*.png -resize 50% -crop 400x240+60+20 +repage +dither -colors 64 \
    -layers optimize "assets/pictures/$name.gif"
  rm -r "$work/film"
  echo "assets/pictures/$name.gif"
}

# A rubber bar whose end is turned twice and pulled, without which it would buckle.
cat > "$work/turns.json" << 'END'
{"elastolab": 1, "mesh": {"primitive": "beam", "resolution": 4}, "method": "nonlinear-fem",
 "fixed": {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}},
 "handles": [{"name": "end", "select": {"box": {"min": [4, 0, 0], "max": [4, 1, 1]}},
              "translate": [0.8, 0, 0], "rotate": {"axis": [1, 0, 0], "degrees": 720, "center": [4, 0.5, 0.5]}}]}
END
film turn "$work/turns.json" 48

# The rabbit's ear turned by 30, 60 and 90 degrees: nonlinear FEM above, linear elasticity by quadratic FEM below.
if [[ ${#wanted[@]} -eq 0 || " ${wanted[*]} " == *" ear "* ]]; then
  columns=()
  for degrees in 30 60 90; do
    for method in nonlinear-fem quadratic-fem; do
      cat > "$work/ear.json" << END
{"elastolab": 1, "mesh": {"file": "$PWD/assets/meshes/rabbit.obj"}, "method": "$method",
 "proxy": {"use": "always", "vertices": 500},
 "fixed": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.12]}},
 "handles": [{"name": "ear", "select": {"sphere": {"center": [0.3, -0.21, 2.25], "radius": 0.16}},
              "rotate": {"axis": [0, 1, 0], "degrees": $degrees, "center": [0.3, -0.21, 2.25]}}]}
END
      tests/support/with_display.sh "$program" view "$work/ear.json" --hidden --frames 2 \
        --picture "$work/ear-$degrees-$method.png" --picture-size 500x500
    done
    columns+=('(' "$work/ear-$degrees-nonlinear-fem.png" "$work/ear-$degrees-quadratic-fem.png"
              -crop 260x250+120+60 +repage -append ')')
  done
  convert "${columns[@]}" +append -strip -colors 240 -define png:compression-level=9 assets/pictures/ear.png
  echo assets/pictures/ear.png
fi
