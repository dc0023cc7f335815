#!/bin/bash
# Makes today's pictures the goldens: bash tests/golden/approve.sh [NAME...]
# Builds, rewrites manifest and the PNGs of those whose names begin so (of all, without names), and prints what
# changed.
# Look at the new pictures before you commit them. README.md beside this file says more.
set -euo pipefail
cd "$(dirname "$0")/../.."

build=${USUZUMI_BUILD:-build/golden}
cmake -S . -B "$build" -DUSUZUMI_BENCHMARKS=OFF > /dev/null
cmake --build "$build" --target usuzumi_golden_approve --parallel > "$build/approve.log" 2>&1 || { cat "$build/approve.log" >&2; exit 1; }
"$build/tests/golden/usuzumi_golden_approve" "$@"
