# SPDX-License-Identifier: BSD-3-Clause
"""Runs examples and writes their pages of `limber view`."""
import re
import subprocess
import tempfile

MARK = re.compile(r"<!-- in motion: (\w+) -->")


def write(source, limber, pages):
    """Those that docs/gallery.md shows in motion."""
    names = MARK.findall((source / "docs/gallery.md").read_text())
    (pages / "motion").mkdir(parents=True, exist_ok=True)
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            call(limber, "run", source / f"examples/{name}.toml", "--out", folder, "--quiet")
            call(limber, "view", folder, "-o", pages / f"motion/{name}.html")


def call(limber, *words):
    result = subprocess.run([limber, *map(str, words)], capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(f"site: limber {words[0]}: {result.stderr}")
