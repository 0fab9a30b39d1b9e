"""MuJoCo: a rigid plate. Its contact is a linear spring; its period is that of Hertz for two rigid
bodies (closed form), because nothing else is known beforehand."""
import math

import mjcf

VARIANTS = ("rigid",)
RADIUS, SPEED, MODULUS = 0.01, 1.0, 210e9 / (1 - 0.3**2)
BALL = 7850 * 4 / 3 * math.pi * RADIUS**3
SIDES = (0.2, 0.2, 0.004)


def measure(mujoco, _):
    mass = 7850 * math.prod(SIDES)
    x, y, z = SIDES
    inertia = [mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)]
    reduced = BALL * mass / (BALL + mass)
    hertz = 4 / 3 * MODULUS * math.sqrt(RADIUS)
    duration = 2.9432 * (1.25 * reduced * SPEED**2 / hertz) ** 0.4 / SPEED
    contact = mjcf.spring_contact(duration)
    half = " ".join(f"{s / 2}" for s in SIDES)
    body = f"""<body name="plate"><freejoint/>{mjcf.inertial(mass, inertia)}
<geom type="box" size="{half}" {contact}/></body>
<body name="ball" pos="0 0 {z / 2 + RADIUS + 1e-6}"><freejoint/>
{mjcf.inertial(BALL, [0.4 * BALL * RADIUS**2] * 3)}<geom type="sphere" size="{RADIUS}" {contact}/></body>"""
    key = f'<keyframe><key qpos="0 0 0 1 0 0 0 0 0 {z / 2 + RADIUS + 1e-6} 1 0 0 0" qvel="0 0 0 0 0 0 0 0 -{SPEED} 0 0 0"/></keyframe>'
    step = 2.5e-7
    run = mujoco.run(mjcf.scene(body, step, more=key), 1.5e-4)
    force = run["contact_force"]
    answers = {
        "peak_force": max(force),
        "duration": 1e6 * step * sum(f > 0 for f in force),
        "impulse": step * sum(force),
    }
    return answers, ([1e6 * t for t in run.time], force)
