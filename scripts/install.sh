#!/usr/bin/env bash
# install.sh [PACKAGE...]: installs what the program is built from and with, and these packages: from Debian, only those
# that are missing.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libeigen3-dev libopenblas-dev liblapacke-dev libsuitesparse-dev libxsimd-dev
  libassimp-dev libtet1.5-dev libcgal-dev libgmp-dev libmpfr-dev nlohmann-json3-dev libcli11-dev
  libglfw3-dev libimgui-dev libepoxy-dev libstb-dev libfontconfig-dev libxi-dev libspnav-dev
  libgl1-mesa-dri fonts-roboto-unhinted gnuplot-nox
  xvfb xdotool libx11-dev xserver-xorg-core xserver-xorg-video-dummy
  libgtest-dev libgmock-dev libbenchmark-dev
  pybind11-dev python3-dev python3-numpy python3-pytest python3-distributed python3-vtk9 mypy python3-mypy chromium "$@"
)

is_installed() { dpkg-query --show --showformat='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
command -v ffmpeg >/dev/null || echo "Films become videos where ffmpeg is installed: scripts/install.sh ffmpeg"
if [[ ${#missing[@]} -eq 0 ]]; then exit 0; fi

as_root=()
if [[ $(id -u) -ne 0 ]]; then as_root=(sudo); fi
echo "Installing: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
