// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/fourier.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/flexbody/modal/modal_response.hpp"

namespace limber::flexbody::test::fourier_test {
namespace {

using ::testing::HasSubstr;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kPi = std::numbers::pi;
constexpr double kPeriod = 0.8;

// A table of two rows; its truth is a sum of three harmonics.
double find_first(double t) {
  const double w = 2.0 * kPi / kPeriod;
  return 1.5 + 2.0 * std::cos(w * t) - 0.5 * std::sin(3.0 * w * t);
}
double find_second(double t) {
  const double w = 2.0 * kPi / kPeriod;
  return -0.25 + std::sin(w * t) + 0.75 * std::cos(2.0 * w * t);
}

LoadTable make_table(std::vector<double> times, double start) {
  LoadTable table{std::move(times), {}};
  table.values.resize(2, std::ssize(table.times));
  for (Eigen::Index j = 0; j < table.values.cols(); ++j) {
    const double t = table.times[static_cast<std::size_t>(j)] - start;
    table.values.col(j) << find_first(t), find_second(t);
  }
  return table;
}

std::vector<double> make_uneven_times(double start, int intervals) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  std::vector<double> times{start};
  for (int i = 1; i < intervals; ++i)
    times.push_back(start + kPeriod * (i + shift(random)) / intervals);
  times.push_back(start + kPeriod);
  return times;
}

TEST(FourierSeries, OfASumOfHarmonicsOnAnUnevenGridIsThatSum) {
  const FourierSeries series =
      fit_fourier_series(make_table(make_uneven_times(2.0, 30), 2.0), 5);
  MatrixX cosine = MatrixX::Zero(2, 6);
  MatrixX sine = MatrixX::Zero(2, 6);
  cosine.col(0) << 1.5, -0.25;
  cosine(0, 1) = 2.0;
  cosine(1, 2) = 0.75;
  sine(0, 3) = -0.5;
  sine(1, 1) = 1.0;
  EXPECT_EQ(series.start, 2.0);
  EXPECT_DOUBLE_EQ(series.period, kPeriod);
  EXPECT_LT((series.cosine - cosine).cwiseAbs().maxCoeff(), 200.0 * kEps);
  EXPECT_LT((series.sine - sine).cwiseAbs().maxCoeff(), 200.0 * kEps);
  EXPECT_LT(series.residual.maxCoeff(), 200.0 * kEps);
}

TEST(FourierSeries, OnAUniformGridIsTheDiscreteTransform) {
  const int n = 16;
  LoadTable table{{}, MatrixX(1, n + 1)};
  std::mt19937 random(8);
  std::normal_distribution<double> noise;
  for (int j = 0; j <= n; ++j) {
    table.times.push_back(0.1 * j);
    table.values(0, j) = noise(random);
  }
  table.values(0, n) = table.values(0, 0);
  const FourierSeries series = fit_fourier_series(table, 7);
  for (int k = 0; k <= 7; ++k) {
    double cosine = 0.0;
    double sine = 0.0;
    for (int j = 0; j < n; ++j) {
      const double fraction = k == 0 ? 1.0 / n : 2.0 / n;
      cosine += fraction * table.values(0, j) * std::cos(2.0 * kPi * k * j / n);
      sine += fraction * table.values(0, j) * std::sin(2.0 * kPi * k * j / n);
    }
    EXPECT_NEAR(series.cosine(0, k), cosine, 100.0 * kEps);
    EXPECT_NEAR(series.sine(0, k), sine, 100.0 * kEps);
  }
}

// The discrete transform of a ramp has closed-form remainders; in the limit,
// Parseval: the mean square beyond K is sum_{k > K} 1 / (2 pi^2 k^2).
TEST(FourierSeries, TellsHowMuchOfARampItMisses) {
  const int n = 4000;
  LoadTable table{{}, MatrixX(1, n + 1)};
  for (int j = 0; j <= n; ++j) {
    table.times.push_back(static_cast<double>(j) / n);
    table.values(0, j) = static_cast<double>(j) / n;
  }
  // Sampled, the two ends share one moment: h (1/2)^2 more than the integral.
  for (const int harmonics : {2, 8, 20}) {
    double rest = kPi * kPi / 6.0;
    for (int k = 1; k <= harmonics; ++k) rest -= 1.0 / (1.0 * k * k);
    const double truth = std::sqrt(rest / (2.0 * kPi * kPi));
    const double residual = fit_fourier_series(table, harmonics).residual[0];
    EXPECT_NEAR(residual / truth, 1.0, 0.02) << harmonics;
  }
}

TEST(FourierSeries, IsEvaluatedPeriodically) {
  const FourierSeries series =
      fit_fourier_series(make_table(make_uneven_times(0.0, 20), 0.0), 3);
  for (const double t : {-3.0, 0.0, 0.3, 0.8, 77.7}) {
    const MatrixX values = evaluate(series, {t});
    EXPECT_NEAR(values(0, 0), find_first(t), 1e-13) << t;
    EXPECT_NEAR(values(1, 0), find_second(t), 1e-13) << t;
  }
}

// A mode without stiffness or damping integrates its load twice.
TEST(FourierSeries, DrivesModesAsItsSum) {
  const double start = 1.0;
  const double until = 1.0 + 2.5 * kPeriod;
  const FourierSeries series =
      fit_fourier_series(make_table(make_uneven_times(start, 20), start), 3);
  const ModalResponse response(VectorX::Zero(2), VectorX::Zero(2),
                               {{}, make_sinusoids(series, until)}, {});
  const double w = 2.0 * kPi / kPeriod;
  const auto first_speed = [&](double t) {
    return 1.5 * t + 2.0 / w * std::sin(w * t) +
           (std::cos(3.0 * w * t) - 1.0) / (6.0 * w);
  };
  const MatrixX etadot =
      response.evaluate({0.5, start + 1.3, until, until + 4.0}).etadot;
  EXPECT_EQ(etadot(0, 0), 0.0);
  EXPECT_NEAR(etadot(0, 1), first_speed(1.3), 1e-13);
  EXPECT_NEAR(etadot(0, 2), first_speed(2.5 * kPeriod), 1e-13);
  EXPECT_NEAR(etadot(0, 3), first_speed(2.5 * kPeriod), 1e-13);
}

std::string find_refusal(const LoadTable& table, int harmonics) {
  try {
    (void)fit_fourier_series(table, harmonics);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing refused";
}

TEST(FourierSeries, RefusesTimesThatDoNotIncreaseOrAreNotFinite) {
  LoadTable table = make_table({0.0, 0.2, 0.2, 0.8}, 0.0);
  EXPECT_THAT(find_refusal(table, 1), HasSubstr("time 2 is 0.2 s after 0.2 s"));
  table.times[2] = std::nan("");
  EXPECT_THAT(find_refusal(table, 1), HasSubstr("time 2 is not finite"));
}

TEST(FourierSeries, RefusesValuesThatAreNotFiniteOrOfOtherSize) {
  LoadTable table = make_table({0.0, 0.2, 0.5, 0.8}, 0.0);
  table.values(1, 3) = std::nan("");
  EXPECT_THAT(find_refusal(table, 1), HasSubstr("a value at time 3"));
  table.values = MatrixX::Ones(2, 3);
  EXPECT_THAT(find_refusal(table, 1), HasSubstr("4 times but 3 columns"));
}

TEST(FourierSeries, RefusesMoreHarmonicsThanTheTableDetermines) {
  const LoadTable table = make_table({0.0, 0.2, 0.5, 0.8}, 0.0);
  EXPECT_EQ(find_refusal(table, 1), "nothing refused");
  EXPECT_THAT(find_refusal(table, 2), HasSubstr("cannot determine 2"));
  EXPECT_THAT(find_refusal(table, -1), HasSubstr("cannot determine -1"));
  EXPECT_THAT(find_refusal({{1.0}, MatrixX::Ones(1, 1)}, 0),
              HasSubstr("1 times; expected at least 2"));
}

TEST(FourierSeries, RefusesAGapThatHidesItsHarmonics) {
  std::vector<double> times;
  for (int i = 0; i < 30; ++i) times.push_back(0.001 * i);
  times.push_back(kPeriod);
  EXPECT_THAT(find_refusal(make_table(times, 0.0), 10),
              HasSubstr("too unevenly spaced for 10 harmonics"));
}

}  // namespace
}  // namespace limber::flexbody::test::fourier_test
