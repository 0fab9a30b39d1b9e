"""MuJoCo: rigid links and spatial tendons through the same points; a restitution of 0.3 by a damping
ratio of 0.36 (linear spring and damper), a contact of 8 ms."""
import math
import statistics

import mjcf

VARIANTS = ("rigid",)
STEP = 2e-4


def make_bar(length):
    mass = 2700 * 0.02 * 0.008 * length
    inertia = (mass / 12 * (0.02**2 + 0.008**2), mass / 12 * (length**2 + 0.008**2), mass / 12 * (length**2 + 0.02**2))
    return mjcf.inertial(mass, inertia, f"{length / 2} 0 0")


def make_joint(name, lower, stiffness, rest):
    return (f'<joint name="{name}" type="hinge" axis="0 1 0" range="{lower} 0.8" limited="true" '
            f'stiffness="{stiffness}" springref="{rest}" damping="0.055" frictionloss="0.005"/>')


def make_finger(k, contact):
    angle = 2 * math.pi * (k - 1) / 3
    place = f"{0.1 * math.cos(angle):.9g} {0.1 * math.sin(angle):.9g} 0.02"

    def site(name, point):
        return f'<site name="{name}_{k}" pos="{point}"/>'

    pad = f"""<body name="pad_{k}" pos="0.15 0 0">{mjcf.inertial(0.02, [2e-6] * 3)}
<geom type="sphere" size="0.015" contype="1" conaffinity="2" {contact}/></body>"""
    distal = f"""<body name="distal_{k}" pos="0.2 0 0">{make_joint(f"middle_{k}", -0.4, 0.3, -0.1)}{make_bar(0.15)}
{site("c", "0.03 0 -0.004")}{site("d", "0.12 0 -0.004")}{pad}</body>"""
    proximal = f"""<body name="proximal_{k}">{make_joint(f"knuckle_{k}", -0.6, 0.6, -0.3)}{make_bar(0.2)}
{site("a", "0.05 0 -0.004")}{site("b", "0.18 0 -0.004")}{distal}</body>"""
    return f"""<body name="mount_{k}" pos="{place}" euler="3.141592654 -1.570796327 {angle:.10g}">
{site("m", "-0.01 0 -0.02")}{proximal}</body>"""


def measure(mujoco, _):
    contact = 'solref="0.008 0.36" solimp="0.99 0.999 0.0001 0.5 2" friction="0.8 0.005 0.0001" condim="4"'
    fingers = "".join(make_finger(k, contact) for k in (1, 2, 3))
    body = f"""<body name="palm"><freejoint/>{mjcf.inertial(20, (0.25, 0.25, 0.4))}{fingers}</body>
<body name="satellite" pos="0.01 0 0.33"><freejoint/>{mjcf.inertial(8, (0.03, 0.03, 0.02))}
<geom type="cylinder" size="0.07 0.1" contype="2" conaffinity="1" {contact}/></body>"""
    tendons, motors = "", ""
    for k in (1, 2, 3):
        sites = "".join(f'<site site="{name}_{k}"/>' for name in "mabcd")
        tendons += f'<spatial name="tendon_{k}">{sites}</spatial>'
        motors += f'<motor tendon="tendon_{k}" gear="-1"/>'
    key = '<key qpos="0 0 0 1 0 0 0 ' + "-0.3 -0.1 " * 3 + '0.01 0 0.33 1 0 0 0" qvel="' + "0 " * 14 + '-0.02 0.1 0.05 0.5"/>'
    more = f"<tendon>{tendons}</tendon><actuator>{motors}</actuator><keyframe>{key}</keyframe>"
    sensors = '<framepos objtype="xbody" objname="satellite" name="p"/>'
    for name in ("satellite", "palm"):
        sensors += f'<frameangvel objtype="xbody" objname="{name}" name="{name}"/>'
    ramp = [min(0.02 * i / 0.8, 1.0) for i in range(60)]
    control = [(0.02 * i, *[20 * s * s * (3 - 2 * s)] * 3) for i, s in enumerate(ramp)]
    run = mujoco.run(mjcf.scene(body, STEP, sensors=sensors, more=more), 3.0, every=25, control=control)
    late = [i for i, t in enumerate(run.time) if t > 2.0]

    def mean(name):
        return statistics.fmean(run[name][i] for i in late)

    way = run["p:2"]
    answers = {
        "drift": 1e3 * (way[late[-1]] - way[late[0]]) / (run.time[late[-1]] - run.time[late[0]]),
        "spin": mean("palm:2"),
        "slip": mean("satellite:2") - mean("palm:2"),
    }
    return answers, (run.time, run["satellite:2"])
