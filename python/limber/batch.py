# SPDX-License-Identifier: BSD-3-Clause
"""Many worlds of one scenario, stepped side by side."""

import operator
import os
import warnings

import numpy

from . import _core
from .errors import InputError, LimberWarning
from .scenario import Controller, Scenario


class Batch:
    """n worlds of one scenario, each a simulation of its own, that the caller steps
    from one control input to the next.

    ``scenario``: a :class:`Scenario` or its file. It is built once; worlds share its
    model. ``n``: the number of worlds. ``inputs``: names of the scenario's
    ``[[controller]]`` whose outputs :meth:`step` sets, in place of their laws; by
    default all of them, in the scenario's order. Other controllers keep their laws.
    ``period`` [s]: between two control inputs, by default that of these controllers.
    ``threads``: at most so many step worlds, by default as many as the process has
    processors; results do not depend on it. ``cache``: folder of reduced bodies.

    A world moves to the bit as ``scenario.run`` does whose controllers write the same
    numbers at the same times. It differs where a run knows more: bodies in closed
    form (a scenario without controllers), a tolerance that is verified by several runs.

    Laws in Python cannot be part of a batch: compute their outputs for all worlds at
    once, and give them to :meth:`step`.
    """

    def __init__(self, scenario, n, inputs=None, period=None, threads=None, cache=None):
        if not isinstance(scenario, Scenario):
            scenario = Scenario(scenario)
        self._file = scenario.file
        self._n = _to_count("n, the number of worlds", n)
        threads = (len(os.sched_getaffinity(0)) if threads is None
                   else _to_count("threads", threads))
        self._core = _core.Batch(scenario._scene, self._n, _to_names(inputs), period,
                                 threads, "" if cache is None else os.fspath(cache))
        self._everywhere = numpy.ones(self._n, dtype=bool)
        for text in self._core.warnings:
            warnings.warn(text, LimberWarning, stacklevel=2)

    def reset(self, mask=None, joints=None, bodies=None):
        """Puts worlds back to their start. Returns :attr:`observations`.

        ``mask``: (n,) of bool, the worlds; by default all. Without other arguments
        they start as the scenario does; nothing is random.

        ``joints``: ``{name: {"position": (n, c), "velocity": (n, c)}}``, coordinates of
        joints [m, rad] and their rates, as in ``[initial.joints]``; one coordinate may
        be (n,), and one number is that of all worlds.
        ``bodies``: ``{name: {"position", "orientation_rpy", "velocity",
        "angular_velocity"}}``, each (n, 3), or (3,) for all worlds [m, rad, m/s, rad/s]:
        of projectiles, and of ``"base"``, the free root link of the only robot, as in
        ``[initial.base]``. Values of worlds that are not in the mask do not matter.
        What is left out is the scenario's, and is so again at the next reset. The start
        is that of a scenario with these keys, to the bit; displacements remain relative
        to the scenario's own.
        """
        changes = []
        for name, keys in dict(joints or {}).items():
            for key, value in _read_keys("joint", name, keys, _JOINT_KEYS):
                changes.append(("joint", name, key, self._to_rows(name, key, value, None)))
        for name, keys in dict(bodies or {}).items():
            for key, value in _read_keys("body", name, keys, _BODY_KEYS):
                changes.append(("body", name, key, self._to_rows(name, key, value, 3)))
        for text in self._core.reset(self._to_mask(mask), changes):
            warnings.warn(text, LimberWarning, stacklevel=2)
        return self.observations

    def step(self, controls=None, steps=1, mask=None):
        """Advances worlds by control periods. Returns :attr:`observations`.

        ``controls``: (n, m) real numbers for the m :attr:`inputs` [their units];
        may be left out if there are none. They act from now on for ``steps`` periods;
        the last period ends with the scenario. ``mask``: (n,) of bool, the worlds that
        are advanced; by default all. Failed worlds are left out.

        Other Python threads continue meanwhile. Ctrl-C raises Interrupted; worlds that
        had not finished by then have failed. Raises InputError if a world is at its
        end (:attr:`ended`); no world is then advanced.
        """
        self._core.step(self._to_controls(controls), _to_count("steps", steps),
                        self._to_mask(mask))
        return self.observations

    @property
    def observations(self):
        """(n, k) float64, the probes' values at the end of the last period, before
        inputs change; NaN of failed worlds. A read-only view of the same memory after
        every step: copy what is to be kept."""
        return self._core.observations

    @property
    def time(self):
        """Time of each world since its start, (n,) [s]; a view."""
        return self._core.time

    @property
    def failed(self):
        """Worlds in which a computation could not continue, until they are reset, (n,)
        of bool; a view."""
        return self._core.failed

    @property
    def failures(self):
        """Why worlds failed, ``{world: text}``."""
        return {int(i): self._core.failure(int(i)) for i in numpy.flatnonzero(self.failed)}

    @property
    def ended(self):
        """Worlds at the end of the scenario, ``time.duration``, (n,) of bool; a view."""
        return self._core.ended

    @property
    def inputs(self):
        """Names of the inputs, the columns of controls."""
        return list(self._core.inputs)

    @property
    def columns(self):
        """Names of the observations' columns, those of the scenario's probes."""
        return [name for name, _ in self._core.columns]

    @property
    def units(self):
        """Units of the columns."""
        return [unit for _, unit in self._core.columns]

    @property
    def period(self):
        """Time between two control inputs [s]."""
        return self._core.period

    @property
    def threads(self):
        """Number of threads that step worlds."""
        return self._core.threads

    def state(self, world):
        """A copy of a world's :class:`SystemState`; of a failed one that of its last
        good step."""
        return self._core.state(self._to_index(world))

    def statistics(self, world):
        """A world's :class:`SimulationStatistics` since its start: steps, events,
        warnings."""
        return self._core.statistics(self._to_index(world))

    def __len__(self):
        return self._n

    def __repr__(self):
        return (f"<limber.Batch {self._file!r}: {self._n} worlds, "
                f"{len(self._core.inputs)} inputs, {len(self._core.columns)} columns>")

    def __reduce_ex__(self, protocol):
        raise TypeError("a limber.Batch cannot be pickled or copied: it is made of running "
                        "simulations; make one in each process, from the scenario")

    def _to_index(self, world):
        index = operator.index(world)
        if not -self._n <= index < self._n:
            raise IndexError(f"world {index}; there are {self._n}")
        return index % self._n

    def _to_mask(self, mask):
        if mask is None:
            return self._everywhere
        array = numpy.asarray(mask)
        if array.dtype != bool or array.shape != (self._n,):
            raise InputError(f"mask: {_describe(array)}; expected ({self._n},) of bool")
        return numpy.ascontiguousarray(array)

    def _to_controls(self, controls):
        shape = (self._n, len(self._core.inputs))
        if controls is None:
            if shape[1] > 0:
                raise InputError("controls are missing; expected an array of shape "
                                 f"{shape}, with columns {', '.join(self.inputs)}")
            return numpy.zeros(shape)
        array = _to_numbers("controls", controls)
        if array.shape != shape:
            raise InputError(f"controls: {_describe(array)}; expected shape {shape}, with "
                             f"columns {', '.join(self.inputs) or '(no inputs)'}")
        return numpy.ascontiguousarray(array, dtype=numpy.float64)

    def _to_rows(self, name, key, value, width):
        """A start of each world, (n, width); width None: any."""
        what = f"start of '{name}': {key}"
        array = _to_numbers(what, value)
        if array.ndim == 0 and width is None:
            array = numpy.full((self._n, 1), array)
        elif array.shape == (self._n,) and width is None:
            array = array.reshape(self._n, 1)
        elif array.shape == (width,):
            array = numpy.tile(array, (self._n, 1))
        if array.ndim != 2 or array.shape[0] != self._n or array.shape[1] != (
                width or array.shape[1]):
            expected = (f"({self._n}, {width}) or ({width},)" if width else
                        f"({self._n}, coordinates), ({self._n},) or a number")
            raise InputError(f"{what}: {_describe(array)}; expected {expected}")
        return numpy.ascontiguousarray(array, dtype=numpy.float64)


_JOINT_KEYS = ("position", "velocity")
_BODY_KEYS = ("position", "orientation_rpy", "velocity", "angular_velocity")


def _read_keys(kind, name, keys, known):
    """Items of a table of arrays, checked."""
    if not isinstance(keys, dict):
        raise InputError(f"start of {kind} '{name}': a {type(keys).__name__}; expected a "
                         "dictionary with " + ", ".join(known))
    for key in keys:
        if key not in known:
            raise InputError(f"start of {kind} '{name}': there is no '{key}'; expected "
                             + ", ".join(known))
    return keys.items()


def _to_numbers(what, value):
    array = numpy.asarray(value)
    if array.dtype.kind not in "fiu":
        raise InputError(f"{what}: {_describe(array)}; expected real numbers")
    return array


def _describe(array):
    return f"shape {array.shape} of {array.dtype}"


def _to_count(what, value):
    try:
        count = operator.index(value)
    except TypeError:
        raise InputError(f"{what}: {value!r}; expected a whole number") from None
    if count < 1:
        raise InputError(f"{what}: {count}; expected at least 1")
    return count


def _to_names(inputs):
    if inputs is None:
        return None
    names = [inputs] if isinstance(inputs, (str, Controller)) else list(inputs)
    for name in names:
        if isinstance(name, Controller):
            raise InputError(
                f"input '{name.name}': a batch does not support laws in Python, as its worlds "
                "run in threads; compute the outputs for all worlds at once and give them to step()")
        if not isinstance(name, str):
            raise InputError(f"input {name!r}; expected the name of a [[controller]]")
    return names
