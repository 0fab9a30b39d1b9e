#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that scripts which make things refuse what they do not know, and say what is missing, at once and in words.

  check_scripts.py SOURCE_FOLDER
"""
import pathlib
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[1]).resolve()
nowhere = tempfile.mkdtemp()
CASES = [(script, "--nonsense") for script in ("package", "playground", "gallery", "site", "schema", "robots")] + [
    ("package", "--try", "--dist", nowhere), ("gallery", "--check", "--build", nowhere),
    ("playground", "one", "two"), ("package", "rpm")]
problems = []
for script, *words in CASES:
    try:
        done = subprocess.run([source / "scripts" / script, *words], capture_output=True, text=True, timeout=60)
    except subprocess.TimeoutExpired:
        problems.append(f"{script} {' '.join(words)}: works on")
        continue
    if done.returncode == 0 or not done.stderr or "Traceback" in done.stderr:
        problems.append(f"{script} {' '.join(words)}: status {done.returncode}: {done.stderr[-300:]}")
pathlib.Path(nowhere).rmdir()
if problems:
    sys.exit("\n".join(problems))
print(f"{len(CASES)} calls")
