"""MuJoCo: booms as rigid segments with springs between them, from the mass matrix."""
import re

import mjcf
import numpy as np
from scipy.linalg import eigh

VARIANTS = {"rigid": 0, "segments": 20, "twice the segments": 40}  # segments
BOOMS = ((6.4, 4.2e6, 21.0), (7.0, 3.2e6, 14.0))
GEARS = {"shoulder": {"z": 4.0e5, "y": 9.0e5}, "elbow": {"y": 5.0e5}, "wrist": {"y": 1.8e5, "z": 1.8e5}}


def make_joints(place, halves):
    """A gear in series with half a segment of each boom that it joins, by axis."""
    lines = []
    for axis, way in (("z", "0 0 1"), ("y", "0 1 0")):
        gear = GEARS[place].get(axis)
        soft = sum(halves) + (1 / gear if gear else 0.0)
        if soft > 0:
            lines.append(f'<joint name="{place}_{axis}" type="hinge" axis="{way}" stiffness="{1 / soft:.12g}"/>')
    return "".join(lines)


def measure(mujoco, variant):
    segments = VARIANTS[variant]
    halves = [length / segments / (2 * bending) if segments else 0.0 for length, bending, _ in BOOMS]

    def make_boom(i, joints, inside):
        length, bending, mu = BOOMS[i]
        bends = {"y": bending, "z": bending} if segments else {}
        return mjcf.beam(f"boom{i}", length, segments or 1, mu, (0.1, 0.1), bends, inside, root=joints)

    hand = make_joints("wrist", halves[1:]) + mjcf.inertial(160, (5, 43, 43), "0.9 0 0")
    body = make_boom(0, make_joints("shoulder", halves[:1]), make_boom(1, make_joints("elbow", halves), hand))
    model = mjcf.scene(body, 1e-3)
    stiffness = [float(k) for k in re.findall(r'<joint [^>]*stiffness="([^"]*)"', model)]
    values = eigh(np.diag(stiffness), np.array(mujoco.mass_matrix(model)), eigvals_only=True)
    found = [float(f) for f in np.sqrt(values[:6]) / (2 * np.pi)]
    return {f"f{i + 1}": f for i, f in enumerate(found)}, (range(1, len(found) + 1), found)
