#!/usr/bin/env bash
# thumbnails.sh PROGRAM [SCENE...]: draws the small pictures of the examples that the viewer's menu shows (default: all).
set -euo pipefail
program=$(realpath "$1")
shift
cd "$(dirname "$0")/.."
scenes=("$@")
[[ ${#scenes[@]} -gt 0 ]] || scenes=(assets/scenes/*.json)
mkdir -p assets/thumbnails
for scene in "${scenes[@]}"; do
  picture=assets/thumbnails/$(basename "$scene" .json).png
  tests/support/with_display.sh "$program" view "$scene" --hidden --frames 4 --method fem --size 1280x800 \
    --picture "$picture" --picture-size 300x200 --transparent
  echo "$picture"
done
