"""The proof that a port is small: this folder's board draws what the simulator draws, its goldens agree, and it has less
than 150 lines."""
import re
import subprocess

from checks import require

FRAMES = 4
MOST_LINES = 150
FLASH = 0x21800000  # as in main.cpp


def printed_with(context, flash):
    done = subprocess.run(
        ["qemu-system-arm", "-M", "mps2-an386", "-nographic", "-monitor", "none",
         "-semihosting-config", "enable=on,target=native", "-device", f"loader,file={flash},addr={FLASH},force-raw=on",
         "-kernel", str(context.build / "boards/board/usuzumi_minimal.elf")],
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
    require(done.returncode == 0, f"exit code {done.returncode}\n{done.stdout}")
    return done.stdout


def run(context):
    folder = context.root / "tests/boards/minimal"
    lines = sum(len(path.read_text().splitlines())
                for path in folder.iterdir() if path.suffix in (".cpp", ".ld", ".cmake", ".txt"))
    require(lines < MOST_LINES, f"the minimal board has {lines} lines; a port is to take less than {MOST_LINES}")
    output = printed_with(context, context.rom)
    crcs = re.findall(r"^frame \d+ picture thinned light=1 crc32=([0-9a-f]{8})", output, re.M)
    expected = [frame["crc32"] for frame in context.expected_frames(FRAMES)]
    require(crcs == expected, f"CRCs {crcs}, the simulator's are {expected}\n{output}")
    context.check_golden(printed_with(context, context.golden_bundle), "cortex-a9")
    return {"crcs": len(crcs), "notes": [f"a port of {lines} lines, on a processor without double precision"]}
