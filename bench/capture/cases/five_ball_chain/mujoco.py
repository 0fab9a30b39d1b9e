"""MuJoCo: rigid balls with linear contacts that last as long as Hertz's between two."""
import math

import mjcf

VARIANTS = ("rigid",)
RADIUS = 0.01


def measure(mujoco, _):
    mass = 7850 * 4 / 3 * math.pi * RADIUS**3
    hertz = 4 / 3 * 0.5 * 210e9 / (1 - 0.3**2) * math.sqrt(0.5 * RADIUS)
    contact = mjcf.spring_contact(2.9432 * (1.25 * 0.5 * mass / hertz) ** 0.4)
    body, sensors = "", ""
    for i in range(5):
        body += f"""<body name="ball{i}" pos="{2 * RADIUS * i - 1e-6 * (i == 0)} 0 0">
<joint name="x{i}" type="slide" axis="1 0 0"/>{mjcf.inertial(mass, [0.4 * mass * RADIUS**2] * 3)}
<geom type="sphere" size="{RADIUS}" {contact}/></body>
"""
        sensors += f'<jointvel joint="x{i}" name="v{i + 1}"/>'
    key = '<keyframe><key qvel="1 0 0 0 0"/></keyframe>'
    run = mujoco.run(mjcf.scene(body, 2e-7, sensors=sensors, more=key), 3e-4, every=10)
    return {f"v{i}": run[f"v{i}:0"][-1] for i in range(1, 6)}, None
