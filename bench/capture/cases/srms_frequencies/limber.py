"""Limber: natural frequencies about the start."""

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled", "nonlinear")


def measure(limber, level):
    found = limber.frequencies("scenario.toml", level, 12)[:6]
    answers = {f"f{i + 1}": f for i, f in enumerate(found)}
    return answers, (range(1, len(found) + 1), found)
