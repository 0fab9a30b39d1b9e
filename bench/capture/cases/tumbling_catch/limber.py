"""Limber: examples/catch.toml as it is."""
import statistics

VARIANTS = ("rigid", "coupled", "nonlinear")


def measure(limber, level):
    run = limber.run("../../../../examples/catch.toml", level)
    end = run.time[-1] - 1.0
    late = [i for i, t in enumerate(run.time) if t > end]

    def mean(name):
        return statistics.fmean(run[name][i] for i in late)

    way = run["satellite.uz"]
    answers = {
        "drift": 1e3 * (way[late[-1]] - way[late[0]]) / (run.time[late[-1]] - run.time[late[0]]),
        "spin": mean("palm.wz"),
        "slip": mean("spin.wz") - mean("palm.wz"),
    }
    return answers, (run.time, run["spin.wz"])
