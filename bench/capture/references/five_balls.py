# SPDX-License-Identifier: BSD-3-Clause
"""Five equal elastic balls in a row that touch; the first comes with 1 m/s.

Hertz between neighbours, F = k d^1.5, integrated by SciPy's DOP853. Velocities at the end do not
depend on size, mass and modulus, only the time does.
"""
import numpy as np
from scipy.integrate import solve_ivp

BALLS = 5


def solve(tolerance=1e-12):
    def rate(_, y):
        x, v = y[:BALLS], y[BALLS:]
        force = np.maximum(x[:-1] - x[1:], 0.0) ** 1.5
        return np.concatenate([v, np.append(0, force) - np.append(force, 0)])

    start = np.zeros(2 * BALLS)
    start[BALLS] = 1.0
    # After 30 units the last pair is apart (an impact of two lasts about 3.2).
    return solve_ivp(rate, (0, 60), start, method="DOP853", rtol=tolerance, atol=tolerance)


def compute():
    v = solve().y[BALLS:, -1]
    return {f"v{i + 1}": v[i] for i in range(BALLS)}


if __name__ == "__main__":
    print(compute(), solve(1e-9).y[BALLS:, -1])
