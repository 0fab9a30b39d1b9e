"""Limber: a rigid ball with an elastic surface; one run an angle."""

VARIANTS = ("rigid",)
KAPPA, FRICTION, RADIUS = 1.4 / 1.7, 0.3, 0.01


def measure(limber, _):
    psi, after = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0), []
    for value in psi:
        speed = value * FRICTION / KAPPA
        run = limber.run("scenario.toml", **{"projectile.ball.velocity.0": speed})
        place = run["v.vx"][-1] - RADIUS * run["w.wy"][-1]
        after.append(place * KAPPA / FRICTION)
    return {f"psi2_at_{p:g}": a for p, a in zip(psi, after)}, (psi, after)
