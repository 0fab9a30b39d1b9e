# SPDX-License-Identifier: BSD-3-Clause
"""The scenes that are attacked, and whether two runs gave the same answer."""

import shutil
from pathlib import Path

HERE = Path(__file__).resolve().parent / "scene"
MATERIAL = ["--youngs-modulus", "70e9", "--poisson-ratio", "0.33",
            "--density", "2700"]
MESH = Path(__file__).resolve().parents[2] / "meshes" / "beam579.msh"
SCENES = ["arm", "craft"]
NODES = 135  # of bar.geo
# Made here, because the values of nodes mean nothing.
NODAL = {
    "u.txt": "".join(f"{1e-6 * (row % 7):g}\n" for row in range(3 * NODES)),
    "nodes.txt": "0.0 0.02\n" + "".join(
        f"{0.01 * (row % 5):g} {-0.005 * (row % 3):g}\n" for row in range(3 * NODES)),
}
FILES = sorted([file.name for file in HERE.iterdir()] + list(NODAL))


def run_words(name, out="out"):
    return ["run", f"{name}.toml", "--out", out]


def read(name):
    return NODAL.get(name) or (HERE / name).read_text()


def lay_out(place):
    """Copies the scenes into a folder."""
    for file in HERE.iterdir():
        shutil.copy(file, place)
    for name, text in NODAL.items():
        (Path(place) / name).write_text(text)


def answers_differ(one, other):
    """What differs between two results folders, of what a run computes."""
    for name in ("probes.csv", "results.h5"):
        files = [Path(folder) / name for folder in (one, other)]
        if any(not file.exists() for file in files):
            return f"no {name}"
        if files[0].read_bytes() != files[1].read_bytes():
            return f"another {name}"
    return ""
