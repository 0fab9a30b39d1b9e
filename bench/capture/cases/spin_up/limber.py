"""Limber: examples/spin_up.toml."""
import statistics

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled", "nonlinear", "full")


def measure(limber, level):
    run = limber.run("../../../../examples/spin_up.toml", level)
    along, across = run["tip_lag.ux"], run["tip_lag.uy"]
    probe = run.summary["probes"]["tip_lag.uy"]
    answers = {
        "lag": abs(probe["peak"]),
        "lag_time": probe["peak_time"],
        "foreshortening": -1e3 * min(along),
        "stretch": 1e3 * statistics.fmean(x for t, x in zip(run.time, along) if t > 16.0),
    }
    return answers, (run.time, across)
