#!/usr/bin/env bash
# try_packages.sh [BUILD]: makes the Debian packages of a build (default build/release) and tries them in a clean root of
# Debian 12: installs them, runs the program, the Python module and an outside project, and removes them without a trace.
# Needs root, debootstrap, lintian, appstream and desktop-file-utils, and Debian's archive. The root is kept for the next
# time in $ELASTOLAB_CLEAN_ROOT (default: a temporary folder, removed at the end).
# shellcheck disable=SC2016  # what the inner shells expand
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
work=$(mktemp -d)
base=${ELASTOLAB_CLEAN_ROOT:-$work/base}
root=$work/root
cleanup() {
  for place in proc dev/null; do mountpoint -q "$root/$place" && umount "$root/$place"; done
  rm -rf "$work"
}
trap cleanup EXIT

scripts/install.sh dpkg-dev file debootstrap lintian appstream desktop-file-utils
echo "Packages"
(cd "$build" && rm -rf packages && cpack -B "$build/packages" >"$work/cpack.log" 2>&1) || { cat "$work/cpack.log"; exit 1; }
rm -rf "$build/packages/_CPack_Packages"
ls -l "$build/packages"
lintian --fail-on error --tag-display-limit 0 "$build"/packages/*.deb
for package in "$build"/packages/elastolab_*.deb; do dpkg-deb -x "$package" "$work/files"; done
desktop-file-validate "$work"/files/usr/share/applications/*.desktop
appstreamcli validate --no-net "$work"/files/usr/share/metainfo/*.xml

echo "Clean root"
if [[ ! -x $base/usr/bin/apt-get ]]; then debootstrap --variant=minbase bookworm "$base" >"$work/debootstrap.log"; fi
cp -a "$base" "$root"
if [[ -f /etc/apt/sources.list.d/debian.sources ]]; then  # that of this machine, with security updates
  cp /etc/apt/sources.list.d/debian.sources "$root/etc/apt/sources.list.d/"
  rm -f "$root/etc/apt/sources.list"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
mount -t proc proc "$root/proc"
inside() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"; }
inside apt-get update -qq
mkdir "$root/packages"
cp "$build"/packages/*.deb "$root/packages"
echo "Installing"
inside sh -c 'apt-get install -y -qq --no-install-recommends /packages/*.deb cmake make >/tmp/install.log 2>&1 || { cat /tmp/install.log; exit 1; }'

echo "Running"
inside elastolab --version
cat >"$root/tmp/cube.elastolab.json" <<'END'
{ "elastolab": 1, "mesh": { "primitive": "cube", "resolution": 4 }, "method": "quadratic-fem",
  "material": { "young_modulus": 1000, "poisson_ratio": 0.3 },
  "fixed": { "plane": { "point": [0, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-6 } },
  "handles": [{ "select": { "plane": { "point": [1, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-6 } }, "translate": [0.1, 0, 0] }] }
END
inside elastolab solve /tmp/cube.elastolab.json --quiet --displacements /tmp/u.csv --mesh-out /tmp/cube.obj
inside elastolab info /tmp/cube.obj --json >/dev/null                      # by the import helper
inside elastolab solve /usr/share/elastolab/scenes/hand.json --quiet --method fem --displacements /tmp/hand.csv
inside python3 - <<'END'
import numpy as np, elastolab as el
u = el.solve("/tmp/cube.elastolab.json").displacement
of_program = np.loadtxt("/tmp/u.csv", delimiter=",", skiprows=1)[:, 4:]
assert np.abs(u - of_program).max() < 1e-12, np.abs(u - of_program).max()
assert el.Proxy(el.Surface.load("/tmp/cube.obj"), 100).surface.report.usable    # by the wrapping helper
print("Python", el.__version__)
END
mkdir "$root/tmp/project"
for part in "cmake CMakeLists.txt" "cpp pull.cpp"; do
  awk -v fence="\`\`\`${part% *}" '$0 == fence { on = 1; text = ""; next } $0 == "```" { on = 0 } on { text = text $0 "\n" } END { printf "%s", text }' \
    docs/library.md >"$root/tmp/project/${part#* }"
done
inside sh -c 'cd /tmp/project && cmake -B build >log 2>&1 && cmake --build build >>log 2>&1 && build/pull || { cat log; exit 1; }'
inside test -s /usr/share/man/man1/elastolab-solve.1.gz
inside bash -c '. /usr/share/bash-completion/completions/elastolab; COMP_WORDS=(elastolab so); COMP_CWORD=1; _elastolab; [[ ${COMPREPLY[*]} == solve ]]'
inside apt-get install -y -qq --no-install-recommends zsh fish shared-mime-info >/dev/null 2>&1
[[ $(inside fish -c "complete -C 'elastolab so'") == solve ]]
inside zsh -fc 'autoload -Uz compinit && compinit -u -D && [[ $_comps[elastolab] == _elastolab ]] && autoload -Uz +X _elastolab &&
  compadd() { shift; print -rl -- $@ } && words=(elastolab solve --dis) && CURRENT=3 && _elastolab' | grep -qx -- --displacements
# File managers: each kind of file of the thumbnailer is known, and its command makes a picture.
entry=$root/usr/share/thumbnailers/elastolab.thumbnailer
for type in $(sed -n 's/^MimeType=//p' "$entry" | tr ';' ' '); do
  grep -qx "$type" "$root/usr/share/mime/types" || { echo "thumbnailer: $type is no known type"; exit 1; }
done
for file in cube.elastolab.json cube.obj; do
  inside sh -c "$(sed -n 's/^Exec=//p' "$entry" | sed "s,%s,128,; s,%i,/tmp/$file,; s,%o,/tmp/$file.png,")"
  inside test -s "/tmp/$file.png"
done

echo "Removing"
inside apt-get purge -y -qq elastolab libelastolab-dev python3-elastolab >/dev/null 2>&1
left=$(inside find / -xdev -path /proc -prune -o -iname '*elastolab*' -not -path '/packages/*' -not -path '/tmp/*' -print)
[[ -z $left ]] || { echo "Left behind: $left"; exit 1; }
inside dpkg --audit
echo "All packages install, run and leave nothing behind."
