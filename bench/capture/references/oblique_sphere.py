# SPDX-License-Identifier: BSD-3-Clause
"""An elastic sphere strikes a half space of its own material obliquely.

The tangential problem of circles in contact is solved exactly by superposing flat rings (J. Jaeger,
Acta Mechanica 96 (1993); the results are those of Maw, Barber and Fawcett, Wear 38 (1976)): a ring of
radius a has normal stiffness 2 E* da and tangential stiffness kappa times that, and slips at mu times
its own pressure, with the force kept from before when it slips. Time by leapfrog.

In units of mu v_n / kappa the velocity psi2 with which the place of contact leaves follows from
psi1, with which it comes; kappa = 2 (1 - nu) / (2 - nu).
"""
import numpy as np

NU = 0.3
KAPPA = 2 * (1 - NU) / (2 - NU)
PSI = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0)


def strike(psi1, friction=0.3, rings=600, steps=20000):
    """psi2. Units: mass, normal speed, Hertz's stiffness 1; force d^1.5, d = a^2 / R."""
    # F = k d^1.5 with k = 4/3 E* sqrt(R) = 1, R = 1: E* = 0.75; ring at a: 2 E* da.
    deepest = 1.25**0.4  # v = 1: k d^2.5 / 2.5 = 1 / 2
    a = (np.arange(rings) + 0.5) * np.sqrt(deepest) * 1.0001 / rings
    stiff = 2 * 0.75 * np.sqrt(deepest) * 1.0001 / rings
    held = np.zeros(rings)  # tangential force on each ring
    d, w, v = 0.0, 1.0, psi1 * friction / KAPPA
    h = 2.94 * deepest / steps
    tangential = 0.0
    while True:
        w -= 0.5 * h * max(d, 0.0) ** 1.5
        v -= 0.5 * h * 3.5 * tangential
        d += h * w
        if d <= 0.0:
            return v * KAPPA / friction
        load = stiff * np.maximum(d - a**2, 0.0)
        held = np.clip(held + KAPPA * stiff * h * v * (load > 0), -friction * load, friction * load)
        tangential = held.sum()
        w -= 0.5 * h * max(d, 0.0) ** 1.5
        v -= 0.5 * h * 3.5 * tangential


def compute():
    return {f"psi2_at_{psi:g}": strike(psi) for psi in PSI}


def trace():
    psi = np.concatenate([[0.05], np.arange(0.25, 8.1, 0.25)])
    return "before psi1,after psi2", [(p, strike(p, rings=300, steps=10000)) for p in psi]


if __name__ == "__main__":
    for psi in PSI:
        print(psi, strike(psi, rings=300, steps=10000), strike(psi))
