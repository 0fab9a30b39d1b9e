// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/level_advice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "limber/common/errors.hpp"
#include "support/chain.hpp"

namespace limber::dynamics::level_advice_test {
namespace {

using ::limber::testing::make_uncoupled_chain;
using ::testing::HasSubstr;

constexpr double kRoundoff = 1e-12;

/// Peaks of the first of `bodies`, spun for a second at `Omega`.
BodyPeaks spin(const SystemModel& model, const Vector3& w_B) {
  LevelObserver level_observer(model);
  SystemModel rigid = model;
  rigid.bodies[0].modes = 0;
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = w_B;
  for (int i = 0; i <= 10; ++i) {
    state.t = 0.1 * i;
    level_observer.include(rigid, state);
  }
  return level_observer.find_peaks().front();
}

// Lambda^-1 J1^T (w w): four times as much at twice the speed.
TEST(LevelObserver, FindsInertialDisplacementInTheSquareOfTheSpeed) {
  const SystemModel model = make_uncoupled_chain(1);
  const BodyPeaks slow = spin(model, {0.1, 0.0, 0.2});
  const BodyPeaks fast = spin(model, {0.2, 0.0, 0.4});
  EXPECT_GT(slow.inertial.value, 0.0);
  EXPECT_NEAR(fast.inertial.value / slow.inertial.value, 4.0, kRoundoff);
  EXPECT_NEAR(fast.angle, Vector3(0.2, 0.0, 0.4).norm(), kRoundoff);
  const flexbody::InertialDisplacementBound bound(*model.bodies[0].reduced);
  EXPECT_LE(slow.inertial.value,
            bound.calc_displacement(0.0, slow.Omega.value) * (1.0 + kRoundoff));
  EXPECT_EQ(slow.loads.value, 0.0);
  EXPECT_NEAR(slow.total.value, 2.0 * slow.inertial.value, kRoundoff);
}

TEST(LevelAdvice, RisesWithTheSpeed) {
  const SystemModel model = make_uncoupled_chain(1);
  const LevelLimits limits{1e-6, 1.0, std::nullopt};
  Fidelity before = Fidelity::rigid;
  for (const double Omega : {0.0, 1e-4, 1e-2, 1.0, 100.0}) {
    const BodyPeaks peaks = spin(model, {Omega, 0.5 * Omega, 0.0});
    const Fidelity now = advise(model.bodies[0], peaks, limits).level;
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_GE(before, Fidelity::coupled);
  EXPECT_EQ(advise(model.bodies[0], spin(model, Vector3::Zero()), limits).level,
            Fidelity::rigid);
}

TEST(LevelAdvice, NamesTheNumbersThatDecide) {
  const SystemModel model = make_uncoupled_chain(1);
  const BodyPeaks peaks = spin(model, {1e-3, 0.0, 0.0});
  const LevelLimits limits{1e-5, 1.0, std::nullopt};
  EXPECT_THAT(advise(model.bodies[0], peaks, limits).reason,
              HasSubstr("within 1e-05 m"));
}

TEST(LevelAdvice, TakesInertialForcesInWhereTheyExceedTheForceLimit) {
  const SystemModel model = make_uncoupled_chain(1);
  BodyPeaks peaks = spin(model, {1e-4, 0.0, 0.0});
  LevelLimits limits{1.0, 1.0, 5.0};
  EXPECT_EQ(advise(model.bodies[0], peaks, limits).level, Fidelity::rigid);
  peaks.force = {5.1, 0.0};
  const LevelAdvice advice = advise(model.bodies[0], peaks, limits);
  EXPECT_EQ(advice.level, Fidelity::one_way);
  EXPECT_THAT(advice.reason, HasSubstr("5.1 N"));
}

TEST(LevelAdvice, KnowsTheEndOfTheLinearRange) {
  const SystemModel model = make_uncoupled_chain(1);
  const BodyPeaks peaks = spin(model, {1.0, 0.0, 0.0});
  const double u = peaks.deformation.value;
  const auto is_beyond = [&](double limit) {
    return advise(model.bodies[0], peaks, {1e-9, limit, std::nullopt})
        .is_beyond_linear;
  };
  EXPECT_TRUE(is_beyond(0.99 * u));
  EXPECT_FALSE(is_beyond(1.01 * u));
}

// Of a quiet body that is off by more than the user neglects.
BodyPeaks bend(const SystemModel& model) {
  BodyPeaks peaks = spin(model, {1e-3, 0.0, 0.0});
  peaks.total.value = 0.01;
  peaks.is_held = true;
  return peaks;
}

TEST(LevelAdvice, AsksForNonlinearWhereAxialLoadStiffens) {
  const SystemModel model = make_uncoupled_chain(1);
  const LevelLimits limits{1e-9, 1.0, std::nullopt};
  BodyPeaks peaks = bend(model);
  const auto level = [&] {
    return advise(model.bodies[0], peaks, limits).level;
  };
  EXPECT_LE(level(), Fidelity::coupled);
  peaks.tension.value = 0.5;  // 0.25 * 0.5 / 1.5 = 8 %
  EXPECT_LE(level(), Fidelity::coupled);
  peaks.tension.value = 0.9;  // 12 %
  EXPECT_EQ(level(), Fidelity::nonlinear);
  EXPECT_THAT(advise(model.bodies[0], peaks, limits).reason,
              HasSubstr("0.9 of that at which it buckles under tension"));
  peaks.tension.value = 0.0;
  peaks.compression.value = 0.25;  // 0.25 * 0.25 / 0.75 = 8 %
  EXPECT_LE(level(), Fidelity::coupled);
  peaks.compression.value = 0.5;
  EXPECT_EQ(level(), Fidelity::nonlinear);
  peaks.compression.value = 0.9;
  EXPECT_EQ(level(), Fidelity::full);
}

// A mean strain of 1e-3 for a second: phase 1.5 * omega * 1e-3 s.
TEST(LevelAdvice, AsksForFullWhereTheStretchRunsAhead) {
  const SystemModel model = make_uncoupled_chain(1);
  const LevelLimits limits{1e-9, 1.0, std::nullopt};
  BodyPeaks peaks = bend(model);
  const double omega =
      std::sqrt(flexbody::rest_stiffness(model.bodies[0].elasticity)[0]);
  const double u = peaks.total.value;
  peaks.stretch[0] = 0.5 * u / peaks.mode_sizes[0];
  peaks.strain = {1e-3, 0.0};
  const auto advise_at = [&](double phase) {
    peaks.strain_time = phase / (1.5 * omega);
    return advise(model.bodies[0], peaks, limits);
  };
  EXPECT_LE(advise_at(0.0).level, Fidelity::coupled);
  EXPECT_NEAR(advise_at(0.1).errors.nonlinear, 0.05 * u, 1e-9 * u);
  EXPECT_LE(advise_at(0.19).level, Fidelity::coupled);
  const LevelAdvice advice = advise_at(0.21);
  EXPECT_EQ(advice.level, Fidelity::full);
  EXPECT_GE(advice.errors.coupled, advice.errors.nonlinear);
  EXPECT_THAT(advice.reason, HasSubstr("its mean strain reaches 0.001"));
  EXPECT_NEAR(advise_at(50.0).errors.nonlinear, u, 1e-9 * u);
}

// A fraction of 0.01 for 10 s: phase 0.5 * 0.25 * 0.01 * 10 s * 50 rad/s.
TEST(LevelAdvice, AsksForNonlinearWhereAnOscillationRunsAhead) {
  SystemModel model = make_uncoupled_chain(1);
  const LevelLimits limits{1e-9, 1.0, std::nullopt};
  BodyPeaks peaks = bend(model);
  peaks.tension.value = 0.01;
  peaks.axial_time = 0.1;
  peaks.frequency = 50.0;
  const auto level = [&] {
    return advise(model.bodies[0], peaks, limits).level;
  };
  EXPECT_LE(level(), Fidelity::coupled);  // nothing oscillates
  peaks.oscillation[0] = 0.01 / peaks.mode_sizes[0];
  EXPECT_EQ(level(), Fidelity::nonlinear);
  model.bodies[0].damping.setConstant(20.0);  // forgotten in 0.1 s
  EXPECT_LE(level(), Fidelity::coupled);
  model.bodies[0].damping.setZero();
  EXPECT_EQ(level(), Fidelity::nonlinear);
  const VectorX& lambda = flexbody::rest_stiffness(model.bodies[0].elasticity);
  const double omega = std::sqrt(lambda.minCoeff());
  model.bodies[0].maxwell = flexbody::find_maxwell_elements(
      20.0 / omega, {omega, std::sqrt(lambda.maxCoeff())});
  EXPECT_LE(level(), Fidelity::coupled);
}

TEST(LevelAdvice, AsksForMoreWhereInterfacesTurn) {
  const SystemModel model = make_uncoupled_chain(1);
  const LevelLimits limits{1e-9, 1.0, std::nullopt};
  BodyPeaks peaks = bend(model);
  peaks.rotation.value = 0.3;
  peaks.relative_rotation.value = 0.39;
  EXPECT_LE(advise(model.bodies[0], peaks, limits).level, Fidelity::coupled);
  peaks.relative_rotation.value = 0.5;
  const LevelAdvice advice = advise(model.bodies[0], peaks, limits);
  EXPECT_EQ(advice.level, Fidelity::nonlinear);
  EXPECT_TRUE(advice.is_beyond_linear);
  EXPECT_THAT(advice.reason, HasSubstr("relative to one another by 0.5 rad"));
  peaks.rotation.value = 0.41;
  EXPECT_EQ(advise(model.bodies[0], peaks, limits).level, Fidelity::full);
}

// No load rotates it.
TEST(LevelAdvice, OfAClampedBodyIsAtMostUncoupled) {
  SystemModel model = make_uncoupled_chain(1);
  auto clamped =
      std::make_shared<flexbody::ReducedBody>(*model.bodies[0].reduced);
  clamped->clamped = true;
  model.bodies[0].reduced = clamped;
  model.bodies[0].clamped = true;
  BodyPeaks peaks = spin(model, Vector3::Zero());
  const LevelLimits limits{1e-6, 1.0, std::nullopt};
  EXPECT_EQ(advise(model.bodies[0], peaks, limits).level, Fidelity::rigid);
  peaks.total = {1.0, 0.0};
  EXPECT_EQ(advise(model.bodies[0], peaks, limits).level, Fidelity::uncoupled);
}

TEST(AdviceSettings, FollowTheBodysSize) {
  flexbody::ReducedBody body;
  body.size = {1.0, 1.0, 5.0};
  const LevelLimits limits = find_limits({}, body);
  EXPECT_NEAR(limits.displacement, 1e-6, kRoundoff);  // the report's
  EXPECT_NEAR(limits.linear_limit, 0.05, kRoundoff);
  EXPECT_FALSE(limits.force);
}

TEST(AdviceSettings, RefuseWhatIsNotPositive) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, -1.0, infinity, std::nan("")}) {
    EXPECT_THROW(check({value, {}, {}}), InputError);
    EXPECT_THROW(check({{}, value, {}}), InputError);
    EXPECT_THROW(check({{}, {}, value}), InputError);
  }
  EXPECT_NO_THROW(check({1.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace limber::dynamics::level_advice_test
