"""MuJoCo: the loop closed by a connect constraint, the rod rigid or as segments."""
import math

import mjcf
import ringing

VARIANTS = {"rigid": 1, "segments": 10, "twice the segments": 20}  # segments
STEP, EI, MU = 1e-5, 70e9 * 0.01**4 / 12, 2700 * 0.01**2
RIGID = 9.86240093  # the crank of a rigid linkage at the end, references/four_bar.py [rad]


def measure(mujoco, variant):
    segments = VARIANTS[variant]
    pin = '<joint name="{}" type="hinge" axis="0 -1 0"/>'
    bends = {"y": EI} if segments > 1 else {}
    # A damping ratio of 0.005 at the first frequency.
    rod = mjcf.beam("rod", 0.5, segments, MU, (0.01, 0.01), bends, '<site name="end"/>', pos="0.1 0 0",
                    root=pin.format("crank_pin"), euler="0 -0.643501109 0",
                    damping=0.01 / (2 * math.pi * 93.6))
    body = f"""<body name="crank">{pin.format("crank")}{mjcf.inertial(1.5, (0.001, 0.004, 0.004), "0.02 0 0")}{rod}</body>
<body name="rocker" pos="0.5 0 0" euler="0 -1.570796327 0">{pin.format("rocker")}
{mjcf.inertial(0.4, (1e-4, 0.003, 0.003), "0.15 0 0")}</body>"""
    more = f"""<equality><connect body1="rod_tip" body2="rocker" anchor="0 0 0" solref="{2 * STEP:g} 1"
solimp="0.9999 0.9999 0.001 0.5 2"/></equality>
<keyframe><key qvel="20 -25 {"0 " * (segments - 1)}-5"/></keyframe>"""
    sensors = '<jointpos joint="crank" name="crank"/>'
    bodies = ["rod_0", "rod_tip"] + ([f"rod_{segments // 2}"] if segments > 1 else [])
    for name in bodies:
        sensors += f'<framepos objtype="xbody" objname="{name}" name="{name}"/>'
    run = mujoco.run(mjcf.scene(body, STEP, sensors=sensors, more=more), 0.5, every=50)
    angle = run["crank:0"][-1]
    answers = {"crank": angle, "lag": 1e3 * (RIGID - angle)}
    if segments == 1:
        return answers, None
    bends = []
    for i in range(len(run.time)):
        ax, az, bx, bz, cx, cz = (run[f"{name}:{k}"][i] for name in bodies for k in (0, 2))
        bends.append(1e3 * ((bx - ax) * (cz - az) - (bz - az) * (cx - ax)) / math.hypot(bx - ax, bz - az))
    answers["frequency"] = ringing.find_frequency(run.time, bends, 60.0, 130.0)
    return answers, (run.time, bends)
