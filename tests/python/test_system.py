# SPDX-License-Identifier: BSD-3-Clause
"""Systems built in Python, as in C++."""

import os
import signal
import threading

import numpy
import pytest
from conftest import SOURCE

import limber


@pytest.fixture(scope="module")
def rod():
    return limber.reduce(SOURCE / "meshes" / "rod.geo", youngs_modulus=210e9,
                         poisson_ratio=0.3, density=7850.0, interfaces=["root", "tip"])


def build_pendulum(length=1.0, mass=2.0):
    builder = limber.SystemBuilder()
    bob = builder.add_rigid_body("bob", mass, 1e-3 * numpy.eye(3))
    builder.add_joint("pivot", "revolute", limber.JointSide(),
                      limber.JointSide(bob, limber.Pose([0.0, length, 0.0])))
    builder.set_gravity([0.0, -9.81, 0.0])
    return builder, bob


def test_the_arm_of_the_cpp_example_has_its_angular_momentum(rod):
    # examples/two_link_arm.cpp: 20 N at 0.5 m for 10 ms are 0.1 N m s.
    arm = limber.SystemBuilder()
    root = limber.Pose(rod.interface("root").p_B)
    tip = limber.Pose(rod.interface("tip").p_B)
    upper = arm.add_rigid_body("upper", rod.mass, rod.inertia)
    lower = arm.add_flexible_body("lower", rod, "coupled")
    arm.add_joint("shoulder", "revolute", limber.JointSide(),
                  limber.JointSide(upper, root))
    arm.add_joint("elbow", "revolute", limber.JointSide(upper, tip),
                  limber.JointSide(lower, interface="root"))
    hand = arm.attach_interface("hand", lower, rod.interface("tip"))
    arm.add_load("strike", hand, [-20.0, 0.0, 0.0], frame="world",
                 function=limber.Pulse(duration=0.01))
    model = arm.build()
    start = limber.make_state(model, {"elbow": numpy.pi / 2})
    settings = limber.SimulationSettings(0.1, 1e-4, [0.01, 0.1])
    probe = limber.Probe.point("hand", model, hand, "position")
    run = limber.simulate(model, start, settings, [probe])
    assert run.energies["angular_momentum"][:, 2] == pytest.approx([0.1, 0.1], abs=5e-4)
    assert run.probes["hand"].shape == (2, 3)
    simulator = limber.Simulator(model, start, settings)
    simulator.advance_to(0.1)
    motion = limber.find_frame_motion(model, simulator.state, hand)
    assert motion.X_WF.p == pytest.approx(run.probes["hand"][-1], rel=1e-6)


def test_a_pendulum_has_its_natural_frequency_about_its_equilibrium():
    model = build_pendulum()[0].build()
    start = limber.find_equilibrium(model, limber.make_state(model, {"pivot": 0.0}))
    lowest = limber.find_natural_frequencies(model, start)[0]
    inertia = 2.0 * 1.0**2 + 1e-3
    expected = numpy.sqrt(2.0 * 9.81 * 1.0 / inertia) / (2 * numpy.pi)
    assert lowest == pytest.approx(expected, rel=1e-4)


def test_a_simulator_goes_on_from_a_checkpoint_to_the_bit():
    model = build_pendulum()[0].build()
    start = limber.make_state(model, {"pivot": 0.3})
    settings = limber.SimulationSettings(1.0, 1e-3)
    whole = limber.Simulator(model, start, settings)
    whole.advance_to(0.5)
    kept = whole.save()
    whole.advance_to(1.0)
    again = limber.Simulator(model, start, settings)
    again.restore(kept)
    again.advance_to(1.0)
    body = model.find_body("bob")
    assert numpy.array_equal(whole.state.body(body).p_WB, again.state.body(body).p_WB)
    with pytest.raises(limber.InputError, match="advance_to"):
        whole.advance_to(0.5)


def test_control_c_ends_a_simulator_after_a_step():
    model = build_pendulum()[0].build()
    simulator = limber.Simulator(model, limber.make_state(model, {"pivot": 0.3}),
                                 limber.SimulationSettings(1e4, 1e-4))
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(limber.Interrupted):
        simulator.advance_to(1e4)
    timer.join()
    assert 0.0 < simulator.state.t < 1e4


def test_a_python_controller_of_a_system_measures_and_drives():
    builder = limber.SystemBuilder()
    rotor = builder.add_rigid_body("rotor", 2.0, numpy.diag([0.3, 0.3, 0.4]))
    torque = builder.add_input("torque", 0.0)
    drive = limber.Drive("effort", limber.InputSignal(torque))
    builder.add_joint("hinge", "revolute", limber.JointSide(), limber.JointSide(rotor),
                      elements=[(0, drive)])
    builder.add_controller(
        "brake", 0.01, [torque], lambda t, measured, memory: -0.4 * measured[0],
        measures={"rate": lambda state: state.body(rotor).w_WB_B[2]}, memory=[])
    model = builder.build()
    start = limber.make_state(model, {"hinge": ([0.0], [1.0])})
    run = limber.simulate(model, start, limber.SimulationSettings(
        0.1, 1e-3, [0.1], integrator="runge-kutta-4"))
    rate = run.bodies["rotor"].angular_velocity[-1, 2]
    assert rate == pytest.approx(0.99**10, rel=1e-9)


def test_what_is_wrong_is_told_and_not_added():
    builder, bob = build_pendulum()
    with pytest.raises(limber.InputError, match="bob"):
        builder.add_rigid_body("bob", 1.0, numpy.eye(3))
    with pytest.raises(limber.InputError, match="revolute"):
        builder.add_joint("j", "revolut", limber.JointSide(), limber.JointSide(bob))
    with pytest.raises(limber.InputError):
        limber.Bushing(translational_stiffness=[1.0, 2.0])
    with pytest.raises(limber.InputError, match="Pulse"):
        builder.add_coupler("c", limber.Pulse(1.0), builder.attach_world(
            "a", limber.Pose()), builder.attach_frame("b", bob, limber.Pose()))
    with pytest.raises(TypeError):
        builder.add_load("l", bob, [1.0, 0.0, 0.0])  # a body is no attachment
    with pytest.raises(limber.InputError, match="body"):
        limber.SystemBuilder().build()
