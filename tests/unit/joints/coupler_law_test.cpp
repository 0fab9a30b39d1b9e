// SPDX-License-Identifier: BSD-3-Clause
// Every law keeps the same contract; a new law joins by one line in
// coupler_cases.cpp.
#include "joints/coupler_law.hpp"

#include <gtest/gtest.h>

#include <cctype>

#include "common/rotation.hpp"
#include "support/differences.hpp"
#include "unit/joints/coupler_cases.hpp"

namespace limber::joints {
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

INSTANTIATE_TEST_SUITE_P(Each, CouplerLaws,
                         ::testing::ValuesIn(testing::coupler_cases()),
                         [](const auto& instance) {
                           std::string name;
                           for (const char c : instance.param.name) {
                             if (std::isalnum(c) != 0) name += c;
                           }
                           return name;
                         });

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
}  // namespace limber::joints
