# SPDX-License-Identifier: BSD-3-Clause
"""The law of docs/reference/python.md damps the arm of the example as the built-in one does."""

import numpy
import pytest
from conftest import SOURCE

import limber


def law(t, measured, memory):
    memory[0] -= 5e-4 * measured[0]
    return 150.0 * memory[0]


def find_residual(run):
    """Of the tip's deformation in the last 0.4 s, peak to peak [m]."""
    return numpy.ptp(run.probes["tip"][run.time > 1.6], axis=0).max()


def test_strain_feedback_in_python_damps_by_ten_times_as_the_built_in_law():
    scenario = limber.load(SOURCE / "examples" / "damped_slew.toml")
    own = find_residual(scenario.run())
    python = find_residual(scenario.run(controllers=[
        limber.Controller("damper", law, memory=[0.0], measures=["root.tz"])]))
    scenario["drive.damper.signal.factor"] = 0.0
    free = find_residual(scenario.run())
    assert python == pytest.approx(own, rel=1e-3)
    assert free > 10.0 * python
