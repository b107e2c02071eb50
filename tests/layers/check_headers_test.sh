#!/usr/bin/env bash
# check_headers.pl finds what a header lacks, and nothing in a sound tree.
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/check_headers.pl
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir "$tree"/{base,mesh}

expect() {  # CODE TEXT: the exit code, and a line of the output
  local output code=0
  output=$(perl "$check" "$tree") || code=$?
  [[ $code -eq $1 && $output == *"$2"* ]] || { echo "expected $1 \"$2\", got $code: $output"; exit 1; }
}
try() {  # TEXT FINDING: a header of this text lacks what is found
  echo "$1" > "$tree/mesh/tried.hpp"
  expect 1 "mesh/tried.hpp: $2"
  rm "$tree/mesh/tried.hpp"
}

expect 1 "0 headers"
echo 'namespace a { class Error { int code; }; double area(int n); constexpr int kMost = 3; struct Later; }' > "$tree/base/error.hpp"
echo '#include "base/error.hpp"' > "$tree/base/all.hpp"
cat > "$tree/mesh/sound.hpp" <<'END'
#include "base/all.hpp"
namespace a {
class Other;                              // vector, Strange: words of a comment
double size(const Other& other, Error e, Later* later, const char* text = "std::vector");
inline double twice(int n = kMost) { return 2 * area(n); }
}
END
expect 0 "3 headers, 0 findings"
try 'std::vector<int> numbers();' 'names std::vector without <vector>'
try 'struct Shape { Error error; };' 'names Error without "base/error.hpp"'
try 'class Fault : public Error {};' 'names Error without'
try 'inline int f() { return kMost; }' 'names kMost without'
try 'inline double f() { return area(3); }' 'calls area() without'
try '#include <Eigen/Core>
Eigen::SparseMatrix<double> matrix();' 'names Eigen::SparseMatrix without'
echo "all found"
