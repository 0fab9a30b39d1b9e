"""Limber: the scene of bench/impact."""

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled", "full")


def measure(limber, level):
    run = limber.run("../../../impact/scenes/plate.toml", level, **{"basis.eigenmodes": 320})
    contact = run.contacts[0]
    answers = {
        "peak_force": contact["peak_force"],
        "duration": 1e6 * contact["duration"],
        "impulse": contact["impulse"],
    }
    return answers, ([1e6 * t for t in run.time], run["impact.normal_force"])
