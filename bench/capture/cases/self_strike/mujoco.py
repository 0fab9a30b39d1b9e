"""MuJoCo: the beam as rigid segments; the contact is a linear spring that lasts as long as Hertz's
between the forearm and a fixed beam."""
import math

import mjcf

VARIANTS = {"rigid": 1, "segments": 25}  # segments
BENDING, MU, STEP = 70e9 * 0.03 * 0.01**3 / 12, 2700 * 3e-4, 1e-5
EFFECTIVE = 1 / ((1 - 0.49**2) / 5e6 + (1 - 0.33**2) / 70e9)


def simulate(mujoco, segments, half_period):
    contact = mjcf.spring_contact(half_period)
    forearm = f"""<body name="forearm" euler="0 0 2.85"><joint name="elbow" type="hinge" axis="0 0 1"/>
{mjcf.inertial(0.4, (1e-4, 0.0084, 0.0084), "0.25 0 0")}
<geom type="sphere" size="0.03" pos="0.5 0 0" contype="1" conaffinity="2" {contact}/></body>"""
    geoms = f'<geom type="box" size="{{half}} 0.005 0.015" pos="{{half}} 0 0" contype="2" conaffinity="1" {contact}/>'
    bends, root = ({"z": BENDING}, None) if segments > 1 else ({}, "")
    body = mjcf.beam("beam", 1.0, segments, MU, (0.01, 0.03), bends, forearm, root=root, geoms=geoms)
    sensors = '<framepos objtype="xbody" objname="beam_tip" name="tip"/>'
    if segments > 1:
        sensors += '<jointpos joint="beam_z_0" name="root"/>'
    rates = " ".join(["0"] * (segments if segments > 1 else 0) + ["3"])
    key = f'<keyframe><key qvel="{rates}"/></keyframe>'
    return mujoco.run(mjcf.scene(body, STEP, sensors=sensors, more=key), 0.3)


def measure(mujoco, variant):
    segments = VARIANTS[variant]
    mass, speed = (0.0084 + 0.4 * 0.25**2) / 0.5**2, 1.5
    hertz = 4 / 3 * EFFECTIVE * math.sqrt(0.03)
    half_period = 2.9432 * (1.25 * mass * speed**2 / hertz) ** 0.4 / speed
    wanted = mass * (math.pi / half_period) ** 2
    run = mjcf.calibrate(lambda half: simulate(mujoco, segments, half), half_period, wanted)
    force = run["contact_force"]
    begin = next(i for i, f in enumerate(force) if f > 0)
    end = next(i for i in range(begin, len(force)) if force[i] <= 0)
    answers = {
        "peak_force": max(force[begin:end]),
        "impulse": STEP * sum(force[begin:end]),
        "duration": 1e3 * STEP * (end - begin),
        "tip": 1e3 * max(map(abs, run["tip:1"])),
    }
    if segments == 1:
        return answers, None
    moment = [2 * BENDING * segments * angle for angle in run["root:0"]]
    answers["root_moment"] = max(map(abs, moment))
    return answers, (run.time[::20], moment[::20])
