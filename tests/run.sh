#!/usr/bin/env bash
# Builds and runs every test: `bash tests/run.sh`. Installs what is missing.
#
#   gcc        released build, warnings are errors, all tests, benchmarks are built
#   clang      the same code by another compiler: same goldens, no warning
#   sanitize   the tests again under AddressSanitizer and UndefinedBehaviorSanitizer
#
# `bash tests/run.sh gcc` runs one of them. Build folders are build/<name>.
set -euo pipefail
cd "$(dirname "$0")/.."
stages=("${@:-}")
[ -n "${stages[0]}" ] || stages=(gcc clang sanitize)
bash sim/install.sh tests

jobs=$(nproc)
build_and_test() {  # folder, then CMake options
  local folder=$1
  shift
  local start=$SECONDS
  echo "== $folder: configure and build"
  cmake -S . -B "build/$folder" -DUSUZUMI_WERROR=ON "$@" >"build/$folder.log" 2>&1 || { cat "build/$folder.log"; return 1; }
  cmake --build "build/$folder" -j "$jobs" >>"build/$folder.log" 2>&1 || { tail -n 60 "build/$folder.log"; return 1; }
  echo "== $folder: test (built in $((SECONDS - start)) s)"
  ctest --test-dir "build/$folder" -j "$jobs" --output-on-failure --timeout 600 --no-tests=error | grep -vE '^ *[0-9]+/[0-9]+ Test .*Passed|^ +Start '
  echo "== $folder: done in $((SECONDS - start)) s"
}

mkdir -p build
for stage in "${stages[@]}"; do
  case $stage in
    gcc) build_and_test gcc -DCMAKE_CXX_COMPILER=g++ ;;
    clang) build_and_test clang -DCMAKE_CXX_COMPILER=clang++ ;;
    sanitize) build_and_test sanitize -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Sanitize -DUSUZUMI_SANITIZE=address,undefined -DUSUZUMI_BENCHMARKS=OFF ;;
    *) echo "tests/run.sh: unknown stage $stage; there are gcc, clang and sanitize" >&2; exit 2 ;;
  esac
done
