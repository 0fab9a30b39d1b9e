#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a test runs every page with blocks of commands or Python: tests/cli/CMakeLists.txt names it.

  check_blocks.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(source / "tests/support"))
from page_blocks import read_blocks  # noqa: E402

# Their tests: check_fragments.py, and slurm_slow.py of tests/cli.
OTHERS = {"docs/reference/scenario.md", "docs/how-to/slurm.md"}
named = set(re.findall(r"\w+", (source / "tests/cli/CMakeLists.txt").read_text()))
count, problems = 0, []
for page in sorted((source / "docs").rglob("*.md")):
    name = str(page.relative_to(source))
    if any(block.language in ("sh", "python") for block in read_blocks(page)) and name not in OTHERS:
        count += 1
        if page.stem not in named:
            problems.append(f"{name}: no test of tests/cli/CMakeLists.txt runs its blocks")
if count < 20:
    problems.append("pages were not found")
if problems:
    sys.exit("\n".join(problems))
print(f"{count} pages")
