// SPDX-License-Identifier: BSD-3-Clause
// All laws along a coordinate must pass the same tests; add a new law by one
// line in `laws`.
#include "limber/joints/scalar/scalar_law.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <random>
#include <string>

#include "support/differences.hpp"

namespace limber::joints::scalar_law_test {
namespace {

using testing::differentiate;
using testing::Margin;

constexpr int kTrials = 400;
constexpr double kEnergyDifference = 1e-8;
// Short, so that no corner of a limit comes between; round-off of 1e-10.
constexpr double kEnergyStep = 1e-5;
constexpr double kForceDifference = 1e-6;

// The drives move until 1.9 s.
constexpr EvaluationTime kMidway{0.7};
constexpr EvaluationTime kAfterwards{10.0};

struct NamedLaw {
  std::string name;
  ScalarLaw law;
  bool stores = true;
  bool dissipates = true;
  friend void PrintTo(const NamedLaw& item, std::ostream* out) {
    *out << item.name;
  }
};

Signal command() {
  return {RampSignal{.from = 0.5,
                     .to = 2.5,
                     .start = 0.2,
                     .duration = 1.4,
                     .shape = RampShape::smooth},
          {{0.6, 0.0}, {0.4, 0.3}}};
}

ScalarLaw drive(DriveMode mode, double max_effort, bool pulls_only) {
  return Drive({.mode = mode,
                .signal = command(),
                .stiffness = 60.0,
                .damping = 5.0,
                .max_effort = max_effort,
                .max_speed = mode == DriveMode::effort ? 1.0 : 4.0,
                .pulls_only = pulls_only});
}

std::vector<NamedLaw> laws() {
  using enum DriveMode;
  const double unlimited = Drive::kUnlimited;
  const SpringCurve linear({.stiffness = 30.0});
  const SpringCurve quadratic({.stiffness = 5.0, .quadratic = 30.0});
  const SpringCurve table({.extensions = {-1.0, 0.0, 0.5, 1.5},
                           .forces = {-60.0, 3.0, 10.0, 90.0}});
  return {
      {"spring", ScalarSpring({.curve = linear, .damping = 2.0, .rest = 0.3})},
      {"quadratic spring", ScalarSpring({.curve = quadratic, .damping = 2.0})},
      {"tabulated spring", ScalarSpring({.curve = table}), true, false},
      {"damper", ScalarSpring({.damping = 2.0}), false, true},
      {"tension only", ScalarSpring({.curve = table,
                                     .damping = 9.0,
                                     .rest = -0.4,
                                     .tension_only = true})},
      {"friction", Friction({.coulomb = 4.0, .viscous = 0.5, .speed = 0.2}),
       false, true},
      {"stops",
       EndStop(
           {.lower = -0.8, .upper = 0.5, .stiffness = 200.0, .damping = 0.7})},
      {"lower stop", EndStop({.lower = -0.8, .stiffness = 200.0}), true, false},
      {"position", drive(position, unlimited, false)},
      {"limited position", drive(position, 50.0, false)},
      {"pulling position", drive(position, 50.0, true)},
      {"velocity", drive(velocity, unlimited, false), false, true},
      {"limited velocity", drive(velocity, 6.0, false), false, true},
      {"pulling velocity", drive(velocity, 6.0, true), false, true},
      {"effort", drive(effort, unlimited, false), false, false},
      {"pulling effort", drive(effort, 4.0, true), false, false},
  };
}

class ScalarLaws : public ::testing::TestWithParam<NamedLaw> {
 protected:
  ScalarMotion draw(double largest_rate = 3.0) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    return {3.0 * uniform(random_), largest_rate * uniform(random_)};
  }
  // Not within a difference of a corner of the force.
  ScalarMotion draw_smooth() {
    constexpr double kReach = 4e-4;
    for (; rejected_ < kTrials / 20; ++rejected_) {
      const ScalarMotion m = draw();
      const ScalarResponse a = at({m.z - kReach, m.rate - kReach}, kMidway);
      const ScalarResponse b = at({m.z + kReach, m.rate + kReach}, kMidway);
      const double jump =
          std::abs(a.stiffness - b.stiffness) + std::abs(a.damping - b.damping);
      if (jump < 0.1 * (1.0 + a.stiffness + a.damping)) return m;
    }
    ADD_FAILURE() << "corners everywhere";
    return {};
  }
  [[nodiscard]] ScalarResponse at(const ScalarMotion& motion,
                                  const EvaluationTime& now) const {
    return evaluate(GetParam().law, motion, now);
  }

  std::mt19937 random_{3};
  int rejected_ = 0;
};

TEST_P(ScalarLaws, ForceIsMinusEnergyGradientWhenNothingMoves) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ScalarMotion still{draw().z, 0.0};
    const double gradient = differentiate(
        [&](double by) {
          return at({still.z + by, 0.0}, kAfterwards).energy;
        },
        kEnergyStep);
    // A drive's force alone may be without an energy.
    const double force = GetParam().stores ? at(still, kAfterwards).force : 0.0;
    margin.add(std::abs(force + gradient), std::abs(force));
  }
  if (GetParam().stores) {
    margin.expect_below(kEnergyDifference);
  } else {
    EXPECT_EQ(margin.worst(), 0.0);
  }
}

TEST_P(ScalarLaws, StiffnessIsMinusForceDerivative) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ScalarMotion m = draw_smooth();
    const double slope = differentiate([&](double by) {
      return at({m.z + by, m.rate}, kMidway).force;
    });
    const double stiffness = at(m, kMidway).stiffness;
    margin.add(std::abs(stiffness + slope), std::abs(stiffness));
  }
  if (GetParam().stores) {
    margin.expect_below(kForceDifference);
  } else {
    EXPECT_EQ(margin.worst(), 0.0);
  }
}

TEST_P(ScalarLaws, DampingIsMinusForceDerivativeByRate) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ScalarMotion m = draw_smooth();
    const double slope = differentiate([&](double by) {
      return at({m.z, m.rate + by}, kMidway).force;
    });
    const double damping = at(m, kMidway).damping;
    margin.add(std::abs(damping + slope), std::abs(damping));
  }
  if (margin.largest() > 0.0) {
    margin.expect_below(kForceDifference);
  } else {
    EXPECT_FALSE(GetParam().dissipates);
    EXPECT_EQ(margin.worst(), 0.0);
  }
}

TEST_P(ScalarLaws, WhatIsSuppliedIsStoredDissipatedOrPassedOn) {
  Margin margin;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ScalarMotion m = draw();
    const ScalarResponse here = at(m, kMidway);
    const double stored = differentiate(
        [&](double by) {
          return at({m.z + by * m.rate, m.rate}, {kMidway.t + by}).energy;
        },
        kEnergyStep);
    const double passed_on = here.force * m.rate;
    const double rest = here.supplied - stored - here.dissipation - passed_on;
    margin.add(std::abs(rest), std::abs(passed_on));
  }
  margin.expect_below(kEnergyDifference);
}

// Also where a limit, a slack line or a stop that is left behind acts.
TEST_P(ScalarLaws, DissipationIsNeverNegative) {
  double largest = 0.0;
  for (int trial = 0; trial < 10 * kTrials; ++trial) {
    const ScalarResponse here = at(draw(30.0), kMidway);
    EXPECT_GE(here.dissipation, 0.0);
    largest = std::max(largest, here.dissipation);
  }
  EXPECT_EQ(largest > 0.1, GetParam().dissipates);
}

TEST_P(ScalarLaws, NothingIsSuppliedButByDrives) {
  double largest = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    largest = std::max(largest, std::abs(at(draw(), kMidway).supplied));
  }
  EXPECT_EQ(largest > 0.1, std::holds_alternative<Drive>(GetParam().law));
}

// Those of end stops and of what only pulls.
TEST_P(ScalarLaws, ASwitchHeldWhereTheMotionHasItChangesNothing) {
  const ScalarLaw& law = GetParam().law;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ScalarMotion m = draw();
    SwitchModes modes{};
    for (int i = 0; i < switch_count(law); ++i) {
      const bool is_up = find_switch(law, i, m).value > 0.0;
      modes.at(static_cast<std::size_t>(i)) =
          is_up ? SwitchMode::on : SwitchMode::off;
    }
    const ScalarResponse held = evaluate(law, m, kMidway, modes);
    EXPECT_EQ(held.force, at(m, kMidway).force);
    EXPECT_EQ(held.energy, at(m, kMidway).energy);
    EXPECT_EQ(held.dissipation, at(m, kMidway).dissipation);
  }
}

TEST_P(ScalarLaws, ASwitchHeldOffExertsNothing) {
  const ScalarLaw& law = GetParam().law;
  if (switch_count(law) == 0) return;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ScalarResponse held =
        evaluate(law, draw(), kMidway, {SwitchMode::off, SwitchMode::off});
    EXPECT_EQ(held.force, 0.0);
    EXPECT_EQ(held.energy, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ScalarLaws, ::testing::ValuesIn(laws()),
                         [](const auto& instance) {
                           std::string name;
                           for (const char c : instance.param.name) {
                             if (std::isalnum(c) != 0) name += c;
                           }
                           return name;
                         });

}  // namespace
}  // namespace limber::joints::scalar_law_test
