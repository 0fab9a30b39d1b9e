// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/newton/hubs.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

/// Bodies with so many couplers that Newton's matrix keeps their motion among
/// its unknowns. Hinges in one place are one hinge as stiff as all.
namespace limber::dynamics {
namespace {

const Vector3 kStart(0.3, -0.2, 0.4);

joints::Joint make_hinge(double stiffness) {
  return joints::make_joint(joints::JointKind::revolute,
                            Vector3(1.0, 2.0, 2.0) / 3.0,
                            Vector3(2.0, 1.0, -2.0) / 3.0,
                            {.translational_stiffness = stiffness,
                             .rotational_stiffness = 0.1 * stiffness,
                             .translational_damping = 1e-4 * stiffness,
                             .rotational_damping = 1e-5 * stiffness},
                            {});
}

RigidInertia make_inertia(double mass) {
  return {mass, mass * Matrix3(Vector3(0.1, 0.15, 0.2).asDiagonal())};
}

struct Panels {
  SystemModel model;
  SystemState state;
};

/// One on hinges in the world, swinging, or two that turn about each other.
Panels make_panels(bool is_free, int count, double stiffness) {
  SystemBuilder builder;
  const auto panel = builder.add_rigid_body("panel", make_inertia(2.0));
  const BodyIndex other =
      is_free ? builder.add_rigid_body("other", make_inertia(3.0)) : kWorld;
  const Pose arm{Matrix3::Identity(), kStart};
  for (int i = 0; i < count; ++i) {
    builder.add_coupler(fmt::format("hinge {}", i),
                        make_hinge(stiffness / count),
                        is_free ? builder.attach_frame("a", other, {})
                                : builder.attach_world("a", {}),
                        builder.attach_frame("b", panel, arm));
  }
  if (!is_free) builder.set_gravity({0.0, 0.0, -9.81});
  Panels panels{builder.build(), {}};
  panels.state = make_state(panels.model);
  panels.state.bodies[0].p_WB = -kStart;
  if (is_free) {
    const Vector3 w = Vector3(1.0, 2.0, 2.0) / 3.0;
    panels.state.bodies[0].w_WB_B = w;
    panels.state.bodies[0].v_WB_W = w.cross(-kStart);
  }
  return panels;
}

TEST(ManyCouplers, InOnePlaceAreOneAsStiffAsAllHoweverStiff) {
  for (const bool is_free : {false, true}) {
    for (const double stiffness : {1e4, 1e8, 1e12, 1e14}) {
      std::vector<SystemState> ends;
      for (const int count : {1, 40}) {
        Panels panels = make_panels(is_free, count, stiffness);
        simulate(panels.model, panels.state, {.end_time = 1.0, .step = 0.01},
                 {});
        ends.push_back(panels.state);
      }
      const BodyState& one = ends[0].bodies[0];
      const BodyState& many = ends[1].bodies[0];
      // Relative to the world only the hinges deflect: the round-off of their
      // stiffness, 0.01 N/m of 1e14, acts on the panel.
      const double error = is_free || stiffness < 1e13 ? 1e-10 : 1e-6;
      EXPECT_LT((many.p_WB - one.p_WB).norm(), error);
      EXPECT_LT(one.quat_WB.angularDistance(many.quat_WB), error);
    }
  }
}

double find_distance(const SystemState& a, const SystemState& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    largest = std::max(largest, (a.bodies[i].p_WB - b.bodies[i].p_WB).norm());
  }
  return largest;
}

/// A free panel with flaps, the first of which turns.
Panels make_flaps(double stiffness) {
  SystemBuilder builder;
  const auto panel = builder.add_rigid_body("panel", make_inertia(20.0));
  constexpr int kCount = 40;
  for (int i = 0; i < kCount; ++i) {
    const auto flap =
        builder.add_rigid_body(fmt::format("flap {}", i), make_inertia(1.0));
    builder.add_coupler(
        fmt::format("hinge {}", i), make_hinge(stiffness),
        builder.attach_frame("a", panel,
                             {Matrix3::Identity(), Vector3(0.1 * i, 1.0, 0.0)}),
        builder.attach_frame("b", flap, {Matrix3::Identity(), kStart}));
  }
  Panels panels{builder.build(), {}};
  panels.state = make_state(panels.model);
  for (int i = 0; i < kCount; ++i) {
    panels.state.bodies[static_cast<std::size_t>(i) + 1].p_WB =
        Vector3(0.1 * i, 1.0, 0.0) - kStart;
  }
  const Vector3 w = Vector3(1.0, 2.0, 2.0) / 3.0;
  panels.state.bodies[1].w_WB_B = w;
  panels.state.bodies[1].v_WB_W = w.cross(-kStart);
  return panels;
}

// What hinges give falls with their stiffness, at 1e14 N/m, too.
TEST(ManyCouplers, OfManyBodiesTendToIdealOnesAndKeepMomenta) {
  std::vector<SystemState> ends;
  std::vector<double> changes;
  for (const double stiffness : {1e8, 1e10, 1e12, 1e14}) {
    Panels panels = make_flaps(stiffness);
    const EnergyBalance before = calc_energy(panels.model, panels.state);
    const SimulationStatistics statistics = simulate(
        panels.model, panels.state, {.end_time = 1.0, .step = 0.01}, {});
    const EnergyBalance after = calc_energy(panels.model, panels.state);
    EXPECT_LT((after.linear_momentum - before.linear_momentum).norm(), 1e-14);
    EXPECT_LT(statistics.newton_iterations, 2.5 * statistics.steps);
    ends.push_back(panels.state);
    if (ends.size() == 1) continue;
    changes.push_back(find_distance(ends.end()[-1], ends.end()[-2]));
  }
  EXPECT_NEAR(std::log10(changes[0] / changes[1]), 2.0, 0.01);
  EXPECT_NEAR(std::log10(changes[1] / changes[2]), 2.0, 0.1);
}

TEST(Hubs, AreBodiesOfManyLinksAndShareNone) {
  std::vector<int> all(20);
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> few = {0, 1, 2};
  const std::vector<int> more(all.begin(), all.begin() + 19);
  using ::testing::ElementsAre;
  using ::testing::IsEmpty;
  EXPECT_THAT(choose_hubs({few, all}, {1, 1}), ElementsAre(1));
  EXPECT_THAT(choose_hubs({more, all, few}, {1, 1, 1}), ElementsAre(1));
  EXPECT_THAT(choose_hubs({more, all}, {1, 0}), ElementsAre(0));
  EXPECT_THAT(choose_hubs({few, all}, {1, 11}), IsEmpty());  // 60 modes
}

// Twice n b^2 + b^3 / 3 against n^3 / 3: 362 and 333 products of blocks for ten
// links and 18 modes, 394 and 444 for eleven.
TEST(Hubs, AreBodiesThatCostLessThanHalfOfTheirEliminatedLinks) {
  using ::testing::ElementsAre;
  using ::testing::IsEmpty;
  std::vector<int> links(10);
  std::iota(links.begin(), links.end(), 0);
  EXPECT_THAT(choose_hubs({links}, {4}), IsEmpty());
  links.push_back(10);
  EXPECT_THAT(choose_hubs({links}, {4}), ElementsAre(0));
  EXPECT_THAT(choose_hubs({links}, {5}), IsEmpty());
}

}  // namespace
}  // namespace limber::dynamics
