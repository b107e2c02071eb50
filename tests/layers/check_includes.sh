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
  [python]="base mesh elasticity deform findings methods scene"
  [petsc]="base mesh elasticity deform fem methods scene cli"
  [cli]="base mesh elasticity deform findings methods scene study app"
)

# Wrapped libraries: the headers that tell them, and the files that may include them.
wrapped=(
  'assimp/|^mesh/[a-z_/]*\.cpp$'
  '(.*/)?tetgen\.h|^mesh/[a-z_/]*\.cpp$'
  'CGAL/|^mesh/wrap/(cgal_mesh\.hpp|hole_filling\.cpp|wrap_main\.cpp)$'
  '(.*/)?cholmod|^fem/[a-z_/]*\.cpp$'
  'nlohmann/|^(scene/file/json_(text|node)\.hpp|cli/json_parts\.hpp|(scene|study|cli|app)/[a-z_/]*\.cpp)$'
  '(petsc[a-z]*|mpi)\.h|^petsc/[a-z_/]*\.(cpp|hpp)$'
  'CLI/|^(cli|petsc)/[a-z_/]*\.cpp$'
  '(GL|GLES2|GLES3|glad|EGL|epoxy)/|^(render|app)/[a-z_/]*\.(cpp|hpp)$'
  'GLFW/|^(app|cli)/[a-z_/]*\.(cpp|hpp)$'
  'spnav\.h|^app/window/six_axis_mouse\.cpp$'
  'X11/|^app/window/touch_screen\.cpp$'
  'imgui|^app/[a-z_/]*\.(cpp|hpp)$'
  # Eigen's factorisations take seconds to compile, in every unit: these files need them, for few rows and many times.
  'Eigen/(Dense|QR|Householder)|^$'
  'Eigen/Eigenvalues|^(elasticity/(neo_hookean|stress)|fem/nodal_field)\.cpp$'
  'Eigen/SVD|^(elasticity/(neo_hookean|rotation)|bem/hierarchical/low_rank)\.cpp$'
  '(cblas|lapacke|openblas_config)\.h|^(base|elasticity|fem|bem|deform)/[a-z_/]*\.cpp$'
)

failures=0
complain() { echo "$1"; failures=$((failures + 1)); }

# "file:<name" or "file:"name" of every include of our sources.
all=$(grep -rsHoE --include='*.[ch]pp' '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"][^">]*' ./*/ |
  sed -E 's|^\./+||; s|^([^:]*):[^"<]*|\1:|' | sort || true)
includes() { grep -oE "^[^:]*:$1" <<< "$all" || true; }  # PATTERN: those that begin like this, as far as they match

while read -r layer; do
  [[ -n ${below[$layer]+known} ]] || complain "$layer: is no known layer"
done < <(find . -mindepth 2 -name '*.[ch]pp' -printf '%P\n' | cut -d/ -f1 | sort -u)

while IFS=: read -r file included; do
  layer=${file%%/*} included=${included//[\"\/]/}
  [[ $included == "$layer" || " ${below[$layer]-} " == *" $included "* ]] || complain "$file: includes $included/..."
done < <(includes '"[a-z_]+/')

# Among the folders of a layer arrows go one way too: what two need lies in the layer itself, or in a third.
in_circles=$(includes '"[a-z_]+/[a-z_]+/' | sed -E 's|^(.*)/[^/:]*:"(.*)/$|\1 \2|' |
  awk '{ n = split($1, from, "/"); split($2, to, "/") } n > 1 && from[1] == to[1] && $1 != $2' |
  tsort 2>&1 >/dev/null | sed -n 's/^tsort: \([a-z].*\)/\1/p' | sort -u) || true
for layer in $(cut -d/ -f1 <<< "$in_circles" | sort -u); do
  complain "$layer: folders include each other in a circle: $(grep "^$layer/" <<< "$in_circles" | tr '\n' ' ')"
done

# The registry names methods; what else they have stays in their folders.
while IFS=: read -r file included; do
  [[ $file != methods/*.hpp ]] || complain "$file: hands on $included..."
done < <(includes '"(fem|bem)/')

for entry in "${wrapped[@]}"; do
  pattern=${entry%|^*} allowed="^${entry##*|^}"
  while IFS=: read -r file _; do
    [[ $file =~ $allowed ]] || complain "$file: includes $pattern, which is wrapped elsewhere"
  done < <(includes "[<\"]$pattern")
done

n_files=$(find . -mindepth 2 -name '*.[ch]pp' | wc -l)
echo "$n_files files, $failures findings"
[[ $failures -eq 0 && $n_files -gt 0 ]]
