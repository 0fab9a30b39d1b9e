"""Limber: small motion about steady rotation, examples/blade.toml."""
import math

VARIANTS = ("coupled", "nonlinear")
UNIT = 1.0801234  # rad/s


def measure(limber, level):
    answers = {}
    for speed in (3, 6):
        rate = speed * UNIT
        found = limber.frequencies(
            "../../../../examples/blade.toml",
            level,
            8,
            **{"initial.joints.axle.velocity": rate, "drive.axle.signal.value": rate},
        )
        # A pair of rigid rotation remains; the lowest bending modes are above half the unit.
        rates = [2 * math.pi * f / UNIT for f in found]
        lag, flap = [r for r in rates if r > 0.5][:2]
        answers |= {f"lag_at_{speed}": lag, f"flap_at_{speed}": flap}
    return answers, None
