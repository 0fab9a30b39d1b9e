// SPDX-License-Identifier: BSD-3-Clause
// What a shaper leaves of the vibration of y'' + 2 z w y' + w^2 y = -s'', the
// tip of an arm relative to its hub, which follows s.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "limber/joints/scalar/signal.hpp"
#include "support/differences.hpp"

namespace limber::joints::shaper_test {
namespace {

using Complex = std::complex<double>;
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kFrequency = 1.7;  // Hz
constexpr double kRoundoff = 1e-14;

Complex find_pole(double frequency, double ratio) {
  return kTurn * frequency * Complex(ratio, std::sqrt(1.0 - ratio * ratio));
}

// Duhamel's integral of unit impulses: the sum of rotating vectors.
Complex find_response(const std::vector<Impulse>& shaper, const Complex& pole) {
  Complex sum = 0.0;
  for (const Impulse& i : shaper) sum += i.fraction * std::exp(pole * i.delay);
  return sum * std::exp(-pole.real() * shaper.back().delay);
}

// The same of a signal whose rate is piecewise constant.
double find_vibration(const Signal& signal, const Complex& pole) {
  Complex sum = 0.0;
  const std::vector<double> breaks = break_times(signal);
  for (const double t : breaks) {
    const double jump = evaluate(signal, {t, Side::right}).rate -
                        evaluate(signal, {t, Side::left}).rate;
    sum += jump * std::exp(pole * (t - breaks.back()));
  }
  return std::abs(sum) / pole.imag();
}

TEST(Shaper, SharesSumToOne) {
  for (const ShaperKind kind : {ShaperKind::zv, ShaperKind::zvd}) {
    for (const double ratio : {0.0, 0.02, 0.3, 0.99}) {
      double sum = 0.0;
      for (const Impulse& i : make_shaper(kind, kFrequency, ratio)) {
        EXPECT_GE(i.fraction, 0.0);
        sum += i.fraction;
      }
      EXPECT_NEAR(sum, 1.0, kRoundoff);
    }
  }
}

TEST(Shaper, NoVibrationIsLeftAtItsFrequency) {
  for (const ShaperKind kind : {ShaperKind::zv, ShaperKind::zvd}) {
    for (const double frequency : {0.002, kFrequency, 3000.0}) {
      for (const double ratio : {0.0, 0.02, 0.3}) {
        const auto shaper = make_shaper(kind, frequency, ratio);
        const Complex left = find_response(shaper, find_pole(frequency, ratio));
        EXPECT_LT(std::abs(left), kRoundoff);
      }
    }
  }
}

TEST(Shaper, NoVibrationIsLeftOfAShapedRamp) {
  const RampSignal ramp{.to = std::numbers::pi, .start = 0.1, .duration = 0.83};
  for (const double ratio : {0.0, 0.05}) {
    const Complex pole = find_pole(kFrequency, ratio);
    const double plain = find_vibration({ramp}, pole);
    EXPECT_GT(plain, 0.1);
    for (const ShaperKind kind : {ShaperKind::zv, ShaperKind::zvd}) {
      const Signal shaped{ramp, make_shaper(kind, kFrequency, ratio)};
      EXPECT_LT(find_vibration(shaped, pole), 1e-13 * plain);
    }
  }
}

// d / d frequency of the vector sum at the design frequency.
TEST(Shaper, OnlyZvdsVibrationHasNoSlopeByFrequency) {
  for (const double ratio : {0.0, 0.02, 0.3}) {
    const auto slope = [&](ShaperKind kind) {
      const auto shaper = make_shaper(kind, kFrequency, ratio);
      Complex sum = 0.0;
      for (const Impulse& i : shaper) {
        const Complex pole = find_pole(1.0, ratio);
        sum +=
            i.fraction * i.delay * pole * std::exp(kFrequency * pole * i.delay);
      }
      return std::abs(sum);
    };
    EXPECT_LT(slope(ShaperKind::zvd), 20.0 * kRoundoff);
    EXPECT_GT(slope(ShaperKind::zv), 0.5);
  }
}

// Without damping: |cos(pi r / 2)| and its square, at r times the frequency.
TEST(Shaper, AWrongFrequencyLeavesWhatTheFormulaSays) {
  for (const double r : {0.9, 1.001, 1.1, 1.6}) {
    const Complex pole = find_pole(r * kFrequency, 0.0);
    const double zv = std::abs(std::cos(0.25 * kTurn * r));
    const auto left = [&](ShaperKind kind) {
      return std::abs(find_response(make_shaper(kind, kFrequency, 0.0), pole));
    };
    EXPECT_NEAR(left(ShaperKind::zv), zv, kRoundoff);
    EXPECT_NEAR(left(ShaperKind::zvd), zv * zv, kRoundoff);
  }
  // 10 %: 15.6 % and 2.4 %.
  EXPECT_NEAR(std::cos(0.55 * std::numbers::pi), -0.1564, 1e-4);
}

TEST(Shaper, AShapedRampWithAWrongFrequencyLeavesTheSameShare) {
  const RampSignal ramp{.to = 1.0, .start = 0.1, .duration = 0.83};
  const Complex pole = find_pole(1.1 * kFrequency, 0.0);
  const double plain = find_vibration({ramp}, pole);
  ASSERT_GT(plain, 0.01);
  const double zv = std::abs(std::cos(0.275 * kTurn));
  const auto left = [&](ShaperKind kind) {
    return find_vibration({ramp, make_shaper(kind, kFrequency, 0.0)}, pole) /
           plain;
  };
  EXPECT_NEAR(left(ShaperKind::zv), zv, 1e-13);
  EXPECT_NEAR(left(ShaperKind::zvd), zv * zv, 1e-13);
}

}  // namespace
}  // namespace limber::joints::shaper_test
