"""Limber: natural frequencies about the start."""

VARIANTS = ("rigid", "uncoupled", "one-way", "coupled", "nonlinear")


def measure(limber, level):
    # Beyond 100 Hz, at level rigid, the constraints of joints vibrate.
    found = [f for f in limber.frequencies("scenario.toml", level, 12) if f < 100.0][:6]
    answers = {f"f{i + 1}": f for i, f in enumerate(found)}
    return answers, (range(1, len(found) + 1), found)
