"""linux-arm64 on QEMU's `virt`: the packaged program on Debian's kernel, its panel and pins held against the simulator.

- The package (cpack) holds the files it must, and no others; systemd finds nothing to say against its unit.
- That package's program runs in the virtual machine. After each frame of a drive with ignition and button the screendump
  is the simulator's picture, the CRC-32 its CRC-32, and the backlight's line what it must be.
- What is missing, damaged or refused gives one line and the documented exit code; the safe picture where there is a
  display. SIGTERM ends the program with the light off and the console's picture back.
- Instructions a frame, by QEMU's own count: what the program's clock says where an instruction takes a nanosecond.
- The golden scenes under qemu-user: instructions are the same, no kernel is needed.
"""
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tarfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from linux_vm import Initramfs, Vm, fetch_kernel, needed_libraries, run as command, unpack_kernel
from checks import require
from pictures import compare, is_black, read_png

WIDTH, HEIGHT = 800, 480
IGNITION, MODE, BACKLIGHT = 4, 5, 6  # lines of the PL061; 3 is the power key

PACKAGE_FILES = {"usr/bin/usuzumi-device": 0o755,
                 "usr/lib/systemd/system/usuzumi-device.service": 0o644,
                 "usr/lib/sysusers.d/usuzumi-device.conf": 0o644,
                 "usr/lib/udev/rules.d/60-usuzumi-device.rules": 0o644,
                 "etc/default/usuzumi-device": 0o644,
                 "usr/share/doc/usuzumi-device/README.md": 0o644,
                 "usr/share/doc/usuzumi-device/copyright": 0o644}

# Frame -> (line, level) of the drive. A press within 50 ms of the one before is bouncing to the firmware, and the
# simulator's frames take 17 ms: presses lie four frames apart. The second is over before the frame begins.
FRAMES = 16
DRIVE = {0: [(IGNITION, 1)],
         2: [(MODE, 1)], 3: [(MODE, 0)],
         7: [(MODE, 1), (MODE, 0)],
         10: [(IGNITION, 0)], 12: [(IGNITION, 1)],
         13: [(MODE, 1)], 14: [(MODE, 0)]}
NAMES = {IGNITION: "ignition", MODE: "mode"}


# ---- the package ----------------------------------------------------------------------------------------------------


def make_package(context):
    """The unpacked package's folder. The .tar.gz, the .deb and the installed tree hold the same files."""
    for old in context.build.glob("usuzumi-device_*"):
        old.unlink()
    command(["cpack", "-G", "TGZ;DEB"], cwd=context.build)
    tree = context.work / "package"
    shutil.rmtree(tree, ignore_errors=True)
    with tarfile.open(the_package(context, "tar.gz")) as tar:
        check_files("the .tar.gz", {m.name.removeprefix("./"): m.mode & 0o777 for m in tar.getmembers() if not m.isdir()})
        tar.extractall(tree)
    deb = context.work / "deb"
    shutil.rmtree(deb, ignore_errors=True)
    command(["dpkg-deb", "-x", the_package(context, "deb"), deb])
    check_files("the .deb", files_below(deb))
    fields = command(["dpkg-deb", "-f", the_package(context, "deb"), "Architecture", "Depends"]).decode()
    require("Architecture: arm64" in fields and "libgpiod" in fields, f"the .deb says:\n{fields}")
    root = context.work / "root"
    shutil.rmtree(root, ignore_errors=True)
    command(["cmake", "--install", context.build, "--component", "device", "--prefix", root])
    check_files("the installed tree", files_below(root))
    machine = command(["aarch64-linux-gnu-readelf", "-h", tree / "usr/bin/usuzumi-device"]).decode()
    require("AArch64" in machine, f"the package's program is not for AArch64:\n{machine}")
    check_unit(tree / "usr/lib/systemd/system/usuzumi-device.service")
    return tree


def the_package(context, ending):
    packages = list(context.build.glob(f"usuzumi-device_*_arm64.{ending}"))
    require(len(packages) == 1, f"cpack made {len(packages)} packages .{ending} in {context.build}, not one")
    return packages[0]


def files_below(folder):
    return {str(path.relative_to(folder)): path.stat().st_mode & 0o777 for path in folder.rglob("*") if path.is_file()}


def check_files(what, files):
    require(files == PACKAGE_FILES, f"{what} holds {files}, not {PACKAGE_FILES}")


def check_unit(unit):
    """By systemd where it is installed; its words on the program being absent here are the only ones allowed."""
    text = unit.read_text()
    for words in ("ExecStart=/usr/bin/usuzumi-device", "EnvironmentFile=/etc/default/usuzumi-device", "Restart=on-failure",
                  "SupplementaryGroups=video gpio", "DeviceAllow=char-drm rw", "DeviceAllow=char-gpiochip rw"):
        require(words in text, f"{unit.name} has no {words}")
    if shutil.which("systemd-analyze"):
        done = subprocess.run(["systemd-analyze", "verify", str(unit)], capture_output=True, text=True, timeout=60)
        said = [line for line in (done.stdout + done.stderr).splitlines()
                if unit.name in line and "is not executable: No such file" not in line]
        require(not said, "systemd-analyze verify: " + "\n".join(said))


# ---- what is put into the machine -----------------------------------------------------------------------------------


def make_initramfs(context, tree, modules, orders):
    program = tree / "usr/bin/usuzumi-device"
    archive = Initramfs()
    archive.add("init", next(context.build.rglob("usuzumi-vm-init")).read_bytes(), 0o755)
    archive.add("modules/order", "".join(f"/modules/{m.name}\n" for m in modules).encode())
    for module in modules:
        archive.add(f"modules/{module.name}", module.read_bytes())
    for path, mode in PACKAGE_FILES.items():
        archive.add(path, (tree / path).read_bytes(), mode)
    for path, file in needed_libraries(program).items():
        archive.add(path, file.read_bytes(), 0o755)
    rom = context.rom.read_bytes()
    archive.add("drawing.rom", rom)
    archive.add("cut.rom", rom[:len(rom) // 2])
    archive.add("empty.rom", b"")
    archive.add("foreign.rom", foreign_rom(context).read_bytes())
    for name, lines in orders.items():
        archive.add(name, "".join(f"{line}\n" for line in lines).encode())
    path = context.work / "initramfs.gz"
    archive.write(path)
    return path


def foreign_rom(context):
    """The same drawing data, packed for another board."""
    path = context.work / "foreign.rom"
    model = next(pathlib.Path("/usr/share/assimp/models").rglob("CesiumMilkTruck.gltf"))
    command([context.usuzumi, "pack", model, "--board", "cortex-m7", "-o", path])
    return path


def device(*words, frames=1, pause=True):
    """A program's line; pausing, so that the panel can be looked at."""
    return " ".join(["/usr/bin/usuzumi-device", "--frames", str(frames), *(["--pause"] if pause else []), *words])


# ---- a drive --------------------------------------------------------------------------------------------------------


def drive(context, image, initramfs):
    """(CRCs compared, the boot's line, most RAM in use): frame by frame as the simulator."""
    script = ",".join(f"{frame}:{NAMES[line]}={level}" for frame, line, level in simulated_events())
    expected = context.expected_frames(FRAMES, "--gpio", script)
    require({e["shown"] for e in expected} == {"picture", "dark"} and
          {e["mode"] for e in expected} == {"full", "thinned", "budget"}, "the drive does not show what it is to show")
    with Vm(image, initramfs, "/drive") as vm:
        for frame in range(FRAMES):
            for line, level in DRIVE.get(frame, []):
                vm.drive(line, level)
            if frame == 0:
                vm.resume()
                boot = vm.wait_for_line("boot ")
            else:
                vm.send(b"\n")
            said = vm.wait_for_line("frame ")
            check_frame(context, vm, said, expected[frame])
        vm.send(b"\n")
        check_exit(vm, 0)
        require(vm.output(BACKLIGHT) == 0, "the backlight stays on when the program has ended")
        vm.wait_exit()
        ram = re.search(r" ram=(\d+)", said)
        require(ram, f"no ram= in '{said}'")
    return FRAMES, boot, int(ram.group(1))


def simulated_events():
    """The drive as the simulator takes it: a press between two frames is one that lasts for the frame that sees it."""
    events = []
    for frame, changes in DRIVE.items():
        short = [line for line, level in changes if level == 0 and (line, 1) in changes]
        for line, level in changes:
            events.append((frame + (1 if line in short and level == 0 else 0), line, level))
    return events


def check_frame(context, vm, line, expected):
    number = expected["frame"]
    said = re.match(r"frame (\d+) (\w+) (\w+) light=(\d) crc32=([0-9a-f]{8}) ", line)
    require(said, f"no frame's line: {line}")
    light = 1 if expected["backlight"] else 0
    wanted = (str(number), expected["shown"], expected["mode"], str(light), expected["crc32"])
    require(said.groups() == wanted, f"frame {number}: the board says {said.groups()}, the simulator {wanted}")
    require(vm.output(BACKLIGHT) == light, f"frame {number}: the backlight's line is not {light}")
    panel = check_panel(context, vm, expected, f"frame-{number:04}")
    require(is_black(panel) == (expected["shown"] == "dark"), f"frame {number}: black, or not, against expectation")


def check_panel(context, vm, expected, name):
    """The panel's picture, which is the expected one. The program stands still after its frame; the emulator's display
    follows the card's commands in a thread of its own, and under load comes later than the program's line."""
    picture = read_png(expected["png"])
    panel = vm.screendump()
    for _ in range(20):
        if panel == picture:
            break
        time.sleep(0.1)
        panel = vm.screendump()
    compare(picture, panel, context.work / "differences", name)
    return panel


def check_exit(vm, code):
    line = vm.wait_for_line("exit ")
    require(line == f"exit {code}", f"the program ended with '{line}', not exit {code}")


# ---- what a frame costs ---------------------------------------------------------------------------------------------

COUNTED_FRAMES = 6  # the first is thinned, the others are drawn of the same copy


def count_instructions(context, image, initramfs):
    """(of the first frame, median of the others): instructions to thin and to draw, in whole thousands. What the kernel
    does meanwhile, its timer's interrupts above all, is counted along."""
    expected = context.expected_frames(COUNTED_FRAMES)
    costs = []
    with Vm(image, initramfs, "/count", count=True) as vm:
        vm.drive(IGNITION, 1)
        vm.resume()
        for frame in expected:
            line = vm.wait_for_line("frame ")
            said = re.search(r" crc32=([0-9a-f]{8}) .* thin_us=(\d+) draw_us=(\d+)", line)
            require(said and said.group(1) == frame["crc32"],
                  f"counting: not the simulator's picture of CRC-32 {frame['crc32']}: {line}")
            costs.append((int(said.group(2)) + int(said.group(3))) * 1000)
        check_exit(vm, 0)
        vm.wait_exit()
    return costs[0], int(statistics.median(costs[1:]))


# ---- what goes wrong ------------------------------------------------------------------------------------------------

SAFE_CASES = [  # (options, words of the error, exit code): the display shows the safe picture
    ("--rom /none.rom", r"error: there are no drawing data: .*", 3),
    ("--rom /empty.rom", r"error: there are no drawing data: .*", 3),
    ("--rom /cut.rom", r"error: file is truncated: .*", 3),
    ("--rom /foreign.rom", r"error: .*another board.*", 3),
]
REFUSED_CASES = [  # the program ends before it touches the display
    ("--rom /drawing.rom --gpio-chip tlmm", r"error: GPIO chip tlmm: not there; .*", 5),
    ("--rom /drawing.rom --ignition 3 --mode 99", r"error: GPIO chip gpiochip0 line 99: the chip has no such line.*", 5),
    ("--rom /drawing.rom --size 801x480", r"error: display /dev/dri/card0 has no 801x480; it has 800x480 .*", 5),
    ("--rom /drawing.rom --card /dev/dri/card7", r"error: display /dev/dri/card7: not there; .* errno 2", 5),
    ("--rom /drawing.rom --rgb565",  # virtio-gpu takes XRGB8888 alone
     r"error: display /dev/dri/card0 takes no RGB565 pictures of 800x480; leave out --rgb565; errno \d+", 5),
    ("--rom /drawing.rom --size big", r"error: --size big: give width and height in pixels.*", 2),
]

# As an unprivileged user, in groups that vm_init.cpp gives GPIO chips (990) and cards (44) to; without an end, as the
# service runs. (groups, options, words of the error)
NO_CARD_CASE = ("990", "--rom /drawing.rom", r"error: display /dev/dri/card0: no permission; .*\(video\).* errno 13")
HELD_CARD_CASE = ("990,44", "--rom /drawing.rom --ignition 0 --mode 1 --backlight 2",
                  r"error: display /dev/dri/card0: setting the mode: no permission; .*"
                  r"no other program shows pictures on this card; errno 13")
OWN_BACKLIGHT = 2  # of that case
AT_ONCE_S = 5      # from the error to the program's end, on a loaded machine

BUSY_CASES = [  # while another instrument runs
    ("--rom /drawing.rom", r"error: GPIO chip gpiochip0 line 4: in use; .* errno 16", 5),
    ("--rom /drawing.rom --ignition 0 --mode 1 --backlight 2", r"error: display /dev/dri/card0: in use by .* errno 16", 5),
]


def as_user(case):
    groups, options, _ = case
    return f"user=1000 groups={groups} /usr/bin/usuzumi-device {options}"


def orders():
    return {"drive": [device("--rom /drawing.rom --orbit", frames=FRAMES)],
            "count": [device("--rom /drawing.rom --orbit", frames=COUNTED_FRAMES, pause=False)],
            "safe": [device(options) for options, _, _ in SAFE_CASES],
            "refused": ["user=1000 " + device("--rom /drawing.rom", pause=False)] +
                       [device(options, pause=False) for options, _, _ in REFUSED_CASES] + [as_user(NO_CARD_CASE)] +
                       ["stop /usr/bin/usuzumi-device --rom /drawing.rom",
                        "stop /usr/bin/usuzumi-device --rom /none.rom",
                        "beside /usr/bin/usuzumi-device --rom /drawing.rom"] +
                       [device(options, pause=False) for options, _, _ in BUSY_CASES] + [as_user(HELD_CARD_CASE)],
            "blind": [device("--rom /drawing.rom", pause=False)]}


def error_line(vm, pattern, options):
    line = vm.wait_for_line("error: ")
    require(re.fullmatch(pattern, line), f"{options}: '{line}' is not as '{pattern}'")
    return line


def safe_pictures(context, image, initramfs):
    """Bad drawing data: one line, the safe picture with its light on, exit code 3."""
    safe = context.expected_frames(1, "--fault", "0:engine-hang=1")[0]
    require(safe["shown"] == "safe", "the simulator does not show its safe picture")
    lines = []
    with Vm(image, initramfs, "/safe") as vm:
        vm.drive(IGNITION, 1)
        vm.resume()
        for options, pattern, code in SAFE_CASES:
            lines.append(error_line(vm, pattern, options))
            check_panel(context, vm, safe, f"safe-{len(lines)}")
            require(vm.output(BACKLIGHT) == 1, f"{options}: the safe picture is not lit")
            vm.send(b"\n")
            check_exit(vm, code)
        vm.wait_exit()
        require("note: --rom /none.rom: No such file or directory; usuzumi pack makes one" in vm.console_lines,
              "a ROM that is not there is not named")
    return lines


def shows_console(vm, console, tries=20):
    """Whether the panel shows what it showed before any program, but for the blinking cursor: one cell of 8x16."""
    for _ in range(tries):
        panel = vm.screendump()
        if panel[:2] == console[:2]:
            differing = sum(panel.rgb[i:i + 3] != console.rgb[i:i + 3] for i in range(0, len(panel.rgb), 3))
            if differing <= 8 * 16:
                return True
        time.sleep(0.1)
    return False


def refused_user(vm, case, backlight):
    """One line, exit code 5 at once, and dark: whoever has no rights does not stand by."""
    groups, options, pattern = case
    what = f"{options} as user 1000 of {groups}"
    line = error_line(vm, pattern, what)
    start = time.monotonic()
    check_exit(vm, 5)
    require(time.monotonic() - start < AT_ONCE_S, f"{what}: ends {AT_ONCE_S} s after its error")
    require(vm.output(backlight) == 0, f"{what}: the backlight is on")
    return line


def refusals(context, image, initramfs):
    """Without rights, chip, card or size: one line, exit code 5. Then SIGTERM: dark, exit code 0, or 3 after bad data."""
    lines = []
    with Vm(image, initramfs, "/refused") as vm:
        vm.drive(IGNITION, 1)
        vm.resume()
        cases = [("as user 1000", r"error: GPIO chip gpiochip0: no permission; .*\(gpio\); errno 13", 5), *REFUSED_CASES]
        for options, pattern, code in cases:
            lines.append(error_line(vm, pattern, options))
            check_exit(vm, code)
            require(vm.output(BACKLIGHT) == 0, f"{options}: the backlight is on")
        lines.append(refused_user(vm, NO_CARD_CASE, BACKLIGHT))
        console = vm.screendump()
        for beginning, code in (("frame 0 picture", 0), ("error: ", 3)):
            vm.wait_for_line(beginning)
            require(vm.output(BACKLIGHT) == 1, "the backlight is off while the program runs")
            require(not shows_console(vm, console, tries=1), "the console's picture is shown, not the instrument's")
            vm.send(b"\n")
            check_exit(vm, code)
            require(vm.output(BACKLIGHT) == 0, "SIGTERM leaves the backlight on")
            require(shows_console(vm, console), "SIGTERM does not bring the console's picture back")
        vm.wait_for_line("frame 0 picture")
        vm.send(b"\n")
        for options, pattern, code in BUSY_CASES:
            lines.append(error_line(vm, pattern, f"{options} beside another"))
            check_exit(vm, code)
            require(vm.output(BACKLIGHT) == 1, "one refused puts out the other's light")
        lines.append(refused_user(vm, HELD_CARD_CASE, OWN_BACKLIGHT))
        require(vm.output(BACKLIGHT) == 1, "one refused puts out the other's light")
        vm.wait_exit()
        errors = [line for line in vm.console_lines if line.startswith("error: ")]
        require(len(errors) == len(lines) + 1, "not one error's line of each case:\n" + "\n".join(errors))  # and SIGTERM's
    with Vm(image, initramfs, "/blind", gpu=None) as vm:
        vm.drive(IGNITION, 1)
        vm.resume()
        lines.append(error_line(vm, r"error: display: no card in /dev/dri; .*", "no display"))
        check_exit(vm, 5)
        vm.wait_exit()
    return lines


# ---- all of it ------------------------------------------------------------------------------------------------------


def goldens(context):
    """The golden scenes and runs, as the manifest has them."""
    player = next(context.build.rglob("usuzumi-goldens"))
    output = command(["qemu-aarch64-static", "-cpu", "cortex-a53", player, context.golden_bundle], timeout=600)
    context.check_golden(output.decode())


def run(context):
    start = time.monotonic()
    cache = context.root / "build/boards/cache"
    package = fetch_kernel(cache)
    image, modules = unpack_kernel(package, cache / package.stem)
    tree = make_package(context)
    initramfs = make_initramfs(context, tree, modules, orders())
    crcs, boot, ram = drive(context, image, initramfs)
    errors = safe_pictures(context, image, initramfs) + refusals(context, image, initramfs)
    first, steady = count_instructions(context, image, initramfs)
    goldens(context)
    sizes = command(["aarch64-linux-gnu-size", tree / "usr/bin/usuzumi-device"]).decode().splitlines()[1].split()
    (context.work / "refusals.txt").write_text("".join(f"{line}\n" for line in errors))
    notes = [boot, f"{crcs} screendumps equal the simulator's pictures, the pins and lights its own",
             f"instructions: {first:,} the first frame with its thinning, {steady:,} the median of the {COUNTED_FRAMES - 1} "
             "after it; the kernel's interrupts are counted along",
             f"{len(errors)} refusals, each one line and its exit code: {context.work / 'refusals.txt'}"]
    return {"wall_s": time.monotonic() - start, "crcs": crcs, "code_bytes": int(sizes[0]), "ram_bytes": ram,
            "instructions_per_frame": steady, "notes": notes}
