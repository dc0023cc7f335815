#!/usr/bin/env python3
"""Builds the firmware for each board, runs it on QEMU and holds it against the simulator and the goldens.

Of every board:
  - its firmware boots with a real model (the truck of sim/demo), and every frame has the CRC-32 that the simulator's panel
    has with the same memories (`usuzumi run --board NAME`); what else a board's run.py compares, it says itself
  - its player draws the golden scenes and runs, and prints the lines of tests/golden/manifest

What is built lies in build/boards: `host` the simulator and the recorder of the goldens, NAME the board's firmware.
"""
import argparse
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import time
import traceback

from checks import Failure
from pictures import PicturesDiffer
from qemu import QemuError

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "boards"
BOARDS = {name: ROOT / "boards" / name for name in ("cortex-m7", "cortex-a9", "linux-arm64")}
BOARDS["minimal"] = ROOT / "tests/boards/minimal"  # what a port takes at least
SIMULATED_AS = {"minimal": "cortex-m7"}            # the simulator's board with its picture
MODEL = pathlib.Path("/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf")
SIDECAR = ROOT / "sim/demo/CesiumMilkTruck.json"
BUILD_TIMEOUT_S = 1800
COMMAND_TIMEOUT_S = 300


def run_command(command, log=None, timeout=COMMAND_TIMEOUT_S, expect=0):
    """The command's output; Failure with its last lines when it ends otherwise than `expect`. `log` is appended to."""
    try:
        done = subprocess.run([str(word) for word in command], cwd=ROOT, timeout=timeout, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    except FileNotFoundError as e:
        raise Failure(f"{command[0]}: not found; bash boards/run.sh installs it") from e
    except subprocess.TimeoutExpired as e:
        raise Failure(f"{' '.join(map(str, command))}: took longer than {timeout} s") from e
    if log is not None:
        with open(log, "a", encoding="utf-8") as out:
            out.write(done.stdout)
    if done.returncode != expect:
        last = "\n".join(done.stdout.splitlines()[-40:])
        raise Failure(f"{' '.join(map(str, command))}: exit code {done.returncode}, not {expect}\n{last}")
    return done.stdout


def build(folder, options, targets=()):
    """Configures and builds; the log lies beside the folder."""
    log = folder.with_suffix(".log")
    folder.parent.mkdir(parents=True, exist_ok=True)
    log.write_text("")
    run_command(["cmake", "-S", ROOT, "-B", folder, *options], log, BUILD_TIMEOUT_S)
    target_words = ["--target", *targets] if targets else []
    run_command(["cmake", "--build", folder, "-j", os.cpu_count() or 1, *target_words], log, BUILD_TIMEOUT_S)


class Context:
    """What a board's run.py is given; paths are absolute."""

    def __init__(self, board, host):
        self.board = board
        self.root = ROOT
        self.build = BUILD / board
        self.work = BUILD / "work" / board  # for what a run leaves to be looked at
        self.work.mkdir(parents=True, exist_ok=True)
        self.usuzumi = host / "sim/cli/usuzumi"
        self.rom = BUILD / "truck.rom"
        self.golden_bundle = BUILD / "golden.bundle"
        self.golden_lines = 0

    def expected_frames(self, frames, *arguments, rom=None):
        """What the simulator's panel shows with this board's memories: a dict per frame as in `usuzumi run --stats`, with
        "png", the picture's path. Turns once around the model, as the boards do; `arguments` are added."""
        name = "-".join(str(word).strip("-").replace("/", "_") for word in (frames, *arguments)) or "run"
        out = self.work / "expected" / name
        stats = self.work / "expected" / f"{name}.json"
        out.mkdir(parents=True, exist_ok=True)
        for old in out.glob("frame-*.png"):
            old.unlink()
        simulated = SIMULATED_AS.get(self.board, self.board)
        run_command([self.usuzumi, "run", rom or self.rom, "--board", simulated, "--frames", frames, "--orbit",
                     "--out", out, "--stats", stats, *arguments])
        records = json.loads(stats.read_text())["frames"]
        for record in records:
            record["png"] = out / f"frame-{record['frame']:04}.png"
        return records

    def check_golden(self, output, board=None):
        """Failure unless `output`, of the board's golden player, is what tests/golden/manifest says of this board, or of
        `board`."""
        printed = self.work / "golden.txt"
        printed.write_text(output)
        text = run_command([sys.executable, ROOT / "tests/golden/check_manifest.py", ROOT / "tests/golden/manifest", printed,
                            "--board", board or self.board])
        self.golden_lines = int(re.search(r"(\d+) of \d+ lines", text).group(1))
        return text


def prepare_host(host):
    """The simulator and the recorder in the build folder `host`, the model's ROM and the goldens' bundle made by them."""
    options = [] if (host / "CMakeCache.txt").exists() else ["-DUSUZUMI_BENCHMARKS=OFF", "-DCMAKE_CXX_COMPILER=g++"]
    build(host, options, ["usuzumi", "usuzumi_golden_record"])
    usuzumi, recorder = host / "sim/cli/usuzumi", host / "tests/golden/usuzumi_golden_record"
    BUILD.mkdir(parents=True, exist_ok=True)
    # The smallest board has 12 MB of flash for drawing data; the truck's texture alone takes 22 MB as it stands.
    run_command([usuzumi, "pack", MODEL, "--sidecar", SIDECAR, "--texture-size", "256", "--texture-format", "rgb565",
                 "-o", BUILD / "truck.rom"])
    run_command([recorder, BUILD / "golden.bundle"])


def load_runner(board):
    path = BOARDS[board] / "run.py"
    spec = importlib.util.spec_from_file_location(f"boards_{board.replace('-', '_')}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run_board(board, host):
    """The row of the table. Failure, or what the board's run.py raises, where anything differs."""
    start = time.monotonic()
    build(BUILD / board, ["--toolchain", BOARDS[board] / "board.cmake", f"-DUSUZUMI_BOARD={BOARDS[board]}",
                          "-DUSUZUMI_SIM=OFF", "-DUSUZUMI_TESTS=OFF", "-DUSUZUMI_WERROR=ON"])
    built = time.monotonic()
    context = Context(board, host)
    result = load_runner(board).run(context)
    if context.golden_lines == 0:
        raise Failure(f"{board}: the goldens were not compared")
    return {"built_s": built - start, "ran_s": time.monotonic() - built, "golden": context.golden_lines, **result}


def number(value):
    return "-" if value is None else f"{value:,}"


def table(rows):
    heads = ["board", "", "built", "ran", "CRCs", "goldens", "code", "RAM used", "instructions a frame"]
    lines = [heads]
    for board, row in rows.items():
        if "error" in row:
            lines.append([board, "FAILED"] + ["-"] * 7)
            continue
        lines.append([board, "ok", f"{row['built_s']:.0f} s", f"{row['ran_s']:.1f} s", number(row.get("crcs")),
                      number(row["golden"]), number(row.get("code_bytes")), number(row.get("ram_bytes")),
                      number(row.get("instructions_per_frame"))])
    widths = [max(len(line[i]) for line in lines) for i in range(len(heads))]
    return "\n".join("  ".join(f"{word:<{w}}" if i < 2 else f"{word:>{w}}"
                               for i, (word, w) in enumerate(zip(line, widths))) for line in lines)


def main():
    parser = argparse.ArgumentParser(prog="boards/run.sh", description=__doc__.split("\n")[0])
    parser.add_argument("boards", nargs="*", metavar="BOARD", help=f"one or more of {', '.join(BOARDS)}; all without")
    parser.add_argument("--host-build", type=pathlib.Path, default=BUILD / "host",
                        help="build folder of the simulator, made where it is not there (default: build/boards/host)")
    arguments = parser.parse_args()
    boards, host = arguments.boards or BOARDS, arguments.host_build.resolve()
    for board in boards:
        if board not in BOARDS:
            parser.error(f"there is no board {board}; there are {', '.join(BOARDS)}")
    rows = {}
    try:
        print(f"== the simulator and the goldens: building, at first for some minutes (log: {host}.log)", flush=True)
        prepare_host(host)
    except Failure as e:
        print(e, file=sys.stderr)
        return 1
    for board in boards:
        print(f"== {board}: building and running (log: build/boards/{board}.log)", flush=True)
        try:
            rows[board] = run_board(board, host)
            for note in rows[board].get("notes", []):
                print(f"   {note}")
        except Exception as e:  # whatever a board does, the others are run and the table is printed
            rows[board] = {"error": str(e)}
            if not isinstance(e, (Failure, PicturesDiffer, QemuError)):  # one of our own mistakes
                traceback.print_exc()
            print(f"{board}: {e}", file=sys.stderr)
    print(f"\n{table(rows)}", flush=True)
    return 1 if any("error" in row for row in rows.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
