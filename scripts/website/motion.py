# SPDX-License-Identifier: BSD-3-Clause
"""Runs examples and writes their pages of `limber view`, and of those that simulate."""
import re
import subprocess
import sys
import tempfile

MOVING = re.compile(r"<!-- in motion: (\w+) -->")
PLAYED = re.compile(r"<!-- to play: (\w+) -->")


def write(source, limber, pages):
    """Those that docs/gallery.md shows in motion or to play."""
    gallery = (source / "docs/gallery.md").read_text()
    for folder in ("motion", "play"):
        (pages / folder).mkdir(parents=True, exist_ok=True)
    for name in MOVING.findall(gallery):
        with tempfile.TemporaryDirectory() as folder:
            call(limber, "run", source / f"examples/{name}.toml", "--out", folder, "--quiet")
            call(limber, "view", folder, "-o", pages / f"motion/{name}.html")
    if not (limber.parent / "playground.wasm").exists():
        print("site: without examples to play, whose module scripts/playground builds", file=sys.stderr)
        return
    for name in PLAYED.findall(gallery):
        call(limber, "view", "--play", source / f"examples/{name}.toml", "-o", pages / f"play/{name}.html")


def call(limber, *words):
    result = subprocess.run([limber, *map(str, words)], capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(f"site: limber {words[0]}: {result.stderr}")
