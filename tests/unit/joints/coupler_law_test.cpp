// SPDX-License-Identifier: BSD-3-Clause
// All laws must pass the same tests; add a new law by one line in
// coupler_cases.cpp.
#include "limber/joints/coupler_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/common/rotation.hpp"
#include "support/differences.hpp"
#include "unit/joints/coupler_cases.hpp"

namespace limber::joints::coupler_law_test {
namespace {

using testing::carried;
using testing::CouplerCase;
using testing::differentiate;
using testing::Ends;
using testing::exchanged;
using testing::hastened;
using testing::kAfterwards;
using testing::kMidway;
using testing::Margin;
using testing::moved;
using testing::Parts;
using testing::random_memory;
using testing::random_motion;
using testing::random_vector;
using testing::stilled;
using testing::turned;
using testing::velocity_of;

constexpr int kTrials = 40;
constexpr double kEnergyDifference = 1e-8;
constexpr double kForceDifference = 1e-6;
constexpr double kRoundoff = 1e-12;

class CouplerLaws : public ::testing::TestWithParam<CouplerCase> {
 protected:
  // A random motion, and what a coupler may remember there.
  void draw() {
    motion_ = random_motion(GetParam().freedom, random_);
    memory_ = random_memory(law_, motion_, random_);
  }

  // A law of these parts alone has nothing to compare, any other something.
  static void expect(const Margin& margin, double tolerance, Parts parts) {
    if (GetParam().parts == parts) {
      EXPECT_EQ(margin.largest(), 0.0);
    } else {
      margin.expect_below(tolerance);
    }
  }

  std::mt19937 random_{11};
  CouplerLaw law_ = GetParam().law();
  RelativeMotion motion_;
  CouplerMemory memory_;
};

TEST_P(CouplerLaws, ForceIsMinusEnergyGradientWhenNothingMoves) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    draw();
    const RelativeMotion still = stilled(motion_);
    const CouplerResponse at = evaluate(law_, still, memory_, kAfterwards);
    for (int i = 0; i < 6; ++i) {
      const double gradient = differentiate([&](double by) {
        return evaluate(law_, moved(still, i, by), memory_, kAfterwards).energy;
      });
      margin.add(std::abs(at.wrench[i] + gradient), at.wrench.norm());
    }
    EXPECT_EQ(at.dissipation, 0.0);
    EXPECT_EQ(at.supplied, 0.0);
  }
  expect(margin, kEnergyDifference, Parts::damper);
}

TEST_P(CouplerLaws, StiffnessIsMinusForceDerivative) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    draw();
    const CouplerResponse at = evaluate(law_, motion_, memory_, kMidway);
    for (int i = 0; i < 6; ++i) {
      const Vector6 column = differentiate([&](double by) {
        return evaluate(law_, moved(motion_, i, by), memory_, kMidway).wrench;
      });
      margin.add((at.stiffness.col(i) + column).norm(), at.stiffness.norm());
    }
  }
  expect(margin, kForceDifference, Parts::damper);
}

TEST_P(CouplerLaws, DampingIsMinusForceDerivativeByVelocity) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    draw();
    const CouplerResponse at = evaluate(law_, motion_, memory_, kMidway);
    for (int i = 0; i < 6; ++i) {
      const Vector6 column = differentiate([&](double by) {
        return evaluate(law_, hastened(motion_, i, by), memory_, kMidway)
            .wrench;
      });
      margin.add((at.damping.col(i) + column).norm(), at.damping.norm());
    }
  }
  expect(margin, kForceDifference, Parts::spring);
}

TEST_P(CouplerLaws, WhatIsSuppliedIsStoredDissipatedOrPassedOn) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    draw();
    const CouplerResponse at = evaluate(law_, motion_, memory_, kMidway);
    const double stored = differentiate([&](double by) {
      return evaluate(law_, carried(motion_, by), memory_, {kMidway.t + by})
          .energy;
    });
    const double passed_on = at.wrench.dot(velocity_of(motion_));
    const double rest = at.supplied - stored - at.dissipation - passed_on;
    margin.add(std::abs(rest), std::abs(passed_on));
  }
  margin.expect_below(kEnergyDifference);
}

TEST_P(CouplerLaws, DissipationIsNeverNegative) {
  double largest = 0.0;
  for (int trial = 0; trial < 25 * kTrials; ++trial) {
    draw();
    const double power = evaluate(law_, motion_, memory_, kMidway).dissipation;
    EXPECT_GE(power, 0.0);
    largest = std::max(largest, power);
  }
  if (GetParam().parts == Parts::spring) {
    EXPECT_EQ(largest, 0.0);
  } else {
    EXPECT_GT(largest, 1e-2);
  }
}

TEST_P(CouplerLaws, TurnedAxesTurnTheWrench) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    draw();
    const Matrix3 Q = exp_rotation(3.0 * random_vector(random_));
    const CouplerResponse at = evaluate(law_, motion_, memory_, kMidway);
    CouplerMemory memory = memory_;
    memory.X_FM = {Q * memory.X_FM.R * Q.transpose(), Q * memory.X_FM.p};
    const CouplerResponse other =
        evaluate(GetParam().make(Q), turned(motion_, Q), memory, kMidway);
    Vector6 expected;
    expected << Q * at.wrench.head<3>(), Q * at.wrench.tail<3>();
    const double scale = at.wrench.norm() + at.energy + at.dissipation;
    margin.add((other.wrench - expected).norm(), scale);
    margin.add(std::abs(other.energy - at.energy), scale);
    margin.add(std::abs(other.dissipation - at.dissipation), scale);
    margin.add(std::abs(other.supplied - at.supplied), scale);
  }
  margin.expect_below(kRoundoff);
}

TEST_P(CouplerLaws, NoForceAtRest) {
  const RelativeMotion& rest = GetParam().rest;
  memory_.latch = LatchStatus::closed;
  memory_.X_FM = {rest.R_FM, rest.p_FM_F};
  const CouplerResponse at = evaluate(law_, rest, memory_, kAfterwards);
  EXPECT_LT(at.wrench.norm(), 1e-13);
  EXPECT_LT(std::abs(at.energy), 1e-15);
  EXPECT_EQ(at.dissipation, 0.0);
}

TEST_P(CouplerLaws, EitherEndSeesTheSamePhysicsIfTheLawSaysSo) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    draw();
    memory_.near = {};
    if (GetParam().ends == Ends::same_at_rest) motion_ = stilled(motion_);
    const CouplerResponse at = evaluate(law_, motion_, memory_, kAfterwards);
    const CouplerResponse other =
        evaluate(law_, exchanged(motion_), memory_, kAfterwards);
    // The reaction on F at Fo, in M.
    const Vector3 force = at.wrench.head<3>();
    const Vector3 moment = at.wrench.tail<3>();
    Vector6 expected;
    expected << -motion_.R_FM.transpose() * force,
        -motion_.R_FM.transpose() * (moment + motion_.p_FM_F.cross(force));
    const double scale = at.wrench.norm() + at.energy + at.dissipation;
    margin.add((other.wrench - expected).norm(), scale);
    margin.add(std::abs(other.energy - at.energy), scale);
    margin.add(std::abs(other.dissipation - at.dissipation), scale);
  }
  if (GetParam().ends == Ends::differ) {
    EXPECT_GT(margin.worst(), 1e-3);
  } else {
    margin.expect_below(kRoundoff);
  }
}

// From one end of a step to the other by its velocities, as energy-conserving
// steps go: p_1 = p_0 + h v, R_1 = cay(h w) R_0.
RelativeMotion stepped(const RelativeMotion& begin, double h) {
  RelativeMotion end = carried(begin, 0.0);
  const Matrix3 half = skew(0.5 * h * begin.w_FM_F);
  const Matrix3 I = Matrix3::Identity();
  end.R_FM = (I - half).inverse() * (I + half) * begin.R_FM;
  end.p_FM_F += h * begin.v_FM_F;
  return end;
}

RelativeMotion mean_of(const RelativeMotion& begin, const RelativeMotion& end) {
  RelativeMotion mean = begin;
  mean.R_FM = 0.5 * (begin.R_FM + end.R_FM);
  mean.p_FM_F = 0.5 * (begin.p_FM_F + end.p_FM_F);
  return mean;
}

TEST_P(CouplerLaws, EnergiesBalanceOverAStepOfAnySize) {
  Margin margin;
  for (const double h : {1e-3, 0.03, 0.1}) {
    for (int trial = 0; trial < kTrials; ++trial) {
      draw();
      const RelativeMotion end = stepped(motion_, h);
      const RelativeMotion mean = mean_of(motion_, end);
      const StepTimes times{kMidway.t, kMidway.t + h, h};
      const CouplerResponse over =
          evaluate_over_step(law_, {motion_, end, mean}, memory_, times);
      const double before =
          evaluate(law_, motion_, memory_, {times.begin, Side::right}).energy;
      const double after =
          evaluate(law_, end, memory_, {times.end, Side::left}).energy;
      const double passed_on = over.wrench.dot(velocity_of(motion_));
      const double rest =
          after - before - h * (over.supplied - over.dissipation - passed_on);
      EXPECT_GE(over.dissipation, 0.0);
      margin.add(std::abs(rest), before + h * std::abs(passed_on));
    }
  }
  margin.expect_below(kRoundoff);
}

// To first order in the step, and so not by a force that merely balances.
TEST_P(CouplerLaws, ForceOverAShortStepIsThatWithin) {
  constexpr double kStep = 1e-6;
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    draw();
    const RelativeMotion end = stepped(motion_, kStep);
    const RelativeMotion mean = mean_of(motion_, end);
    const CouplerResponse over =
        evaluate_over_step(law_, {motion_, end, mean}, memory_,
                           {kMidway.t, kMidway.t + kStep, kStep});
    const CouplerResponse at = evaluate(law_, motion_, memory_, kMidway);
    margin.add((over.wrench - at.wrench).norm(), at.wrench.norm());
  }
  margin.expect_below(100.0 * kStep);
}

// About a direction that it does not ask for it neither holds nor damps.
TEST_P(CouplerLaws, RequiresTheRotationsThatItActsOn) {
  const RelativeMotion& rest = GetParam().rest;
  memory_.latch = LatchStatus::closed;
  memory_.X_FM = {rest.R_FM, rest.p_FM_F};
  const CouplerResponse at = evaluate(law_, rest, memory_, kMidway);
  const Matrix3 stiffness = at.stiffness.bottomRightCorner<3, 3>();
  const Matrix3 damping = at.damping.bottomRightCorner<3, 3>();
  const RequiredSides required = find_required_rotations(law_);
  for (const RequiredRotations& side : {required.F, required.M}) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(side);
    EXPECT_GE(solver.eigenvalues()[0], -kRoundoff);
    for (int i = 0; i < 3; ++i) {
      if (solver.eigenvalues()[i] > kRoundoff) continue;
      const Vector3 free = solver.eigenvectors().col(i);
      EXPECT_LE((stiffness * free).norm(), kRoundoff * at.stiffness.norm());
      EXPECT_LE((damping * free).norm(), kRoundoff * at.damping.norm());
    }
  }
}

TEST_P(CouplerLaws, SwitchesHaveRatesAndMeanings) {
  const int count = switch_count(law_);
  ASSERT_LE(count, kMaxSwitches);
  for (int i = 0; i < count; ++i) {
    draw();
    const auto value = [&](double by) {
      return find_switch(law_, i, carried(motion_, by), memory_, kMidway.t + by)
          .value;
    };
    const SwitchValue at = find_switch(law_, i, motion_, memory_, kMidway.t);
    if (std::isfinite(at.value)) {
      EXPECT_NEAR(at.rate, differentiate(value),
                  kEnergyDifference * (1.0 + std::abs(at.value)));
    }
    EXPECT_TRUE(find_event(law_, i, true, memory_).has_value());
    CouplerMemory after = memory_;
    update_memory(law_, i, motion_, after);
    EXPECT_EQ(after.latch != memory_.latch, has_triggers(law_));
  }
}

TEST_P(CouplerLaws, WhatItShowsHasARateAndAnEffort) {
  const auto kinds = reading_kinds(law_);
  ASSERT_GE(kinds.size(), coordinates_of(law_).size());
  for (int i = 0; i < std::ssize(kinds); ++i) {
    for (int trial = 0; trial < kTrials; ++trial) {
      draw();
      const auto z = [&](double by) {
        return read(law_, i, carried(motion_, by), memory_, kMidway).motion.z;
      };
      const CoordinateReading at = read(law_, i, motion_, memory_, kMidway);
      EXPECT_NEAR(at.motion.rate, differentiate(z),
                  kEnergyDifference * (1.0 + std::abs(at.motion.z)));
      EXPECT_EQ(std::abs(at.effort), std::abs(at.response.force));
    }
  }
  EXPECT_THROW(static_cast<void>(read(law_, static_cast<int>(kinds.size()),
                                      motion_, memory_, kMidway)),
               ContractError);
}

TEST_P(CouplerLaws, WhatStandsForAConstraintDoesNotGiveWayAtRest) {
  const auto stiffness = find_constraint_stiffness(law_);
  if (!stiffness) return;
  const RelativeMotion& rest = GetParam().rest;
  const ConstraintDeflection none = find_deflection(law_, *stiffness, rest);
  EXPECT_EQ(none.distance, 0.0);
  EXPECT_LT(none.rotation, 1e-7);  // the root of round-off
  // Along the direction that it holds most, by as much as it is moved.
  double distance = 0.0;
  double rotation = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    RelativeMotion off = rest;
    off.p_FM_F += 0.01 * random_vector(random_).normalized();
    distance =
        std::max(distance, find_deflection(law_, *stiffness, off).distance);
    off = rest;
    off.R_FM *= exp_rotation(0.01 * random_vector(random_).normalized());
    rotation =
        std::max(rotation, find_deflection(law_, *stiffness, off).rotation);
  }
  EXPECT_NEAR(distance, stiffness->translational > 0.0 ? 0.01 : 0.0, 1e-3);
  EXPECT_NEAR(rotation, stiffness->rotational > 0.0 ? 0.01 : 0.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Each, CouplerLaws,
                         ::testing::ValuesIn(testing::coupler_cases()),
                         [](const auto& instance) {
                           std::string name;
                           for (const char c : instance.param.name) {
                             if (std::isalnum(c) != 0) name += c;
                           }
                           return name;
                         });

// A law that is not among the cases keeps no contract.
TEST(CouplerLaws, AllOfThemAreHeldToTheContract) {
  std::set<std::size_t> laws;
  std::set<std::size_t> elements;
  for (const CouplerCase& item : testing::coupler_cases()) {
    const CouplerLaw law = item.law();
    laws.insert(law.index());
    for (const JointElement& element : elements_of(law)) {
      elements.insert(element.law.index());
    }
  }
  EXPECT_EQ(laws.size(), std::variant_size_v<CouplerLaw>);
  EXPECT_EQ(elements.size(), std::variant_size_v<ScalarLaw>);
}

// A run that goes on from a checkpoint compares them by it.
TEST(CouplerLaws, LawsOfOneManifestAreTheSame) {
  std::mt19937 random(3);
  const RelativeMotion motion = random_motion(JointKind::fixed, random);
  std::map<std::string, Vector6> wrenches;
  for (const CouplerCase& item : testing::coupler_cases()) {
    const CouplerLaw law = item.law();
    Manifest manifest;
    describe(manifest, "law", law);
    CouplerMemory memory;
    memory.latch = LatchStatus::closed;
    const Vector6 wrench = evaluate(law, motion, memory, kMidway).wrench;
    const auto known = wrenches.emplace(manifest.text(), wrench).first;
    EXPECT_EQ(known->second, wrench) << item.name;
  }
  // A continuous joint is a revolute one.
  EXPECT_EQ(wrenches.size() + 1, testing::coupler_cases().size());
}

TEST(CouplerLaws, AUniversalJointSeenFromItsOtherEndHasItsAxesExchanged) {
  const Vector3 a = Vector3(1.0, 2.0, 2.0) / 3.0;
  const Vector3 b = Vector3(2.0, 1.0, -2.0) / 3.0;
  const JointParameters stiff{.translational_stiffness = 300.0,
                              .rotational_stiffness = 40.0};
  const Joint joint = make_joint(JointKind::universal, a, b, stiff);
  const Joint other = make_joint(JointKind::universal, b, a, stiff);
  std::mt19937 random(5);
  for (int trial = 0; trial < kTrials; ++trial) {
    const RelativeMotion m = random_motion(JointKind::ball, random);
    const CouplerResponse at = joint.evaluate(m, {}, {});
    const CouplerResponse seen = other.evaluate(exchanged(m), {}, {});
    EXPECT_GT(at.energy, 1e-6);
    EXPECT_NEAR(seen.energy, at.energy, 1e-13 * (1.0 + at.energy));
  }
}

}  // namespace
}  // namespace limber::joints::coupler_law_test
