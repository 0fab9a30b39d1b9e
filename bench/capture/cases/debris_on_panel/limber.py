"""Limber: the scene of bench/impact. Level nonlinear is left out: the plate bends by a hundredth of its
thickness, and the pairs of 320 modes are 51 000 vectors."""

VARIANTS = ("rigid", "uncoupled", "coupled", "full")


def measure(limber, level):
    run = limber.run("../../../impact/scenes/plate.toml", level, **{"basis.eigenmodes": 20 if level == "rigid" else 320})
    contact = run.contacts[0]
    answers = {
        "peak_force": contact["peak_force"],
        "duration": 1e6 * contact["duration"],
        "impulse": contact["impulse"],
    }
    return answers, ([1e6 * t for t in run.time], run["impact.normal_force"])
