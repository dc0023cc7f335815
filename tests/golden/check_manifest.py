#!/usr/bin/env python3
"""Compares what the player printed with the manifest: check_manifest.py MANIFEST OUTPUT --board NAME

OUTPUT ("-" for standard input) may hold other lines before the player's first and behind its last one, as a console
does. Names every line that differs, is missing or is too many, and what was passed over without the manifest's word.
Exit codes: 0 all the same, 1 not, 2 bad usage, 3 a file that cannot be read.
"""
import argparse
import pathlib
import re
import sys

BEGIN = re.compile(r"# golden: (\d+) cases on (\S+)")
END = re.compile(r"# golden: done, (\d+) lines")
RESULT = re.compile(r"(\S+) +(\d+) +(\d+) +([0-9a-f]{8})")
NOT_ON = re.compile(r"(\S+) +not on ([^:]+): (.+)")
FAILED = re.compile(r"(\S+|a case) failed: (.*)")


class BadInput(Exception):
    pass


def read_lines(name):
    try:
        if name == "-":
            return sys.stdin.buffer.read().decode("utf-8", "replace").splitlines()
        return pathlib.Path(name).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise BadInput(f"{name}: {error.strerror}") from error


def read_manifest(name, board):
    """Name -> the numbers as printed, and case -> reason, of what the board must print."""
    results, reasons = {}, {}
    for number, line in enumerate(read_lines(name), 1):
        if not line or line.startswith("#"):
            continue
        if match := NOT_ON.fullmatch(line):
            if match[2] == board:
                reasons[match[1]] = match[3]
        elif match := RESULT.match(line):
            results[match[1]] = " ".join(match.group(2, 3, 4))
        else:
            raise BadInput(f"{name}:{number}: neither a result nor a board that a case is not on")
    if not results:
        raise BadInput(f"{name}: holds no results")
    return {n: r for n, r in results.items() if n.partition("/")[0] not in reasons}, reasons


def players_lines(lines, board, faults):
    """The lines between the player's first and last one."""
    lines = [line.rstrip() for line in lines]
    begin = next((i for i, line in enumerate(lines) if BEGIN.fullmatch(line)), None)
    if begin is None:
        # Before its first line the player says only what is wrong with its bundle.
        faults += [line.removeprefix("# golden: ") for line in lines if line.startswith("# golden: ")]
        faults.append("the player did not begin")
        return []
    printed_for = BEGIN.fullmatch(lines[begin])[2]
    if printed_for != board:
        faults.append(f"played for {printed_for}, not for {board}")
    end = next((i for i in range(begin + 1, len(lines)) if END.fullmatch(lines[i])), None)
    if end is None:
        faults.append("the player did not come to its end")
        return lines[begin + 1:]
    if int(END.fullmatch(lines[end])[1]) != end - begin - 1:
        faults.append(f"{end - begin - 1} lines, but the player printed {END.fullmatch(lines[end])[1]}")
    return lines[begin + 1:end]


def compare(results, reasons, lines, board, faults):
    """Appends to faults; the number of results that are right."""
    seen, right = set(), 0
    for line in lines:
        if match := RESULT.fullmatch(line):
            name, printed = match[1], " ".join(match.group(2, 3, 4))
            expected = results.get(name)
            right += printed == expected
            if expected is None:
                why = "the manifest says it is not on this board" if name.partition("/")[0] in reasons else \
                    "the manifest does not have it"
                faults.append(f"{name}: too many; {why}")
            elif printed != expected:
                faults.append(f"{name}: expected {expected}, got {printed}")
        elif match := NOT_ON.fullmatch(line):
            name = match[1]
            if match[2] != board or reasons.get(name) != match[3]:
                word = reasons.get(name)
                faults.append(f"{name}: passed over on {match[2]}: \"{match[3]}\"; the manifest "
                              + (f"has \"{word}\"" if word else "gives no reason"))
        elif match := FAILED.fullmatch(line):
            faults.append(line)
            continue  # and is missing
        else:
            faults.append(f"no line of the player: {line}")
            continue
        if name in seen:
            faults.append(f"{name}: printed twice")
        seen.add(name)
    faults += [f"{name}: missing" for name in [*results, *reasons] if name not in seen]
    return right


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("manifest")
    parser.add_argument("output")
    parser.add_argument("--board", required=True)
    options = parser.parse_args(arguments)
    faults = []
    try:
        results, reasons = read_manifest(options.manifest, options.board)
        lines = players_lines(read_lines(options.output), options.board, faults)
    except BadInput as error:
        print(error, file=sys.stderr)
        return 3
    right = compare(results, reasons, lines, options.board, faults)
    for fault in faults:
        print(fault)
    passed_over = f", {len(reasons)} cases are not on this board" if reasons else ""
    print(f"{options.board}: {right} of {len(results)} lines as in the manifest{passed_over}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
