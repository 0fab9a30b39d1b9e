# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios: load, set keys, run, compare, linearise, find equilibria and frequencies."""

import inspect
import os
import warnings

from . import _core
from .errors import InputError, LimberWarning
from .linear import LinearModel
from .run import Run, StaticRun, finish
from .toml import from_toml, is_of_robot, look_up, put, read_toml, to_toml


def load(file, set=None, unset=(), fidelity=None):
    """Loads a scenario file (docs/reference/scenario.md) and its robot.

    ``set``: ``{path: value}``, keys of the scenario or the robot, as
    ``{"time.step": 1e-4, "load.strike.force.2": -200.0}``; ``unset``: paths of
    keys to remove; ``fidelity``: the level of every flexible link.

    Raises InputError with every problem of the files.
    """
    return Scenario(file, set, unset, fidelity)


def linearize(scenario, at="start", inputs=None, outputs=None, states=None,
              closed_loop=False, cache=None):
    """Linear model of a scenario, a :class:`Scenario` or its file.

    As :meth:`Scenario.linearize`. Returns a :class:`LinearModel`.
    """
    if not isinstance(scenario, Scenario):
        scenario = Scenario(scenario)
    return scenario._linearize(at, inputs, outputs, states, closed_loop, cache)


class Controller:
    """A Python function in place of the law of a scenario's controller.

    ``name``: of a ``[[controller]]`` of the scenario, which has its sample
    times, and the loads and drives that follow it.

    ``law(t, measured, memory)`` is called at every sample, and returns the output
    (a number): time [s], measurements, (n,) [their units], and memory from sample
    to sample, (k,), which it changes in place.

    ``memory``: its initial value, k numbers, possibly none: ``[]``. It is part of
    the run's state, so that runs to a verified tolerance, which repeat samples, can
    restore it. Without it the law is called as ``law(t, measured)`` and may have
    memory of its own; a run with ``tolerance_passes = "verified"`` then refuses it.

    ``measures``: columns of probes, as ``["tip.ux"]``; by default those of the
    scenario's controller. ``period`` [s]: by default the scenario's.
    """

    def __init__(self, name, law, memory=None, measures=None, period=None):
        self.name = name
        self.law = law
        self.memory = None if memory is None else [float(one) for one in memory]
        self.measures = None if measures is None else list(measures)
        self.period = period
        self.identity = _identify(law)


def _identify(law):
    """Identity of a law."""
    name = f"{getattr(law, '__module__', '')}.{getattr(law, '__qualname__', law)}"
    try:
        return name + "\n" + inspect.getsource(law)
    except (OSError, TypeError):
        return name


class Scenario:
    """A scenario and its robot, checked; see :func:`load`.

    Keys are set by their dotted paths: ``scenario["time.step"] = 1e-4``, read
    by ``scenario["time.step"]`` and removed by ``del scenario["time.steps"]``.
    An invalid value raises InputError, and leaves the scenario unchanged; to
    read a key that is neither in the file nor set raises KeyError.
    """

    def __init__(self, file, set=None, unset=(), fidelity=None):
        self._file = os.fspath(file)
        self._settings = []
        self._fidelity = fidelity
        self._change([(path, None) for path in unset] + _to_settings(set))

    def __getitem__(self, path):
        given = dict(self._settings)
        if given.get(path) is not None:
            return from_toml(given[path])
        tables = read_toml(self._file)
        for key, text in self._settings:
            if not is_of_robot(key, tables):
                put(tables, key, text)
        if is_of_robot(path, tables):
            raise KeyError(f"{path} is a key of the robot's file, which is read "
                           "here only where it was set")
        return look_up(tables, path, self._file)

    def __setitem__(self, path, value):
        self.set({path: value})

    def __delitem__(self, path):
        self.set({}, unset=[path])

    def set(self, values, unset=()):
        """Sets and removes several keys at once, all or none of them."""
        self._change(self._settings + [(path, None) for path in unset]
                     + _to_settings(values))

    def _change(self, settings):
        """Changes keys; the last value of each path counts."""
        settings = [(path, value) for i, (path, value) in enumerate(settings)
                    if all(path != later for later, _ in settings[i + 1:])]
        self._scene = _core.load(self._file, settings, self._fidelity)
        self._settings = settings

    def copy(self):
        """An independent copy."""
        made = object.__new__(Scenario)
        made.__dict__.update(self.__dict__)
        return made

    @property
    def settings(self):
        """Keys that were set, [(path, TOML), ...]; None: removed."""
        return list(self._settings)

    @property
    def name(self):
        """Stem of its file."""
        return self._scene.describe()["name"]

    @property
    def file(self):
        """Path of its file."""
        return self._file

    @property
    def links(self):
        """Names of all links of its robots."""
        return self._scene.describe()["links"]

    @property
    def controllers(self):
        """Names of its controllers."""
        return self._scene.describe()["controllers"]

    @property
    def end_time(self):
        """End time of a run [s]."""
        return self._scene.describe()["end_time"]

    def __repr__(self):
        return f"<limber.Scenario {self._file!r}, {len(self._settings)} keys set>"

    def run(self, controllers=(), judge=True, cache=None, progress=None, errors=False):
        """Simulates it, as ``limber run`` does, in memory.

        ``controllers``: of :class:`Controller`. ``judge``: whether to find if
        levels neglect too much, which costs time at every step. ``cache``:
        folder of reduced bodies. ``progress(what, fraction)`` is called every
        few milliseconds. ``errors``: whether to find the errors of all probes by
        cause, ``run.summary["errors"]``, each from one more run.

        Other Python threads continue meanwhile. Ctrl-C raises Interrupted, and a
        computation that cannot continue NumericalError; both have the :class:`Run`
        up to then as ``run``. Warnings are LimberWarning.
        """
        if errors and controllers:
            raise InputError("errors are found by running the scenario again, without "
                             "Python's controllers; leave one of both out")
        recorded = _core.run(self._scene, _path(cache), judge, errors,
                             list(controllers), progress)
        return finish(Run(recorded))

    def static(self, method=None, cache=None):
        """Equilibrium under the loads at the start, as ``limber static``.

        ``method``: "newton" or "relaxation", by default the scenario's.
        Returns a :class:`StaticRun`, which has one output.
        """
        recorded, summary, texts = _core.find_static(self._scene, method,
                                                     _path(cache))
        for text in texts:
            warnings.warn(text, LimberWarning, stacklevel=2)
        return StaticRun(recorded, summary, texts)

    def frequencies(self, count=20, cache=None):
        """Natural frequencies about the start, as ``limber frequencies --json``.

        Returns a dictionary: "modes" has for each mode "frequency" [Hz],
        "damping_ratio" [-] and more; "frequencies" those without damping [Hz].
        """
        found = _core.find_frequencies(self._scene, count, _path(cache))
        for text in found["warnings"]:
            warnings.warn(text, LimberWarning, stacklevel=2)
        return found

    def advise(self, cache=None):
        """Recommended level of every flexible link, as ``limber advise --json``.

        Returns a dictionary: "bodies" has for each link "recommended", "reason",
        "peaks", "left_out" and more; "fidelity_table" is the text of a
        scenario's table that follows the advice. "doubt" of a body states that
        its figures have no stated error.
        """
        found = _core.advise(self._scene, _path(cache))
        for text in found["warnings"]:
            warnings.warn(text, LimberWarning, stacklevel=2)
        return found

    def check(self, cache=None):
        """Masses, frequencies and cost without a run, as ``limber check --json``.

        Returns a dictionary: "mass" [kg], "bodies", "joints" and
        "frequencies_hz" [Hz], "cost" (seconds, bytes), "silent" (parts that
        cannot answer), "choices" and more.
        """
        return _core.check(self._scene, _path(cache))

    def linearize(self, at="start", inputs=None, outputs=None, states=None,
                  closed_loop=False, cache=None):
        """Linear model (A, B, C, D) of its system, as ``limber linearize``.

        ``at``: "start", "equilibrium", or a time of its run [s]. ``inputs``:
        names of loads, drives and controllers, ``outputs``: names of probes or
        their columns, both by default all, in the model's order. ``states``: a
        number of states n, to which the model is reduced by balanced
        truncation. Controllers are not part of it, their loops are open, except
        with ``closed_loop``: then the model is discrete, from sample to sample,
        with all inputs, outputs and states.

        Returns a :class:`LinearModel`, with matrices of shapes (n, n), (n, m),
        (p, n) and (p, m) for m inputs and p outputs.
        """
        return self._linearize(at, inputs, outputs, states, closed_loop, cache)

    def _linearize(self, at, inputs, outputs, states, closed_loop, cache):
        """Common part of both functions; warnings refer to the caller's line."""
        made = LinearModel(_core.linearize(
            self._scene, at, _names(inputs), _names(outputs), states, closed_loop,
            _path(cache)))
        for text in made.warnings:
            warnings.warn(text, LimberWarning, stacklevel=3)
        return made

    def compare(self, levels=(), modes=(), sources=(), steps=(), reference=None,
                reference_modes=None, reference_step=None,
                reference_integrator=None, repeats=0, cache=None):
        """Runs it at several levels, bases and steps, as ``limber compare``.

        ``levels``: as ``["rigid", "coupled"]``; ``modes``: numbers of
        eigenmodes; ``sources`` of the bases; ``steps`` [s]; all combinations
        are run. ``reference...``: what they are compared with.
        Returns a dictionary, that of comparison.json (docs/reference/compare.md), with
        the cost and the errors of each run.
        """
        wish = dict(levels=list(levels), modes=list(modes), sources=list(sources),
                    steps=[float(step) for step in steps], reference=reference,
                    reference_modes=reference_modes, reference_step=reference_step,
                    reference_integrator=reference_integrator, repeats=repeats)
        return _core.compare(self._scene, wish, _path(cache))


def _to_settings(values):
    return [(path, to_toml(value)) for path, value in dict(values or {}).items()]


def _names(names):
    """A list of names; one text is one name."""
    if isinstance(names, str):
        return [names]
    return None if names is None else list(names)


def _path(folder):
    return "" if folder is None else os.fspath(folder)
