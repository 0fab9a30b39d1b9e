// SPDX-License-Identifier: BSD-3-Clause
// A hinged rod at rest, with no load, must stay where it is.
#include <cmath>
#include <cstdio>
#include <limber/limber.hpp>

int main() {
  using namespace limber;
  dynamics::SystemBuilder builder;
  const auto rod = builder.add_rigid_body(
      "rod", {.mass = 2.0, .inertia = Vector3(0.2, 0.2, 0.01).asDiagonal()});
  const joints::Bushing hinge = joints::make_joint_bushing(
      joints::JointKind::revolute, Vector3::UnitX(),
      {.translational_stiffness = 1e8, .rotational_stiffness = 1e8});
  const Vector3 to_hinge(0.0, 0.0, -0.5);
  builder.add_coupler(
      "hinge", hinge, builder.attach_world("pin", {}),
      builder.attach_frame("end", rod, {Matrix3::Identity(), to_hinge}));
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  state.bodies[0].p_WB = -to_hinge;

  dynamics::SimulationSettings settings;
  settings.end_time = 0.1;
  settings.step = 1e-3;
  const dynamics::SimulationStatistics done =
      dynamics::simulate(model, state, settings, {});
  const double moved = (state.bodies[0].p_WB + to_hinge).norm();
  std::printf("%ld steps, moved %g m\n", done.steps, moved);
  return done.steps == 100 && std::abs(moved) < 1e-9 ? 0 : 1;
}
