"""MuJoCo: the rod as rigid segments on a heavy hub; its frequencies from 60 s of small ringing."""
import mjcf
import ringing

VARIANTS = {"segments": 10, "twice the segments": 20}  # segments
EI, MU, UNIT = 1.4e4, 1.2, 1.0801234


def measure(mujoco, variant):
    segments = VARIANTS[variant]
    rod = mjcf.beam("rod", 10.0, segments, MU, (0.0775, 0.0775), {"y": EI, "z": EI}, "")
    hub = f'<body name="hub"><joint name="axle" type="hinge" axis="0 0 1"/>{mjcf.inertial(100, (1e9, 1e9, 1e9))}{rod}</body>'
    sensors = '<jointpos joint="rod_z_0" name="lag"/><jointpos joint="rod_y_0" name="flap"/>'
    answers = {}
    for speed in (3, 6):
        rates = " ".join([f"{speed * UNIT:.12g}"] + ["1e-4"] * (2 * segments))
        key = f'<keyframe><key qvel="{rates}"/></keyframe>'
        step = 4e-3 / segments
        run = mujoco.run(mjcf.scene(hub, step, sensors=sensors, more=key), 60.0, every=round(0.04 / step))
        for name in ("lag", "flap"):
            found = ringing.find_frequency(run.time, run[f"{name}:0"], 0.4, 2.0)
            answers[f"{name}_at_{speed}"] = 2 * 3.141592653589793 * found / UNIT
    return answers, None
