# SPDX-License-Identifier: BSD-3-Clause
"""The scene that is attacked, and whether two runs gave the same answer."""

import shutil
from pathlib import Path

HERE = Path(__file__).resolve().parent / "scene"
MATERIAL = ["--youngs-modulus", "70e9", "--poisson-ratio", "0.33",
            "--density", "2700"]
MESH = Path(__file__).resolve().parents[2] / "meshes" / "beam579.msh"
FILES = ["arm.toml", "arm.urdf", "bar.geo"]


def lay_out(place):
    """Copies the scene into a folder."""
    for name in FILES:
        shutil.copy(HERE / name, place)


def read(name):
    return (HERE / name).read_text()


def answers_differ(one, other):
    """What differs between two results folders, of what a run computes."""
    for name in ("probes.csv", "results.h5"):
        files = [Path(folder) / name for folder in (one, other)]
        if any(not file.exists() for file in files):
            return f"no {name}"
        if files[0].read_bytes() != files[1].read_bytes():
            return f"another {name}"
    return ""
