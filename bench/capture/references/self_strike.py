# SPDX-License-Identifier: BSD-3-Clause
"""A rigid forearm folds back and strikes the elastic beam that carries it.

Planar: Euler-Bernoulli finite elements (cubic), clamped, reduced to their lowest modes; the forearm
turns freely about the tip; Hertz between its rubber ball and the beam's face, without loss. Small
deflections of the beam, any rotation of the forearm. Integrated by SciPy's DOP853.
"""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

LENGTH, THICK, WIDE, MODULUS, DENSITY = 1.0, 0.01, 0.03, 70e9, 2700.0
EI = MODULUS * WIDE * THICK**3 / 12
MU = DENSITY * WIDE * THICK
MASS, LEVER, REACH, INERTIA, BALL = 0.4, 0.25, 0.5, 0.0084, 0.03
ANGLE, RATE = 2.85, 3.0
DAMPING = 0.002  # ratio, of every mode
EFFECTIVE = 1 / ((1 - 0.49**2) / 5e6 + (1 - 0.33**2) / 70e9)
HERTZ = 4 / 3 * EFFECTIVE * np.sqrt(BALL)
ELEMENTS = 60
END = 0.3


def make_modes(count):
    """Frequencies squared and shapes (nodal w and slope), M-normal."""
    h = LENGTH / ELEMENTS
    k = EI / h**3 * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    m = MU * h / 420 * np.array(
        [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
         [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
    size = 2 * ELEMENTS + 2
    K, M = np.zeros((size, size)), np.zeros((size, size))
    for e in range(ELEMENTS):
        part = slice(2 * e, 2 * e + 4)
        K[part, part] += k
        M[part, part] += m
    values, shapes = eigh(K[2:, 2:], M[2:, 2:])
    return values[:count], np.vstack([np.zeros((2, count)), shapes[:, :count]])


class Arm:
    def __init__(self, count):
        self.count = count
        self.lam, self.shapes = make_modes(count)
        self.loss = 2 * DAMPING * np.sqrt(self.lam)
        self.tip = self.shapes[-2]

    def find_row(self, x):
        """Rows of w and its slope at x."""
        h = LENGTH / ELEMENTS
        e = min(max(int(x / h), 0), ELEMENTS - 1)
        s = x / h - e
        part = self.shapes[2 * e : 2 * e + 4]
        w = [1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3,
             h * (s**3 - s**2)]
        d = [(-6 * s + 6 * s**2) / h, 1 - 4 * s + 3 * s**2, (6 * s - 6 * s**2) / h,
             3 * s**2 - 2 * s]
        return np.array(w) @ part, np.array(d) @ part

    def find_force(self, y):
        q, angle = y[: self.count], y[self.count]
        place = LENGTH + REACH * np.cos(angle)
        if not 0 < place < LENGTH:
            return 0.0, None
        row, slope = self.find_row(place)
        tilt = slope @ q
        cosine = 1 / np.sqrt(1 + tilt**2)
        gap = (REACH * np.sin(angle) + (self.tip - row) @ q) * cosine - BALL - 0.5 * THICK
        force = HERTZ * max(-gap, 0.0) ** 1.5
        by_angle = (REACH * np.cos(angle) + tilt * REACH * np.sin(angle)) * cosine
        return force, np.append((self.tip - row) * cosine, by_angle)

    def rate(self, _, y):
        n = self.count
        q, angle, v, spin = y[:n], y[n], y[n + 1 : 2 * n + 1], y[-1]
        M = np.zeros((n + 1, n + 1))
        M[:n, :n] = np.eye(n) + MASS * np.outer(self.tip, self.tip)
        M[:n, n] = M[n, :n] = MASS * LEVER * np.cos(angle) * self.tip
        M[n, n] = INERTIA + MASS * LEVER**2
        f = np.append(MASS * LEVER * np.sin(angle) * spin**2 * self.tip - self.lam * q - self.loss * v, 0.0)
        force, by = self.find_force(y)
        if force > 0:
            f += force * by
        return np.concatenate([v, [spin], np.linalg.solve(M, f)])

    def find_root_moment(self, y):
        """E I w'' at the root."""
        h = LENGTH / ELEMENTS
        part = self.shapes[:4] @ y[: self.count]
        return EI * (np.array([-6, -4 * h, 6, -2 * h]) / h**2) @ part


def solve(count=10, step=2.5e-5):
    arm = Arm(count)
    y = np.zeros(2 * count + 2)
    y[count], y[-1] = ANGLE, RATE
    times = np.arange(0, END + step / 2, step)
    found = solve_ivp(arm.rate, (0, END), y, method="DOP853", rtol=1e-8, atol=1e-10, t_eval=times)
    force = np.array([arm.find_force(s)[0] for s in found.y.T])
    moment = np.array([arm.find_root_moment(s) for s in found.y.T])
    return times, force, moment, arm.tip @ found.y[:count], found.y[count]


def compute(count=16):
    times, force, moment, tip, angle = solve(count)
    on = np.flatnonzero(force > 0)
    first = on[: np.argmax(np.diff(on) > 1) + 1] if np.any(np.diff(on) > 1) else on
    return {
        "peak_force": force[first].max(),
        "impulse": np.trapz(force[first], times[first]),
        "duration": 1e3 * (times[first[-1]] - times[first[0]] + times[1]),  # ms
        "tip": 1e3 * np.abs(tip).max(),  # mm
        "root_moment": np.abs(moment).max(),
    }


def trace(count=16):
    times, _, moment, _, _ = solve(count)
    return "time [s],moment [N m]", list(zip(times, moment))[::40]


if __name__ == "__main__":
    for count in (6, 10, 16):
        print(count, compute(count))
