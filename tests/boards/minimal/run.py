"""The proof that a port is small: this folder's board draws what the simulator draws, and has less than 150 lines."""
import re
import subprocess

FRAMES = 4
MOST_LINES = 150
FLASH = 0x21800000  # as in main.cpp


def run(context):
    folder = context.root / "tests/boards/minimal"
    lines = sum(len(path.read_text().splitlines())
                for path in folder.iterdir() if path.suffix in (".cpp", ".ld", ".cmake", ".txt"))
    if lines >= MOST_LINES:
        raise AssertionError(f"the minimal board has {lines} lines; a port is to take less than {MOST_LINES}")
    output = subprocess.run(
        ["qemu-system-arm", "-M", "mps2-an386", "-nographic", "-monitor", "none",
         "-semihosting-config", "enable=on,target=native",
         "-device", f"loader,file={context.rom},addr={FLASH},force-raw=on",
         "-kernel", str(context.build / "boards/board/usuzumi_minimal")],
        stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60, check=True)
    printed = re.findall(r"^frame \d+ picture thinned light=1 crc32=([0-9a-f]{8})", output.stdout + output.stderr, re.M)
    expected = [frame["crc32"] for frame in context.expected_frames(FRAMES)]
    if printed != expected:
        raise AssertionError(f"CRCs {printed}, the simulator's are {expected}\n{output.stdout}{output.stderr}")
    return {"crcs": len(printed), "notes": [f"a port of {lines} lines, on a processor without double precision"]}
