#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the files of a page in docs/ and runs its commands and Python scripts, one
block after the other; fails at the first that fails. The page finds the folders
examples, models and meshes of the sources, and a block `with=NAME:FOLDER` a folder of the
sources under a name. A Python block `goes_on=yes` continues those before it; a block
`runs=no` is left out. Each line of a block `text shows=yes` is among those that the last
one printed: words alike, numbers within 2 %, or two units of the last digit of a fraction,
and anything after an ending "...".

  run_page.py LIMBER SOURCE_FOLDER PAGE WORK_FOLDER [PYTHON_FOLDER]

Without the folder of the Python module, scripts that import it are skipped.
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
from shown_text import has_line  # noqa: E402

shutil.rmtree(work, ignore_errors=True)
(work / "bin").mkdir(parents=True)
(work / "bin/limber").symlink_to(limber)
for folder in ("examples", "models", "meshes"):
    (work / folder).symlink_to(source / folder)
environment = {"LIMBER_CACHE": str(work / "cache"), **os.environ,
               "PATH": f"{work / 'bin'}:{os.environ['PATH']}"}
if len(sys.argv) > 5:
    environment["PYTHONPATH"] = sys.argv[5]
programs = {"sh": ["bash", "-euc"], "python": ["/usr/bin/python3", "-c"]}
commands, output, before = 0, "", ""
for block in read_blocks(page):
    if "with" in block.values:
        name, folder = block.values["with"].split(":")
        (work / name).symlink_to(source / folder)
    if "runs" in block.values:
        print(f"{page.name}:{block.line}: skipped: what it needs is not everywhere")
        continue
    if "file" in block.values:
        (work / block.values["file"]).write_text(block.text)
    elif block.language in programs:
        if "import limber" in block.text and "PYTHONPATH" not in environment:
            print(f"{page.name}:{block.line}: skipped: needs the Python module")
            continue
        commands += 1
        script = block.text
        if block.language == "python":
            script = before = (before if "goes_on" in block.values else "") + block.text
        print(f"{page.name}:{block.line}: {block.text}", flush=True)
        result = subprocess.run([*programs[block.language], script], cwd=work,
                                env=environment, capture_output=True, text=True)
        print(result.stdout, result.stderr, sep="", flush=True)
        output = result.stdout + result.stderr
        if result.returncode != 0:
            sys.exit(f"{page}:{block.line}: status {result.returncode}")
        expected = block.values.get("warns")
        warns = "limber: warning:" in result.stderr
        if expected is not None and warns != (expected == "yes"):
            sys.exit(f"{page}:{block.line}: warnings: expected {expected}")
    elif "shows" in block.values:
        lost = [line for line in block.text.splitlines() if not has_line(line, output)]
        if lost:
            sys.exit(f"{page}:{block.line}: not printed: " + "\n".join(lost))
if commands == 0:
    sys.exit(f"{page} has no commands")
