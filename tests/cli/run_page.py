#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the files of a page in docs/ and runs its commands, one block after the
other; fails at the first that fails.

  run_page.py LIMBER SOURCE_FOLDER PAGE WORK_FOLDER
"""
import os
import pathlib
import shutil
import subprocess
import sys

limber, source = (pathlib.Path(text).resolve() for text in sys.argv[1:3])
page = source / sys.argv[3]
work = pathlib.Path(sys.argv[4]).resolve()
sys.path.insert(0, str(source / "tests/support"))
from page_blocks import read_blocks  # noqa: E402

shutil.rmtree(work, ignore_errors=True)
(work / "bin").mkdir(parents=True)
(work / "bin/limber").symlink_to(limber)
environment = {**os.environ, "LIMBER_CACHE": str(work / "cache"),
               "PATH": f"{work / 'bin'}:{os.environ['PATH']}"}
commands = 0
for block in read_blocks(page):
    if "file" in block.values:
        (work / block.values["file"]).write_text(block.text)
    elif block.language == "sh":
        commands += 1
        print(f"{page.name}:{block.line}: {block.text}", flush=True)
        result = subprocess.run(["bash", "-euc", block.text], cwd=work, env=environment,
                                capture_output=True, text=True)
        print(result.stdout, result.stderr, sep="", flush=True)
        if result.returncode != 0:
            sys.exit(f"{page}:{block.line}: status {result.returncode}")
        expected = block.values.get("warns")
        warns = "limber: warning:" in result.stderr
        if expected is not None and warns != (expected == "yes"):
            sys.exit(f"{page}:{block.line}: warnings: expected {expected}")
if commands == 0:
    sys.exit(f"{page} has no commands")
