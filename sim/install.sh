#!/usr/bin/env bash
# Installs the Debian packages that building needs: `install.sh` for the simulator, `install.sh tests` for the tests and
# benchmarks as well, `install.sh boards` for the boards on QEMU. Says what it installs; does nothing where all is there.
set -euo pipefail

packages=(g++ cmake make libfmt-dev libcli11-dev nlohmann-json3-dev libassimp-dev libtinygltf-dev libpng-dev libjpeg-dev
          libosmesa6-dev assimp-testmodels)
if [ "${1:-}" = tests ]; then
  packages+=(clang libclang-rt-14-dev libgtest-dev libgmock-dev libbenchmark-dev libmeshoptimizer-dev xz-utils binutils python3
             pkg-config libgpiod-dev libdrm-dev)
fi
if [ "${1:-}" = boards ]; then
  packages+=(python3 libgtest-dev libgmock-dev gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib
             g++-aarch64-linux-gnu qemu-system-arm qemu-user-static kmod pkg-config libgpiod-dev:arm64 libdrm-dev:arm64)
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

if ! command -v apt-get >/dev/null; then
  echo "install.sh: this needs Debian's apt-get; install by hand: ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install.sh: run as root, or install by hand: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
# Libraries of another architecture come only where dpkg knows of it.
for package in "${missing[@]}"; do
  [[ $package == *:arm64 ]] || continue
  "${as_root[@]}" dpkg --add-architecture arm64
  break
done
echo "Installing Debian packages: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update -q && \
       "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "install.sh: apt-get failed; its last lines stand above" >&2
  exit 1
fi
