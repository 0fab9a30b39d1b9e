"""MuJoCo: rods as rigid segments on sliders with springs; they touch with a spring as between segments."""
import math

import mjcf

VARIANTS = {"rigid": 1, "segments": 40, "twice the segments": 80}  # segments
SIDE, MODULUS, DENSITY = 0.01, 210e9, 7850.0
SLIDER = '<joint type="slide" axis="1 0 0"/>'


def simulate(mujoco, segments, half_period, step):
    contact = mjcf.spring_contact(half_period)
    radius = 0.4 * SIDE
    nose = f'<geom type="sphere" size="{radius}" pos="{-radius} 0 0" {contact}/>'
    back = f'<geom type="sphere" size="{radius}" pos="{radius} 0 0" {contact}/>'

    def make_rod(name, place, root, inside):
        return mjcf.beam(name, 1.0, segments, DENSITY * SIDE**2, (SIDE, SIDE), {}, inside,
                         pos=f"{place} 0 0", stretch=MODULUS * SIDE**2, root=root)

    body = make_rod("coming", -1.000001, SLIDER, nose) + make_rod("resting", 0.0, SLIDER + back, "")
    # Sliders of segments are relative: one rate moves the whole rod.
    moving = " ".join(["1"] + ["0"] * (2 * segments - 1))
    key = f'<keyframe><key qvel="{moving}"/></keyframe>'
    return mujoco.run(mjcf.scene(body, step, more=key), 8e-4)


def measure(mujoco, variant):
    segments = VARIANTS[variant]
    h, mass = 1.0 / segments, DENSITY * SIDE**2 / segments
    stiffness = MODULUS * SIDE**2 / h  # as between segments; rigid rods: that of a whole rod
    half_period = math.pi * math.sqrt(0.5 * mass / stiffness)
    step = min(2.5e-7, 0.05 * half_period)
    run = mjcf.calibrate(lambda half: simulate(mujoco, segments, half, step), half_period, stiffness)
    force = run["contact_force"]
    duration, impulse = step * sum(f > 0 for f in force), step * sum(force)
    answers = {
        "peak_force": max(force),
        "mean_force": impulse / duration,
        "duration": 1e6 * duration,
        "impulse": impulse,
    }
    return answers, ([1e6 * t for t in run.time], force)
