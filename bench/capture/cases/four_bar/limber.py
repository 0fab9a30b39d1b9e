"""Limber: examples/four_bar.toml with stiff pins."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "references"))
import four_bar  # noqa: E402
import ringing  # noqa: E402

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled", "nonlinear", "full")


def measure(limber, level):
    run = limber.run("../../../../examples/four_bar.toml", level)
    rigid = four_bar.solve().y[0, -1]
    bends = [1e3 * z for z in run["rod_middle.dz"]]
    answers = {"crank": run["crank.q"][-1], "lag": 1e3 * (rigid - run["crank.q"][-1])}
    if max(map(abs, bends)) > 1e-6:
        answers["frequency"] = ringing.find_frequency(run.time, bends, 60.0, 130.0)
    return answers, (run.time, bends)
