# SPDX-License-Identifier: BSD-3-Clause
"""Limber simulates arms that bend. Docs: docs/reference/python.md.

    run = limber.load("examples/struck_finger.toml").run()
    run.plot("finger_1_tip")

SI units everywhere; angles in radians.
"""

from importlib.util import find_spec as _find_spec

# pip install limber[reduction] brings a compiled part with meshing and reduction (GPL).
_reduction = _find_spec("limber_reduction")
if _reduction is not None:
    __path__[:0] = _reduction.submodule_search_locations

from . import errors
from ._core import (
    WORLD, AttachmentIndex, BodyIndex, BodyState, Bushing, Checkpoint, Constant,
    ConstantSignal, ControllerIndex, CouplerIndex, Drive, EndStop, EnergyBalance,
    FrameMotion, Friction, InputFunction, InputIndex, InputSignal, InterfaceTable,
    JointSide, Latch, LoadIndex, PointSpring, Pose, Probe, Pulse, RampSignal,
    ReducedBody, ScalarSpring, Signal, SimulationSettings, SimulationStatistics,
    Simulator, SineSignal, Sinusoid, StepSequence, SystemBuilder, SystemModel,
    SystemState, Table, TableSignal, TransmissionIndex, __version__, build_id,
    calc_energy, explain, find_equilibrium, find_frame_motion, find_natural_frequencies,
    make_shaper, make_state, read_body)
from .batch import Batch
from .body import reduce
from .errors import (
    ContractError, InputError, Interrupted, LimberWarning, NumericalError)
from .linear import LinearModel
from .run import BodyMotion, Envelope, Event, Peak, Run, StaticRun
from .scenario import Controller, Scenario, linearize, load
from .simulation import simulate
from .study import Effect, Row, Study, StudyResults

__all__ = [name for name in dir() if not name.startswith("_") and name not in (
    "batch", "body", "linear", "run", "scenario", "simulation", "study", "toml")]
__all__ += ["__version__"]
