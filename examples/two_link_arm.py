# SPDX-License-Identifier: BSD-3-Clause
"""Strikes the tip of a bent arm, a steel rod on a rigid one, for 10 ms; two_link_arm.cpp in Python.

  two_link_arm.py meshes/rod.geo
"""
import math
import sys

import limber
import numpy

rod = limber.reduce(sys.argv[1], youngs_modulus=210e9, poisson_ratio=0.3, density=7850,  # 0.5 m along x
                    interfaces=["root", "tip"])
root, tip = (limber.Pose(p=rod.interface(name).p_B) for name in ("root", "tip"))

arm = limber.SystemBuilder()
upper = arm.add_rigid_body("upper", rod.mass, rod.inertia)
lower = arm.add_flexible_body("lower", rod, "coupled")
arm.add_joint("shoulder", "revolute", limber.JointSide(), limber.JointSide(upper, root))  # about z
arm.add_joint("elbow", "revolute", limber.JointSide(upper, tip), limber.JointSide(lower, interface="root"))
hand = arm.attach_interface("hand", lower, rod.interface("tip"), tip)
arm.add_load("strike", hand, force=numpy.array([-20.0, 0.0, 0.0]), frame="world", function=limber.Pulse(0.01))
model = arm.build()

simulator = limber.Simulator(model, limber.make_state(model, {"elbow": math.pi / 2}),
                             limber.SimulationSettings(end_time=0.1, step=1e-4))
for time in (0.01, 0.1):
    simulator.advance_to(time)
    p = limber.find_frame_motion(model, simulator.state, hand).X_WF.p
    spin = simulator.calc_energy().angular_momentum[2]
    print(f"t = {time:.2f} s  hand ({p[0]:.3f}, {p[1]:.3f}) m  Lz = {spin:.3f} N m s")
