"""Limber: the scene of bench/impact. Level nonlinear is left out: the plate bends by a hundredth of its
thickness, and the pairs of 320 modes are 51 000 vectors."""

import ball_strike

VARIANTS = ("rigid", "uncoupled", "coupled", "full")


def measure(limber, level):
    run = limber.run("../../../impact/scenes/plate.toml", level, **{"basis.eigenmodes": 20 if level == "rigid" else 320})
    return ball_strike.read_impact(run)
