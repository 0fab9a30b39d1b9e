// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/stable_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/integrators/central_differences.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/joints/point_spring.hpp"
#include "support/point_mass_body.hpp"
#include "support/spring_network.hpp"

namespace limber::dynamics::stable_step_test {
namespace {

constexpr double kStiffness = 3e4;                        // [N/m]
constexpr double kReducedMass = 2.0 * 5.0 / (2.0 + 5.0);  // [kg]

/// Two rigid bodies and a spring of no length with a damper along all axes.
SystemModel make_pair_of_masses(double stiffness, double damping) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", {2.0, Matrix3::Identity()});
  const auto b = builder.add_rigid_body("b", {5.0, Matrix3::Identity()});
  builder.add_coupler(
      "spring",
      joints::PointSpring({.stiffness = stiffness, .damping = damping}),
      builder.attach_frame("a", a, {}), builder.attach_frame("b", b, {}));
  return builder.build();
}

double find(const SystemModel& model) {
  return find_stable_step(model, make_state(model));
}

/// Whether a thousand steps leave the motion bounded.
bool is_stable(const SystemModel& model, double step) {
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(1e-3, 0, 0);
  state.bodies[0].v_WB_W = Vector3(1e-3, 0, 0);
  CentralDifferences scheme(model);
  scheme.start(state, step);
  for (int i = 1; i <= 1000; ++i) scheme.step(state, step, i * step);
  return (state.bodies[0].p_WB - state.bodies[1].p_WB).norm() < 1.0;
}

TEST(StableStep, OfTwoMassesAndASpringIsTwoOverTheirFrequency) {
  const double omega = std::sqrt(kStiffness / kReducedMass);
  EXPECT_NEAR(find(make_pair_of_masses(kStiffness, 0.0)), 2.0 / omega,
              1e-6 / omega);
}

// omega^2 h^2 + 4 c h = 4, the scheme's own limit (stable_step.hpp), and what
// its steps do on both sides of it.
TEST(StableStep, ShrinksWithADamperAsTheSchemeDoes) {
  const double omega = std::sqrt(kStiffness / kReducedMass);
  for (const double ratio : {0.05, 0.5, 1.0, 20.0}) {
    const SystemModel model =
        make_pair_of_masses(kStiffness, 2.0 * ratio * omega * kReducedMass);
    const double step =
        2.0 / omega * (std::sqrt(1.0 + 4.0 * ratio * ratio) - 2.0 * ratio);
    EXPECT_NEAR(find(model), step, 1e-6 * step) << ratio;
    EXPECT_TRUE(is_stable(model, 0.99 * step)) << ratio;
    EXPECT_FALSE(is_stable(model, 1.02 * step)) << ratio;
  }
}

TEST(StableStep, OfADamperAloneIsOneOverItsRate) {
  const SystemModel model = make_pair_of_masses(0.0, 100.0);
  const double step = kReducedMass / 100.0;
  EXPECT_NEAR(find(model), step, 1e-6 * step);
  EXPECT_TRUE(is_stable(model, 0.99 * step));
}

// Coulomb friction is a damper of F / vs near rest. In steps of 1e-3 kg^1/2 m/s
// a mote of 1 ug moved at 1000 vs.
TEST(StableStep, OfFrictionIsThatNearRestOfBodiesOfAnyMass) {
  constexpr double kSpeed = 1e-3;  // [m/s]
  for (const double mass : {1e-6, 1e-2, 100.0}) {
    const double force = 1e3 * mass;
    SystemBuilder builder;
    const auto slider =
        builder.add_rigid_body("slider", {mass, mass * Matrix3::Identity()});
    builder.add_coupler(
        "rail",
        joints::make_joint(
            joints::JointKind::prismatic, Vector3::UnitX(), Vector3::UnitY(),
            {.translational_stiffness = 1e8 * mass,
             .rotational_stiffness = 1e8 * mass},
            {{0, joints::Friction({.coulomb = force, .speed = kSpeed})}}),
        builder.attach_world("ground", {}),
        builder.attach_frame("shoe", slider, {}));
    const double rate = force / kSpeed / mass;  // 1e6 1/s
    const double expected = 2.0 / (rate + std::hypot(rate, 1e4));
    EXPECT_NEAR(find(builder.build()), expected, 1e-2 * expected) << mass;
  }
}

TEST(StableStep, IsInfiniteWhereNothingVibrates) {
  EXPECT_TRUE(std::isinf(find(make_pair_of_masses(0.0, 0.0))));
}

TEST(StableStep, OfModesIsTwoOverTheHighestFrequency) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(24, 6, 4.0, 1.0, 60.0, 42);
  SystemBuilder builder;
  builder.add_flexible_body("modal", testing::share(body), Fidelity::coupled,
                            {});
  const double highest = std::sqrt(body.reduced.lambda.maxCoeff());
  EXPECT_NEAR(find(builder.build()), 2.0 / highest, 1e-3 / highest);
}

TEST(StableStep, OfAWholeMeshIsTwoOverItsHighestFrequency) {
  const testing::SpringNetwork network = testing::make_lattice();
  const int modes = 3 * network.size() - 6;
  const auto reduced = testing::make_reduced(network, modes);
  SystemBuilder builder;
  builder.add_full_body("lattice", reduced, testing::make_full(network), {});
  // Beside it, something a million times lighter that does not vibrate.
  builder.add_rigid_body("grain", {1e-6, 1e-12 * Matrix3::Identity()});
  const double highest = std::sqrt(reduced->lambda[modes - 1]);
  EXPECT_NEAR(find(builder.build()), 2.0 / highest, 2e-3 / highest);
}

TEST(StableStep, OfADampedMeshCountsItsDamping) {
  const testing::SpringNetwork network = testing::make_lattice();
  const int modes = 3 * network.size() - 6;
  const auto reduced = testing::make_reduced(network, modes);
  SystemBuilder builder;
  builder.add_full_body("lattice", reduced, testing::make_full(network),
                        {.ratios = {0.3}});
  const double highest = std::sqrt(reduced->lambda[modes - 1]);
  const double step = 2.0 / highest * (std::sqrt(1.36) - 0.6);
  EXPECT_NEAR(find(builder.build()), step, 2e-3 * step);
}

}  // namespace
}  // namespace limber::dynamics::stable_step_test
