// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/signal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "support/differences.hpp"

namespace limber::joints::signal_test {
namespace {

using testing::differentiate;

constexpr double kTurn = 2.0 * std::numbers::pi;

struct NamedSignal {
  std::string name;
  Signal signal;
  bool jumps = true;  // its rate
  friend void PrintTo(const NamedSignal& item, std::ostream* out) {
    *out << item.name;
  }
};

RampSignal ramp(RampShape shape) {
  return {
      .from = -0.4, .to = 1.1, .start = 0.3, .duration = 0.7, .shape = shape};
}

std::vector<NamedSignal> signals() {
  // Delays whose sums with the times of a signal are not exact.
  const std::vector<Impulse> shaper{{0.3, 0.0}, {0.5, 0.1}, {0.2, 0.7}};
  const TableSignal table{{-0.1, 0.2, 0.7}, {1.0, -2.0, 0.5}};
  const SineSignal sine{.mean = 0.2,
                        .amplitude = 0.7,
                        .frequency = 1.3,
                        .phase = 0.4,
                        .start = 0.1};
  return {
      {"Linear", {ramp(RampShape::linear)}},
      {"Trapezoid", {ramp(RampShape::trapezoid)}, false},
      {"Smooth", {ramp(RampShape::smooth)}, false},
      {"Table", {table}},
      {"Sine", {sine}},
      {"ShapedLinear", {ramp(RampShape::linear), shaper}},
      {"ShapedTrapezoid", {ramp(RampShape::trapezoid), shaper}, false},
      {"ShapedSmooth", {ramp(RampShape::smooth), shaper}, false},
      {"ShapedTable", {table, shaper}},
      {"ShapedSine", {sine, shaper}},
  };
}

class Signals : public ::testing::TestWithParam<NamedSignal> {
 protected:
  [[nodiscard]] SignalValue at(double t, Side side = Side::right) const {
    return evaluate(GetParam().signal, {t, side});
  }
  std::vector<double> breaks_ = break_times(GetParam().signal);
};

// By Simpson's rule between breaks.
TEST_P(Signals, HaveTheIntegralOfTheirValue) {
  const Signal& signal = GetParam().signal;
  std::vector<double> marks = break_times(signal);
  marks.insert(marks.begin(), marks.front() - 0.3);
  marks.push_back(marks.back() + 0.3);
  for (std::size_t i = 1; i < marks.size(); ++i) {
    constexpr int kParts = 200;
    const double h = (marks[i] - marks[i - 1]) / kParts;
    double sum = 0.0;
    for (int k = 0; k < kParts; ++k) {
      const double t = marks[i - 1] + k * h;
      sum += h / 6.0 *
             (evaluate(signal, {t, Side::right}).value +
              4.0 * evaluate(signal, {t + 0.5 * h, Side::right}).value +
              evaluate(signal, {t + h, Side::left}).value);
      EXPECT_NEAR(*integrate(signal, t + h) - *integrate(signal, marks[i - 1]),
                  sum, 1e-10);
    }
  }
}

TEST_P(Signals, ValueIsContinuousAtEachBreak) {
  for (const double t : breaks_) {
    EXPECT_NEAR(at(t, Side::left).value, at(t).value, 1e-14);
    EXPECT_NEAR(at(t - 1e-9).value, at(t).value, 1e-7);
    EXPECT_NEAR(at(t + 1e-9).value, at(t).value, 1e-7);
  }
}

// At a break the one-sided limit is selected by the side.
TEST_P(Signals, RateAtABreakIsThatOfItsSide) {
  double largest_jump = 0.0;
  for (const double t : breaks_) {
    const double left = at(t, Side::left).rate;
    const double right = at(t).rate;
    EXPECT_NEAR(left, at(t - 1e-9).rate, 1e-6);
    EXPECT_NEAR(right, at(t + 1e-9).rate, 1e-6);
    largest_jump = std::max(largest_jump, std::abs(right - left));
  }
  EXPECT_EQ(largest_jump > 0.1, GetParam().jumps);
}

// The same time by another sum.
TEST_P(Signals, ATimeARoundingOffABreakIsOnIt) {
  for (const double t : breaks_) {
    for (const double to : {-9.0, 9.0}) {
      const double other = std::nextafter(t, to);
      EXPECT_NEAR(at(other, Side::left).rate, at(t, Side::left).rate, 1e-12);
      EXPECT_NEAR(at(other).rate, at(t).rate, 1e-12);
    }
  }
}

TEST_P(Signals, RateIsTheDerivativeOfTheValue) {
  double largest = 0.0;
  for (double t = -0.35; t < 2.4; t += 0.0137) {
    const bool is_near_break =
        std::any_of(breaks_.begin(), breaks_.end(),
                    [&](double b) { return std::abs(b - t) < 4e-4; });
    if (is_near_break) continue;
    const double slope =
        differentiate([&](double by) { return at(t + by).value; });
    EXPECT_NEAR(at(t).rate, slope, 1e-10);
    largest = std::max(largest, std::abs(slope));
  }
  EXPECT_GT(largest, 0.5);
}

// Simpson's rule between the breaks is exact for a cubic, and the smooth rate
// is a quartic: 200 panels leave (1/200)^4 of it.
TEST_P(Signals, AreaUnderTheRateIsTheChangeOfTheValue) {
  double area = 0.0;
  const auto rate = [&](double t, Side side) { return at(t, side).rate; };
  for (std::size_t i = 1; i < breaks_.size(); ++i) {
    const double h = (breaks_[i] - breaks_[i - 1]) / 200.0;
    for (int panel = 0; panel < 200; ++panel) {
      const double a = breaks_[i - 1] + panel * h;
      const double b = panel == 199 ? breaks_[i] : a + h;
      area += (b - a) / 6.0 *
              (rate(a, Side::right) + 4.0 * rate(0.5 * (a + b), Side::right) +
               rate(b, Side::left));
    }
  }
  const double change = at(breaks_.back()).value - at(breaks_.front()).value;
  EXPECT_NEAR(area, change, 1e-9);
}

TEST_P(Signals, BreaksIncreaseAndAreFurtherApartThanRoundoff) {
  ASSERT_FALSE(breaks_.empty());
  for (std::size_t i = 1; i < breaks_.size(); ++i) {
    EXPECT_GT(breaks_[i] - breaks_[i - 1], 1e-12);
  }
}

TEST_P(Signals, StayBelowTheirLargestValues) {
  const SignalValue largest = find_largest(GetParam().signal);
  SignalValue seen;
  for (double t = -0.5; t < 8.0; t += 1e-3) {
    seen.value = std::max(seen.value, std::abs(at(t).value));
    seen.rate = std::max(seen.rate, std::abs(at(t).rate));
  }
  EXPECT_LE(seen.value, largest.value * (1.0 + 1e-14));
  EXPECT_LE(seen.rate, largest.rate * (1.0 + 1e-14));
  if (GetParam().signal.shaper.size() > 1) return;
  EXPECT_NEAR(seen.value, largest.value, 1e-4 * largest.value);
  EXPECT_NEAR(seen.rate, largest.rate, 1e-4 * largest.rate);
}

INSTANTIATE_TEST_SUITE_P(Each, Signals, ::testing::ValuesIn(signals()),
                         [](const auto& instance) {
                           return instance.param.name;
                         });

TEST(Signal, ARampGoesFromOneValueToTheOtherAndStays) {
  for (const RampShape shape :
       {RampShape::linear, RampShape::trapezoid, RampShape::smooth}) {
    const Signal signal{ramp(shape)};
    EXPECT_EQ(evaluate(signal, {0.2}).value, -0.4);
    EXPECT_NEAR(evaluate(signal, {0.65}).value, 0.35, 1e-14);  // halfway
    EXPECT_EQ(evaluate(signal, {1.2}).value, 1.1);
    EXPECT_EQ(evaluate(signal, {1.2}).rate, 0.0);
  }
}

// With rise a the plateau is 1 / (1 - a) of the mean rate.
TEST(Signal, ATrapezoidsPlateauIsItsLargestRate) {
  RampSignal r = ramp(RampShape::trapezoid);
  r.rise = 0.2;
  const double mean = 1.5 / 0.7;
  EXPECT_NEAR(evaluate({r}, {0.65}).rate, 1.25 * mean, 1e-14);
  EXPECT_NEAR(find_largest({r}).rate, 1.25 * mean, 1e-14);
  EXPECT_NEAR(evaluate({r}, {0.3 + 0.07}).rate, 0.625 * mean, 1e-13);
  const std::vector<double> breaks = break_times({r});
  const std::array expected{0.3, 0.44, 0.86, 1.0};
  ASSERT_EQ(breaks.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(breaks[i], expected[i], 1e-15);
  }
}

TEST(Signal, ATriangleHasOneBreakInItsMiddle) {
  for (const double duration : {0.3, 0.7, 1.1}) {
    RampSignal r = ramp(RampShape::trapezoid);
    r.rise = 0.5;
    r.duration = duration;
    EXPECT_EQ(break_times({r}).size(), 3U);
  }
}

TEST(Signal, TheSmoothRampStartsAndEndsWithoutAcceleration) {
  const Signal signal{ramp(RampShape::smooth)};
  const auto acceleration = [&](double t) {
    return differentiate(
        [&](double by) { return evaluate(signal, {t + by}).rate; }, 1e-6);
  };
  EXPECT_NEAR(acceleration(0.3), 0.0, 1e-3);
  EXPECT_NEAR(acceleration(1.0), 0.0, 1e-3);
  // 1.875 of the mean rate halfway.
  EXPECT_NEAR(evaluate(signal, {0.65}).rate, 1.875 * 1.5 / 0.7, 1e-13);
  // Largest 10 / sqrt(3) of the mean rate by duration, at (1 - 1/sqrt(3)) / 2.
  const double early = 0.3 + 0.7 * 0.5 * (1.0 - 1.0 / std::sqrt(3.0));
  EXPECT_NEAR(acceleration(early), 10.0 / std::sqrt(3.0) * 1.5 / 0.49, 1e-6);
}

TEST(Signal, ASineHoldsItsFirstValueUntilItStarts) {
  const Signal signal{SineSignal{.mean = 1.0,
                                 .amplitude = 2.0,
                                 .frequency = 3.0,
                                 .phase = 0.5,
                                 .start = 0.4}};
  EXPECT_EQ(evaluate(signal, {0.1}).value, 1.0 + 2.0 * std::sin(0.5));
  EXPECT_EQ(evaluate(signal, {0.4, Side::left}).rate, 0.0);
  EXPECT_NEAR(evaluate(signal, {0.4}).rate, 6.0 * kTurn * std::cos(0.5), 1e-13);
  EXPECT_NEAR(evaluate(signal, {0.5}).value,
              1.0 + 2.0 * std::sin(0.5 + 0.3 * kTurn), 1e-14);
}

TEST(Signal, ATableHoldsItsEnds) {
  const Signal signal{TableSignal{{0.0, 1.0}, {3.0, 5.0}}};
  EXPECT_EQ(evaluate(signal, {-1.0}).value, 3.0);
  EXPECT_EQ(evaluate(signal, {0.25}).value, 3.5);
  EXPECT_EQ(evaluate(signal, {1.0, Side::left}).rate, 2.0);
  EXPECT_EQ(evaluate(signal, {1.0}).rate, 0.0);
  EXPECT_EQ(evaluate(signal, {7.0}).value, 5.0);
  const Signal point{TableSignal{{2.0}, {4.0}}};
  EXPECT_EQ(evaluate(point, {0.0}).value, 4.0);
  EXPECT_EQ(evaluate(point, {2.0}).rate, 0.0);
}

TEST(Signal, AShapersDelayMovesEachBreak) {
  const Signal signal{ramp(RampShape::linear), {{0.5, 0.0}, {0.5, 0.1}}};
  const std::vector<double> expected{0.3, 0.3 + 0.1, 0.3 + 0.7,
                                     0.3 + 0.7 + 0.1};
  EXPECT_EQ(break_times(signal), expected);
  // Between the two starts half of the rate.
  EXPECT_NEAR(evaluate(signal, {0.35}).rate, 0.75 / 0.7, 1e-14);
}

// The first impulse's end and the second's start, 0.3 and 3 * 0.1.
TEST(Signal, BreaksThatAreOneButForRoundoffAreOne) {
  RampSignal r = ramp(RampShape::linear);
  r.start = 0.0;
  r.duration = 0.3;
  const double delay = 3.0 * 0.1;
  ASSERT_NE(r.duration, delay);
  const Signal signal{r, {{0.5, 0.0}, {0.5, delay}}};
  ASSERT_EQ(break_times(signal).size(), 3U);
  const double middle = break_times(signal)[1];
  // Both use the requested side: one ramp of twice the duration.
  for (const Side side : {Side::left, Side::right}) {
    EXPECT_NEAR(evaluate(signal, {middle, side}).rate, 2.5, 1e-14);
  }
}

TEST(Signal, AConstantHasNoBreaks) {
  EXPECT_TRUE(break_times({ConstantSignal{2.0}}).empty());
  EXPECT_EQ(evaluate({ConstantSignal{2.0}}, {1.0}).value, 2.0);
  EXPECT_EQ(find_largest({ConstantSignal{-2.0}}).value, 2.0);
}

}  // namespace
}  // namespace limber::joints::signal_test
