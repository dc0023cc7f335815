"""The cortex-a9 board on QEMU's realview-pbx-a9: its panel, its pins and its mistakes, held against the simulator.

Virtual time is counted in instructions, two nanoseconds each (-icount shift=1), so that no time measured here depends
on the machine that runs QEMU, but for moments in which the board sleeps.
"""
import pathlib
import re
import struct
import subprocess
import time

import pictures
import qemu
from checks import require

FRAMES = 8           # of a turn around the model
NS_PER_INSTRUCTION = 2
ROM_ADDRESS, RAM_ADDRESS, RAM_BYTES = 0x02000000, 0x00800000, 8 << 20     # link.ld
STACK_ADDRESS, STACK_BYTES = 0x00100000, 64 << 10
IGNITION, MODE, BACKLIGHT = 0, 1, 4     # lines of GPIO 0; ignition is active low (memory_map.h)
WAKE_FRAMES = 2      # firmware/instrument: from a picture drawn to the light
FRAME_US = 16_667
REPORT_US = 40_000   # the line behind each step, nearly all of it the CRC-32 of the picture
# Budgets of the truck's frames: what it takes today and an eighth more, of code 5 %. Who exceeds one finds out why, then
# raises it. Code: the engine 210 KB (kernels of three texel fetches, each a copy for NEON), four methods of thinning with
# textures and seams 111 KB, layers 23 KB, solids 20 KB. Instructions: every pixel of the truck is four texels, its floats
# lane by lane.
CODE_BUDGET, RAM_BUDGET, INSTRUCTION_BUDGET = 494_000, 1_550_000, 70_200_000


def fields_of(line):
    """The words NAME=NUMBER of a board's line."""
    return {name: int(value) for name, value in re.findall(r"(\w+)=(\d+)(?= |$)", line)}


def lights_of(board):
    """Levels that the backlight's line has taken since it was last asked for."""
    return [level for line, level in board.output_events() if line == BACKLIGHT]


def crc_of(line):
    return re.search(r"crc32=([0-9a-f]{8})", line).group(1)


class Bench:
    """Starts the board's programs; what they leave lies in context.work."""

    def __init__(self, context):
        self.context = context
        self.folder = next(iter(context.build.rglob("usuzumi-cortex-a9.elf")), None)
        require(self.folder, f"no usuzumi-cortex-a9.elf below {context.build}; build the board first")
        self.folder = self.folder.parent

    def elf(self, program=""):
        return self.folder / f"usuzumi-cortex-a9{program}.elf"

    def machine(self, options="", rom=None, program="", debugger=True, timeout_s=120):
        command = ["qemu-system-arm", "-M", "realview-pbx-a9", "-m", "512", "-icount", "shift=1",
                   "-kernel", self.elf(program)]
        if debugger:
            command += ["-semihosting-config", "enable=on,target=native", "-append", options]
        if rom is not None:
            command += ["-device", f"loader,file={rom},addr={ROM_ADDRESS:#x},force-raw=on"]
        return qemu.Qemu(command, qtest=True, timeout_s=timeout_s)


def compare_step(board, line, expected, folder, name, rgb565=False):
    """A step's line and the panel against the simulator's record of the same step."""
    words = line.split()
    shown, mode, light = words[2], words[3], fields_of(line)["light"]
    wanted = (expected["shown"], expected["mode"], int(expected["backlight"]))
    require((shown, mode, light) == wanted, f"{name}: {(shown, mode, light)}, the simulator has {wanted}: {line}")
    require(crc_of(line) == expected["crc32"], f"{name}: CRC-32 {crc_of(line)}, the simulator's is {expected['crc32']}")
    picture = pictures.read_png(expected["png"])
    pictures.compare(pictures.shifted_565(picture) if rgb565 else picture, board.screendump(), folder, name)


# ---- what is shown --------------------------------------------------------------------------------------------------


def turn(bench, name, options, expected, rgb565=False):
    """A turn around the model, frame by frame. Its lines, and the machine's memory use at its end."""
    lines = []
    with bench.machine(f"--frames {len(expected)} --orbit --hold {options}", bench.context.rom) as board:
        board.resume()
        for record in expected:
            line = board.wait_for_line(f"frame {record['frame']} ")
            compare_step(board, line, record, bench.context.work, f"{name}-{record['frame']:04}", rgb565)
            lines.append(line)
            if record is expected[-1]:
                memory = touched_memory(board)
            board.send(b"s")
        code = board.wait_exit()
        require(code == 0, f"{name}: exit code {code}, not 0")
        # The clock's counter wraps meanwhile (sp804.h), which would show as an hour.
        first = fields_of(lines[0])
        drawn = first["thin_us"] + first["draw_us"]
        require(0 < drawn < 1_000_000, f"{name}: the first frame took {drawn} us")
        require(drawn < first["wake_us"] < drawn + 1_000_000, f"{name}: woke in {first['wake_us']} us")
        return lines, memory, board.console_lines[0]


def touched_memory(board):
    """Bytes of the work area and of the stack that are no longer as reset left them, which is zero."""
    def image(address, size):
        path = board.folder / "memory"
        board.qmp("pmemsave", val=address, size=size, filename=str(path))
        return path.read_bytes()
    ram, stack, page = image(RAM_ADDRESS, RAM_BYTES), image(STACK_ADDRESS, STACK_BYTES), 256
    work = sum(page for at in range(0, RAM_BYTES, page) if any(ram[at:at + page]))
    unused = len(stack) - len(stack.lstrip(b"\0"))
    return {"work": work, "stack": STACK_BYTES - unused}


# ---- what the pins do -----------------------------------------------------------------------------------------------

# Before the step of that number: level of ignition and button, as `usuzumi run --gpio` has them. The presses are four
# steps apart, for the firmware takes a second one within 50 ms for a bounce.
SCRIPT = {0: {"ignition": 1}, 2: {"mode": 1}, 3: {"mode": 0}, 7: {"mode": 1}, 8: {"mode": 0}, 12: {"mode": 1},
          13: {"mode": 0}, 17: {"ignition": 0}, 19: {"ignition": 1}}
SCRIPT_STEPS = 21


def apply(board, gpio, changes):
    for name, level in changes.items():
        board.set_input(gpio, MODE if name == "mode" else IGNITION, level if name == "mode" else 1 - level)


def panel_powered(board):
    """LCDPWR of LCDControl, without which the colour lines are low, whatever is in the picture."""
    return int(board.qtest("readl 0x10020018"), 16) >> 11 & 1 == 1


def pins_step_by_step(bench):
    """The button's modes and the ignition, every step as the simulator has it. A press that is over before the next
    step counts too: the last one is such."""
    script = ",".join(f"{step}:{name}={level}" for step, changes in SCRIPT.items() for name, level in changes.items())
    expected = bench.context.expected_frames(SCRIPT_STEPS, "--gpio", script)
    modes = {record["mode"] for record in expected}
    require(modes == {"full", "thinned", "budget"}, f"the script does not come through all modes, but {modes}")
    with bench.machine(f"--frames {SCRIPT_STEPS} --orbit --hold", bench.context.rom) as board:
        gpio = board.paths_of("pl061")[0]
        board.watch_outputs(gpio)
        lights = []
        for record in expected:
            step = record["frame"]
            apply(board, gpio, SCRIPT.get(step, {}))
            if step == 12:
                apply(board, gpio, SCRIPT[13])  # up again before anybody has looked
            if step == 0:
                board.resume()
            else:
                lights += lights_of(board)
                if SCRIPT.get(step) == {"ignition": 0}:
                    wait_for(lambda: lights.extend(lights_of(board)) or lights[-1] == 0,
                             "the light waits for a step when the ignition goes off")
                    wait_for(lambda: not panel_powered(board),
                             "the panel's colours wait for a step when the ignition goes off")
                board.send(b"s")
            line = board.wait_for_line(f"frame {step} ")
            compare_step(board, line, record, bench.context.work, f"pins-{step:04}")
        lights += lights_of(board)
        board.send(b"s")
        require(board.wait_exit() == 0, "pins: the exit code is not 0")
    changes = [event for i, event in enumerate(lights) if i == 0 or event != lights[i - 1]]
    require(changes == [1, 0, 1], f"the backlight's line went {changes}, not on, off and on again")
    return len(expected)


def ignition_off(board, gpio):
    """The times of the board's line; light and panel are dark."""
    apply(board, gpio, {"ignition": 0})
    off = fields_of(board.wait_for_line("ignition 0 "))
    require(pictures.is_black(board.screendump()), "ignition off: the panel is not black")
    require(lights_of(board)[-1] == 0, "ignition off: the backlight's line is not low")
    require(off["vcompares"] == 1, f"ignition off: black {off['vcompares']} vertical compares after its painting")
    return off


def ignition_on(board, gpio):
    """The same, with the drawing's times; a picture is lit."""
    apply(board, gpio, {"ignition": 1})
    woken = board.wait_for_line("frame ")
    while "wake_us=" not in woken:
        woken = board.wait_for_line("frame ")
    on = fields_of(board.wait_for_line("ignition 1 "))
    require(" picture " in woken and " light=1 " in woken, f"ignition on: no picture is lit: {woken}")
    require(lights_of(board)[-1] == 1, "ignition on: the backlight's line is not high")
    require(on["vcompares"] == WAKE_FRAMES,
            f"ignition on: light {on['vcompares']} vertical compares after the picture, not {WAKE_FRAMES}")
    return {**fields_of(woken), **on}


def pins_running(bench):
    """How fast light and panel follow the ignition while the instrument runs freely. A host that stalls while the board
    sleeps makes virtual time longer, never shorter: the shortest of a few counts."""
    offs, ons = [], []
    with bench.machine("--orbit", bench.context.rom) as board:
        gpio = board.paths_of("pl061")[0]
        board.watch_outputs(gpio)
        board.resume()
        board.wait_for_line("frame 2 ")
        for _ in range(4):
            board.wait_for_line("frame ")
            offs.append(ignition_off(board, gpio))
            ons.append(ignition_on(board, gpio))
        pictures = [fields_of(line) for line in board.console_lines if " picture " in line]
    drawing = max(f["thin_us"] + f["draw_us"] for f in pictures[1:])
    off_light, off_black = (min(f[name] for f in offs) for name in ("light_us", "black_us"))
    on_light, wake = (min(f[name] for f in ons) for name in ("light_us", "wake_us"))
    # A drawing or a report ends first; then black is painted and waits for the next blank.
    off_bound = max(drawing, FRAME_US + REPORT_US) + 2 * FRAME_US
    wake_bound = drawing + (WAKE_FRAMES + 1) * FRAME_US
    for what, value, bound in (("light off", off_light, FRAME_US), ("black", off_black, off_bound),
                               ("light on", on_light, wake_bound + REPORT_US), ("wake_us", wake, wake_bound)):
        require(value <= bound, f"ignition: {what} after {value} us, over {bound}")
    slowest = max(f["light_us"] for f in offs)
    return (f"ignition off: light off after at most {slowest} us, black sent after {off_black} us, a vertical "
            f"compare after it was painted",
            f"ignition on: lit after {on_light} us, {WAKE_FRAMES} vertical compares after a drawing of {drawing} us; "
            f"wake_us={wake}")


# ---- what goes wrong ------------------------------------------------------------------------------------------------


def bad_input(bench):
    """Each gives one line and its exit code; with a display there is the safe picture, without one no light."""
    context = bench.context
    image, folder = context.rom.read_bytes(), context.work / "bad"
    folder.mkdir(exist_ok=True)

    def file_of(name, data):
        (folder / name).write_bytes(data)
        return folder / name

    damaged = bytearray(image)
    damaged[len(image) // 2] ^= 1
    foreign = folder / "foreign.rom"
    source = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf"
    subprocess.run([context.usuzumi, "pack", source, "--board", "cortex-m7", "-o", foreign], check=True, timeout=60,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    cases = [  # name, image, options, exit code, words of the line, the safe picture is lit
        ("no image", None, "", 3, "", True),
        ("truncated image", file_of("truncated.rom", image[:len(image) // 2]), "", 3, "", True),
        ("damaged image", file_of("damaged.rom", damaged), "", 3, "CRC", True),
        ("image that is none", file_of("text.rom", b"not an image\n" * 100), "", 3, "", True),
        ("image for another board", foreign, "", 3, "another board", True),
        ("width of no sixteens", context.rom, "--size 808x480", 5, "steps of 16", False),
        ("picture too wide", context.rom, "--size 1040x480", 5, "1024 pixels", False),
        ("picture too high", context.rom, "--size 800x1025", 5, "1024 lines", False),
        ("option that is none", context.rom, "--colour", 2, "--colour is wrong", False)]
    safe = context.expected_frames(1, "--fault", "0:engine-hang=1")[0]
    require(safe["shown"] == "safe", f"the simulator shows {safe['shown']} where the engine hangs")
    for name, rom, options, code, words, lit in cases:
        with bench.machine(f"--frames 2 --hold {options}", rom) as board:
            board.watch_outputs(board.paths_of("pl061")[0])
            board.resume()
            line = board.wait_for_line("error: ")
            require(words in line, f"{name}: '{words}' is not in: {line}")
            if lit:
                wait_for(lambda: 1 in lights_of(board), f"{name}: the safe picture is not lit")
                name_of_files = f"safe-{name.replace(' ', '-')}"
                pictures.compare(pictures.read_png(safe["png"]), board.screendump(), context.work, name_of_files)
            if code != 2:  # with wrong options it does not come to a step
                board.send(b"s")
            got = board.wait_exit()
            require(got == code, f"{name}: exit code {got}, not {code}")
            words = [said for said in board.console_lines if not said.startswith("ignition ")]
            require(words == [line], f"{name}: more than one line: {board.console_lines}")
            require(lit or not lights_of(board), f"{name}: the backlight went on")
    return len(cases)


def wait_for(condition, text, timeout_s=20):
    end = time.monotonic() + timeout_s
    while not condition():
        require(time.monotonic() < end, text)
        time.sleep(0.02)


DEEDS = {"read-null": r"fault: data abort at 0x00000000, status 0x[0-9a-f]{8}, pc 0x001",
         "write-rom": r"fault: data abort at 0x02000000, status 0x0000080d",  # a write without permission
         "leave-memory": r"fault: data abort at 0x50000000",
         "misalign": r"fault: data abort at 0x00800002, status 0x00000001",   # alignment
         "run-data": r"fault: prefetch abort at 0x00800000, status 0x0000000d, pc 0x00800000",
         "undefined": r"fault: undefined instruction, pc 0x001",
         "overflow-stack": r"fault: data abort at 0x000ff"}


def traps(bench):
    """What a program must not do is caught: one line, the light goes off, exit code 70."""
    for deed, pattern in DEEDS.items():
        with bench.machine(deed, program="-traps") as board:
            board.watch_outputs(board.paths_of("pl061")[0])
            board.resume()
            code = board.wait_exit()
            lines = board.console_lines
            require(len(lines) == 1 and re.match(pattern, lines[0]), f"{deed}: {lines} instead of {pattern}")
            require(code == 70, f"{deed}: exit code {code}, not 70")
            require(lights_of(board) == [1, 0], f"{deed}: the light does not go on and off")
    with bench.machine("keep-floats", program="-traps") as board:
        board.resume()
        board.wait_exit()
        require(board.console_lines == ["floats are kept"], f"an interrupt spoils floats: {board.console_lines}")
    return len(DEEDS)


def without_debugger(bench, safe_png):
    """On a board that nobody watches semihosting is refused: the instrument runs for ever, a missing image leaves the
    safe picture lit, a trap says its words on the console and is dark."""
    with bench.machine(rom=bench.context.rom, debugger=False) as board:
        board.resume()
        board.wait_for_line("frame 2 picture thinned light=1")
    with bench.machine(debugger=False) as board:
        board.watch_outputs(board.paths_of("pl061")[0])
        board.resume()
        board.wait_for_line("error: ")
        wait_for(lambda: 1 in lights_of(board), "without a debugger: the safe picture is not lit")
        time.sleep(0.3)  # the exit is refused by now
        require(0 not in lights_of(board), "without a debugger: the safe picture's light goes off")
        pictures.compare(pictures.read_png(safe_png), board.screendump(), bench.context.work, "safe-without-debugger")
    with bench.machine(program="-traps", debugger=False) as board:
        board.watch_outputs(board.paths_of("pl061")[0])
        board.resume()
        board.wait_for_line("trap: operator new: there is no heap, called from 0x001")
        lights = []
        wait_for(lambda: lights.extend(lights_of(board)) or lights == [1, 0], "without a debugger: a trap stays lit")


def goldens(bench):
    """The cases of tests/golden, as the manifest has them."""
    with bench.machine(rom=bench.context.golden_bundle, program="-goldens", timeout_s=300) as board:
        board.resume()
        code = board.wait_exit(300)
        output = "\n".join(board.console_lines) + "\n"
    bench.context.check_golden(output)
    require(code == 0, f"goldens: exit code {code}, not 0")


# ---- how large it is ------------------------------------------------------------------------------------------------


def section_sizes(elf):
    """Bytes of each section that is in memory, by name."""
    data = pathlib.Path(elf).read_bytes()
    at, entry, count, names = struct.unpack_from("<I", data, 32)[0], *struct.unpack_from("<HHH", data, 46)
    headers = [struct.unpack_from("<10I", data, at + i * entry) for i in range(count)]
    text = headers[names][4]
    return {data[text + h[0]:data.index(b"\0", text + h[0])].decode(): h[5] for h in headers if h[2] & 2}


def check_no_neon_floats(elf):
    """NEON of a Cortex-A9 flushes denormals to zero, so GCC must not compute with it. Constants (vmov) and conversions
    to and from integers (vcvt) are the same without denormals, and allowed."""
    code = subprocess.run(["arm-none-eabi-objdump", "-d", elf], check=True, timeout=60, capture_output=True, text=True)
    used = re.findall(r"\t(v(?!mov|cvt)[a-z]+\.f32\t[qd]\d+.*)", code.stdout)
    require("vmul.f32\ts" in code.stdout, f"no float arithmetic is seen in {elf}: does objdump spell it otherwise?")
    require(not used, f"NEON computes floats in {elf}: {used[:3]}")


def check_no_heap(map_file):
    used = [name for name in ("malloc", "_malloc_r", "free", "_sbrk", "_sbrk_r", "calloc", "realloc")
            if re.search(rf"^ +0x[0-9a-f]+ +{name}$", map_file.read_text(), re.MULTILINE)]
    require(not used, f"a heap is in the program: {', '.join(used)}; see {map_file}")


def run(context):
    start = time.monotonic()
    bench = Bench(context)
    check_no_heap(bench.elf().with_suffix(".map"))
    check_no_neon_floats(bench.elf("-goldens"))

    expected = context.expected_frames(FRAMES)
    lines, memory, _ = turn(bench, "xrgb8888", "", expected)
    compared = len(lines)
    expected = context.expected_frames(FRAMES, "--format", "rgb565")
    lines_565, _, boot_565 = turn(bench, "rgb565", "--rgb565", expected, rgb565=True)
    require("rgb565 depth=24" in boot_565, f"not what was asked for: {boot_565}")
    # 1024 x 1024 leaves no room for more than 16 bits a pixel: the simulator and the board come to that by themselves.
    expected = context.expected_frames(2, "--size", "1024x1024")
    lines_short, _, boot_short = turn(bench, "vram-short", "--size 1024x1024", expected, rgb565=True)
    require("rgb565 depth=16" in boot_short and "VRAM is short" in boot_short, f"VRAM is not said short: {boot_short}")
    compared += len(lines_565) + len(lines_short)

    compared += pins_step_by_step(bench)
    notes = list(pins_running(bench))
    cases = bad_input(bench)
    deeds = traps(bench)
    without_debugger(bench, context.expected_frames(1, "--fault", "0:engine-hang=1")[0]["png"])

    goldens(bench)

    sizes = section_sizes(bench.elf())
    code = sum(size for name, size in sizes.items() if name not in (".stack", ".bss", ".table", ".work"))
    ram = sum(sizes[name] for name in (".stack", ".data", ".bss", ".table", ".work")) + memory["work"]
    steady = [fields_of(line) for line in lines[1:]]
    instructions = sum(f["thin_us"] + f["draw_us"] for f in steady) * 1000 // NS_PER_INSTRUCTION // len(steady)
    for what, value, budget in (("code", code, CODE_BUDGET), ("RAM", ram, RAM_BUDGET),
                                ("instructions a frame", instructions, INSTRUCTION_BUDGET)):
        require(value <= budget, f"{what}: {value} is over the budget of {budget}; find out why, then raise it here")
    first = fields_of(lines[0])
    notes.append(f"{compared} panels equal, XRGB8888 and RGB565; {cases} bad inputs, {deeds} faults end as they should")
    notes.append(f"stack {memory['stack']} of {STACK_BYTES} bytes, work area {memory['work']} of {RAM_BYTES}; "
                 f"thinning, once: {first['thin_us'] * 1000 // NS_PER_INSTRUCTION:,} instructions")
    return {"wall_s": time.monotonic() - start, "crcs": compared, "code_bytes": code, "ram_bytes": ram,
            "instructions_per_frame": instructions, "notes": notes}
