#!/usr/bin/env python3
"""The playground's module under node against the command: check.py LIMBER NODE FOLDER SCENARIO...
The states of `limber run` and of the page of `limber view --play` must be equal to the bit, at all
outputs: scenes without turned mounts, as the last bit of a sine is that of the C library. Ends with 77, and
says why, where the module was not built (scripts/playground)."""
import base64
import json
import pathlib
import subprocess
import sys
import zlib

SKIPPED = 77
HERE = pathlib.Path(__file__).parent
MARK = '<script id="limber-data" type="text/plain">'


def read_setup(page):
    text = page.read_text()
    start = text.index(MARK) + len(MARK)
    return json.loads(zlib.decompress(base64.b64decode(text[start:text.index("<", start)])))


def check(limber, node, folder, scenario):
    folder.mkdir(parents=True, exist_ok=True)
    page, setup_file = folder / "page.html", folder / "setup.json"
    subprocess.run([limber, "view", "--play", scenario, "-o", page], check=True)
    setup = read_setup(page)
    setup_file.write_text(json.dumps(setup))
    options = [word for setting in setup["settings"] for word in ("--set", setting)]
    subprocess.run([limber, "-q", "run", scenario, "--out", folder / "native", *options], check=True)
    subprocess.run([node, "--no-experimental-fetch", HERE / "play.mjs", setup_file,
                    folder / "played"], check=True)
    return subprocess.run([sys.executable, HERE / "compare.py", folder / "native/results.h5",
                           folder / "played"]).returncode


def main(limber, node, folder, *scenarios):
    module = pathlib.Path(limber).parent / "playground.wasm"
    if not module.exists():
        print(f"skipped: {module} is not there; scripts/playground builds it")
        sys.exit(SKIPPED)
    unequal = 0
    for scenario in scenarios:
        name = pathlib.Path(scenario).stem
        print(f"{name}:", flush=True)
        unequal += check(limber, node, pathlib.Path(folder) / name, scenario)
    sys.exit(1 if unequal else 0)


main(*sys.argv[1:])
