#!/usr/bin/env bash
# soak.sh [SECONDS [SEED]]: random edits and drags in the real window, on a display of its own, for five minutes unless
# told otherwise; memory, open files and threads must stay level.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install.sh
TARGETS="elastolab soak_program" scripts/build.sh release
DISPLAY='' exec tests/support/with_display.sh build/release/tests/fuzz/soak_program --seconds "${1:-300}" \
  --seed "${2:-$(date +%s)}"
