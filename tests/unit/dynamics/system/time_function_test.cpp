// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/time_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"

namespace limber::dynamics::time_function_test {
namespace {

TEST(TimeFunction, SumOfSinusoidsIsRefusedIfATermIsNotFinite) {
  EXPECT_THROW(check(HarmonicSum{.terms = {{-1.0, 0.0, 1.0}}}), InputError);
  EXPECT_THROW(check(HarmonicSum{.mean = std::nan("")}), InputError);
  EXPECT_NO_THROW(check(HarmonicSum{.terms = {{3.0, 1.0, 0.0}}}));
}

TEST(TimeFunction, PulseJumpsExactlyAtItsEdges) {
  const TimeFunction pulse = Pulse{PulseShape::rectangular, 0.1, 0.3};
  EXPECT_EQ(evaluate(pulse, 0.1, Side::left), 0.0);
  EXPECT_EQ(evaluate(pulse, 0.1, Side::right), 1.0);
  EXPECT_EQ(evaluate(pulse, 0.1 + 0.3, Side::left), 1.0);
  EXPECT_EQ(evaluate(pulse, 0.1 + 0.3, Side::right), 0.0);
}

TEST(TimeFunction, ShapedPulsesPeakInTheMiddle) {
  for (const PulseShape shape :
       {PulseShape::half_sine, PulseShape::triangular}) {
    const TimeFunction pulse = Pulse{shape, 1.0, 2.0};
    EXPECT_DOUBLE_EQ(evaluate(pulse, 2.0, Side::left), 1.0);
    EXPECT_NEAR(evaluate(pulse, 3.0, Side::left), 0.0, 1e-15);
    EXPECT_EQ(evaluate(pulse, 3.5, Side::left), 0.0);
  }
}

TEST(TimeFunction, StepSequenceHoldsEachValueUntilTheNext) {
  const TimeFunction steps = StepSequence{{0.0, 1.0, 2.5}, {3.0, -1.0, 0.5}};
  EXPECT_EQ(evaluate(steps, -0.1, Side::right), 0.0);
  EXPECT_EQ(evaluate(steps, 0.0, Side::left), 0.0);
  EXPECT_EQ(evaluate(steps, 0.0, Side::right), 3.0);
  EXPECT_EQ(evaluate(steps, 1.0, Side::left), 3.0);
  EXPECT_EQ(evaluate(steps, 1.0, Side::right), -1.0);
  EXPECT_EQ(evaluate(steps, 99.0, Side::right), 0.5);
}

TEST(TimeFunction, TableIsLinearBetweenPointsAndZeroOutside) {
  const TimeFunction table = Table{{0.0, 1.0, 3.0}, {2.0, 4.0, 0.0}};
  EXPECT_DOUBLE_EQ(evaluate(table, 0.5, Side::right), 3.0);
  EXPECT_DOUBLE_EQ(evaluate(table, 2.0, Side::left), 2.0);
  EXPECT_EQ(evaluate(table, 0.0, Side::left), 0.0);
  EXPECT_EQ(evaluate(table, 0.0, Side::right), 2.0);
  EXPECT_EQ(evaluate(table, 3.5, Side::right), 0.0);
}

TEST(TimeFunction, SinusoidStartsItsPhaseWhereItStarts) {
  const TimeFunction wave =
      Sinusoid{.frequency = 2.0, .phase = 0.0, .from = 1.0};
  EXPECT_NEAR(evaluate(wave, 1.125, Side::left), 1.0, 1e-14);
  EXPECT_EQ(evaluate(wave, 0.9, Side::left), 0.0);
}

TEST(TimeFunction, EveryJumpIsABreakTime) {
  const TimeFunction pulse = Pulse{PulseShape::triangular, 1.0, 2.0};
  EXPECT_EQ(break_times(pulse), (std::vector{1.0, 2.0, 3.0}));
  const TimeFunction steps = StepSequence{{0.0, 1.0}, {3.0, 1.0}};
  EXPECT_EQ(break_times(steps), (std::vector{0.0, 1.0}));
}

TEST(TimeFunction, BadOnesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check(Table{{0.0, 0.0}, {1.0, 1.0}}), InputError);
  EXPECT_THROW(check(Table{{0.0}, {1.0}}), InputError);
  EXPECT_THROW(check(Table{{0.0, 1.0}, {1.0}}), InputError);
  EXPECT_THROW(check(StepSequence{{0.0, 1.0}, {1.0, nan}}), InputError);
  EXPECT_THROW(check(Pulse{PulseShape::rectangular, 0.0, 0.0}), InputError);
  EXPECT_THROW(check(Constant{1.0, 1.0}), InputError);
  EXPECT_THROW(check(Sinusoid{.frequency = -1.0}), InputError);
}

}  // namespace
}  // namespace limber::dynamics::time_function_test
