#!/usr/bin/env bash
# Builds and runs every test: `bash tests/run.sh`. Installs what is missing. One of them: `bash tests/run.sh gcc`.
#
#   gcc        released build, warnings are errors, all tests; builds the benchmarks
#   clang      the same code by another compiler: the same goldens, no warning
#   sanitize   the tests again under AddressSanitizer and UndefinedBehaviorSanitizer
#
# These are the presets of CMakePresets.json; what they build lies in build/<name>.
set -euo pipefail
cd "$(dirname "$0")/.."
presets=("$@")
[ ${#presets[@]} -gt 0 ] || presets=(gcc clang sanitize)
for preset in "${presets[@]}"; do
  case $preset in gcc | clang | sanitize) ;; *) echo "tests/run.sh: there is no $preset; there are gcc, clang and sanitize" >&2; exit 2 ;; esac
done
bash sim/install.sh tests

jobs=$(nproc)
mkdir -p build
for preset in "${presets[@]}"; do
  start=$SECONDS
  log=build/$preset.log
  echo "== $preset: building (log: $log)"
  { cmake --preset "$preset" && cmake --build --preset "$preset" -j "$jobs"; } >"$log" 2>&1 || { tail -n 60 "$log"; exit 1; }
  echo "== $preset: built in $((SECONDS - start)) s, testing"
  ctest --preset "$preset" -j "$jobs" | grep -vE '^ *[0-9]+/[0-9]+ Test .* Passed|^ *Start +[0-9]+:'
  echo "== $preset: done in $((SECONDS - start)) s"
done
