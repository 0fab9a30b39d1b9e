"""MuJoCo: a rigid box on a plane; contacts critically damped with a time constant of two timesteps, the
stiffest that it recommends."""
import math

import mjcf

VARIANTS = ("rigid",)
STEP = 1e-4  # at 10 us its edge hops more, not less


def measure(mujoco, _):
    contact = f'solref="{2 * STEP:g} 1" solimp="0.99 0.999 0.0001 0.5 2" friction="1 0 0" condim="3"'
    slope = math.asin(-0.32613634554676313)
    turned = -0.4322135507465967
    body = f"""<geom type="plane" size="5 5 1" euler="0 {slope:.12g} 0" {contact}/>
<body name="box" pos="-0.01743024005 0 0.15715020"><freejoint/>
{mjcf.inertial(1.0, (0.1 / 12, 0.1 / 12, 0.02 / 12))}
<geom type="box" size="0.05 0.05 0.15" {contact}/></body>"""
    q = f"{math.cos(turned / 2):.15g} 0 {math.sin(turned / 2):.15g} 0"
    key = f'<keyframe><key qpos="-0.01743024005 0 0.15715020 {q}"/></keyframe>'
    sensors = '<frameangvel objtype="xbody" objname="box" name="w"/><framezaxis objtype="xbody" objname="box" name="z"/>'
    run = mujoco.run(mjcf.scene(body, STEP, "0 0 -9.81", sensors=sensors, more=key), 0.7)
    rates = run["w:1"]
    half = 0.5 * max(map(abs, rates))
    last = max(i for i, rate in enumerate(rates) if abs(rate) > half)
    end = math.atan2(run["z:0"][-1], run["z:2"][-1])
    answers = {
        "landing_time": run.time[last],
        "landing_rate": -rates[last - 1],  # the step before landing
        "rotation": turned - end,
    }
    return answers, (run.time[::10], rates[::10])
