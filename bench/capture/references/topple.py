# SPDX-License-Identifier: BSD-3-Clause
"""A box tips over its lower edge on a rough slope, lands on its side and rests there.

Planar rigid body. It turns about its edge while that sticks, slides when the friction that this takes
exceeds Coulomb's, and flies when the edge would have to be pulled; it lands when its upper corner meets the
slope. Events located by SciPy's DOP853. Nothing of this depends on stiffness.
"""
import math

import numpy as np
from scipy.integrate import solve_ivp

WIDTH, HEIGHT, MASS, G, FRICTION = 0.1, 0.3, 1.0, 9.81, 1.0
CENTRAL = MASS * (WIDTH**2 + HEIGHT**2) / 12  # about the centre [kg m^2]
NORMAL = np.array([-0.32613634554676313, 0.9453227407152556])  # x, z
ALONG = np.array([NORMAL[1], -NORMAL[0]])
CENTRE = np.array([-0.01743023525231584, 0.1571502048966177])  # at the start, the edge at 0 [m]
START = -0.4322135507465967  # rotation about y at the start [rad]
FLAT = -math.pi / 2 - math.asin(-NORMAL[0])  # rotation with the side on the slope
CORNERS = 0.5 * np.array([[-WIDTH, -HEIGHT], [WIDTH, -HEIGHT], [-WIDTH, HEIGHT], [WIDTH, HEIGHT]])
EDGE = CORNERS[0]  # the lower one, over which it tips


def turn(rotation, r):
    """Rotation about y takes z to x."""
    c, s = math.cos(rotation), math.sin(rotation)
    return np.array([c * r[0] + s * r[1], -s * r[0] + c * r[1]])


def find_edge(y):
    """Its arm from the centre, and its velocity."""
    arm = turn(y[2], EDGE)
    return arm, y[3:5] + y[5] * np.array([arm[1], -arm[0]])


def find_reaction(y, phase):
    """Normal and tangential force on the edge [N]."""
    if phase == "flies":
        return 0.0, 0.0
    arm, velocity = find_edge(y)
    lever = np.array([arm[1], -arm[0]])  # moment about y of a force f: lever @ f
    free = np.array([0.0, -G]) - y[5] ** 2 * arm
    response = np.eye(2) / MASS + np.outer(lever, lever) / CENTRAL
    if phase == "sticks":
        force = np.linalg.solve(response, -free)
        return NORMAL @ force, ALONG @ force
    sign = -math.copysign(1.0, ALONG @ velocity)
    way = NORMAL + sign * FRICTION * ALONG
    normal = -(NORMAL @ free) / (NORMAL @ response @ way)
    return normal, sign * FRICTION * normal


def find_rate(y, phase):
    normal, tangential = find_reaction(y, phase)
    force = normal * NORMAL + tangential * ALONG
    arm, _ = find_edge(y)
    spin = (arm[1] * force[0] - arm[0] * force[1]) / CENTRAL
    return np.concatenate([y[3:], force / MASS + [0.0, -G], [spin]])


def find_gap(y, corner):
    return NORMAL @ (y[:2] + turn(y[2], corner))


def advance(t, y, phase, ends):
    """Until one of `ends`, functions of the state that fall through zero."""
    def make(end):
        event = lambda _, s: end(s)  # noqa: E731
        event.terminal, event.direction = True, -1
        return event

    found = solve_ivp(lambda _, s: find_rate(s, phase), (t, 3.0), y, method="DOP853",
                      rtol=1e-11, atol=1e-12, events=[make(e) for e in ends])
    which = next(i for i, times in enumerate(found.t_events) if len(times))
    return found.t[-1], found.y[:, -1], which


def solve():
    """Phases with the times at which they begin, and the state at landing."""
    def stick(y):
        normal, tangential = find_reaction(y, "sticks")
        return FRICTION * normal - abs(tangential)

    t, y = 0.0, np.array([*CENTRE, START, 0.0, 0.0, 0.0])
    t, y, _ = advance(t, y, "sticks", [stick])
    phases = [("slides", t)]
    # The edge starts to slide the way that friction failed to hold.
    _, tangential = find_reaction(y, "sticks")
    nudge = -1e-9 * math.copysign(1.0, tangential)
    y[3:5] += nudge * ALONG
    side = lambda y: find_gap(y, CORNERS[2])  # noqa: E731
    t, y, which = advance(t, y, "slides", [side, lambda y: find_reaction(y, "slides")[0]])
    if which == 1:
        phases.append(("flies", t))
        t, y, _ = advance(t, y, "flies", [side])
    return phases, t, y


def compute():
    _, t, y = solve()
    return {"landing_time": t, "landing_rate": -y[5], "rotation": START - FLAT}


def trace():
    """Up to landing, by phases that stick and slide."""
    phases, end, _ = solve()
    slip = phases[0][1]
    start = np.array([*CENTRE, START, 0.0, 0.0, 0.0])
    times = np.linspace(0, slip, 60)
    sticks = solve_ivp(lambda _, s: find_rate(s, "sticks"), (0, slip), start, t_eval=times,
                       rtol=1e-9, atol=1e-10)
    y = sticks.y[:, -1].copy()
    times = np.linspace(slip, end, 20)
    y[3:5] -= 1e-9 * math.copysign(1.0, find_reaction(y, "sticks")[1]) * ALONG
    slides = solve_ivp(lambda _, s: find_rate(s, "slides"), (slip, end), y, t_eval=times,
                       rtol=1e-9, atol=1e-10)
    rows = [*zip(sticks.t, sticks.y[5]), *zip(slides.t, slides.y[5])]
    return "time [s],about y [rad/s]", rows


if __name__ == "__main__":
    phases, t, y = solve()
    print(phases, t, y, compute(), "edge's gap", find_gap(y, EDGE))
