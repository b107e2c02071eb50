#!/usr/bin/env bash
# check_includes.sh SRC: fails when a source of SRC includes a layer above its own, or a wrapped library elsewhere than
# where it is wrapped. Prints every such line.
set -euo pipefail
cd "$1"

# The layers that each may include besides itself.
declare -A below=(
  [base]=""
  [mesh]="base"
  [elasticity]="base"
  [deform]="base mesh elasticity"
  [fem]="base mesh elasticity deform"
  [bem]="base mesh elasticity deform"
  [findings]="base mesh elasticity deform"
  [methods]="base mesh elasticity deform fem bem findings"
  [scene]="base mesh elasticity deform findings methods"
  [study]="base mesh elasticity deform fem bem findings methods scene"
  [render]="base"
  [app]="base mesh elasticity deform findings methods scene render"
  [cli]="base mesh elasticity deform findings methods scene study app"
)

# Wrapped libraries: the headers that tell them, and the files that may include them.
wrapped=(
  'assimp/|^mesh/[a-z_/]*\.cpp$'
  '(.*/)?tetgen\.h|^mesh/[a-z_/]*\.cpp$'
  'CGAL/|^mesh/wrap/(cgal_mesh\.hpp|hole_filling\.cpp|wrap_main\.cpp)$'
  '(.*/)?cholmod|^fem/[a-z_/]*\.cpp$'
  'nlohmann/|^(scene/file/json_(text|node)\.hpp|cli/proxy_json\.hpp|(scene|study|cli|app)/[a-z_/]*\.cpp)$'
  'CLI/|^cli/[a-z_/]*\.cpp$'
  '(GL|GLES2|GLES3|glad|EGL|epoxy)/|^(render|app)/[a-z_/]*\.(cpp|hpp)$'
  'GLFW/|^(app|cli)/[a-z_/]*\.(cpp|hpp)$'
  'imgui|^app/[a-z_/]*\.(cpp|hpp)$'
  '(cblas|lapacke|openblas_config)\.h|^(base|elasticity|fem|bem|deform)/[a-z_/]*\.cpp$'
)

failures=0
complain() { echo "$1"; failures=$((failures + 1)); }

check_layers() {  # FILE: its includes of our own headers
  local layer=${1%%/*} included
  if [[ -z ${below[$layer]+known} ]]; then complain "$1: is in no known layer"; return; fi
  while read -r included; do
    [[ $included == "$layer" || " ${below[$layer]} " == *" $included "* ]] || complain "$1: includes $included/..."
  done < <(sed -nE 's|^[[:space:]]*#[[:space:]]*include[[:space:]]*"([a-z_]+)/.*|\1|p' "$1")
}

check_wrapped() {  # FILE: its includes of wrapped libraries
  local entry pattern allowed
  for entry in "${wrapped[@]}"; do
    pattern=${entry%|^*} allowed="^${entry##*|^}"
    if grep -qE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]$pattern" "$1" && ! [[ $1 =~ $allowed ]]; then
      complain "$1: includes $pattern, which is wrapped elsewhere"
    fi
  done
}

n_files=0
while read -r file; do
  check_layers "$file"
  check_wrapped "$file"
  n_files=$((n_files + 1))
done < <(find . -mindepth 2 \( -name '*.hpp' -o -name '*.cpp' \) -printf '%P\n' | sort)

echo "$n_files files, $failures findings"
[[ $failures -eq 0 && $n_files -gt 0 ]]
