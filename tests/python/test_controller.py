# SPDX-License-Identifier: BSD-3-Clause
"""Python functions as controllers."""

import numpy
import pytest

import limber

PERIOD = 0.02
INERTIA = 0.4


def pd(t, measured):
    return -3.0 * measured[0] - 1.2 * measured[1]


def sampled_rotor(p, d, samples):
    """Angle and rate at samples, of I q'' = u held: q + T v + T^2 u / (2 I)."""
    q, v, rows = 0.5, 0.0, []
    for _ in range(samples):
        rows.append((q, v))
        u = -p * q - d * v
        q, v = q + PERIOD * v + PERIOD**2 * u / (2 * INERTIA), v + PERIOD * u / INERTIA
    return numpy.array(rows)


def test_a_pd_law_moves_a_rotor_as_the_sampled_double_integrator(rotor):
    law = limber.Controller("pd", pd)
    run = limber.load(rotor).run(controllers=[law])
    expected = sampled_rotor(3.0, 1.2, 51)
    assert numpy.abs(run.probes["angle.q"] - expected[:, 0]).max() < 1e-10
    assert numpy.abs(run.probes["speed.qdot"] - expected[:, 1]).max() < 1e-10


def test_the_built_in_law_in_python_has_its_bits(rotor):
    def same(t, measured):
        return 3.0 * (0.0 - measured[0]) + 0.0 + 1.2 * (0.0 - measured[1])
    own = limber.load(rotor).run()
    python = limber.load(rotor).run(controllers=[limber.Controller("pd", same)])
    assert numpy.abs(own.probes["angle"] - python.probes["angle"]).max() < 1e-14


def test_it_is_called_once_a_sample_with_its_own_memory(rotor):
    times = []

    def integral(t, measured, memory):
        times.append(t)
        memory[0] += PERIOD * measured[0]
        return -2.0 * memory[0]
    law = limber.Controller("pd", integral, memory=[0.0], measures=["angle.q"])
    limber.load(rotor).run(controllers=[law])
    assert numpy.abs(numpy.array(times) - PERIOD * numpy.arange(51)).max() < 1e-12


ADAPTIVE = {"time.tolerance": 1e-6, "time.integrator": "generalized-alpha"}


def test_one_pass_to_a_tolerance_samples_once_in_order(rotor):
    """Also where steps are rejected: an arm whose torque jumps every 5th sample."""
    robot = rotor.parent / "robot.urdf"
    robot.write_text(robot.read_text().replace(
        "<inertial>", "<inertial><origin xyz='0.3 0 0'/>"))
    own, kept = [], []

    def hidden(t, measured):
        own.append(t)
        return kick(len(own)) - measured[0]

    def declared(t, measured, memory):
        memory[0] += 1.0
        kept.append(t)
        return kick(memory[0]) - measured[0]

    def kick(count):
        return 400.0 if count % 5 == 0 else 0.0
    scenario = limber.load(
        rotor, set={**ADAPTIVE, "time.tolerance": 1e-4, "time.step": PERIOD})
    one = scenario.run(controllers=[limber.Controller("pd", hidden)])
    two = scenario.run(controllers=[limber.Controller("pd", declared, memory=[0.0])])
    assert one.summary["steps_rejected"] > 0
    assert numpy.array_equal(own, kept)
    assert numpy.abs(numpy.array(own) - PERIOD * numpy.arange(51)).max() < 1e-12
    assert numpy.array_equal(one.probes["angle"], two.probes["angle"])


def test_verified_passes_repeat_with_memory_and_are_refused_without(rotor):
    scenario = limber.load(rotor, set={**ADAPTIVE, "time.tolerance_passes": "verified"})

    def integral(t, measured, memory):
        memory[0] += PERIOD * measured[0]
        return -2.0 * memory[0] - measured[0]
    law = limber.Controller("pd", integral, memory=[0.0], measures=["angle.q"])
    first = scenario.run(controllers=[law])
    second = scenario.run(controllers=[law])
    assert numpy.array_equal(first.probes["angle"], second.probes["angle"])
    with pytest.raises(limber.InputError, match="pd"):
        scenario.run(controllers=[limber.Controller("pd", pd)])


def test_an_exception_names_the_controller_and_keeps_the_run(rotor):
    def fails(t, measured):
        if t > 0.51:
            raise ValueError("gauge 3 is off")
        return 0.0
    with pytest.raises(limber.NumericalError) as caught:
        limber.load(rotor).run(controllers=[limber.Controller("pd", fails)])
    text = str(caught.value)
    assert "controller 'pd' at t = 0.52 s" in text
    assert "ValueError: gauge 3 is off" in text
    assert isinstance(caught.value.__cause__, ValueError)
    assert caught.value.__cause__.__traceback__ is not None
    run = caught.value.run
    assert 0.49 < run.time[-1] < 0.53
    assert numpy.abs(run.probes["angle.q"] - 0.5).max() < 1e-12


@pytest.mark.parametrize("result, words", [
    (None, "returned None; expected a number"),
    ([1.0, 2.0], "returned 2 numbers; expected 1"),
    ("fast", "returned str; expected numbers"),
    (float("nan"), "expected a finite number"),
])
def test_what_is_no_number_is_told(rotor, result, words):
    law = limber.Controller("pd", lambda t, measured: result)
    with pytest.raises(limber.NumericalError, match=words):
        limber.load(rotor).run(controllers=[law])


def test_wrong_names_are_told(rotor):
    scenario = limber.load(rotor)
    with pytest.raises(limber.InputError, match="pd"):
        scenario.run(controllers=[limber.Controller("pdd", pd)])
    with pytest.raises(limber.InputError, match="angle"):
        scenario.run(controllers=[limber.Controller("pd", pd, measures=["angel.q"])])
    with pytest.raises(limber.InputError, match="period"):
        scenario.run(controllers=[limber.Controller("pd", pd, period=0.0)])


def test_an_interrupt_in_a_controller_ends_the_run(rotor):
    def stops(t, measured):
        if t > 0.5:
            raise KeyboardInterrupt
        return 0.0
    with pytest.raises(limber.Interrupted) as caught:
        limber.load(rotor).run(controllers=[limber.Controller("pd", stops)])
    assert 0.0 < caught.value.run.time[-1] < 1.0
