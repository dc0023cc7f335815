"""QEMU as a board's test bench: in a folder of its own, driven over QMP, qtest and the console, never waited for
without an end.

    with Qemu(["qemu-system-arm", "-M", "realview-pbx-a9", "-kernel", "firmware.elf"], qtest=True) as board:
        gpio = board.paths_of("pl061")[0]
        board.set_input(gpio, 0, 1)         # before the processor's first instruction
        board.resume()
        line = board.wait_for_line("frame ")
        compare(read_png("expected.png"), board.screendump(), folder, "frame-0000")
"""
import json
import os
import pathlib
import re
import shutil
import socket
import struct
import subprocess
import tempfile
import time
import zlib
from typing import NamedTuple


class QemuError(Exception):
    """The machine did not do what was asked of it; the text says what, and what it said last."""


class PicturesDiffer(Exception):
    """Two pictures are not the same; the text says where, and where both lie."""


# ---- pictures -------------------------------------------------------------------------------------------------------


class Picture(NamedTuple):
    width: int
    height: int
    rgb: bytes  # rows from the top, three bytes a pixel

    def at(self, x: int, y: int) -> tuple:
        first = 3 * (y * self.width + x)
        return tuple(self.rgb[first:first + 3])


def read_ppm(path) -> Picture:
    """A binary PPM of eight bits, as screendump writes it."""
    data = pathlib.Path(path).read_bytes()
    head = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
    if not head:
        raise ValueError(f"{path}: not a binary PPM of eight bits")
    width, height = int(head.group(1)), int(head.group(2))
    rgb = data[head.end():]
    if len(rgb) != 3 * width * height:
        raise ValueError(f"{path}: {width}x{height} needs {3 * width * height} bytes of pixels, there are {len(rgb)}")
    return Picture(width, height, rgb)


def _unfiltered(kind: int, row: bytearray, above: bytes, step: int) -> bytearray:
    """A row of a PNG before its filter (PNG specification, chapter 9); `step` is the bytes of a pixel."""
    if kind == 1:
        for i in range(step, len(row)):
            row[i] = (row[i] + row[i - step]) & 255
    elif kind == 2:
        row = bytearray((a + b) & 255 for a, b in zip(row, above))
    elif kind == 3:
        for i in range(len(row)):
            left = row[i - step] if i >= step else 0
            row[i] = (row[i] + (left + above[i]) // 2) & 255
    elif kind == 4:
        for i in range(len(row)):
            left, up_left = (row[i - step], above[i - step]) if i >= step else (0, 0)
            up = above[i]
            d_left, d_up, d_up_left = abs(up - up_left), abs(left - up_left), abs(left + up - 2 * up_left)
            nearest = left if d_left <= d_up and d_left <= d_up_left else up if d_up <= d_up_left else up_left
            row[i] = (row[i] + nearest) & 255
    elif kind != 0:
        raise ValueError(f"filter {kind}, which PNG does not have")
    return row


def read_png(path) -> Picture:
    """A PNG of eight bits a channel, RGB or RGBA (whose alpha is left out), not interlaced, as the simulator writes."""
    data = pathlib.Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path}: not a PNG")
    at, header, packed = 8, None, b""
    while at + 12 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if struct.unpack_from(">I", data, at + 8 + length)[0] != zlib.crc32(kind + body):
            raise ValueError(f"{path}: chunk {kind.decode(errors='replace')} is damaged")
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    if header is None or header[2] != 8 or header[3] not in (2, 6) or header[6] != 0:
        raise ValueError(f"{path}: only RGB and RGBA of eight bits, not interlaced, are read here; this is {header}")
    width, height, step = header[0], header[1], 3 if header[3] == 2 else 4
    raw, stride = zlib.decompress(packed), width * step
    if len(raw) != height * (stride + 1):
        raise ValueError(f"{path}: {height} rows of {stride + 1} bytes were expected, there are {len(raw)} bytes")
    above, rows = bytes(stride), []
    for y in range(height):
        first = y * (stride + 1)
        above = _unfiltered(raw[first], bytearray(raw[first + 1:first + 1 + stride]), above, step)
        rows.append(bytes(above))
    pixels = b"".join(rows)
    if step == 4:
        rgb = bytearray(3 * width * height)
        for channel in range(3):
            rgb[channel::3] = pixels[channel::4]
        pixels = bytes(rgb)
    return Picture(width, height, pixels)


def write_png(path, picture: Picture) -> None:
    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    stride = 3 * picture.width
    rows = b"".join(b"\0" + picture.rgb[y * stride:(y + 1) * stride] for y in range(picture.height))
    header = struct.pack(">IIBBBBB", picture.width, picture.height, 8, 2, 0, 0, 0)
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def shifted_565(picture: Picture) -> Picture:
    """A picture whose RGB565 became eight bits by repeating upper bits, as QEMU's PL111 makes them: zeros below."""
    five, six = bytes(v & 0xF8 for v in range(256)), bytes(v & 0xFC for v in range(256))
    rgb = bytearray(len(picture.rgb))
    for channel, kept in enumerate((five, six, five)):
        rgb[channel::3] = picture.rgb[channel::3].translate(kept)
    return Picture(picture.width, picture.height, bytes(rgb))


def compare(expected: Picture, actual: Picture, folder, name: str) -> None:
    """Raises PicturesDiffer unless both are the same, byte for byte; leaves both in `folder`, which is made."""
    if expected == actual:
        return
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"{name}.{which}.png" for which in ("expected", "actual")]
    for path, picture in zip(paths, (expected, actual)):
        write_png(path, picture)
    if expected[:2] != actual[:2]:
        what = f"{expected.width}x{expected.height} was expected, this is {actual.width}x{actual.height}"
    else:
        wrong = [i for i in range(0, len(expected.rgb), 3) if expected.rgb[i:i + 3] != actual.rgb[i:i + 3]]
        y, x = divmod(wrong[0] // 3, expected.width)
        what = (f"{len(wrong)} pixels differ, the first at x {x}, y {y}: expected #{bytes(expected.at(x, y)).hex()}, "
                f"actual #{bytes(actual.at(x, y)).hex()}")
    raise PicturesDiffer(f"{name}: {what}; see {paths[0]} and {paths[1]}")


def is_black(picture: Picture) -> bool:
    return not any(picture.rgb)


# ---- the machine ----------------------------------------------------------------------------------------------------


class _Channel:
    """A Unix socket read line by line, with an end to every wait."""

    def __init__(self, name: str, path: pathlib.Path, machine: "Qemu"):
        self.name, self._machine, self._rest = name, machine, b""
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.settimeout(0.2)
        while True:
            try:
                self._socket.connect(str(path))
                return
            except OSError:
                try:
                    machine.check_running(f"opening {name}")
                except QemuError:
                    self._socket.close()
                    raise
                time.sleep(0.01)

    def send(self, data: bytes) -> None:
        try:
            self._socket.settimeout(5)
            self._socket.sendall(data)
        except OSError as error:
            self._machine.fail(f"{self.name} takes no more bytes ({error})")

    def line(self, waiting_for: str, end: float):
        """The next line without its end; None once QEMU has closed the socket. Raises at `end` (time.monotonic())."""
        while b"\n" not in self._rest:
            if time.monotonic() > end:
                self._machine.fail(f"no {waiting_for} on {self.name} in time")
            self._socket.settimeout(0.2)
            try:
                got = self._socket.recv(65536)
            except TimeoutError:
                continue
            except OSError:
                got = b""
            if not got:
                return None
            self._rest += got
        line, self._rest = self._rest.split(b"\n", 1)
        return line.decode(errors="replace").rstrip("\r")

    def close(self) -> None:
        self._socket.close()


class Qemu:
    """One run of QEMU. `arguments` begins with the program; sockets, no display and a halted processor are added here.
    The whole run may take `timeout_s`, a single answer `answer_s`; then QEMU is killed and QemuError raised.

    `console`: the first serial port is a socket (wait_for_line, send). `qtest`: pins can be driven."""

    def __init__(self, arguments, *, qtest=False, console=True, timeout_s=120.0, answer_s=30.0):
        self._end = time.monotonic() + timeout_s
        self._answer_s = answer_s
        self.console_lines, self._output_events = [], []
        # Not below the caller's folder: the path of a Unix socket has 107 characters at most.
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="usuzumi-qemu-"))
        self._process = self._console = self._qmp = self._qtest = None
        command = [str(a) for a in arguments] + ["-S", "-display", "none", "-monitor", "none"]
        command += ["-qmp", self._listen("qmp")]
        command += ["-serial", self._listen("console")] if console else ["-serial", "null"]
        if qtest:
            command += ["-qtest", self._listen("qtest"), "-qtest-log", "none"]
        try:
            with open(self.folder / "stderr", "wb") as errors:
                self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=errors, stderr=errors,
                                                 env={**os.environ, "QEMU_AUDIO_DRV": "none"})
            if console:
                self._console = _Channel("the console", self.folder / "console", self)
            if qtest:
                self._qtest = _Channel("qtest", self.folder / "qtest", self)
            self._qmp = _Channel("QMP", self.folder / "qmp", self)
            self._qmp.line("greeting", self._answer_end())
            self.qmp("qmp_capabilities")
        except FileNotFoundError as error:
            self.close()
            raise QemuError(f"{command[0]} is not installed: {error}") from error
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    # -- running

    def resume(self) -> None:
        """The processor runs, from where it stands: at first, from reset."""
        self._qmp.send(b'{"execute": "cont"}\n')
        end = self._answer_end()
        while True:
            line = self._qmp.line("answer to cont", end)
            if line is None or "return" in json.loads(line):
                return  # of a short program QEMU may end before it answers

    def pause(self) -> None:
        """The processor stands still, and virtual time with it."""
        self.qmp("stop")

    def wait_exit(self, timeout_s=None) -> int:
        """The exit code, once the machine has ended by itself; what it still said is in console_lines."""
        end = self._answer_end(timeout_s)
        if self._console:
            while self._console_line("end of the run", end) is not None:
                pass
        try:
            return self._process.wait(max(0.1, end - time.monotonic()))
        except subprocess.TimeoutExpired:
            self.fail("the machine did not end in time")

    def close(self) -> None:
        if self._process and self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        for channel in (self._console, self._qmp, self._qtest):
            if channel:
                channel.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def check_running(self, doing: str) -> None:
        if self._process.poll() is not None:
            self.fail(f"QEMU ended with code {self._process.returncode} while {doing}")
        if time.monotonic() > self._end:
            self.fail(f"the run took too long, while {doing}")

    def fail(self, what: str):
        """Kills QEMU and raises QemuError with its last words and the console's."""
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        errors = self.folder / "stderr"
        said = errors.read_text(errors="replace").splitlines() if errors.exists() else []
        said = "\n".join(line for line in said if not line.startswith("qemu: module "))[-500:]  # of packages not needed
        last = "".join(f"\n  console: {line}" for line in self.console_lines[-5:])
        raise QemuError(what + last + (f"\n  QEMU: {said}" if said else ""))

    # -- console

    def send(self, data: bytes) -> None:
        self._console.send(data)

    def next_line(self, timeout_s=None) -> str:
        line = self._console_line("line", self._answer_end(timeout_s))
        if line is None:
            self._ended("line")
        return line

    def wait_for_line(self, beginning: str, timeout_s=None) -> str:
        """The next line that begins so; those before it are passed over, and kept in console_lines."""
        end = self._answer_end(timeout_s)
        while True:
            line = self._console_line(f"line '{beginning}…'", end)
            if line is None:
                self._ended(f"line '{beginning}…'")
            if line.startswith(beginning):
                return line

    def _console_line(self, waiting_for: str, end: float):
        line = self._console.line(waiting_for, end)
        if line is not None:
            self.console_lines.append(line)
        return line

    # -- QMP

    def qmp(self, command: str, **arguments):
        """The command's result; QemuError with QEMU's own words where it refuses."""
        request = {"execute": command, **({"arguments": arguments} if arguments else {})}
        self._qmp.send(json.dumps(request).encode() + b"\n")
        end = self._answer_end()
        while True:
            line = self._qmp.line(f"answer to {command}", end)
            if line is None:
                self._ended(f"answer to {command}")
            answer = json.loads(line)
            if "error" in answer:
                self.fail(f"QMP {command}: {answer['error'].get('desc')}")
            if "return" in answer:
                return answer["return"]

    def screendump(self) -> Picture:
        """What the display controller sends at this moment."""
        path = self.folder / "screen.ppm"
        self.qmp("screendump", filename=str(path))
        return read_ppm(path)

    def paths_of(self, kind: str) -> list:
        """QOM paths of the board's devices of that type, in the order in which the board makes them."""
        parent = "/machine/unattached"
        names = [p["name"] for p in self.qmp("qom-list", path=parent) if p["type"] == f"child<{kind}>"]
        return [f"{parent}/{name}" for name in sorted(names, key=lambda name: int(re.search(r"\d+", name).group()))]

    # -- pins, by qtest

    def qtest(self, command: str) -> str:
        self._qtest.send(command.encode() + b"\n")
        end = self._answer_end()
        while True:
            line = self._qtest.line(f"answer to {command}", end)
            if line is None:
                self._ended(f"answer to {command}")
            if self._noted(line):
                continue
            if line.startswith("OK"):
                return line[2:].strip()
            self.fail(f"qtest {command}: {line}")

    def set_input(self, path: str, line: int, level: int) -> None:
        """Drives an input line of a GPIO device."""
        self.qtest(f"set_irq_in {path} unnamed-gpio-in {line} {level}")

    def watch_outputs(self, path: str) -> None:
        """From now on changes of that device's output lines are noted. Of one device only."""
        self.qtest(f"irq_intercept_out {path}")

    def output_events(self) -> list:
        """(line, level) of each change since the last call, in order; of a machine that has ended, too."""
        if self._process.poll() is None:
            self.qtest("endianness")  # any command: what has been noted comes before its answer
        else:
            while (line := self._qtest.line("end", self._answer_end())) is not None:
                self._noted(line)
        events, self._output_events = self._output_events, []
        return events

    # -- inside

    def _noted(self, line: str) -> bool:
        if not line.startswith("IRQ "):
            return False
        _, edge, number = line.split()
        self._output_events.append((int(number), 1 if edge == "raise" else 0))
        return True

    def _listen(self, name: str) -> str:
        return f"unix:{self.folder / name},server=on,wait=off"

    def _answer_end(self, timeout_s=None) -> float:
        return min(self._end, time.monotonic() + (timeout_s or self._answer_s))

    def _ended(self, waiting_for: str):
        try:
            self._process.wait(2)
        except subprocess.TimeoutExpired:
            pass
        self.fail(f"QEMU ended with code {self._process.poll()} before the {waiting_for}")
