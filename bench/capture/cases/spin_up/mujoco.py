"""MuJoCo: the rod as rigid segments that bend and stretch; the hub follows the angle by a stiff servo."""
import math
import statistics

import mjcf

VARIANTS = {"segments": 10, "twice the segments": 20}  # segments
EA, EI, MU, SPEED, RISE = 2.8e7, 1.4e4, 1.2, 6.0, 15.0


def find_angle(t):
    if t >= RISE:
        return SPEED * (t - RISE / 2)
    return SPEED / RISE * (t * t / 2 + (RISE / (2 * math.pi)) ** 2 * (math.cos(2 * math.pi * t / RISE) - 1))


def measure(mujoco, variant):
    segments = VARIANTS[variant]
    rod = mjcf.beam("rod", 10.0, segments, MU, (0.0775, 0.0775), {"z": EI},
                    '<site name="tip" pos="0 0 0"/>', stretch=EA)
    hub = f'<body name="hub"><joint name="axle" type="hinge" axis="0 0 1"/>{mjcf.inertial(100, (10, 10, 10))}{rod}</body>'
    actuator = '<actuator><position joint="axle" kp="1e8"/></actuator>'
    sensors = '<framepos objtype="site" objname="tip" name="tip"/><jointpos joint="axle" name="axle"/>'
    step = 1e-3 / segments
    control = [(0.02 * i, find_angle(0.02 * i)) for i in range(910)]
    run = mujoco.run(mjcf.scene(hub, step, sensors=sensors, more=actuator), 18.0,
                     every=round(0.01 / step), control=control)
    along, across = [], []
    for x, y, angle in zip(run["tip:0"], run["tip:1"], run["axle:0"]):
        along.append(x * math.cos(angle) + y * math.sin(angle) - 10.0)
        across.append(y * math.cos(angle) - x * math.sin(angle))
    i = max(range(len(across)), key=lambda i: abs(across[i]))
    answers = {
        "lag": abs(across[i]),
        "lag_time": run.time[i],
        "foreshortening": -1e3 * min(along),
        "stretch": 1e3 * statistics.fmean(x for t, x in zip(run.time, along) if t > 16.0),
    }
    return answers, (run.time, across)
