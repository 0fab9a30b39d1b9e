# SPDX-License-Identifier: BSD-3-Clause
"""Linear models of scenarios, for the design of controllers."""

import os

import numpy


class LinearModel:
    """z' = A z + B (u - u0), y - y0 = C z + D (u - u0), of n states, m inputs
    and p outputs; see docs/reference/linearize.md. With closed loops it is discrete, from
    sample to sample: z_(k+1) = A z_k + B du_k, dy_k = C z_k + D du_k.

    Matrices are read-only views of the memory of the model, which they keep
    alive. Units of their entries follow from those of states, inputs and
    outputs, :attr:`state_units`, :attr:`input_units` and :attr:`output_units`.
    """

    def __init__(self, made):
        self._made = made

    @property
    def A(self):
        """(n, n) [unit of the row's state per second / column's state], of a
        discrete model not per second."""
        return self._made.A

    @property
    def B(self):
        """(n, m) [unit of the row's state per second / column's input], of a
        discrete model not per second."""
        return self._made.B

    @property
    def C(self):
        """(p, n) [unit of the row's output / column's state]."""
        return self._made.C

    @property
    def D(self):
        """(p, m) [unit of the row's output / column's input]."""
        return self._made.D

    @property
    def input_names(self):
        """Names of the columns of B and D, m texts: loads, drives, and outputs of
        controllers."""
        return [name for name, _, _ in self._made.inputs]

    @property
    def input_units(self):
        """Units of the inputs, m texts."""
        return [unit for _, unit, _ in self._made.inputs]

    @property
    def u0(self):
        """Inputs at the reference, (m,) [their units]."""
        return numpy.array([value for _, _, value in self._made.inputs], dtype=float)

    @property
    def output_names(self):
        """Names of the rows of C and D, p texts: columns of probes, "tip.ux"."""
        return [name for name, _, _ in self._made.outputs]

    @property
    def output_units(self):
        """Units of the outputs, p texts."""
        return [unit for _, unit, _ in self._made.outputs]

    @property
    def y0(self):
        """Outputs at the reference, (p,) [their units]."""
        return numpy.array([value for _, _, value in self._made.outputs], dtype=float)

    @property
    def state_names(self):
        """Names of the states, n texts; of a reduced model "kept1", ..., "balanced1"."""
        return [name for name, _, _ in self._made.states]

    @property
    def state_units(self):
        """Units of the states, n texts."""
        return [unit for _, unit, _ in self._made.states]

    @property
    def time(self):
        """Time of the reference [s]."""
        return self._made.time

    @property
    def period(self):
        """Period of a discrete model [s]; None: the model is continuous."""
        return self._made.period

    @property
    def about(self):
        """Reference of the model: "start", "equilibrium" or "time"."""
        return self._made.about

    @property
    def scenario(self):
        """Name of the scenario."""
        return self._made.scenario

    @property
    def axes_angular_velocity(self):
        """Angular velocity of the axes of world vectors, (3,) [rad/s]."""
        return self._made.axes_angular_velocity

    @property
    def open_loops(self):
        """Names of controllers that are not part of the model."""
        return self._made.open_loops

    @property
    def states_in_all(self):
        """Number of states before balanced truncation."""
        return self._made.all_states

    @property
    def kept_states(self):
        """For a reduced model, number of states of motion that does not decay,
        which come first; None for others."""
        return self._made.kept

    @property
    def hankel_singular_values(self):
        """For a reduced model, those of decaying motion, descending, (k,)
        [output's / input's]; None for others."""
        return self._made.hankel

    @property
    def error_bound(self):
        """For a reduced model, upper bound of the error in gain from inputs to
        outputs at any frequency [output's / input's]; None for others."""
        return self._made.bound

    @property
    def warnings(self):
        """Warnings of the command."""
        return self._made.warnings

    def save(self, file):
        """Writes it as ``limber linearize -o`` does: .mat, .npz or .json."""
        self._made.save(os.fspath(file))

    def to_scipy(self):
        """As a ``scipy.signal.StateSpace``, whose matrices are copies; a discrete
        model with ``dt``."""
        from scipy.signal import StateSpace
        sampled = {} if self.period is None else {"dt": self.period}
        return StateSpace(self.A, self.B, self.C, self.D, **sampled)

    def __repr__(self):
        return (f"<limber.LinearModel of {self.scenario!r} about the {self.about}, "
                f"{len(self.A)} states, {self.B.shape[1]} inputs, "
                f"{len(self.C)} outputs>")
