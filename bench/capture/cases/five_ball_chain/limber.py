"""Limber: five rigid projectiles with elastic surfaces."""

VARIANTS = ("rigid",)


def measure(limber, _):
    run = limber.run("scenario.toml")
    return {f"v{i}": run[f"v{i}.vx"][-1] for i in range(1, 6)}, None
