// SPDX-License-Identifier: BSD-3-Clause
#include "small_run.hpp"

#include <random>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::results::test {
namespace {

using dynamics::BodyState;
using dynamics::EnergyBalance;
using dynamics::Fidelity;
using dynamics::SystemState;

SmallRun make_system(const BodyNames& names) {
  SmallRun run;
  run.points = {testing::make_point_mass_body(24, 3, 4.0, 1.0, 60.0, 42),
                testing::make_point_mass_body(15, 2, 3.0, 0.8, 80.0, 7),
                testing::make_point_mass_body(10, 1, 1.0, 0.5, 90.0, 9)};
  run.points[0].reduced.triangles = {{0, 1, 2}, {3, 4, 5}, {23, 22, 21}};
  run.points[1].reduced.triangles = {{14, 0, 7}};
  run.points[2].reduced.triangles = {{9, 8, 7}, {1, 0, 9}};

  dynamics::SystemBuilder builder;
  const auto add = [&](const std::string& name, std::size_t i, Fidelity level) {
    return builder.add_flexible_body(name, testing::share(run.points[i]), level,
                                     {.ratios = {0.02}});
  };
  const auto arm = add(names.arm, 0, Fidelity::coupled);
  const auto hand = add(names.hand, 1, Fidelity::coupled);
  add(names.plate, 2, Fidelity::rigid);
  builder.add_rigid_body(names.ball, {2.0, Vector3(1, 2, 3).asDiagonal()});
  const auto wrist = testing::make_interface(run.points[0], 0, 8);
  const auto root = testing::make_interface(run.points[1], 0, 8);
  builder.add_coupler(
      "wrist",
      joints::make_joint_bushing(joints::JointKind::fixed, Vector3::UnitX(),
                                 {.translational_stiffness = 1e4,
                                  .rotational_stiffness = 1e3,
                                  .translational_damping = 5.0,
                                  .rotational_damping = 1.0}),
      builder.attach_interface("wrist", arm, wrist,
                               {Matrix3::Identity(), wrist.p_B}),
      builder.attach_interface("root", hand, root,
                               {Matrix3::Identity(), root.p_B}));
  builder.set_gravity({0.3, 0.0, -9.81});
  run.model = builder.build();
  run.history.columns = {{"tip.ux", "m"}, {"tip.wy", "rad/s"}};
  return run;
}

// Every number of the state differs from every other.
SystemState make_start(const SmallRun& run) {
  SystemState state = make_state(run.model);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (BodyState& body : state.bodies) {
    for (int a = 0; a < 3; ++a) {
      body.v_WB_W[a] = uniform(random);
      body.w_WB_B[a] = uniform(random);
    }
    body.p_WB = 0.02 * body.v_WB_W;
    const double y = 0.1 * uniform(random);
    const double x = 0.1 * uniform(random);
    body.quat_WB = Quaternion(1.0, x, y, 0.1).normalized();
  }
  for (double& x : state.eta) x = 0.02 * uniform(random);
  for (double& x : state.etadot) x = uniform(random);
  return state;
}

}  // namespace

SmallRun make_small_run(const BodyNames& names) {
  SmallRun run = make_system(names);
  SystemState state = make_start(run);
  std::vector<double> times;
  for (int i = 0; i < kOutputs; ++i) times.push_back(0.005 * i);
  const auto keep = [&](const SystemState& s, const EnergyBalance& energy) {
    run.history.times.push_back(s.t);
    run.history.states.push_back(s);
    run.history.energies.push_back(energy);
    run.history.probe_rows.push_back(
        {s.bodies[0].p_WB.x() / 3.0, s.bodies[1].w_WB_B.y() / 7.0});
  };
  dynamics::simulate(
      run.model, state,
      {.end_time = times.back(), .step = 1e-4, .output_times = times}, keep);
  return run;
}

SmallRun make_empty_run() { return make_system({}); }

}  // namespace limber::results::test
