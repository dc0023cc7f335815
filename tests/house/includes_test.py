#!/usr/bin/env python3
"""Dependencies point one way: reads every #include of the tree and refuses those that a folder may not have."""
import pathlib
import re
import sys

# hal's public headers are included as hal/…, but lie in hal/include/hal; rules name them by where they lie.
HAL = "hal/include/"
# What hardware and software share: the bus, the command list, the registers, and what these are made of.
HAL_BASE = [f"hal/include/hal/{name}" for name in
            ("arena.h", "bus.h", "command_list.h", "crc32.h", "memory_regions.h", "status.h", "vec.h", "registers/")]
# folder -> what its files may include, by the first words of its path. The longest folder that fits rules.
HOSTED = "hosted"  # the whole C++ library and other libraries
# A board puts the firmware together with the software engine; its second program plays the goldens.
BOARD = [HAL, "firmware/", "gfx_subsystem/engine/", "gfx_subsystem/engine_soft/", "boards/", "tests/golden/player/"]
ALLOWED = {
    "hal/include": HAL_BASE + [HAL + "hal/clock.h", HAL + "hal/display.h", HAL + "hal/pins.h"],
    "hal/include/hal/drivers": [HAL],
    "hal": ["hal/"],
    "hal/linux": ["hal/", HOSTED],
    "firmware": [HAL, "firmware/"],
    "gfx_subsystem": HAL_BASE + ["gfx_subsystem/register_file.h"],
    "gfx_subsystem/engine": HAL_BASE + ["gfx_subsystem/engine/", "gfx_subsystem/register_file.h"],
    "gfx_subsystem/engine_soft": HAL_BASE + ["gfx_subsystem/engine/", "gfx_subsystem/engine_soft/"],
    "gfx_subsystem/engine_osmesa": HAL_BASE + ["gfx_subsystem/engine/", "gfx_subsystem/engine_osmesa/", HOSTED],
    "gfx_subsystem/display": HAL_BASE + ["gfx_subsystem/display/", "gfx_subsystem/register_file.h"],
    "sim/image": [HAL, "sim/image/", "sim/common/", HOSTED],
    "sim/common": [HAL, "sim/common/", HOSTED],
    "sim/pack": [HAL, "firmware/", "sim/common/", "sim/pack/", HOSTED],
    "sim/panel": [HAL, "gfx_subsystem/display/video_signal.h", "sim/panel/", "sim/image/", HOSTED],
    "sim": [HAL, "firmware/", "gfx_subsystem/", "sim/", HOSTED],
    "boards": BOARD,
    "boards/linux-arm64": BOARD + ["hal/linux/", HOSTED],
    "tests/golden/player": [HAL, "firmware/", "gfx_subsystem/engine/", "gfx_subsystem/engine_soft/", "boards/common/",
                            "tests/golden/player/"],
}
# What runs on the device uses only these of the standard library: nothing that allocates, throws or needs an OS.
FREESTANDING = {
    "algorithm", "array", "atomic", "bit", "cassert", "cmath", "concepts", "cstddef", "cstdint", "cstring", "limits",
    "new", "span", "string_view", "type_traits", "utility", "charconv", "immintrin.h", "arm_neon.h", "tuple", "iterator",
    "numeric",
}
FOLDERS = ("hal/", "firmware/", "gfx_subsystem/", "sim/", "boards/", "tests/golden/player/")
OURS = ("hal/", "firmware/", "gfx_subsystem/", "sim/", "tests/", "boards/")


def rule_for(folder: str):
    while folder:
        if folder in ALLOWED:
            return ALLOWED[folder]
        folder = folder.rpartition("/")[0]
    return None


def faults_of(root: pathlib.Path):
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.suffix not in (".h", ".cc", ".cpp") or not name.startswith(FOLDERS):
            continue
        allowed = rule_for(name.rpartition("/")[0])
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
            if not match:
                continue
            target = match.group(2)
            if match.group(1) == '"' or target.startswith(OURS):
                if (root / HAL / target).exists():
                    target = HAL + target
                if not target.startswith(tuple(a for a in allowed if a != HOSTED)):
                    yield f"{name}:{number}: includes {target}, which its folder may not know"
            elif HOSTED not in allowed and target not in FREESTANDING:
                yield f"{name}:{number}: includes <{target}>, which the device does not have"


def main():
    root = pathlib.Path(sys.argv[1])
    faults = list(faults_of(root))
    print("\n".join(faults) if faults else "every include points the right way")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
