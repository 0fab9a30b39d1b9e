# SPDX-License-Identifier: BSD-3-Clause
"""A four-bar linkage that swings through on its own: rigid links by loop closure, and its rod as a
slender beam between pins. Planar; the formulas are those of docs/theory/verification.md.
"""
import math

import numpy as np
from scipy.integrate import quad, solve_ivp

CRANK, ROD, ROCKER, GROUND = 0.1, 0.5, 0.3, 0.5  # m
MU = 2700 * 0.01**2  # kg/m
EI = 70e9 * 0.01**4 / 12  # N m^2
CRANK_ABOUT = 0.004 + 1.5 * 0.02**2  # kg m^2
ROCKER_ABOUT = 0.003 + 0.4 * 0.15**2
RATE, END = 20.0, 0.5  # rad/s at the start, s


def along(angle):
    return np.array([math.cos(angle), math.sin(angle)])


def across(angle):
    return np.array([-math.sin(angle), math.cos(angle)])


def place(theta):
    """Rod's angle, rate of its middle by theta, and the linkage's inertia."""
    way = np.array([GROUND, 0.0]) - CRANK * along(theta)
    squared = way @ way
    rod = math.atan2(way[1], way[0]) + math.acos(
        (ROD**2 + squared - ROCKER**2) / (2 * ROD * math.sqrt(squared))
    )
    end = CRANK * along(theta) + ROD * along(rod) - np.array([GROUND, 0.0])
    psi = math.atan2(end[1], end[0])
    rod_rate = -CRANK * across(theta) @ along(psi) / (ROD * across(rod) @ along(psi))
    rocker_rate = CRANK * across(theta) @ along(rod) / (ROCKER * across(psi) @ along(rod))
    middle = CRANK * across(theta) + 0.5 * ROD * rod_rate * across(rod)
    inertia = (
        CRANK_ABOUT
        + ROCKER_ABOUT * rocker_rate**2
        + MU * ROD * (middle @ middle + (ROD**2 + 0.01**2) / 12 * rod_rate**2)
    )
    return rod, middle, inertia


def find_rate(theta):
    return RATE * math.sqrt(place(0.0)[2] / place(theta)[2])


def find_deflection(theta):
    """Of the rod's middle by the rod's own inertia [m]."""
    step = 1e-5
    velocity = [place(x)[1] * find_rate(x) for x in (theta - step, theta + step)]
    acceleration = (velocity[1] - velocity[0]) / (2 * step) * find_rate(theta)
    a = acceleration @ across(place(theta)[0])
    return -5 * MU * a * ROD**4 / (384 * EI)


def find_frequency(theta):
    """Of the rod between pins on moving links [Hz]."""
    rod, middle, inertia = place(theta)
    shared = MU * 2 * ROD / math.pi * (middle @ across(rod))
    pinned = 0.5 * math.pi * math.sqrt(EI / (MU * ROD**4))
    return pinned / math.sqrt(1 - shared**2 / (0.5 * MU * ROD * inertia))


def find_slowing(theta):
    k = math.pi**4 * EI / (2 * ROD**3)
    energy = [0.5 * k * find_deflection(x) ** 2 for x in (0.0, theta)]
    return (energy[0] + 3 * energy[1]) / (place(theta)[2] * find_rate(theta))


def solve():
    """Angle and mean lag over time."""
    return solve_ivp(
        lambda t, y: [find_rate(y[0]), find_slowing(y[0])],
        (0, END),
        [0.0, 0.0],
        rtol=1e-9,
        atol=1e-12,
        dense_output=True,
    )


def compute():
    solution = solve()
    angle, lag = solution.y[:, -1]
    mean = quad(lambda t: find_frequency(solution.sol(t)[0]), 0, END, epsrel=1e-5)[0] / END
    # Shear and rotary inertia of the first mode, Timoshenko: 0.07 %.
    return {"crank": angle - lag, "lag": 1e3 * lag, "frequency": mean * (1 - 7e-4)}


if __name__ == "__main__":
    print(compute())
