"""Limber: flat ends as contact surfaces, 120 modes a rod. Levels nonlinear and full are left out:
nothing bends, and steps of 0.5 us of the whole mesh take minutes."""

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled")


def measure(limber, level):
    run = limber.run("scenario.toml", level)
    contact = run.contacts[0]
    answers = {
        "peak_force": contact["peak_force"],
        "mean_force": contact["impulse"] / contact["duration"],
        "duration": 1e6 * contact["duration"],
        "impulse": contact["impulse"],
    }
    return answers, ([1e6 * t for t in run.time], run["force.normal_force"])
