# SPDX-License-Identifier: BSD-3-Clause
"""Runs of systems that were built in Python."""

from . import _core
from .run import Run, finish


def simulate(model, start, settings, probes=(), progress=None):
    """Simulates a system from a state.

    ``probes``: of :class:`Probe`; displacements are relative to ``start``.
    Otherwise as :meth:`Scenario.run`. Returns a :class:`Run`.
    """
    return finish(Run(_core.simulate(model, start, settings, list(probes), progress)))
