#!/usr/bin/env python3
"""Pages of `limber view --play` against the command: check.py states|page LIMBER NODE NODE_MODULES FOLDER
SCENARIO...

states: those of `limber run` and of the page's module under node must be equal, but for what the last
bits of the C library's sines and powers grow to.
page: in headless Chromium every control must change the answer (drive_play.mjs).
Ends with 77, and says why, where the module was not built (scripts/playground) or is of other sources, or Chromium
is missing."""
import base64
import json
import pathlib
import shutil
import subprocess
import sys
import zlib

SKIPPED = 77
HERE = pathlib.Path(__file__).parent
# Of states: before a chaotic motion, as that of pendulums, makes more of a last bit.
HORIZON = "time.duration=0.5"
MARK = '<script id="limber-data" type="text/plain">'


def read_setup(page):
    text = page.read_text()
    start = text.index(MARK) + len(MARK)
    return json.loads(zlib.decompress(base64.b64decode(text[start:text.index("<", start)])))


def make_page(limber, folder, scenario, change=lambda setup: None):
    """The page and its setup, changed; results and summary.json of the command with its settings."""
    folder.mkdir(parents=True, exist_ok=True)
    page = folder / "page.html"
    subprocess.run([limber, "view", "--play", scenario, "-o", page], check=True)
    setup = read_setup(page)
    change(setup)
    options = [word for setting in setup["settings"] for word in ("--set", setting)]
    subprocess.run([limber, "-q", "run", scenario, "--out", folder / "native", *options], check=True)
    return page, setup


def check_states(limber, node, folder, scenario):
    _, setup = make_page(limber, folder, scenario, lambda setup: setup["settings"].append(HORIZON))
    setup_file = folder / "setup.json"
    setup_file.write_text(json.dumps(setup))
    subprocess.run([node, "--no-experimental-fetch", HERE / "play.mjs", setup_file,
                    folder / "played"], check=True)
    return subprocess.run([sys.executable, HERE / "compare.py", folder / "native/results.h5",
                           folder / "played"]).returncode


def check_page(limber, node, modules, folder, scenario):
    page, _ = make_page(limber, folder, scenario)
    return subprocess.run([node, HERE / "drive_play.mjs", modules, page, folder / "native/summary.json",
                           find_chromium(), folder]).returncode


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def find_chromium():
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    return chromium or skip("Chromium is not installed; scripts/install-deps --with-chromium")


def main(what, limber, node, modules, folder, *scenarios):
    asked = subprocess.run([limber, "view", "--play", scenarios[0], "-o", "/dev/null"], capture_output=True, text=True)
    if "scripts/playground" in asked.stderr:  # no module, or one of other sources
        skip(asked.stderr.strip())
    if what == "page" and not (pathlib.Path(modules) / "playwright-core").is_dir():
        skip("npm could not fetch the packages of the page")
    failed = 0
    for scenario in scenarios:
        name = pathlib.Path(scenario).stem
        print(f"{name}:", flush=True)
        at = pathlib.Path(folder) / name
        failed += (check_states(limber, node, at, scenario) if what == "states"
                   else check_page(limber, node, modules, at, scenario))
    sys.exit(1 if failed else 0)


main(*sys.argv[1:])
