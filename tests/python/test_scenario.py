# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios in Python: the numbers of the command and of C++, and what is wrong."""

import gc
import json
import os
import signal
import subprocess
import threading
import time
import tomllib

import h5py
import numpy
import pytest
from conftest import SOURCE, call

import limber

FLEXIBLE = SOURCE / "examples" / "beam_stress.toml"


def test_command_and_python_have_the_same_bits(sled, tmp_path):
    run = limber.load(sled).run()
    call("run", sled, "--out", tmp_path / "o")
    run.save(tmp_path / "p")
    assert (tmp_path / "o/probes.csv").read_bytes() == (
        tmp_path / "p/probes.csv").read_bytes()
    with h5py.File(tmp_path / "o/results.h5") as file:
        names = []
        file.visit(names.append)
        with h5py.File(tmp_path / "p/results.h5") as other:
            count = 0
            for name in names:
                if isinstance(file[name], h5py.Dataset):
                    assert numpy.array_equal(file[name][()], other[name][()]), name
                    count += 1
    assert count > 10
    summary = json.loads((tmp_path / "o/summary.json").read_text())
    assert summary["probes"] == run.summary["probes"]


def test_cpp_and_python_have_the_same_bits_of_a_flexible_scene(tmp_path):
    cache = tmp_path / "cache"
    raw = subprocess.run(
        [os.environ["LIMBER_WITNESS"], str(FLEXIBLE), str(cache)], check=True,
        env=dict(os.environ, LIMBER_MESHER=os.environ["WITNESS_MESHER"]),
        capture_output=True).stdout
    run = limber.load(FLEXIBLE).run(cache=cache)
    own = numpy.column_stack([run.time] + [run.probes[name] for name in run.probes])
    assert own.shape[0] > 10 and numpy.abs(own[:, 1:]).max() > 0.0
    assert own.tobytes() == raw
    call("run", FLEXIBLE, "--cache", cache, "--out", tmp_path / "o")
    run.save(tmp_path / "p")
    assert (tmp_path / "o/probes.csv").read_bytes() == (
        tmp_path / "p/probes.csv").read_bytes()


def test_keys_are_those_of_the_command(sled, tmp_path):
    scenario = limber.load(sled, set={"load.push.force": [2.0, 0.0, 0.0]})
    scenario["robot.spring.coil.stiffness"] = 20.0
    scenario["robot.spring.coil.stiffness"] = numpy.float64(40.0)
    run = scenario.run()
    call("run", sled, "--set", "load.push.force=[2, 0, 0]", "--set",
         "robot.spring.coil.stiffness=40", "--out", tmp_path / "o")
    run.save(tmp_path / "p")
    assert (tmp_path / "o/probes.csv").read_bytes() == (
        tmp_path / "p/probes.csv").read_bytes()
    del scenario["time.output_interval"]
    assert scenario.settings[-1] == ("time.output_interval", None)
    with pytest.raises(limber.InputError):
        scenario["load.push.force"] = [1.0]


def test_keys_are_read_from_the_file_and_from_what_was_set(sled):
    scenario = limber.load(sled)
    with open(sled, "rb") as stream:
        tables = tomllib.load(stream)
    assert scenario["time.step"] == tables["time"]["step"]
    push = next(one for one in tables["load"] if one["name"] == "push")
    assert scenario["load.push.force"] == push["force"]
    scenario["load.push.force.1"] = 3.5
    assert scenario["load.push.force"] == [push["force"][0], 3.5, push["force"][2]]
    assert scenario["load.push.force.1"] == 3.5
    scenario["output.pictures"] = False
    assert scenario["output.pictures"] is False
    assert scenario["output"] == {**tables.get("output", {}), "pictures": False}
    scenario["robot.spring.coil.stiffness"] = 20.0
    assert scenario["robot.spring.coil.stiffness"] == 20.0
    del scenario["time.output_interval"]
    for path in ["time.output_interval", "time.stp", "load.pull.force", "load.push.force.7",
                 "load.push.force.-1", "time.step.0"]:
        with pytest.raises(KeyError, match="neither in"):
            scenario[path]
    for path in ["", "time..step", 'time."step', ".time"]:
        with pytest.raises(KeyError, match="is not a path"):
            scenario[path]
    with pytest.raises(KeyError, match="robot's file"):
        scenario["robot.spring.coil.damping"]


def test_wrong_keys_name_the_nearest_and_leave_the_scenario(sled):
    scenario = limber.load(sled)
    with pytest.raises(limber.InputError, match="force") as caught:
        scenario["load.push.forse.0"] = 2.0
    assert caught.value.problems
    assert scenario.settings == []
    with pytest.raises(limber.InputError, match="object is not a value"):
        scenario["time.step"] = object()
    with pytest.raises(limber.InputError, match="none.toml"):
        limber.load("none.toml")
    assert scenario.run().completed


def test_arrays_share_the_memory_of_the_run(sled):
    run = limber.load(sled).run()
    column, probe = run.probes["sled.ux"], run.probes["sled"]
    body = run.bodies["sled"]
    pairs = [(run.time, run.time), (column, probe), (column, run.probes["sled.ux"]),
             (run.energies["kinetic_rigid"], run.energies["kinetic_rigid"]),
             (body.position, run.bodies["sled"].position),
             (body.velocity, run.bodies["sled"].velocity)]
    for a, b in pairs:
        assert numpy.shares_memory(a, b)
        assert not a.flags.owndata and not a.flags.writeable
    energies = run.energies
    first = energies["kinetic_rigid"].__array_interface__["data"][0]
    second = energies["kinetic_modal"].__array_interface__["data"][0]
    assert second - first == 8  # members of one struct, not columns of a copy
    assert energies["kinetic_rigid"].strides[0] > 8
    table = run.to_pandas()
    assert numpy.shares_memory(table["sled.ux"].to_numpy(), column)


def test_arrays_keep_the_run_alive(sled):
    run = limber.load(sled).run()
    time_, column = run.time, run.probes["sled.ux"]
    kept = time_.copy(), column.copy()
    del run
    gc.collect()
    junk = [numpy.ones(10000) for _ in range(20)]
    assert numpy.array_equal(time_, kept[0]) and numpy.array_equal(column, kept[1])
    assert junk


def test_motion_and_energies_are_those_of_the_closed_form(sled):
    # 3 kg on 10 N/m, pushed by 1 N from 0.1 m: x = 0.1 throughout.
    run = limber.load(sled, set={"load.push.force.0": 0.0,
                                 "time.integrator": "runge-kutta-4"}).run()
    w = numpy.sqrt(10.0 / 3.0)
    x = 0.1 * numpy.cos(w * run.time)
    assert numpy.abs(run.probes["sled.ux"] - (x - 0.1)).max() < 1e-9
    velocity = run.bodies["sled"].velocity[:, 0]
    assert numpy.abs(velocity + 0.1 * w * numpy.sin(w * run.time)).max() < 1e-9
    kinetic = run.energies["kinetic_rigid"]
    assert numpy.abs(kinetic - 1.5 * velocity**2).max() < 1e-12
    assert run.units["sled.ux"] == "m"


def test_control_c_ends_a_run_and_keeps_it(sled):
    scenario = limber.load(sled, set={"time.duration": 1e3})
    is_under_way = threading.Event()

    def interrupt():
        assert is_under_way.wait(60)
        os.kill(os.getpid(), signal.SIGINT)

    def progress(what, fraction):
        if fraction > 1e-3:
            is_under_way.set()
    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(limber.Interrupted) as caught:
        scenario.run(judge=False, progress=progress)
    thread.join()
    run = caught.value.run
    assert not run.completed and 0.0 < run.time[-1] < 1e3
    assert isinstance(caught.value, KeyboardInterrupt)
    assert isinstance(caught.value.__cause__, KeyboardInterrupt)
    assert len(run.probes["sled.ux"]) == len(run.time)


def test_other_threads_go_on_while_it_steps(sled):
    scenario = limber.load(sled, set={"time.duration": 20.0})
    counts, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counts[0] += 1
            time.sleep(1e-4)
    thread = threading.Thread(target=count)
    thread.start()
    before = counts[0]
    scenario.run(judge=False)
    counted = counts[0] - before
    done.set()
    thread.join()
    assert counted > 10


def test_progress_is_told_and_its_exception_ends_the_run(sled):
    scenario = limber.load(sled, set={"time.duration": 1e4})
    told = []

    def progress(what, fraction):
        told.append((what, fraction))
        if len(told) == 3:
            raise LookupError("enough")
    with pytest.raises(limber.Interrupted, match="LookupError") as caught:
        scenario.run(judge=False, progress=progress)
    assert isinstance(caught.value.__cause__, LookupError)
    assert 0.0 < told[0][1] < 1.0


def test_advise_is_that_of_the_command(sled):
    told = json.loads(call("advise", FLEXIBLE, "--json"))
    found = limber.load(FLEXIBLE).advise()
    assert found["fidelity_table"] == told["fidelity_table"]
    assert found["bodies"] == told["bodies"]
    with pytest.raises(limber.InputError, match="no link is flexible"):
        limber.load(sled).advise()


def test_check_is_that_of_the_command(sled):
    told = json.loads(call("check", sled, "--json"))
    found = limber.load(sled).check()
    for key in ("mass", "frequencies_hz", "outputs", "silent", "bodies"):
        assert found[key] == told[key]


def test_explain_is_that_of_the_command(sled):
    folder = sled.parent / "o"
    call("run", sled, "--out", folder)
    assert limber.explain(folder) == json.loads(
        call("explain", folder, "--json"))


def test_static_frequencies_and_compare_are_those_of_the_commands(sled):
    scenario = limber.load(sled)
    found = scenario.frequencies(count=1)
    lowest = numpy.sqrt(10.0 / 3.0) / (2.0 * numpy.pi)
    assert found["frequencies"][0] == pytest.approx(lowest, rel=1e-6)
    rest = scenario.static()
    # The spring has its free length at 0; 1 N stretches it by 0.1 m.
    assert rest.bodies["sled"].position[0, 0] == pytest.approx(
        0.1, abs=1e-6)
    call("static", sled, "--out", sled.parent / "o")
    rest.save(sled.parent / "p")
    for name in ("summary.json", "probes.csv"):
        assert (sled.parent / "o" / name).read_bytes() == (
            sled.parent / "p" / name).read_bytes()
    compared = scenario.compare(steps=[1e-3, 5e-4], repeats=1)
    assert len(compared["runs"]) == 2


def test_a_body_is_reduced_saved_and_read(tmp_path):
    mesh = SOURCE / "meshes" / "rod.geo"
    body = limber.reduce(mesh, youngs_modulus=210e9, poisson_ratio=0.3, density=7850.0,
                         interfaces=["root", "tip"], modes=4)
    assert body.interfaces == ["root", "tip"]
    assert numpy.shares_memory(body.nodes, body.nodes)
    assert body.mode_shapes.shape == (3 * len(body.nodes), body.mode_count)
    body.save(tmp_path / "rod.h5")
    again = limber.read_body(tmp_path / "rod.h5")
    assert numpy.array_equal(again.eigenvalues, body.eigenvalues)
    with pytest.raises(limber.InputError, match="density"):
        limber.reduce(mesh, youngs_modulus=1.0, poisson_ratio=0.3, density=-1.0)


def test_a_deck_of_shells_has_its_material_and_the_frequencies_of_calculix():
    deck = SOURCE / "tests/data/structures/plate16.inp"
    body = limber.reduce(deck, modes=3)
    assert body.mass == pytest.approx(7800.0 * 0.02 * 1.0 * 0.7)
    # CalculiX 2.20 with S4, twice the elements (tests/cli/structures_test.cpp).
    assert body.frequencies == pytest.approx([95.14645, 106.7729, 221.4544], rel=0.015)
    with pytest.raises(limber.InputError, match="have their own"):
        limber.reduce(deck, youngs_modulus=1e9, poisson_ratio=0.3, density=1e3)


def test_surfaces_and_curves_of_a_geometry_become_shells_and_beams(tmp_path):
    (tmp_path / "panel.geo").write_text(
        "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\nPoint(3) = {1, 1, 0};\nPoint(4) = {0, 1, 0};\n"
        "Point(5) = {2, 0, 0};\nLine(1) = {1, 2};\nLine(2) = {2, 3};\nLine(3) = {3, 4};\nLine(4) = {4, 1};\n"
        "Line(5) = {2, 5};\nCurve Loop(1) = {1, 2, 3, 4};\nPlane Surface(1) = {1};\n"
        "Physical Surface(\"skin\") = {1};\nPhysical Curve(\"mast\") = {5};\n")
    materials = [dict(youngs_modulus=7e10, poisson_ratio=0.3, density=2700.0),
                 dict(group="skin", youngs_modulus=[140e9, 9e9, 9e9], poisson_ratio=[0.3, 0.3, 0.4],
                      shear_modulus=[5e9, 5e9, 3e9], density=1600.0)]
    beams = [dict(group="mast", section="rectangle", height=0.03, width=0.02, y_axis=[0, 0, 1])]
    body = limber.reduce(tmp_path / "panel.geo", size=0.25, materials=materials, beams=beams, modes=2,
                         shells=[dict(group="skin", thickness=0.001, angles=[0, 90, 0])])
    assert body.mass == pytest.approx(1600.0 * 0.003 + 2700.0 * 0.03 * 0.02)
    with pytest.raises(limber.InputError, match="no thickness"):
        limber.reduce(tmp_path / "panel.geo", size=0.25, materials=materials[:1], beams=beams)


def test_a_deck_of_solids_has_its_material_masses_and_supports():
    deck = SOURCE / "tests/data/attachments/masses.bdf"
    body = limber.reduce(deck, unit="mm", clamps=["spc:12"], modes=3)
    # CalculiX 2.20 (tests/data/attachments).
    assert body.eigenvalues == pytest.approx([8.878801e6, 1.282718e7, 8.856904e7], rel=5e-7)
    heavy = limber.reduce(deck, unit="mm", force_unit=2.0, ignore="CONM2", modes=3)
    assert heavy.mass == pytest.approx(2.0 * (body.mass - 0.07), rel=1e-12)


def test_peaks_and_envelopes_are_those_of_all_steps(sled, tmp_path):
    run = limber.load(sled).run()
    run.save(tmp_path / "o")
    for name in run.probes:
        values, peak = run.probes[name], run.peaks[name]
        summary = run.summary["probes"][name]
        assert (peak.value, peak.time) == (summary["peak"], summary["peak_time"])
        edges, least, most = run.envelopes[name]
        assert len(edges) == len(least) + 1 == len(most) + 1
        assert (edges[0], edges[-1]) == (run.time[0], run.time[-1])
        assert max(most.max(), -least.min()) == abs(peak.value)
        at = numpy.searchsorted(edges, run.time[1:], side="left") - 1
        assert (least[at] <= values[1:]).all() and (values[1:] <= most[at]).all()
    assert (tmp_path / "o/peaks.csv").read_text().count("\n") == 1 + len(run.peaks)
    with pytest.raises(limber.InputError, match="'slad.ux'"):
        run.peaks["slad.ux"]
    with pytest.raises(limber.InputError, match="'slad.ux'"):
        run.envelopes["slad.ux"]


def test_a_notebook_shows_the_page_and_plots(sled):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    run = limber.load(sled).run()
    html = run._repr_html_()
    assert html.startswith("<iframe") and len(html) > 100000
    axes = run.plot("sled")
    assert len(axes) == 1 and len(axes[0].lines) == 3
    assert numpy.array_equal(axes[0].lines[0].get_ydata(), run.probes["sled.ux"])
    pyplot.close("all")
    with pytest.raises(limber.InputError, match="'slad'"):
        run.plot("slad")


def test_python_costs_less_than_a_hundredth_of_a_run(sled):
    """Of a run of a second: all that a call takes but its steps, building included.

    Times of the processor, as others may be busy, too.
    """
    scenario = limber.load(sled, set={"time.output_interval": 1e-3})

    def spend(duration):
        scenario["time.duration"] = duration
        began = time.thread_time()
        run = scenario.run(judge=False)
        assert len(run.time) == len(run.probes["sled"])
        assert len(run.bodies["sled"].position) == len(run.time)
        return time.thread_time() - began
    spend(1e-3)
    scenario["time.output_interval"] = 0.5
    second = 100.0 / spend(100.0)  # simulated in one of the processor
    whole = spend(max(100.0, second))
    scenario["time.output_interval"] = 1e-3
    assert whole > 0.3
    assert min(spend(1e-3) for _ in range(5)) < 0.01 * whole
