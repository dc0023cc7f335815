"""QEMU as a board's test bench: in a folder of its own, driven over QMP, qtest and the console, never waited for
without an end.

    with Qemu(["qemu-system-arm", "-M", "realview-pbx-a9", "-kernel", "firmware.elf"], qtest=True) as board:
        gpio = board.paths_of("pl061")[0]
        board.set_input(gpio, 0, 1)         # before the processor's first instruction
        board.resume()
        line = board.wait_for_line("frame ")
        pictures.compare(pictures.read_png("expected.png"), board.screendump(), folder, "frame-0000")
"""
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import tempfile
import time

from pictures import Picture, read_ppm


class QemuError(Exception):
    """The machine did not do what was asked of it; the text says what, and what it said last."""


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
