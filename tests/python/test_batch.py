# SPDX-License-Identifier: BSD-3-Clause
"""Batches: worlds of one scenario beside single runs, to the bit."""

import copy
import os
import pickle
import signal
import threading
import time

import numpy
import pytest
from conftest import ROTOR, ROTOR_ROBOT, SLED, SLED_ROBOT, SOURCE, place

import limber

PERIOD = 0.02

# A rotor under torque, and a ball that hops on a floor under a thrust.
HOP = ROTOR.replace("integrator = 'runge-kutta-4'\n", "").replace(
    "duration = 1.0", "duration = 0.2") + """
[gravity]
acceleration = [0, 0, -9.81]
[[projectile]]
name = 'ball'
radius = 0.1
mass = 2.0
position = [3.0, 0, 0.13]
velocity = [0.3, 0, -1.0]
[[obstacle]]
name = 'floor'
shape = 'plane'
normal = [0, 0, 1]
position = [0, 0, 0]
youngs_modulus = 1e7
poisson_ratio = 0.3
[[contact]]
between = ['ball', 'floor']
friction = 0.3
restitution = 0.8
[[controller]]
name = 'thrust'
period = 0.02
measures = 'ball.uz'
proportional = 1.0
hold = 'linear'
[[load]]
name = 'lift'
link = 'ball'
force = [0, 0, 1]
frame = 'world'
time = { kind = 'input', controller = 'thrust' }
[[probe]]
name = 'ball'
link = 'ball'
[[probe]]
name = 'impact'
contact = ['ball', 'floor']
quantity = 'touching'
"""

ALPHA = {"time.integrator": "generalized-alpha"}
SCENES = {
    "runge-kutta": (ROTOR, {}),
    "generalized-alpha": (ROTOR, ALPHA),
    "linear hold": (ROTOR.replace("period = 0.02\n", "period = 0.02\nhold = 'linear'\n"),
                    ALPHA),
    "outputs between samples": (ROTOR, {**ALPHA, "time.output_interval": 0.013}),
    "tolerance": (ROTOR, {**ALPHA, "time.tolerance": 1e-6}),
    "contact": (HOP, {}),
    "contact to a tolerance": (HOP, {"time.tolerance": 1e-4}),
}


@pytest.fixture
def hop(tmp_path):
    """File of a rotor and a hopping ball, with two inputs."""
    return place(tmp_path, ROTOR_ROBOT, HOP)


def draw(scenario, batch, seed=1):
    """Controls of all periods, (periods, n, m)."""
    periods = round(scenario.end_time / batch.period)
    random = numpy.random.default_rng(seed)
    return random.uniform(-3.0, 3.0, (periods, len(batch), len(batch.inputs)))


def play(controls, world, column):
    """A law that writes one input of one world at its samples."""
    def law(t, measured):
        sample = min(round(t / PERIOD), len(controls) - 1)
        return controls[sample, world, column]
    return law


def run_alone(scenario, batch, controls, world):
    return scenario.run(judge=False, controllers=[
        limber.Controller(name, play(controls, world, column))
        for column, name in enumerate(batch.inputs)])


def motion_columns(batch):
    """Those that do not depend on inputs, which a run has changed at a sample."""
    return [i for i, name in enumerate(batch.columns) if not name.endswith(".u")]


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("scene", SCENES)
def test_worlds_have_the_bits_of_runs_by_themselves(tmp_path, scene, threads):
    text, keys = SCENES[scene]
    scenario = limber.load(place(tmp_path, ROTOR_ROBOT, text), set=keys)
    batch = limber.Batch(scenario, 3, threads=threads)
    controls = draw(scenario, batch)
    rows = [batch.step(of_period).copy() for of_period in controls]
    assert not batch.failed.any() and batch.ended.all()
    same_times = "time.output_interval" not in keys
    for world in range(3):
        run = run_alone(scenario, batch, controls, world)
        state = batch.state(world)
        for name in run.bodies:
            last, body = run.bodies[name], state.body(_find_body(batch, run, name))
            assert numpy.array_equal(last.position[-1], body.p_WB)
            assert numpy.array_equal(last.velocity[-1], body.v_WB_W)
            assert numpy.array_equal(last.angular_velocity[-1], body.w_WB_B)
        for column in motion_columns(batch) if same_times else ():
            found = numpy.array([row[world, column] for row in rows])
            expected = run.probes[batch.columns[column]][1:]
            assert numpy.array_equal(found, expected), batch.columns[column]


def _find_body(batch, run, name):
    return limber.BodyIndex(list(run.bodies).index(name))


def test_a_ball_hops_in_the_contact_scene(hop):
    """So that the test above has impacts in it, at other times in each world."""
    scenario = limber.load(hop)
    batch = limber.Batch(scenario, 3)
    for controls in 5.0 * draw(scenario, batch):
        batch.step(controls)
    times = [[event[0] for event in batch.statistics(i).events] for i in range(3)]
    assert all(times) and times[0] != times[1] != times[2]


def test_a_flexible_arm_has_the_bits_of_its_run():
    scenario = limber.load(SOURCE / "examples/damped_slew.toml",
                           set={"time.duration": 0.02})
    batch = limber.Batch(scenario, 2, threads=2)
    controls = draw(scenario, batch)
    for of_period in controls:
        batch.step(of_period)
    period = batch.period
    run = scenario.run(judge=False, controllers=[limber.Controller(
        batch.inputs[0], lambda t, measured: controls[
            min(round(t / period), len(controls) - 1), 1, 0])])
    state = batch.state(1)
    eta = numpy.concatenate([run.bodies[name].eta[-1] for name in run.bodies])
    assert len(eta) > 0 and numpy.array_equal(eta, state.eta)


def test_worlds_do_not_depend_on_their_number_nor_on_threads(hop):
    scenario = limber.load(hop)
    five = limber.Batch(scenario, 5, threads=2)
    controls = draw(scenario, five)
    rows = numpy.array([five.step(of_period).copy() for of_period in controls])
    for world in (0, 4):
        one = limber.Batch(scenario, 1, threads=1)
        own = numpy.array([one.step(of_period[[world]]).copy() for of_period in controls])
        assert numpy.array_equal(rows[:, world], own[:, 0], equal_nan=True)


def test_controls_held_for_several_periods_are_those_repeated(hop):
    one, held = limber.Batch(hop, 2), limber.Batch(hop, 2)
    controls = numpy.array([[2.0, 15.0], [-1.0, 4.0]])
    for _ in range(5):
        one.step(controls)
    held.step(controls, steps=5)
    assert numpy.array_equal(one.observations, held.observations)
    assert held.time == pytest.approx([0.1, 0.1], abs=1e-12)


def test_observations_stay_where_they_are_and_have_the_names_of_probes(hop):
    batch = limber.Batch(hop, 4)
    first = batch.observations
    assert first.shape == (4, len(batch.columns)) and first.dtype == numpy.float64
    assert batch.columns[:3] == ["angle.q", "speed.qdot", "torque.u"]
    assert batch.units[:2] == ["rad", "rad/s"]
    assert batch.inputs == ["pd", "thrust"]
    second = batch.step(numpy.ones((4, 2)))
    assert numpy.shares_memory(first, second)
    assert first.ctypes.data == second.ctypes.data
    assert first[0, 0] == second[0, 0] != 0.5
    with pytest.raises(ValueError):
        first[0, 0] = 1.0


def test_a_reset_puts_back_those_of_its_mask(rotor):
    batch = limber.Batch(rotor, 3)
    start = batch.observations.copy()
    controls = numpy.array([[1.0], [2.0], [3.0]])
    moved = [batch.step(controls).copy() for _ in range(3)]
    batch.reset(numpy.array([True, False, True]))
    assert numpy.array_equal(batch.observations[[0, 2]], start[[0, 2]])
    assert numpy.array_equal(batch.observations[1], moved[-1][1])
    assert batch.time[0] == 0.0 and batch.time[1] == pytest.approx(0.06)
    for row in moved:
        again = batch.step(controls, mask=numpy.array([True, False, True]))
        assert numpy.array_equal(again[[0, 2]], row[[0, 2]])


def test_joints_start_as_in_a_scenario_with_these_keys(rotor):
    batch = limber.Batch(rotor, 3)
    batch.reset(joints={"hinge": {"position": [0.1, 0.2, 0.3], "velocity": -2.0}})
    controls = numpy.array([[1.0], [-2.0], [0.5]])
    batch.step(controls)
    for world, angle in enumerate([0.1, 0.2, 0.3]):
        other = limber.Batch(limber.load(rotor, set={
            "initial.joints.hinge.position": angle,
            "initial.joints.hinge.velocity": -2.0}), 1)
        other.step(controls[[world]])
        assert numpy.array_equal(other.observations[0], batch.observations[world])
    batch.reset()
    assert batch.observations[:, 0] == pytest.approx([0.5, 0.5, 0.5])


def test_projectiles_start_as_in_a_scenario_with_these_keys(hop):
    batch = limber.Batch(hop, 2)
    velocities = numpy.array([[0.0, 0.1, -2.0], [1.0, 0.0, 0.5]])
    batch.reset(bodies={"ball": {"velocity": velocities, "position": [3.0, 0.0, 0.5]}})
    for _ in range(9):
        batch.step(numpy.ones((2, 2)))
    for world in range(2):
        other = limber.Batch(limber.load(hop, set={
            "projectile.ball.velocity": velocities[world],
            "projectile.ball.position": [3.0, 0.0, 0.5]}), 1)
        for _ in range(9):
            other.step(numpy.ones((1, 2)))
        body = limber.BodyIndex(1)
        assert numpy.array_equal(other.state(0).body(body).p_WB,
                                 batch.state(world).body(body).p_WB)


def test_starts_that_cannot_be_are_told_and_change_nothing(hop):
    batch = limber.Batch(hop, 2)
    batch.step(numpy.ones((2, 2)))
    before = batch.observations.copy()
    for arguments, words in [
            (dict(joints={"hing": {"position": 0.1}}), "hinge"),
            (dict(joints={"hinge": {"place": 0.1}}), "'place'; expected position"),
            (dict(joints={"hinge": {"position": [0.1, 0.2, 0.3]}}), r"shape \(3,\)"),
            (dict(joints={"hinge": {"position": numpy.ones((2, 2))}}), "2 numbers"),
            (dict(joints={"hinge": {"position": numpy.nan}}), "nan"),
            (dict(bodies={"bal": {"velocity": [0, 0, 1]}}), "ball"),
            (dict(bodies={"base": {"velocity": [0, 0, 1]}}), "world"),
            (dict(bodies={"ball": {"velocity": [0, 1]}}), r"shape \(2,\)"),
            (dict(bodies={"ball": {"position": [3.0, 0.0, 0.05]}}), "overlap")]:
        with pytest.raises(limber.InputError, match=words):
            batch.reset(**arguments)
        assert numpy.array_equal(batch.observations, before)


def test_a_failed_world_is_nan_and_others_go_on_until_a_reset_revives_it(rotor):
    batch, other = limber.Batch(rotor, 3), limber.Batch(rotor, 3)
    controls = numpy.array([[1.0], [2.0], [3.0]])
    batch.step(controls)
    other.step(controls)
    broken = controls.copy()
    broken[1] = numpy.nan
    batch.step(broken)
    other.step(controls)
    assert batch.failed.tolist() == [False, True, False]
    assert numpy.isnan(batch.observations[1]).all()
    assert list(batch.failures) == [1] and "input 'pd' is nan" in batch.failures[1]
    batch.step(controls)
    other.step(controls)
    assert numpy.array_equal(batch.observations[[0, 2]], other.observations[[0, 2]])
    batch.reset(batch.failed)
    assert not batch.failed.any() and batch.failures == {}
    first = limber.Batch(rotor, 3).step(controls)
    assert numpy.array_equal(batch.step(controls)[1], first[1])


def test_a_motion_that_blows_up_fails_its_world_alone(rotor):
    batch = limber.Batch(rotor, 2)
    for _ in range(5):
        batch.step(numpy.array([[1e200], [1.0]]))
    assert batch.failed.tolist() == [True, False]
    assert batch.failures[0]
    assert numpy.isfinite(batch.observations[1]).all()


def test_worlds_end_with_their_scenario(rotor):
    batch = limber.Batch(rotor, 2)
    batch.step(numpy.zeros((2, 1)), steps=60)
    assert batch.ended.all() and batch.time.tolist() == [1.0, 1.0]
    batch.reset(numpy.array([True, False]))
    with pytest.raises(limber.InputError, match="world 1 is at the end"):
        batch.step(numpy.zeros((2, 1)))
    assert batch.time.tolist() == [0.0, 1.0]
    batch.step(numpy.zeros((2, 1)), mask=~batch.ended)


def test_controllers_that_are_no_inputs_keep_their_laws(hop):
    scenario = limber.load(hop)
    batch = limber.Batch(scenario, 1, inputs=["thrust"])
    controls = draw(scenario, batch)
    for of_period in controls:
        batch.step(of_period)
    run = run_alone(scenario, batch, controls, 0)
    body = limber.BodyIndex(0)
    assert numpy.array_equal(run.bodies["rotor"].angular_velocity[-1],
                             batch.state(0).body(body).w_WB_B)
    assert abs(run.bodies["rotor"].angular_velocity[-1][2]) > 0.1


def test_a_scenario_without_inputs_needs_a_period_alone(tmp_path):
    sled = place(tmp_path, SLED_ROBOT, SLED)
    batch = limber.Batch(sled, 2, period=0.05)
    batch.reset(joints={"rail": {"position": [0.1, 0.2]}})
    for _ in range(10):
        batch.step()
    run = limber.load(sled).run(judge=False)
    assert batch.ended.all()
    assert batch.observations[0] == pytest.approx(run.probes["sled"][-1], abs=1e-12)
    with pytest.raises(limber.InputError, match="give 'period'"):
        limber.Batch(sled, 2)


@pytest.mark.parametrize("arguments, words", [
    (dict(n=0), "n, the number of worlds: 0; expected at least 1"),
    (dict(n=2.5), "expected a whole number"),
    (dict(n=2, inputs=["pdd"]), "pd"),
    (dict(n=2, inputs=["pd", "pd"]), "twice"),
    (dict(n=2, inputs=[limber.Controller("pd", max)]), "does not support laws in Python"),
    (dict(n=2, inputs=[3]), "expected the name"),
    (dict(n=2, period=0.0), "period"),
    (dict(n=2, period=float("nan")), "period"),
    (dict(n=2, period=1e-9), "period"),
    (dict(n=2, threads=0), "threads: 0"),
])
def test_batches_that_cannot_be_are_told(rotor, arguments, words):
    with pytest.raises(limber.InputError, match=words):
        limber.Batch(rotor, **arguments)


def test_scenarios_that_need_whole_runs_are_told(rotor):
    with pytest.raises(limber.InputError, match="tolerance_passes"):
        limber.Batch(limber.load(rotor, set={
            **ALPHA, "time.tolerance": 1e-6, "time.tolerance_passes": "verified"}), 2)
    with pytest.raises(limber.InputError, match="offset"):
        limber.Batch(limber.load(rotor, set={"controller.pd.offset": 0.01}), 2)


def test_controllers_of_two_periods_need_one(hop):
    scenario = limber.load(hop, set={"controller.thrust.period": 0.01})
    with pytest.raises(limber.InputError, match="'pd' and 'thrust' have periods"):
        limber.Batch(scenario, 2)
    assert limber.Batch(scenario, 2, period=0.01).period == 0.01


@pytest.mark.parametrize("controls, words", [
    (None, "controls are missing"),
    (numpy.zeros(2), r"shape \(2,\) of float64; expected shape \(2, 1\), with columns pd"),
    (numpy.zeros((3, 1)), r"shape \(3, 1\)"),
    (numpy.zeros((2, 1), dtype=complex), "complex128; expected real numbers"),
    (numpy.array([["a"], ["b"]]), "expected real numbers"),
    (numpy.array([[True], [False]]), "expected real numbers"),
])
def test_controls_that_are_none_are_told(rotor, controls, words):
    batch = limber.Batch(rotor, 2)
    with pytest.raises(limber.InputError, match=words):
        batch.step(controls)
    assert batch.time.tolist() == [0.0, 0.0]


@pytest.mark.parametrize("mask", [
    numpy.array([True]), numpy.array([1, 0]), [0], numpy.ones((2, 1), dtype=bool)])
def test_masks_that_are_none_are_told(rotor, mask):
    batch = limber.Batch(rotor, 2)
    with pytest.raises(limber.InputError, match=r"mask: .* expected \(2,\) of bool"):
        batch.reset(mask)
    with pytest.raises(limber.InputError, match="mask"):
        batch.step(numpy.zeros((2, 1)), mask=mask)


@pytest.mark.parametrize("steps", [0, -1, 1.5])
def test_numbers_of_steps_that_are_none_are_told(rotor, steps):
    with pytest.raises(limber.InputError, match="steps"):
        limber.Batch(rotor, 2).step(numpy.zeros((2, 1)), steps=steps)


def test_numbers_of_other_types_are_controls(rotor):
    batch, other = limber.Batch(rotor, 2), limber.Batch(rotor, 2)
    batch.step(numpy.array([[1.0, 9.0], [2.0, 9.0]], dtype=numpy.float32)[:, :1])
    other.step([[1], [2]])
    assert numpy.array_equal(batch.observations, other.observations)


def test_a_batch_is_not_copied(rotor):
    batch = limber.Batch(rotor, 2)
    for work in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match="cannot be pickled"):
            work(batch)


@pytest.fixture
def long_batch(rotor):
    """A batch whose whole scenario takes minutes."""
    return limber.Batch(limber.load(rotor, set={
        "time.step": 1e-7, "time.duration": 20.0, "time.output_interval": 10.0}), 2,
        threads=2)


def test_ctrl_c_ends_a_step_and_a_reset_revives_its_worlds(long_batch):
    def interrupt():
        time.sleep(0.3)
        os.kill(os.getpid(), signal.SIGINT)
    threading.Thread(target=interrupt).start()
    begin = time.monotonic()
    with pytest.raises(limber.Interrupted):
        long_batch.step(numpy.zeros((2, 1)), steps=1000)
    assert time.monotonic() - begin < 30.0
    assert long_batch.failed.all() and "interrupted" in long_batch.failures[0]
    long_batch.reset()
    assert not long_batch.failed.any()


def test_another_thread_runs_meanwhile_but_does_not_step_the_same_batch(long_batch):
    told = []

    def meddle():
        time.sleep(0.3)
        try:
            long_batch.step(numpy.zeros((2, 1)))
        except limber.InputError as error:
            told.append(str(error))
        os.kill(os.getpid(), signal.SIGINT)
    thread = threading.Thread(target=meddle)
    thread.start()
    with pytest.raises(limber.Interrupted):
        long_batch.step(numpy.zeros((2, 1)), steps=1000)
    thread.join()
    assert len(told) == 1 and "another thread" in told[0]
