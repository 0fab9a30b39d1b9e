# SPDX-License-Identifier: BSD-3-Clause
"""Results of a run, as NumPy arrays."""

import base64
import collections
import os
import tempfile
import warnings

from . import _core, errors

Event = collections.namedtuple("Event", "time source what rate")
Event.__doc__ = """What happened at a coupler, a transmission or a load.

time [s]; source: its name; what: "stop reached", "latched", "load edge", ...;
rate: of what triggered it [m/s or rad/s]."""


Peak = collections.namedtuple("Peak", "value time")
Peak.__doc__ = """Value of largest magnitude of all steps, signed, and its time [s]."""

Envelope = collections.namedtuple("Envelope", "edges least most")
Envelope.__doc__ = """Smallest and largest values in n intervals of time.

edges (n + 1,) [s]; least, most (n,): of all steps and outputs in each interval,
NaN where there is no value."""


class BodyMotion:
    """Motion of one body's frame B and its modes; arrays share the run's memory.

    ``position`` (T, 3): centre of mass, world [m]; ``orientation`` (T, 4): unit
    quaternion w x y z, body to world [-]; ``velocity`` (T, 3): world [m/s];
    ``angular_velocity`` (T, 3): in the body [rad/s]; ``eta`` (T, m): modal
    coordinates [kg^1/2 m]; ``etadot`` (T, m): their rates [kg^1/2 m/s];
    ``level``: its fidelity.
    """

    def __init__(self, name, arrays):
        self.name = name
        self.position = arrays["position"]
        self.orientation = arrays["orientation"]
        self.velocity = arrays["velocity"]
        self.angular_velocity = arrays["angular_velocity"]
        self.eta = arrays["eta"]
        self.etadot = arrays["etadot"]
        self.level = arrays["level"]

    def __repr__(self):
        return (f"<limber.BodyMotion {self.name!r}, level {self.level}, "
                f"{self.eta.shape[1]} modes>")


class Named(collections.abc.Mapping):
    """A dictionary by name that is filled on demand."""

    def __init__(self, kind, names, find):
        self._kind = kind
        self._names = list(names)
        self._find = find

    def __getitem__(self, name):
        found = self._find(name)
        if found is None:
            raise errors.InputError(
                f"there is no {self._kind} '{name}'; there are "
                + (", ".join(self._names) or "none"))
        return found

    def __contains__(self, name):
        return self._find(name) is not None

    def __iter__(self):
        return iter(self._names)

    def __len__(self):
        return len(self._names)

    def __repr__(self):
        return f"<{self._kind}: {', '.join(self._names)}>"


class Run:
    """A finished run of T outputs.

    Arrays are read-only views, which keep the run alive: of the recorded times
    and energies, and of probes and motion gathered at first use.
    """

    def __init__(self, recorded):
        self._recorded = recorded
        self._units = dict(recorded.columns)
        self._columns = [name for name, unit in recorded.columns]

    @property
    def name(self):
        """Of the scenario."""
        return self._recorded.name

    @property
    def time(self):
        """Output times, (T,) [s]."""
        return self._recorded.time

    @property
    def probes(self):
        """By the name of a column, "tip.ux", (T,), or of a probe, "tip", (T, k).

        Units: :attr:`units`.
        """
        return Named("probe", self._columns, self._find_probe)

    def _find_probe(self, name):
        if name in self._columns:
            return self._recorded.probes[:, self._columns.index(name)]
        of = [i for i, column in enumerate(self._columns)
              if column.rpartition(".")[0] == name]
        return self._recorded.probes[:, of[0]:of[-1] + 1] if of else None

    @property
    def peaks(self):
        """:class:`Peak` of each column of the probes, by name: of all steps,
        where ``probes`` has the outputs."""
        peaks = dict(zip(self._columns, self._recorded.peaks))
        return Named("peak", peaks,
                     lambda name: Peak(*peaks[name]) if name in peaks else None)

    @property
    def envelopes(self):
        """:class:`Envelope` of each column of the probes, by name. Its intervals
        are those between outputs, of more than 1000 outputs several together;
        an equilibrium has none."""
        names = self._columns[:self._recorded.enveloped]

        def find(name):
            if name not in names:
                return None
            return Envelope(*self._recorded.envelope(names.index(name)))
        return Named("envelope", names, find)

    @property
    def units(self):
        """Unit of each column of the probes, by name."""
        return dict(self._units)

    @property
    def bodies(self):
        """Motion of each body by name, :class:`BodyMotion`."""
        names = self._recorded.bodies

        def find(name):
            if name not in names:
                return None
            return BodyMotion(name, self._recorded.body(names.index(name)))
        return Named("body", names, find)

    @property
    def energies(self):
        """Energies [J], (T,): kinetic_rigid, kinetic_modal, elastic, coupler;
        dissipated and work since the start; linear_momentum [kg m/s] and
        angular_momentum about the world's origin [kg m^2/s], (T, 3)."""
        arrays = self._recorded.energies
        return Named("energy", arrays, arrays.get)

    @property
    def events(self):
        """List of :class:`Event`, in the order of time."""
        return [Event(*one) for one in self._recorded.events]

    @property
    def summary(self):
        """The content of summary.json of ``limber run``, as a dictionary."""
        return self._recorded.summary

    @property
    def warnings(self):
        """Texts."""
        return self._recorded.warnings

    @property
    def seconds(self):
        """Wall time of the steps [s]."""
        return self._recorded.seconds

    @property
    def completed(self):
        """Whether the run reached its end."""
        return self._recorded.failure is None

    def save(self, folder, pictures=False, xdmf=False):
        """Writes results.h5, probes.csv, peaks.csv, envelopes.csv and
        summary.json, as ``limber run`` does; with ``pictures``, and files for ParaView (``xdmf``)."""
        self._recorded.save(os.fspath(folder), pictures, xdmf)

    def write_page(self, file):
        """Writes one HTML file that shows the motion in a browser."""
        with tempfile.TemporaryDirectory() as folder:
            self.save(folder)
            _core.write_page(os.fspath(file), [folder])

    def to_pandas(self, what="probes"):
        """A pandas.DataFrame over time [s]: of the "probes", or "energies".

        Its ``attrs["units"]`` has the units.
        """
        import pandas
        index = pandas.Index(self.time, name="time")
        if what == "probes":
            frame = pandas.DataFrame(self._recorded.probes, index=index,
                                     columns=self._columns, copy=False)
            frame.attrs["units"] = self.units
            return frame
        if what != "energies":
            raise errors.InputError(
                f"there is no table '{what}'; there are probes and energies")
        scalars = {name: values for name, values in self.energies.items()
                   if values.ndim == 1}
        frame = pandas.DataFrame(scalars, index=index)
        frame.attrs["units"] = dict.fromkeys(scalars, "J")
        return frame

    def plot(self, *names):
        """Draws probes over time with matplotlib, by default all.

        ``names``: of columns or probes. Returns the axes, one for each unit.
        """
        return _plot(self, names)

    def __repr__(self):
        end = "" if self.completed else ", ended early"
        last = self.time[-1] if len(self.time) else 0.0
        return (f"<limber.Run {self.name!r}: {len(self.time)} outputs to "
                f"{last:g} s, {len(self._recorded.bodies)} bodies{end}>")

    def _repr_html_(self):
        """The page of ``limber view``, in a notebook."""
        with tempfile.TemporaryDirectory() as folder:
            page = os.path.join(folder, "view.html")
            try:
                self.write_page(page)
            except errors.InputError as error:
                return f"<pre>{_escape(repr(self))}\n{_escape(str(error))}</pre>"
            with open(page, "rb") as file:
                data = base64.b64encode(file.read()).decode()
        return (f'<iframe src="data:text/html;base64,{data}" width="100%" '
                'height="600" style="border:0"></iframe>')


class StaticRun(Run):
    """An equilibrium, as a run with one output."""

    def __init__(self, recorded, summary, texts):
        super().__init__(recorded)
        self._summary = summary
        self._texts = texts

    def save(self, folder, xdmf=False):
        """Writes the files of ``limber static``."""
        self._recorded.save(os.fspath(folder), False, xdmf)

    @property
    def summary(self):
        """The content of summary.json of ``limber static``, as a dictionary."""
        return self._summary

    @property
    def warnings(self):
        """Texts."""
        return self._texts


def finish(run):
    """Issues the warnings of a run, and raises the exception that ended it early."""
    for text in run.warnings:
        warnings.warn(text, errors.LimberWarning, stacklevel=3)
    failure = run._recorded.failure
    if failure is None:
        return run
    kind, text = failure
    error = getattr(errors, kind)(text)
    error.run = run
    raise error from run._recorded.cause


def _escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;")


def _plot(run, names):
    from matplotlib import pyplot
    columns = []
    for name in names or run.probes:
        run.probes[name]  # raises for an unknown one
        columns += [one for one in run.probes
                    if one == name or one.rpartition(".")[0] == name]
    by_unit = {}
    for column in columns:
        by_unit.setdefault(run.units[column], []).append(column)
    count = max(1, len(by_unit))
    axes = pyplot.subplots(count, sharex=True, squeeze=False, layout="constrained",
                           figsize=(8, 1 + 2.5 * count))[1][:, 0]
    for axis, (unit, of_unit) in zip(axes, by_unit.items()):
        for column in of_unit:
            line, = axis.plot(run.time, run.probes[column], label=column)
            _plot_extremes(axis, run, column, line.get_color())
        axis.set_ylabel(f"[{unit}]")
        axis.legend(loc="best")
    axes[0].set_title(run.name)
    axes[-1].set_xlabel("time [s]")
    return axes


def _plot_extremes(axis, run, column, colour):
    if column in run.envelopes:
        edges, least, most = run.envelopes[column]
        axis.fill_between(edges, [*least, least[-1]], [*most, most[-1]], step="post",
                          color=colour, alpha=0.25, linewidth=0)
    if column not in run.peaks:
        return
    peak = run.peaks[column]
    axis.scatter([peak.time], [peak.value], edgecolors=colour, facecolors="none")
    axis.annotate(f"{peak.value:.3g}", (peak.time, peak.value), color=colour,
                  xytext=(4, 4), textcoords="offset points")
