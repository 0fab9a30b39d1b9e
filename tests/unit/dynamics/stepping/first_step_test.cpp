// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/stepping/step_control.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/bushing.hpp"

namespace limber::dynamics::first_step_test {
namespace {

constexpr double kAllowed = 1e-7;
constexpr double kStiffness = 4e3;
constexpr double kMass = 2.0;

// Two spheres of 2 kg in a common velocity, joined by a spring and a damper.
struct Pair {
  explicit Pair(double stiffness, double damping, const Vector3& common = {}) {
    joints::Bushing::Parameters p;
    p.translational_stiffness = stiffness * Matrix3::Identity();
    p.translational_damping = damping * Matrix3::Identity();
    SystemBuilder builder;
    for (const char* name : {"a", "b"}) {
      builder.add_rigid_body(name, {kMass, 0.01 * Matrix3::Identity()});
    }
    builder.add_coupler("spring", joints::Bushing(p),
                        builder.attach_frame("on_a", BodyIndex(0), {}),
                        builder.attach_frame("on_b", BodyIndex(1), {}));
    model = builder.build();
    state = make_state(model);
    for (BodyState& body : state.bodies) body.v_WB_W = common;
  }
  SystemModel model;
  SystemState state;
};

// a = 0, and a' = k (v_b - v_a) / m of each.
TEST(FirstStep, ErrsByTheAllowedErrorByTheChangeOfTheAcceleration) {
  Pair pair(kStiffness, 0.0, Vector3::Zero());
  pair.state.bodies[1].v_WB_W.x() = 0.3;
  const double jerk = kStiffness * 0.3 / kMass;
  const double expected = std::cbrt(kAllowed / jerk);
  EXPECT_NEAR(find_first_step(pair.model, pair.state, kAllowed), expected,
              1e-9 * expected);
}

TEST(FirstStep, IsTheSameAtACommonVelocity) {
  const auto find = [](const Vector3& common) {
    Pair pair(kStiffness, 5.0, common);
    pair.state.bodies[1].v_WB_W.x() += 0.3;
    return find_first_step(pair.model, pair.state, kAllowed);
  };
  const double at_rest = find(Vector3::Zero());
  EXPECT_NEAR(find({7500.0, -20.0, 3.0}), at_rest, 1e-6 * at_rest);
}

TEST(FirstStep, FromRestMovesByTheAllowedError) {
  Pair pair(kStiffness, 0.0, Vector3::Zero());
  pair.state.bodies[1].p_WB.x() = 0.01;
  const double expected = std::sqrt(kAllowed / (kStiffness * 0.01 / kMass));
  EXPECT_NEAR(find_first_step(pair.model, pair.state, kAllowed), expected,
              1e-9 * expected);
}

TEST(FirstStep, OfSteadyMotionIsNotLimited) {
  const Pair pair(kStiffness, 0.0, {1.0, 2.0, 3.0});
  EXPECT_EQ(find_first_step(pair.model, pair.state, kAllowed), kInfinity);
}

// The damper stops the relative motion within 1e-5 s, and the steps resolve
// it, however long the run is: with a fraction of its duration as the first
// step, longer runs took it as an impulse.
TEST(FirstStep, DoesNotDependOnTheDuration) {
  constexpr double kRate = 1e5;  // [1/s]
  for (const double duration : {1e-4, 1.0, 1e3}) {
    Pair pair(0.0, 0.5 * kMass * kRate, Vector3::Zero());
    pair.state.bodies[1].v_WB_W.x() = 1.0;
    SimulationSettings settings;
    settings.tolerance = 1e-9;
    settings.passes = TolerancePasses::one;
    settings.step = duration;
    settings.end_time = duration;
    settings.output_times = {2e-5, duration};
    std::vector<double> gaps;
    const SimulationStatistics statistics = simulate(
        pair.model, pair.state, settings,
        [&](const SystemState& now, const EnergyBalance&) {
          gaps.push_back((now.bodies[1].p_WB - now.bodies[0].p_WB).x());
        });
    EXPECT_TRUE(statistics.warnings.empty()) << duration;
    ASSERT_EQ(gaps.size(), 2U);
    EXPECT_NEAR(gaps[0], (1.0 - std::exp(-2.0)) / kRate, 1e-9) << duration;
    EXPECT_NEAR(gaps[1], (1.0 - std::exp(-kRate * duration)) / kRate, 1e-9);
  }
}

}  // namespace
}  // namespace limber::dynamics::first_step_test
