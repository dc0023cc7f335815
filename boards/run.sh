#!/usr/bin/env bash
# Builds the firmware for boards, runs it on QEMU and compares: `bash boards/run.sh` for all, `bash boards/run.sh cortex-m7`
# for one. Installs what is missing; prints a table; ends with 1 where anything differs. run.py says what is compared.
set -euo pipefail
cd "$(dirname "$0")/.."
bash sim/install.sh boards
exec python3 boards/run.py "$@"
