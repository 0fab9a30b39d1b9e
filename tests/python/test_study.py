# SPDX-License-Identifier: BSD-3-Clause
"""Studies by executors: the rows of `limber study`, each once."""

import concurrent.futures
import multiprocessing
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import threading

import numpy
import pytest
from conftest import call

import limber

STUDY = """scenario = 's.toml'
[design]
kind = 'monte-carlo'
samples = {samples}
seed = 5
[[factor]]
name = 'force'
path = 'load.push.force.0'
uniform = [-2.0, 2.0]
[[factor]]
name = 'stiffness'
path = 'robot.spring.coil.stiffness'
log_range = [1.0, 100.0]
[[response]]
name = 'peak'
probe = 'sled.ux'
[[response]]
name = 'twice'
expression = '2 * peak'
"""


def write(sled, samples=12, duration=0.5):
    text = STUDY.format(samples=samples)
    file = sled.parent / "study.toml"
    file.write_text(f"set = ['time.duration={duration}']\n" + text)
    return file


def read(file):
    with sqlite3.connect(file) as database:
        return database.execute("SELECT * FROM runs ORDER BY run").fetchall()


def of_command(file):
    call("study", file, "--out", file.parent / "command")
    return read(file.parent / "command/study.sqlite")


def test_threads_have_the_rows_of_the_command(sled, tmp_path):
    file = write(sled)
    results = limber.Study(file).run(out=tmp_path / "python")
    assert read(results.file) == of_command(file)
    assert len(results) == 12 and numpy.isfinite(results["peak"]).all()
    assert numpy.array_equal(results["twice"], 2 * results["peak"])


def test_a_process_pool_has_them_too_and_goes_on_where_it_was(sled, tmp_path):
    file = write(sled)
    study = limber.Study(file)
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        results = study.run(pool, out=tmp_path / "python")
        expected = of_command(file)
        assert read(results.file) == expected
        with sqlite3.connect(results.file) as database:
            database.execute("DELETE FROM runs WHERE run % 3 = 0")
            database.execute("DELETE FROM timing WHERE run % 3 = 0")
        told = []
        study.run(pool, out=tmp_path / "python", progress=lambda *n: told.append(n))
        assert read(results.file) == expected
        assert told[-1] == (12, 12) and len(told) == 4


def test_a_study_from_python_is_that_of_the_file(sled, tmp_path):
    study = limber.Study(
        scenario=sled, set={"time.duration": 0.5},
        design=dict(kind="monte-carlo", samples=12, seed=5),
        factors={"force": dict(path="load.push.force.0", uniform=[-2.0, 2.0]),
                 "stiffness": dict(path="robot.spring.coil.stiffness",
                                   log_range=[1.0, 100.0])},
        responses={"peak": dict(probe="sled.ux"),
                   "twice": dict(expression="2 * peak")})
    results = study.run(out=tmp_path / "python")
    assert read(results.file) == of_command(write(sled))
    table = results.to_pandas()
    assert list(table.columns) == ["force", "stiffness", "peak", "twice", "error",
                                   "warnings"]


def test_wrong_studies_are_told(sled):
    file = write(sled)
    file.write_text(file.read_text().replace("sled.ux", "sled.uxx"))
    with pytest.raises(limber.InputError, match="sled.uxx"):
        limber.Study(file).run(out=sled.parent / "o")
    file.write_text("version = 7\n" + STUDY.format(samples=1))
    with pytest.raises(limber.InputError, match="version"):
        limber.Study(file)
    with pytest.raises(limber.InputError, match="none"):
        limber.Study("none.toml")
    with pytest.raises(limber.InputError):
        limber.Study()


def test_a_worker_with_other_files_is_refused(sled, tmp_path):
    file = write(sled)
    study = limber.Study(file)
    context = multiprocessing.get_context("spawn")

    class Late:
        """Workers that begin after the scenario has changed."""

        def __init__(self, pool):
            self.pool = pool

        def submit(self, *work):
            sled.write_text(sled.read_text().replace("step = 1e-3", "step = 2e-3"))
            return self.pool.submit(*work)
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=context) as pool:
        with pytest.raises(limber.InputError, match="other files"):
            study.run(Late(pool), out=tmp_path / "python")
    assert read(tmp_path / "python/study.sqlite") == []


def test_control_c_keeps_the_rows_that_are_done(sled, tmp_path):
    study = limber.Study(write(sled, samples=400, duration=20.0))
    told = threading.Event()

    def interrupt():
        told.wait(60)
        os.kill(os.getpid(), signal.SIGINT)
    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(limber.Interrupted, match="the same call continues"):
        study.run(out=tmp_path / "python", progress=lambda *n: told.set())
    thread.join()
    rows = read(tmp_path / "python/study.sqlite")
    assert 0 < len(rows) < 400 and all(row[-2] in (None, "") for row in rows)


def test_a_killed_dask_worker_loses_and_doubles_no_row(sled, tmp_path):
    distributed = pytest.importorskip("distributed")
    file = write(sled, samples=40, duration=5.0)
    study = limber.Study(file)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True,
                                  dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            workers = client.run(os.getpid)
            assert len(set(workers.values())) == 2
            killed = []

            def kill(done, runs):
                if done >= 5 and not killed:
                    killed.append(next(iter(workers.values())))
                    os.kill(killed[0], signal.SIGKILL)
            results = study.run(client.get_executor(), out=tmp_path / "dask",
                                progress=kill)
    assert killed
    rows = read(results.file)
    assert [row[0] for row in rows] == list(range(40))
    assert rows == of_command(file)


class Losing(concurrent.futures.ThreadPoolExecutor):
    """Threads that lose a run as often as told, as a killed worker does."""

    def __init__(self, run, times):
        super().__init__(2)
        self.run, self.left = run, times

    def submit(self, work, task, digest, run, attempt):
        if run != self.run or self.left == 0:
            return super().submit(work, task, digest, run, attempt)
        self.left -= 1
        future = concurrent.futures.Future()
        future.set_exception(ValueError("worker lost"))
        return future


def test_a_run_that_the_executor_loses_is_made_again(sled, tmp_path):
    file = write(sled)
    told = []
    with Losing(7, times=2) as executor:
        results = limber.Study(file).run(executor, out=tmp_path / "python",
                                         progress=lambda *n: told.append(n))
    assert read(results.file) == of_command(file)
    assert told[-1] == (12, 12) and max(told) == (12, 12)


def test_a_run_that_is_lost_each_time_is_told_and_the_others_are_kept(sled, tmp_path):
    file = write(sled)
    study = limber.Study(file)
    with Losing(7, times=1000) as executor:
        with pytest.raises(RuntimeError, match="1 of 12 .* run 7 .*worker lost"):
            study.run(executor, out=tmp_path / "python")
    assert len(read(tmp_path / "python/study.sqlite")) == 11
    assert read(study.run(out=tmp_path / "python").file) == of_command(file)


def test_a_broken_pool_is_told_in_words(sled, tmp_path):
    study = limber.Study(write(sled, samples=40, duration=5.0))
    context = multiprocessing.get_context("spawn")

    def kill(done, runs):
        for process in list(pool._processes.values()):
            process.kill()
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        with pytest.raises(RuntimeError, match="of 40 runs were lost"):
            study.run(pool, out=tmp_path / "python", progress=kill)
    assert 0 < len(read(tmp_path / "python/study.sqlite")) < 40


def test_mpi_has_the_rows_of_the_command(sled, tmp_path):
    pytest.importorskip("mpi4py")
    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("there is no mpiexec (Debian's openmpi-bin)")
    file = write(sled)
    script = tmp_path / "script.py"
    script.write_text(f"""
from mpi4py.futures import MPIPoolExecutor
import limber
if __name__ == "__main__":
    with MPIPoolExecutor() as pool:
        limber.Study({str(file)!r}).run(pool, out={str(tmp_path / "mpi")!r})
""")
    started = subprocess.run(
        [mpiexec, "--allow-run-as-root", "--oversubscribe", "-n", "3", sys.executable,
         "-m", "mpi4py.futures", script], capture_output=True, text=True, timeout=120)
    assert started.returncode == 0, started.stderr
    assert read(tmp_path / "mpi/study.sqlite") == of_command(file)
