# SPDX-License-Identifier: BSD-3-Clause
"""Linear models in Python: those of the command, and of closed forms and SciPy."""

import gc

import numpy
import pytest
import scipy.linalg
import scipy.signal
from conftest import SOURCE, call

import limber

ARM = SOURCE / "examples" / "damped_slew.toml"


def gain(model, w):
    """Of outputs by inputs at an angular frequency [rad/s], (p, m)."""
    n = len(model.A)
    return model.C @ numpy.linalg.solve(1j * w * numpy.eye(n) - model.A, model.B) + model.D


def test_the_model_is_that_of_the_file_of_the_command(rotor, tmp_path):
    model = limber.linearize(rotor)
    for ending in ("npz", "mat", "json"):
        call("linearize", rotor, "-o", tmp_path / f"o.{ending}")
        model.save(tmp_path / f"p.{ending}")
        assert (tmp_path / f"o.{ending}").read_bytes() == (
            tmp_path / f"p.{ending}").read_bytes(), ending
    file = numpy.load(tmp_path / "o.npz")
    for name in "ABCD":
        assert numpy.array_equal(getattr(model, name), file[name]), name
    assert numpy.array_equal(model.u0, file["u0"][:, 0])
    assert numpy.array_equal(model.y0, file["y0"][:, 0])
    for name in ("input_names", "input_units", "output_names", "output_units",
                 "state_names", "state_units"):
        assert getattr(model, name) == list(file[name]), name
    assert model.time == 0.0 and model.about == "start" and model.scenario == "s"
    assert model.open_loops == ["pd"] and model.input_names == ["pd"]


def test_a_mass_on_a_spring_has_its_closed_form(sled):
    # 3 kg on 10 N/m, pushed by 1 N: G = 1 / (10 - 3 w^2).
    model = limber.load(sled).linearize(outputs="sled.ux")
    assert model.input_names == ["push"] and model.output_names == ["sled.ux"]
    assert model.input_units == ["1"] and model.output_units == ["m"]
    assert model.u0 == [1.0] and model.y0 == pytest.approx([0.0], abs=1e-12)
    for w in (0.0, 1.0, 3.0, 20.0):
        assert gain(model, w)[0, 0] == pytest.approx(1.0 / (10.0 - 3.0 * w**2), rel=1e-8)


def test_scipy_takes_it_and_finds_the_frequencies_and_the_step(sled):
    scenario = limber.load(sled)
    system = scenario.linearize(outputs="sled.ux").to_scipy()
    assert isinstance(system, scipy.signal.StateSpace)
    poles = numpy.linalg.eigvals(system.A)
    for mode in scenario.frequencies(count=3)["modes"]:
        s = complex(mode["growth_rate"], 2.0 * numpy.pi * mode["damped_frequency"])
        assert numpy.abs(poles - s).min() < 1e-9 * abs(s)
    t, x = scipy.signal.step(system, T=numpy.linspace(0.0, 3.0, 50))
    w = numpy.sqrt(10.0 / 3.0)
    assert numpy.abs(x - 0.1 * (1.0 - numpy.cos(w * t))).max() < 1e-8


def test_it_is_reduced_as_by_the_command_and_within_the_bound(tmp_path):
    scenario = limber.load(ARM)
    names = dict(inputs=["damper"], outputs=["root.tz"])
    whole, few = scenario.linearize(**names), scenario.linearize(**names, states=4)
    call("linearize", ARM, "-o", tmp_path / "few.npz", "--inputs", "damper",
         "--outputs", "root.tz", "--states", "4")
    file = numpy.load(tmp_path / "few.npz")
    for name in "ABCD":
        assert numpy.array_equal(getattr(few, name), file[name]), name
    assert few.A.shape == (4, 4) and few.states_in_all == len(whole.A)
    assert few.kept_states == 0 and whole.kept_states is None
    assert whole.hankel_singular_values is None and whole.error_bound is None
    # SciPy's Lyapunov equations.
    p = scipy.linalg.solve_continuous_lyapunov(whole.A, -whole.B @ whole.B.T)
    q = scipy.linalg.solve_continuous_lyapunov(whole.A.T, -whole.C.T @ whole.C)
    hankel = numpy.sort(numpy.sqrt(numpy.abs(scipy.linalg.eigvals(p @ q))))[::-1]
    found = few.hankel_singular_values
    assert numpy.abs(found[:4] - hankel[:4]).max() < 1e-6 * hankel[0]
    assert few.error_bound == pytest.approx(2.0 * found[4:].sum(), rel=1e-12)
    for w in numpy.logspace(0.0, 6.0, 200):
        gap = numpy.abs(gain(whole, w) - gain(few, w))[0, 0]
        assert gap <= few.error_bound * (1.0 + 1e-6) + 1e-9 * hankel[0], w


def test_it_is_about_an_equilibrium_or_a_time_of_the_run(sled):
    scenario = limber.load(sled)
    rest = scenario.linearize(at="equilibrium", outputs=["sled"])
    assert rest.about == "equilibrium"
    # 1 N stretches 10 N/m to 0.1 m, where it is at the start.
    assert rest.y0 == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)
    late = limber.load(sled, set={"load.push.force.0": 0.0}).linearize(at=0.25)
    assert late.about == "time" and late.time == 0.25
    x = 0.1 * numpy.cos(numpy.sqrt(10.0 / 3.0) * 0.25)
    assert late.y0[0] == pytest.approx(x - 0.1, abs=1e-6)
    assert any("0.25 s is not a steady motion" in text for text in late.warnings)


def test_the_closed_loop_has_the_poles_of_the_sampled_double_integrator(rotor, tmp_path):
    model = limber.linearize(rotor, closed_loop=True)
    h, inertia = 0.02, 0.4
    step = numpy.array([0.5 * h**2, h]) / inertia
    closed = numpy.array([[1.0, h], [0.0, 1.0]]) - numpy.outer(step, [3.0, 1.2])
    poles = numpy.linalg.eigvals(model.A)
    for pole in numpy.linalg.eigvals(closed):
        assert numpy.abs(poles - pole).min() < 1e-9
    assert model.period == model.to_scipy().dt == h and model.open_loops == []
    assert model.input_names == ["pd.reference"]
    model.save(tmp_path / "m.npz")
    assert numpy.load(tmp_path / "m.npz")["period"] == h
    assert limber.linearize(rotor).period is None


def test_matrices_share_the_memory_of_the_model_and_keep_it(rotor):
    model = limber.linearize(limber.load(rotor))
    for name in "ABCD":
        one = getattr(model, name)
        assert numpy.shares_memory(one, getattr(model, name)), name
        assert not one.flags.owndata and not one.flags.writeable, name
    a, kept = model.A, model.A.copy()
    del model
    gc.collect()
    junk = [numpy.ones(1000) for _ in range(20)]
    assert numpy.array_equal(a, kept) and junk


@pytest.mark.parametrize("words, culprit", [
    (dict(inputs=["pdd"]), "'pdd'; did you mean 'pd'"),
    (dict(inputs=[""]), "unknown input ''"),
    (dict(inputs=[]), "inputs is an empty list"),
    (dict(outputs="angel"), "angel"),
    (dict(states=0), "states is 0"),
    (dict(states=1), "do not decay"),
    (dict(at="later"), "'later': expected 'start'"),
    (dict(at=None), "'None': expected 'start'"),
    (dict(at=2.0), "the run goes from 0 s to 1 s"),
    (dict(at=float("nan")), "the run goes from 0 s to 1 s"),
])
def test_what_it_cannot_do_is_refused_with_the_reason(rotor, words, culprit):
    with pytest.raises(limber.InputError, match=culprit):
        limber.linearize(rotor, **words)


def test_a_file_of_no_known_ending_is_refused(rotor, tmp_path):
    with pytest.raises(limber.InputError, match="does not end in .mat"):
        limber.linearize(rotor).save(tmp_path / "m.csv")
    assert not (tmp_path / "m.csv").exists()
