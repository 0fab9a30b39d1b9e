# SPDX-License-Identifier: BSD-3-Clause
"""A slender rod of 10 m is spun up to 6 rad/s in 15 s [Simo and Vu-Quoc, J. Appl. Mech. 53 (1986)].

Planar discrete elastic rod: point masses, springs of E A between them, bending E I by the angle at
each mass, the root's direction prescribed; leapfrog. Second order in the length of a segment, so two
numbers of segments extrapolate. Stretch in steady rotation: rho Omega^2 L^3 / (3 E).
"""
import numpy as np

LENGTH, EA, EI, MU = 10.0, 2.8e7, 1.4e4, 1.2
SPEED, RISE, END = 6.0, 15.0, 18.0


def find_angle(t):
    if t >= RISE:
        return SPEED * (t - RISE / 2)
    a = 2 * np.pi * t / RISE
    return SPEED / RISE * (t * t / 2 + (RISE / (2 * np.pi)) ** 2 * (np.cos(a) - 1))


def find_forces(x, direction, h):
    """On each mass; x (n + 1, 2) starts with the root."""
    way = np.diff(x, axis=0)
    length = np.hypot(way[:, 0], way[:, 1])
    t = way / length[:, None]
    normal = np.stack([-t[:, 1], t[:, 0]], axis=1)
    before = np.vstack([direction, t[:-1]])
    turn = np.arctan2(before[:, 0] * t[:, 1] - before[:, 1] * t[:, 0], (before * t).sum(axis=1))
    # At the clamp half a segment bends: twice the stiffness.
    moment = EI / h * turn
    moment[0] *= 2.0
    after = np.append(moment[1:], 0.0)
    # d(angle of a segment)/dx = normal / length.
    pull = EA * (length / h - 1.0)[:, None] * t + ((moment - after) / length)[:, None] * normal
    force = np.zeros_like(x)
    force[:-1] += pull
    force[1:] -= pull
    return force


def solve(segments, fraction=0.5):
    """Times and the tip in the hub's axes (displacement)."""
    h = LENGTH / segments
    mass = np.full((segments + 1, 1), MU * h)
    mass[-1] *= 0.5
    x = np.stack([np.linspace(0, LENGTH, segments + 1), np.zeros(segments + 1)], axis=1)
    v = np.zeros_like(x)
    limit = 2 / (2 / h * np.sqrt(EA / MU))
    every = 0.02
    parts = int(np.ceil(every / (fraction * limit)))
    step = every / parts
    times, tips = [0.0], [np.zeros(2)]
    n = 0
    a = np.zeros_like(x)
    for row in range(int(END / every + 0.5)):
        for _ in range(parts):
            v += 0.5 * step * a
            x += step * v
            x[0] = 0.0
            n += 1
            angle = find_angle(n * step)
            direction = np.array([np.cos(angle), np.sin(angle)])
            a = find_forces(x, direction, h) / mass
            a[0] = 0.0
            v += 0.5 * step * a
        side = np.array([-direction[1], direction[0]])
        times.append((row + 1) * every)
        tips.append(np.array([x[-1] @ direction - LENGTH, x[-1] @ side]))
    return np.array(times), np.array(tips)


def measure(times, tips):
    i = np.argmax(np.abs(tips[:, 1]))
    fit = np.polyfit(times[i - 2 : i + 3] - times[i], -tips[i - 2 : i + 3, 1], 2)
    return {
        "lag": fit[2] - fit[1] ** 2 / (4 * fit[0]),
        "lag_time": times[i] - fit[1] / (2 * fit[0]),
        "foreshortening": -1e3 * tips[:, 0].min(),  # mm
        "stretch": 1e3 * tips[times > 16.0, 0].mean(),  # mm
    }


def compute(counts=(20, 40)):
    coarse, fine = (measure(*solve(n)) for n in counts)
    found = {key: fine[key] + (fine[key] - coarse[key]) / 3 for key in fine}
    found["stretch"] = 1e3 * MU * SPEED**2 * LENGTH**3 / (3 * EA)
    return found


def trace():
    times, tips = solve(40)
    return "time [s],across the hub axis [m]", list(zip(times, tips[:, 1]))[::5]


if __name__ == "__main__":
    for n in (10, 20, 40):
        times, tips = solve(n)
        print(n, measure(times, tips), flush=True)
    print(compute(), compute((10, 20)))
