# SPDX-License-Identifier: BSD-3-Clause
"""Frequencies of a rotating cantilever clamped on its axis, out of and in the plane of rotation.

Rayleigh and Ritz with polynomials x^2 .. x^13 on the Euler-Bernoulli beam with the tension of its
rotation; values of Wright, Smith, Thresher and Wang, J. Appl. Mech. 49 (1982). In units of
sqrt(E I / (rho A L^4)); lag^2 = flap^2 - Omega^2.
"""
import numpy as np
from scipy.linalg import eigh

UNIT = 1.0801234  # rad/s, of the rod of 10 m in models/spin_up.urdf
SPEEDS = (3, 6)


def find_flap(speed, terms=12):
    i = np.arange(2, 2 + terms)
    p, q = i[:, None], i[None, :]
    mass = 1.0 / (p + q + 1)
    bending = p * (p - 1) * q * (q - 1) / (p + q - 3)
    tension = 0.5 * p * q * (1.0 / (p + q - 1) - 1.0 / (p + q + 1))
    return float(np.sqrt(eigh(bending + speed**2 * tension, mass, eigvals_only=True)[0]))


def find_lag(speed):
    return float(np.sqrt(find_flap(speed) ** 2 - speed**2))


def compute():
    found = {}
    for speed in SPEEDS:
        found[f"lag_at_{speed}"] = find_lag(speed)
        found[f"flap_at_{speed}"] = find_flap(speed)
    return found


if __name__ == "__main__":
    print({s: (find_lag(s), find_flap(s)) for s in range(1, 8)}, find_flap(6, 10))
