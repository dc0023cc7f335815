#!/usr/bin/env bash
# install_test.sh BUILD COMPILER GENERATOR VERSION: installs BUILD, moves the tree elsewhere, and uses it as another project
# does: example/ configures, builds and draws the right pictures, and every header compiles alone.
set -euo pipefail
build=$1 compiler=$2 generator=$3 version=$4
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "install_test.sh: $*" >&2; exit 1; }
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "failed: $*"; }; }

quietly cmake --install "$build" --prefix "$work/first"
mv "$work/first" "$work/tree"
tree=$work/tree
for path in bin/usuzumi share/doc/usuzumi/LICENSE share/doc/usuzumi/README.md; do
  [ -s "$tree/$path" ] || fail "$path is not installed"
done
[ "$("$tree/bin/usuzumi" --version)" = "usuzumi $version" ] || fail "bin/usuzumi --version does not say usuzumi $version"
if grep -rnF -e "$build" -e "$source" -e "$work/first" "$tree/lib/cmake" "$tree/include"; then
  fail "the installed files above name folders of the build"
fi

# The example, copied away from the tree so that nothing of it is found by chance.
cp -r "$here/example" "$work/example"
configure=(cmake -G "$generator" "-DCMAKE_CXX_COMPILER=$compiler" "-DCMAKE_PREFIX_PATH=$tree"
           -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_BUILD_TYPE=Release)
quietly "${configure[@]}" -S "$work/example" -B "$work/example-build"
quietly cmake --build "$work/example-build"
commands=$work/example-build/compile_commands.json
grep -q -e '-ffp-contract=off' "$commands" || fail "users of the libraries do not compile with -ffp-contract=off"
if grep -E -e ' -W| -fno-(rtti|exceptions)' "$commands"; then fail "our own compiler options reach users"; fi

# What the pictures must be, from the numbers in example/main.cc: XRGB8888, so the bytes blue, green, red, 255.
python3 - >"$work/expected" <<'PY'
import zlib
WIDTH, HEIGHT = 160, 120
def picture(*boxes):
    inside = lambda x, y: any(x0 <= x < x1 and y0 <= y < y1 for x0, y0, x1, y1 in boxes)
    return b"".join(b"\xff\xff\xff\xff" if inside(x, y) else bytes((96, 32, 16, 255))
                    for y in range(HEIGHT) for x in range(WIDTH))
dial, ornament = (40, 30, 120, 90), (140, 45, 150, 75)
print(f"whole: 2 of 2 meshes, CRC-32 {zlib.crc32(picture(dial, ornament)):08x}")
print(f"thinned: 1 of 2 meshes, CRC-32 {zlib.crc32(picture(dial)):08x}")
PY
"$work/example-build/cluster" >"$work/actual" || fail "the example ended with exit code $?"
diff "$work/expected" "$work/actual" || fail "the example drew other pictures (<: expected, >: drawn)"

# While the major version is 0, another minor version may break callers: it is not found.
sed 's/find_package(usuzumi 0.1/find_package(usuzumi 0.0/' "$work/example/CMakeLists.txt" >"$work/other.txt"
cmp -s "$work/example/CMakeLists.txt" "$work/other.txt" && fail "example/CMakeLists.txt asks for another version than 0.1"
mv "$work/other.txt" "$work/example/CMakeLists.txt"
"${configure[@]}" -S "$work/example" -B "$work/other-build" >"$work/log" 2>&1 && fail "version 0.0 was asked for and found"
grep -q 'compatible with requested version' "$work/log" || { cat "$work/log"; fail "version 0.0 is missed for another reason"; }

# All of hal/include is public, so none of it may be missing; of the other folders, what public headers include.
diff <(cd "$source/hal/include" && find hal -name '*.h' | sort) <(cd "$tree/include/usuzumi" && find hal -name '*.h' | sort) ||
  fail "hal/CMakeLists.txt does not list the public headers above (<: in the tree, >: installed)"

# Every header compiles alone, under a user's warnings, with nothing but the installed tree to include from.
count=0
while read -r header; do
  echo "#include \"$header\"" >"$work/alone.cc"
  quietly "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Werror -I "$tree/include/usuzumi" "$work/alone.cc"
  count=$((count + 1))
done < <(cd "$tree/include/usuzumi" && find . -name '*.h' -printf '%P\n' | sort)
[ "$count" -gt 0 ] || fail "no headers are installed"
echo "the example draws the right pictures against the moved tree; $count headers compile alone"
