// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/curve_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace limber::study::curve_measures_test {
namespace {

struct Curve {
  std::vector<double> times;
  std::vector<double> values;
};

Curve sample(double from, double to, std::size_t count,
             const std::function<double(double)>& f) {
  Curve curve;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = from + (to - from) * static_cast<double>(i) /
                                static_cast<double>(count - 1);
    curve.times.push_back(t);
    curve.values.push_back(f(t));
  }
  return curve;
}

/// Damped oscillator of unit stiffness under a unit step from rest.
struct Oscillator {
  double omega = 1.0;  // [rad/s]
  double zeta = 0.1;   // [-]
  double from = 0.0;   // value at the start
  double size = 1.0;   // of the step

  [[nodiscard]] double damped() const {
    return omega * std::sqrt(1.0 - zeta * zeta);
  }
  double operator()(double t) const {
    const double decay = std::exp(-zeta * omega * t);
    const double x =
        1.0 - decay * (std::cos(damped() * t) +
                       zeta * omega / damped() * std::sin(damped() * t));
    return from + size * x;
  }
};

// Its overshoot is exp(-pi zeta / sqrt(1 - zeta^2)), whatever the units, the
// sign and the place; a parabola through samples of h is off by (w h)^4.
TEST(Overshoot, OfADampedOscillatorIsThatInClosedForm) {
  for (const double zeta : {0.05, 0.2, 0.5}) {
    const double expected =
        std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
    for (const Oscillator& o :
         {Oscillator{1.0, zeta, 0.0, 1.0}, Oscillator{50.0, zeta, 0.0, 1.0},
          Oscillator{1.0, zeta, 1000.0, -1e-3}}) {
      const auto [t, x] = sample(0.0, 300.0 / o.omega, 6001, o);
      EXPECT_NEAR(*find_overshoot(t, x), expected, 1e-5) << zeta;
    }
  }
  const auto [t, x] =
      sample(0.0, 9.0, 90, [](double s) { return 1.0 - std::exp(-s); });
  EXPECT_EQ(find_overshoot(t, x), 0.0);
  EXPECT_FALSE(find_overshoot(t, std::vector<double>(90, 2.0)));
}

TEST(SettlingTime, OfADampedOscillatorIsWhereItEntersTheBand) {
  for (const double zeta : {0.05, 0.3}) {
    const Oscillator o{2.0, zeta, 5.0, -3.0};
    const auto [t, x] = sample(0.0, 200.0, 40001, o);
    const double found = *find_settling_time(t, x);
    // It leaves the band at the last time, within its envelope.
    EXPECT_NEAR(std::abs(o(found) - 2.0), 0.02 * 3.0, 1e-5);
    for (double s = found + 1e-3; s < 60.0; s += 1e-3) {
      ASSERT_LE(std::abs(o(s) - 2.0), 0.02 * 3.0) << s;
    }
    EXPECT_LE(found, -std::log(0.02 * std::sqrt(1.0 - zeta * zeta)) /
                         (zeta * o.omega));
  }
}

TEST(SettlingTime, IsNoneOfACurveThatHasNotSettled) {
  const auto [t, x] = sample(0.0, 10.0, 1001, Oscillator{2.0, 0.01});
  EXPECT_FALSE(find_settling_time(t, x));
  EXPECT_FALSE(find_settling_time(t, std::vector<double>(1001, 1.0)));
  EXPECT_FALSE(find_settling_time({}, {}));
}

// The damped frequency: sqrt(1 - zeta^2) omega. Damping moves the top of the
// spectrum by a fraction zeta^2, and the two sides of it overlap at 1 / T.
TEST(DominantFrequency, OfADampedOscillatorIsItsOwn) {
  for (const double hertz : {3.0, 17.3}) {
    const double zeta = 0.01;
    const Oscillator o{2.0 * std::numbers::pi * hertz, zeta, 4.0, -2.0};
    const auto [t, x] =
        sample(1.0, 5.0, 801, [&](double s) { return o(s - 1.0); });
    EXPECT_NEAR(*find_dominant_frequency(t, x), hertz, 0.005 * hertz);
  }
}

TEST(DominantFrequency, IsThatOfTheLargestOfTwoSinesOnASlope) {
  const auto [t, x] = sample(0.0, 10.0, 2001, [](double s) {
    return 7.0 - 30.0 * s + 2.0 * std::sin(2.0 * M_PI * 4.37 * s) +
           std::sin(2.0 * M_PI * 9.0 * s);
  });
  EXPECT_NEAR(*find_dominant_frequency(t, x), 4.37, 1e-3);
}

TEST(DominantFrequency, IsNoneWithoutOscillation) {
  const auto [t, x] = sample(0.0, 1.0, 101, [](double) { return 3.0; });
  EXPECT_FALSE(find_dominant_frequency(t, x));
  auto uneven = t;
  uneven[50] += 1e-3;
  EXPECT_FALSE(find_dominant_frequency(uneven, x));
}

TEST(LargestDerivative, OfASineIsItsAmplitudeByItsFrequency) {
  const double w = 5.0;
  const auto [t, x] =
      sample(0.0, 10.0, 10001, [&](double s) { return 0.3 * std::sin(w * s); });
  const double fraction = (w * 1e-3) * (w * 1e-3);
  EXPECT_NEAR(*find_largest_derivative(t, x, 1), 0.3 * w, 0.3 * w * fraction);
  EXPECT_NEAR(*find_largest_derivative(t, x, 2), 0.3 * w * w,
              0.3 * w * w * fraction);
}

}  // namespace
}  // namespace limber::study::curve_measures_test
