# SPDX-License-Identifier: BSD-3-Clause
"""Studies: many runs of a scenario with varied values, in one table."""

import collections
import concurrent.futures
import functools
import hashlib
import os
import pathlib

from . import _core
from .errors import InputError, Interrupted
from .toml import to_document, to_toml

Effect = collections.namedtuple("Effect", "main total")
Effect.__doc__ = "Fractions of a response's variance that a factor causes."

Row = collections.namedtuple(
    "Row", "run factors responses error warnings seconds seconds_ready")
Row.__doc__ = """One run of a study.

run: from 0; factors: {name: value}; responses: {name: number or None};
error: why it failed, or ""; warnings: a line each; seconds: wall time of its
steps [s]; seconds_ready: and before them [s]."""


class Study:
    """A study, from a file (docs/reference/studies.md), or from Python:

        limber.Study(
            scenario="struck.toml",
            factors={"force": dict(path="load.strike.force.2", uniform=[-2e2, -1e2])},
            responses={"tip": dict(probe="tip.uz", measure="peak")},
            design=dict(kind="latin-hypercube", samples=100, seed=1))

    with the keys of the file. ``cache``: folder of reduced bodies.
    Raises InputError with every problem of the study.
    """

    def __init__(self, file=None, *, scenario=None, factors=None, responses=None,
                 design=None, set=None, unset=(), name="study", cache=None):
        if (file is None) == (scenario is None):
            raise InputError("a Study is of a study file, or of a scenario with "
                             "factors and responses")
        if file is not None:
            path = pathlib.Path(file).absolute()
            try:
                text = path.read_text(encoding="utf-8")
            except (OSError, UnicodeDecodeError) as error:
                raise InputError(f"{file}: cannot be read: {error}") from error
        else:
            path = pathlib.Path(f"{name}.toml").absolute()
            text = _write_study(scenario, factors or {}, responses or {},
                                design or {}, dict(set or {}), unset)
        self._task = _Task(text, str(path), "" if cache is None else os.fspath(cache))
        self._plan = _plan(self._task)

    @property
    def name(self):
        """Stem of its file."""
        return self._plan.name

    @property
    def runs(self):
        """Number of runs of its design."""
        return self._plan.runs

    @property
    def design(self):
        """Values of the factors of every run, [{name: value}, ...]."""
        return [_to_values(self._plan.factors, values)
                for values in self._plan.design]

    def __repr__(self):
        return f"<limber.Study {self.name!r}: {self.runs} runs>"

    def run(self, executor=None, out=None, progress=None):
        """Makes all runs that the results do not have yet.

        ``executor``: any of ``concurrent.futures``: a process pool, Dask's
        ``client.get_executor()``, ``mpi4py.futures.MPIPoolExecutor()``. Its
        workers need this version of Limber and the files of the study under the
        same paths; a worker with other ones is refused. By default as many threads
        as processors.

        ``out``: folder of ``study.sqlite``, by default ``out/NAME``. Rows are
        written as they finish, only by this process, so that each exists once,
        whatever happens to workers or to this process; the same call continues with
        the others.

        A run whose worker was lost is made again, three times at most.

        ``progress(done, runs)`` is called after each.

        Returns :class:`StudyResults`. Ctrl-C raises Interrupted; finished runs
        are kept. Raises RuntimeError if the executor lost runs each time.
        """
        folder = pathlib.Path("out") / self.name if out is None else pathlib.Path(out)
        folder.mkdir(parents=True, exist_ok=True)
        file = _core.StudyFile.open(folder / "study.sqlite", self._plan)
        try:
            self._make_rows(executor, file, progress)
        finally:
            file.close()
        return StudyResults(folder / "study.sqlite")

    def _make_rows(self, executor, file, progress):
        done = {row[0] for row in file.rows}
        left = [run for run in range(self.runs) if run not in done]
        self._plan.go_on()
        own = None
        if executor is None:
            executor = own = concurrent.futures.ThreadPoolExecutor(os.cpu_count())
        try:
            for attempt in range(_ATTEMPTS):
                lost = self._attempt(executor, attempt, left, file, progress)
                left = list(lost)
                if not left:
                    return
        except KeyboardInterrupt as cause:
            raise Interrupted(
                f"interrupted after {len(file.rows)} of {self.runs} runs; the same "
                "call continues with the others") from cause
        finally:
            self._plan.stop()
            if own is not None:
                own.shutdown(wait=True)
        run, error = next(iter(lost.items()))
        raise RuntimeError(
            f"{len(lost)} of {self.runs} runs were lost by the executor {_ATTEMPTS} "
            f"times, run {run} first: {type(error).__name__}: {error}. The same call "
            "continues with them") from error

    def _attempt(self, executor, attempt, runs, file, progress):
        """Makes ``runs``. Returns those that the executor lost, {run: error}."""
        digest = _digest(self._plan)
        futures, lost = {}, {}
        try:
            for run in runs:
                try:
                    future = executor.submit(make_row, self._task, digest, run, attempt)
                except RuntimeError as error:  # broken, or shut down
                    lost[run] = error
                else:
                    futures[future] = run
            done = self.runs - len(runs)
            for future in concurrent.futures.as_completed(futures):
                done += self._take(future, futures[future], file, lost)
                if progress is not None:
                    progress(done, self.runs)
        finally:
            for future in futures:
                future.cancel()
        return lost

    @staticmethod
    def _take(future, run, file, lost):
        """Writes its row. Returns whether there is one."""
        try:
            row = future.result()
        except InputError:
            raise
        except Exception as error:  # of the executor: a run's own is in its row
            lost[run] = error
            return False
        if row is None:
            raise KeyboardInterrupt
        file.add([row])
        return True


class StudyResults:
    """The results of a study, from its file ``study.sqlite``."""

    def __init__(self, file):
        self.file = pathlib.Path(file)
        results = _core.StudyFile.read(self.file)
        self.factors = results.factors
        self.responses = results.responses
        self.runs = results.runs
        self.rows = [
            Row(run, _to_values(self.factors, factors),
                dict(zip(self.responses, responses)), *rest)
            for run, factors, responses, *rest in results.rows]
        self.effects = {
            factor: {name: Effect(*effect) for name, effect in of.items()}
            for factor, of in results.effects.items()}
        results.close()

    def __getitem__(self, name):
        """A factor or response of all rows, (rows,); NaN: none."""
        import numpy
        if name in self.responses:
            values = [row.responses[name] for row in self.rows]
            return numpy.array([numpy.nan if one is None else one for one in values])
        if name in self.factors:
            return numpy.array([row.factors[name] for row in self.rows])
        raise InputError(
            f"there is no factor or response '{name}'; there are "
            + ", ".join(self.factors + self.responses))

    def to_pandas(self):
        """A pandas.DataFrame with a row a run: factors, responses, error,
        warnings."""
        import pandas
        columns = {name: self[name] for name in self.factors + self.responses}
        columns["error"] = [row.error for row in self.rows]
        columns["warnings"] = [row.warnings for row in self.rows]
        index = pandas.Index([row.run for row in self.rows], name="run")
        return pandas.DataFrame(columns, index=index)

    def __len__(self):
        return len(self.rows)

    def __repr__(self):
        failed = sum(bool(row.error) for row in self.rows)
        return (f"<limber.StudyResults {str(self.file)!r}: {len(self.rows)} of "
                f"{self.runs} runs, {failed} failed>")


_Task = collections.namedtuple("_Task", "text file cache")

_ATTEMPTS = 3


@functools.lru_cache(maxsize=4)
def _plan(task):
    """The study's plan, made once per process, so that its runs share bodies."""
    return _core.StudyPlan(task.text, task.file, task.cache)


def _digest(plan):
    return hashlib.sha256(plan.manifest.encode()).hexdigest()


def make_row(task, digest, run, attempt=0):
    """Makes one run in a worker's process. Returns its row, or None if ended by a
    signal. ``attempt`` distinguishes a repeated run for executors that identify
    work by its arguments (Dask)."""
    del attempt
    plan = _plan(task)
    found = _digest(plan)
    if found != digest:
        raise InputError(
            f"run {run}: this worker has another Limber, or other files of the "
            f"study {task.file} (its scenario and robot), than the process that "
            "made the study")
    return plan.make_row(run)


def _to_values(names, texts):
    """Numbers as such; other values as TOML."""
    def read(text):
        try:
            return float(text)
        except ValueError:
            return text
    return {name: read(text) for name, text in zip(names, texts)}


def _write_study(scenario, factors, responses, design, values, unset):
    tables = {"version": 1, "scenario": os.path.abspath(os.fspath(scenario))}
    if values:
        tables["set"] = [f"{path}={to_toml(value)}" for path, value in values.items()]
    if unset:
        tables["unset"] = list(unset)
    if design:
        tables["design"] = dict(design)
    tables["factor"] = [dict(name=name, **keys) for name, keys in factors.items()]
    tables["response"] = [dict(name=name, **keys) for name, keys in responses.items()]
    return to_document(tables)
