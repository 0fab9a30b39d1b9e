"""Limber: the scene of examples/four_bar.toml."""
import ringing

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled", "nonlinear", "full")
RIGID = 9.86240093  # the crank of a rigid linkage at the end, references/four_bar.py [rad]


def measure(limber, level):
    run = limber.run("scenario.toml", level)
    ends = zip(run["rod_middle.dz"], run["rod_root.dz"], run["rod_tip.dz"])
    bends = [1e3 * (middle - 0.5 * (root + tip)) for middle, root, tip in ends]
    answers = {"crank": run["crank.q"][-1], "lag": 1e3 * (RIGID - run["crank.q"][-1])}
    if max(map(abs, bends)) > 1e-6:
        answers["frequency"] = ringing.find_frequency(run.time, bends, 60.0, 130.0)
    return answers, (run.time, bends)
