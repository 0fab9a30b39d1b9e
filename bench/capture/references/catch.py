# SPDX-License-Identifier: BSD-3-Clause
"""A free palm holds a satellite that drifted and tumbled: what momentum alone says of both after.

Linear momentum: the velocity of the common centre of mass. Angular momentum about z: the satellite's
alone at the start (it drifts along z); then both turn as one, with the moments of inertia of palm,
satellite and closed fingers, whose place is known to a few millimetres.
"""
PALM, SATELLITE = 20.0, 8.0  # kg
PALM_ABOUT, SATELLITE_ABOUT = 0.4, 0.02  # about z [kg m^2]
DENSITY, THICK, WIDE = 2700.0, 0.008, 0.02
PROXIMAL, DISTAL, PAD = DENSITY * THICK * WIDE * 0.2, DENSITY * THICK * WIDE * 0.15, 0.02  # kg
DRIFT, SPIN = -0.02, 0.5  # m/s, rad/s
RADIUS, OFFSET = 0.095, 0.01  # of the fingers about the axis; between the axes at the start [m]


def compute():
    fingers = 3 * (PROXIMAL + DISTAL + PAD)
    free = PALM + fingers
    total = free + SATELLITE
    reduced = free * SATELLITE / total
    about = PALM_ABOUT + SATELLITE_ABOUT + fingers * RADIUS**2 + reduced * OFFSET**2
    return {
        "drift": 1e3 * SATELLITE * DRIFT / total,  # mm/s
        "spin": SATELLITE_ABOUT * SPIN / about,
        "slip": 0.0,
    }


if __name__ == "__main__":
    print(compute())
