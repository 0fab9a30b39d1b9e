"""Limber: a rigid box with an elastic surface."""

VARIANTS = ("rigid",)


def measure(limber, _):
    run = limber.run("scenario.toml")
    fastest = run.summary["probes"]["w.wy"]
    answers = {
        "landing_time": fastest["peak_time"],
        "landing_rate": -fastest["peak"],
        "rotation": -run["r.ry"][-1],
    }
    return answers, (run.time, run["w.wy"])
