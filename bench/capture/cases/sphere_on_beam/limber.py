"""Limber: the scene of bench/impact."""

import ball_strike

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled", "nonlinear", "full")


def measure(limber, level):
    run = limber.run("../../../impact/scenes/bar.toml", level, **{"basis.eigenmodes": 40})
    return ball_strike.read_impact(run)
