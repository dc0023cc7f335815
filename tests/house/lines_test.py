#!/usr/bin/env python3
"""No line of source is longer than .clang-format says.

clang-format --lines=N:N mends code; tables in comments are wrapped by hand, for it runs their rows together.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
limit = int(re.search(r"ColumnLimit: (\d+)", (root / ".clang-format").read_text()).group(1))
sources = [path for folder in ("boards", "firmware", "gfx_subsystem", "hal", "sim", "tests")
           for path in sorted((root / folder).rglob("*")) if path.suffix in (".cc", ".cpp", ".h")]
long_lines = [f"{path.relative_to(root)}:{number}: {len(line)} columns"
              for path in sources for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
              if len(line) > limit]
for line in long_lines:
    print(line)
if not sources:
    print(f"no sources below {root}")
sys.exit(1 if long_lines or not sources else 0)
