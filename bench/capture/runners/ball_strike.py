"""A steel ball of 20 mm strikes a free steel body with 1 m/s: what the cases of a bar and a plate share."""
import math

import mjcf

RADIUS, SPEED, MODULUS = 0.01, 1.0, 210e9 / (1 - 0.3**2)
BALL = 7850 * 4 / 3 * math.pi * RADIUS**3


def strike(mujoco, sides, end):
    """Answers and curve of a run to `end` [s] in which the ball falls on the middle of a free rigid box."""
    mass = 7850 * math.prod(sides)
    x, y, z = sides
    inertia = [mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)]
    reduced = BALL * mass / (BALL + mass)
    hertz = 4 / 3 * MODULUS * math.sqrt(RADIUS)
    duration = 2.9432 * (1.25 * reduced * SPEED**2 / hertz) ** 0.4 / SPEED
    contact = mjcf.spring_contact(duration)
    half = " ".join(f"{s / 2}" for s in sides)
    body = f"""<body name="struck"><freejoint/>{mjcf.inertial(mass, inertia)}
<geom type="box" size="{half}" {contact}/></body>
<body name="ball" pos="0 0 {z / 2 + RADIUS + 1e-6}"><freejoint/>
{mjcf.inertial(BALL, [0.4 * BALL * RADIUS**2] * 3)}<geom type="sphere" size="{RADIUS}" {contact}/></body>"""
    key = f'<keyframe><key qpos="0 0 0 1 0 0 0 0 0 {z / 2 + RADIUS + 1e-6} 1 0 0 0" qvel="0 0 0 0 0 0 0 0 -{SPEED} 0 0 0"/></keyframe>'
    step = 2.5e-7
    run = mujoco.run(mjcf.scene(body, step, more=key), end)
    force = run["contact_force"]
    answers = {
        "peak_force": max(force),
        "duration": 1e6 * step * sum(f > 0 for f in force),
        "impulse": step * sum(force),
    }
    return answers, ([1e6 * t for t in run.time], force)


def read_impact(run):
    """The same of a run of Limber with the probe 'impact'."""
    contact = run.contacts[0]
    answers = {
        "peak_force": contact["peak_force"],
        "duration": 1e6 * contact["duration"],
        "impulse": contact["impulse"],
    }
    return answers, ([1e6 * t for t in run.time], run["impact.normal_force"])
