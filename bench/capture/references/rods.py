# SPDX-License-Identifier: BSD-3-Clause
"""A steel rod flies flat onto an equal one at rest: the wave solution (Saint-Venant, 1867).

Force E A v / (2 c) for 2 L / c; the first stops, the other leaves with v.
"""
import math

LENGTH, SIDE, MODULUS, DENSITY, SPEED = 1.0, 0.01, 210e9, 7850.0, 1.0


def compute():
    c = math.sqrt(MODULUS / DENSITY)
    force = 0.5 * MODULUS * SIDE**2 * SPEED / c
    duration = 2 * LENGTH / c
    return {
        "peak_force": force,
        "mean_force": force,
        "duration": 1e6 * duration,  # us
        "impulse": force * duration,
    }


def trace():
    found = compute()
    force, end = found["peak_force"], found["duration"]
    return "time [us],force [N]", [(0, 0), (0, force), (end, force), (end, 0)]


if __name__ == "__main__":
    print(compute())
