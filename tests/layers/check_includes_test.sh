#!/usr/bin/env bash
# check_includes.sh finds what it is for, and nothing in a sound tree.
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/check_includes.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{base,mesh,fem,scene/file,render}

expect() {  # CODE TEXT: the exit code, and a line of the output
  local output code=0
  output=$("$check" "$tree") || code=$?
  [[ $code -eq $1 && $output == *"$2"* ]] || { echo "expected $1 \"$2\", got $code: $output"; exit 1; }
}
try() {  # FILE LINE TEXT: the line in the file is a finding with the text
  echo "$2" > "$tree/$1"
  expect 1 "$1: $3"
  rm "$tree/$1"
}

expect 1 "0 files"
echo '#include "base/error.hpp"' > "$tree/mesh/check.hpp"
echo '#include <assimp/scene.h>' > "$tree/mesh/import.cpp"
echo '#include <nlohmann/json.hpp>' > "$tree/scene/file/json_text.hpp"
expect 0 "3 files, 0 findings"
try base/error.hpp '#include "mesh/check.hpp"' 'includes mesh'
try fem/a.cpp '  #  include "bem/b.hpp"' 'includes bem'
try render/a.cpp '#include "scene/document.hpp"' 'includes scene'
try mesh/import.hpp '#include <assimp/scene.h>' 'includes assimp'
try scene/document.hpp '#include <nlohmann/json_fwd.hpp>' 'includes nlohmann'
try scene/a.cpp '#include <CLI/CLI.hpp>' 'includes CLI'
try fem/a.hpp '#include <suitesparse/cholmod.h>' 'includes (.*/)?cholmod'
try fem/b.cpp '#include <GL/gl.h>' 'includes'
try scene/a.cpp '#include <Eigen/QR>' 'includes Eigen'
try mesh/a.cpp '#include <Eigen/SVD>' 'includes Eigen'
mkdir -p "$tree"/fem/{linear,nonlinear,dense}
echo '#include "fem/linear/a.hpp"' > "$tree/fem/nonlinear/a.hpp"
echo '#include "fem/nonlinear/a.hpp"' > "$tree/fem/dense/a.hpp"
expect 0 "0 findings"
echo '#include "fem/dense/a.hpp"' > "$tree/fem/linear/a.hpp"
expect 1 "fem: folders include each other in a circle: fem/dense fem/linear fem/nonlinear"
echo "all found"
