// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/joints/pairs/point_springs.hpp"

/// Bodies of pairs are unknowns of Newton's matrix: stiff couplers between them
/// must not lose their inertia.
namespace limber::dynamics::pair_matrix_test {
namespace {

constexpr int kBodies = 5;
const Vector3 kArm(0.3, -0.2, 0.4);

RigidInertia make_inertia(double mass) {
  return {mass, mass * Matrix3(Vector3(0.1, 0.15, 0.2).asDiagonal())};
}

struct Loop {
  SystemModel model;
  SystemState state;
};

/// A free chain on hinges whose ends, and all neighbours if `is_dense`, springs
/// hold together, of pairs or couplers.
Loop make_loop(double stiffness, bool by_pairs, bool is_dense) {
  SystemBuilder builder;
  for (int b = 0; b < kBodies; ++b) {
    builder.add_rigid_body(fmt::format("body {}", b), make_inertia(1.0 + b));
  }
  const auto at = [&](BodyIndex body, const Vector3& p) {
    return builder.attach_frame("f", body, {Matrix3::Identity(), p});
  };
  const auto pull = [&](BodyIndex a, BodyIndex b) {
    const joints::PointSpring spring({.stiffness = 5.0, .free_length = 0.5});
    const auto from = at(a, {0.2, 0.1, 0.0});
    const auto to = at(b, {0.0, 0.1, -0.2});
    const std::string name = fmt::format("spring {} {}", a, b);
    if (!by_pairs) {
      builder.add_coupler(name, spring, from, to);
      return;
    }
    builder.add_pair(
        name, a, b,
        std::make_shared<joints::PointSprings>(
            std::vector<joints::PointSprings::Line>{
                {builder.find_place(from), builder.find_place(to), spring}}));
  };
  for (BodyIndex b(0); b + 1 < kBodies; ++b) {
    builder.add_coupler(
        fmt::format("hinge {}", b),
        joints::make_joint(joints::JointKind::revolute,
                           Vector3(1.0, 2.0, 2.0) / 3.0,
                           Vector3(2.0, 1.0, -2.0) / 3.0,
                           {.translational_stiffness = stiffness,
                            .rotational_stiffness = 0.1 * stiffness,
                            .translational_damping = 1e-4 * stiffness,
                            .rotational_damping = 1e-5 * stiffness},
                           {}),
        at(b, kArm), at(BodyIndex(b + 1), -kArm));
    if (is_dense) pull(b, BodyIndex(b + 1));
  }
  pull(BodyIndex(0), BodyIndex(kBodies - 1));
  Loop loop{builder.build(), {}};
  loop.state = make_state(loop.model);
  for (int b = 0; b < kBodies; ++b) {
    loop.state.bodies[static_cast<std::size_t>(b)].p_WB = 2.0 * b * kArm;
  }
  return loop;
}

double find_distance(const SystemState& a, const SystemState& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    largest =
        std::max({largest, (a.bodies[i].p_WB - b.bodies[i].p_WB).norm(),
                  a.bodies[i].quat_WB.angularDistance(b.bodies[i].quat_WB)});
  }
  return largest;
}

TEST(PairMatrix, KeepsTheInertiaOfBodiesThatStiffCouplersJoin) {
  for (const bool is_dense : {false, true}) {
    for (const double stiffness : {1e8, 1e12, 1e14}) {
      Loop pairs = make_loop(stiffness, true, is_dense);
      Loop couplers = make_loop(stiffness, false, is_dense);
      const SimulationSettings settings{
          .end_time = 0.3, .step = 1e-3, .newton_tolerance = 1e-12};
      const EnergyBalance before = calc_energy(pairs.model, pairs.state);
      const SimulationStatistics of_pairs =
          simulate(pairs.model, pairs.state, settings, {});
      const SimulationStatistics of_couplers =
          simulate(couplers.model, couplers.state, settings, {});
      const EnergyBalance after = calc_energy(pairs.model, pairs.state);
      EXPECT_GT(find_distance(pairs.state,
                              make_loop(stiffness, true, is_dense).state),
                0.01);
      // What the springs' tension does to the start's accelerations, which
      // stiffer hinges do not add to.
      EXPECT_LT(find_distance(pairs.state, couplers.state), 2e-7)
          << stiffness << (is_dense ? " dense" : "");
      EXPECT_LT((after.linear_momentum - before.linear_momentum).norm(), 1e-12);
      EXPECT_NEAR(static_cast<double>(of_pairs.newton_iterations),
                  static_cast<double>(of_couplers.newton_iterations),
                  0.1 * static_cast<double>(of_couplers.newton_iterations));
      EXPECT_EQ(of_pairs.halved_steps, 0);
    }
  }
}

}  // namespace
}  // namespace limber::dynamics::pair_matrix_test
