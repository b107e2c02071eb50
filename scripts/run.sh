#!/usr/bin/env bash
# run.sh [ARGUMENTS]: installs what is missing, builds, and runs elastolab with the arguments.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/install.sh" >&2
TARGETS=elastolab "$root/scripts/build.sh" release >&2
exec "$root/build/release/bin/elastolab" "$@"
