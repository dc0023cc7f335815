#!/usr/bin/env bash
# Builds and runs every test: `bash tests/run.sh`. Installs what is missing. One of them: `bash tests/run.sh gcc`.
#
#   gcc        released build, warnings are errors, all tests; builds the benchmarks
#   clang      the same code by another compiler: the same goldens, no warning
#   sanitize   the tests again under AddressSanitizer and UndefinedBehaviorSanitizer
#   boards     the firmware of every board on QEMU (boards/run.sh)
#
# The first three are the presets of CMakePresets.json; what they build lies in build/<name>.
set -euo pipefail
cd "$(dirname "$0")/.."
parts=("$@")
[ ${#parts[@]} -gt 0 ] || parts=(gcc clang sanitize boards)
for part in "${parts[@]}"; do
  case $part in gcc | clang | sanitize | boards) ;;
    *) echo "tests/run.sh: there is no $part; there are gcc, clang, sanitize and boards" >&2; exit 2 ;;
  esac
done
bash sim/install.sh tests

jobs=$(nproc)
mkdir -p build

run_preset() {
  local preset=$1 start=$SECONDS log=build/$1.log
  echo "== $preset: building (log: $log)"
  { cmake --preset "$preset" && cmake --build --preset "$preset" -j "$jobs"; } >"$log" 2>&1 || { tail -n 60 "$log"; exit 1; }
  echo "== $preset: built in $((SECONDS - start)) s, testing"
  ctest --preset "$preset" -j "$jobs" | grep -vE '^ *[0-9]+/[0-9]+ Test .* Passed|^ *Start +[0-9]+:'
  echo "== $preset: done in $((SECONDS - start)) s"
}

run_boards() {
  local start=$SECONDS host=build/boards/host
  if ! bash sim/install.sh boards; then
    echo "*****************************************************************************************************" >&2
    echo "** boards: NOT TESTED. QEMU or a cross compiler cannot be installed here; the reason stands above. **" >&2
    echo "*****************************************************************************************************" >&2
    return
  fi
  [ -x build/gcc/sim/cli/usuzumi ] && host=build/gcc  # built already
  python3 boards/run.py --host-build "$host"
  echo "== boards: done in $((SECONDS - start)) s"
}

for part in "${parts[@]}"; do
  if [ "$part" = boards ]; then run_boards; else run_preset "$part"; fi
done
