# SPDX-License-Identifier: BSD-3-Clause
"""Natural frequencies of an arm of the Shuttle arm's size with elastic gearboxes, held at the shoulder.

Straight along x, so three problems part: across in y (shoulder yaw, wrist yaw), across in z
(shoulder, elbow, wrist pitch), torsion (wrist roll). Timoshenko finite elements (linear, reduced
integration, 400 an arm), point inertia at the end.
"""
import numpy as np
from scipy.linalg import eigh

BOOMS = ((6.4, 4.2e6, 21.0), (7.0, 3.2e6, 14.0))  # length [m], E I [N m^2], kg/m
SIDE, NU, KAPPA = 0.1, 0.3, 5 / 6  # of the solid square that stands for the tube
GEARS_Y = (4.0e5, None, 1.8e5)  # N m/rad: shoulder, elbow, wrist; None: no joint in that plane
GEARS_Z = (9.0e5, 5.0e5, 1.8e5)
WRIST, WRIST_MASS = 1.8, 160.0  # length, mass of wrist and end effector
WRIST_ABOUT = 43.0  # across, about its middle [kg m^2]


def assemble(gears, elements=200):
    """K and M of one plane: unknowns are w and slope at nodes, slopes doubled at gears."""
    K, M = {}, {}

    def add(matrix, unknowns, block):
        for i, p in enumerate(unknowns):
            for j, q in enumerate(unknowns):
                matrix[p, q] = matrix.get((p, q), 0.0) + block[i, j]

    count = 0

    def new():
        nonlocal count
        count += 1
        return count - 1

    w = slope = None  # held at the shoulder
    for (length, ei, mu), gear in zip(BOOMS, gears):
        before, slope = slope, new() if gear is not None else slope
        if gear is not None:
            one = [slope] if before is None else [before, slope]
            spring = np.array([[1.0]]) if before is None else np.array([[1.0, -1.0], [-1.0, 1.0]])
            add(K, one, gear * spring)
        h = length / elements
        modulus = ei * 12 / SIDE**4
        shear = KAPPA * SIDE**2 * modulus / (2 * (1 + NU))
        rotary = mu / SIDE**2 * SIDE**4 / 12
        for _ in range(elements):
            ends = [w, slope, new(), new()]
            w, slope = ends[2:]
            bend = np.array([0, -1, 0, 1]) / h
            shears = np.array([-1 / h, -0.5, 1 / h, -0.5])
            k = h * (ei * np.outer(bend, bend) + shear * np.outer(shears, shears))
            line = h / 6 * np.array([[2, 1], [1, 2]])
            m = np.zeros((4, 4))
            m[np.ix_([0, 2], [0, 2])] = mu * line
            m[np.ix_([1, 3], [1, 3])] = rotary * line
            keep = [i for i, e in enumerate(ends) if e is not None]
            unknowns = [ends[i] for i in keep]
            add(K, unknowns, k[np.ix_(keep, keep)])
            add(M, unknowns, m[np.ix_(keep, keep)])
    before, slope = slope, new()
    add(K, [before, slope], gears[2] * np.array([[1.0, -1.0], [-1.0, 1.0]]))
    half = WRIST / 2
    m = WRIST_MASS * np.array([[1, half], [half, half**2]]) + np.diag([0, WRIST_ABOUT])
    add(M, [w, slope], m)

    def fill(matrix):
        full = np.zeros((count, count))
        for (p, q), value in matrix.items():
            full[p, q] = value
        return full

    return fill(K), fill(M)


def find_plane(gears, elements=200, count=4):
    values = eigh(*assemble(gears, elements), eigvals_only=True, subset_by_index=[0, count - 1])
    return np.sqrt(values) / (2 * np.pi)


def compute(elements=200):
    found = sorted([*find_plane(GEARS_Y, elements), *find_plane(GEARS_Z, elements)])
    return {f"f{i + 1}": found[i] for i in range(6)}


def trace():
    return "mode,frequency [Hz]", [(i + 1, f) for i, f in enumerate(compute().values())]


if __name__ == "__main__":
    print(compute(60))
    print(compute(), find_plane(GEARS_Y), find_plane(GEARS_Z))
