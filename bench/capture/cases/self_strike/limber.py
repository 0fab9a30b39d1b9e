"""Limber: examples/self_strike.toml without loss at the strike."""

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled", "nonlinear", "full")


def measure(limber, level):
    run = limber.run("../../../../examples/self_strike.toml", level, **{"contact.0.restitution": 1})
    first, probes = run.contacts[0], run.summary["probes"]
    answers = {
        "peak_force": first["peak_force"],
        "impulse": first["impulse"],
        "duration": 1e3 * first["duration"],
        "tip": 1e3 * abs(probes["tip.uy"]["peak"]),
        "root_moment": abs(probes["root.tz"]["peak"]),
    }
    if level == "rigid":
        return answers, None  # the moment of its joint, which rings
    return answers, (run.time, [-moment for moment in run["root.tz"]])
