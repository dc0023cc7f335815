#!/usr/bin/env bash
# Shows the device at work: builds the simulator, draws two real models whole and thinned, and says what thinning saved.
set -euo pipefail
cd "$(dirname "$0")/.."
models=/usr/share/assimp/models
out=out/demo
usuzumi=build/demo/sim/cli/usuzumi

bash sim/install.sh
echo "Building the simulator in build/demo, which takes two or three minutes on two cores (log: build/demo.log)"
mkdir -p build "$out"
{ cmake --preset demo && cmake --build --preset demo -j "$(nproc)"; } >build/demo.log 2>&1 || { tail -n 40 build/demo.log; exit 1; }

field() { sed -n "s/^ *\"$2\": \"\{0,1\}\([^\",]*\).*/\1/p" "$1" | tail -n 1; }  # the last frame's value in a stats file

draw() {  # name, model file
  local name=$1 model=$2
  $usuzumi pack "$model" --sidecar "sim/demo/$name.json" -o "$out/$name.rom"
  for thin in off on; do
    $usuzumi run "$out/$name.rom" --size 800x480 --thin $thin --out "$out/$thin" --stats "$out/$name-$thin.json" >/dev/null
    mv "$out/$thin/frame-0000.png" "$out/$name-$([ $thin = on ] && echo thinned || echo full).png"
    rmdir "$out/$thin"
  done
  $usuzumi compare "$out/$name-full.png" "$out/$name-thinned.png" --diff "$out/$name-difference.png" >"$out/$name-compare.txt" || [ $? -eq 1 ]
}

draw 2CylinderEngine "$models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"
draw CesiumMilkTruck "$models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf"

echo
echo "What thinning saved, one frame of 800x480 (thinning itself is done once and kept):"
printf '%-15s %13s %17s %19s %26s %9s\n' model "meshes drawn" "faces in RAM" "engine cycles" "device drawing time" thinning
for name in 2CylinderEngine CesiumMilkTruck; do
  full=$out/$name-off.json thinned=$out/$name-on.json
  printf '%-15s %4s -> %5s %7s -> %6s %8s -> %7s %6.2f -> %5.2f ms, -%2d %% %6.1f ms\n' $name \
    "$(field $full meshes_out)" "$(field $thinned meshes_out)" "$(field $full faces_thinned)" "$(field $thinned faces_thinned)" \
    "$(field $full engine_cycles)" "$(field $thinned engine_cycles)" "$(field $full draw_ms)" "$(field $thinned draw_ms)" \
    "$(awk "BEGIN { print int(100 - 100 * $(field $thinned draw_ms) / $(field $full draw_ms) + 0.5) }")" "$(field $thinned thin_ms)"
done
echo
echo "Look at:"
for name in 2CylinderEngine CesiumMilkTruck; do
  for picture in full thinned difference; do echo "  $out/$name-$picture.png"; done
done
