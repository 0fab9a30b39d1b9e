// SPDX-License-Identifier: BSD-3-Clause
// Energies and work of the exact modal response.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "unit/flexbody/modal/modal_cases.hpp"

namespace limber::flexbody::test::modal_energy_test {
namespace {

// Report, section 5.5.1: four steps that start and end with zero load, unit
// initial velocity.
class FourSteps : public ::testing::Test {
 protected:
  ModalResponse response_{
      make_vector({1096.0 * 1096.0}),
      make_vector({0.0}),
      {{{0.0, 0.02, 0.05, 0.08}, MatrixX{{0.0, 2e3, -1e3, 0.0}}}, {}},
      {0.0, make_vector({0.0}), make_vector({1.0})}};
};

TEST_F(FourSteps, CorrectedEnergyIsConstantOverEachStep) {
  constexpr double kTolerance = 1e-13;  // the issue's
  for (const double start : response_.interval_starts()) {
    std::vector<double> times;
    for (int i = 0; i < 200; ++i) times.push_back(start + 1e-4 * i);
    const ModalEnergies energies = response_.evaluate_energies(times);
    const MatrixX corrected = energies.corrected();
    const double scale = (energies.kinetic + energies.elastic).maxCoeff();
    EXPECT_LT(corrected.maxCoeff() - corrected.minCoeff(), kTolerance * scale);
    // Guards against zero motion.
    EXPECT_GT(energies.kinetic.maxCoeff() - energies.kinetic.minCoeff(),
              0.1 * scale);
  }
}

TEST_F(FourSteps, EnergyGrowsByTheWork) {
  const std::vector<double> times = make_grid(0.0, 0.15, 301);
  const ModalEnergies energies = response_.evaluate_energies(times);
  const MatrixX total = energies.kinetic + energies.elastic;
  const MatrixX work = response_.evaluate_step_work(times);
  const double scale = total.maxCoeff();
  EXPECT_GT(work.cwiseAbs().maxCoeff(), 0.1 * scale);
  for (Eigen::Index j = 0; j < total.cols(); ++j)
    EXPECT_NEAR(total(0, j) - 0.5, work(0, j), 1e-13 * scale);
}

// Integral of f(t) over [from, until] by 8-point Gauss-Legendre on n panels;
// nodes and weights from Abramowitz and Stegun, table 25.4.
double integrate_gauss(const std::function<double(double)>& f, double from,
                       double until, int n) {
  constexpr std::array<double, 4> x{0.183434642495650, 0.525532409916329,
                                    0.796666477413627, 0.960289856497536};
  constexpr std::array<double, 4> w{0.362683783378362, 0.313706645877887,
                                    0.222381034453374, 0.101228536290376};
  double sum = 0.0;
  const double half = 0.5 * (until - from) / n;
  for (int p = 0; p < n; ++p) {
    const double centre = from + half * (2 * p + 1);
    for (std::size_t i = 0; i < 4; ++i)
      sum += w[i] * (f(centre - half * x[i]) + f(centre + half * x[i])) * half;
  }
  return sum;
}

TEST(ModalResponse, WorkIsEnergyPlusDissipationInEveryKindOfMode) {
  const Modes modes;
  const ModalResponse response(modes.lambda, modes.damping, {make_steps(6), {}},
                               make_state());
  const std::vector<double>& starts = response.interval_starts();
  const ModalEnergies energies = response.evaluate_energies(starts);
  const MatrixX total = energies.kinetic + energies.elastic;
  const MatrixX work = response.calc_interval_work();
  const MatrixX cumulative = response.evaluate_step_work(starts);
  for (Eigen::Index k = 0; k < 6; ++k) {
    for (Eigen::Index j = 0; j + 1 < total.cols(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      const double dissipated = integrate_gauss(
          [&](double t) {
            const double v = response.evaluate({t}).etadot(k, 0);
            return modes.damping[k] * v * v;
          },
          starts[at], starts[at + 1], 16);
      // The nodes have 15 digits.
      EXPECT_NEAR(total(k, j + 1) - total(k, j) + dissipated, work(k, j), 1e-13)
          << k << ' ' << j;
      EXPECT_NEAR(cumulative(k, j + 1) - cumulative(k, j), work(k, j), 1e-14);
    }
  }
}

// A power up to each of the times, between the breaks of make_loads().
VectorX integrate_power(const std::function<double(double)>& power,
                        const std::vector<double>& times) {
  const std::vector<double> breaks{0.25, 0.5, 0.53, 0.7, 1.9, 3.1, 4.0, 9.0};
  VectorX sums = VectorX::Zero(std::ssize(times));
  for (std::size_t j = 0; j < times.size(); ++j) {
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double end = std::min(times[j], breaks[i + 1]);
      if (end <= breaks[i]) break;
      sums[static_cast<Eigen::Index>(j)] +=
          integrate_gauss(power, breaks[i], end, 16);
    }
  }
  return sums;
}

TEST(ModalResponse, StepWorkCountsTheMotionThatSinusoidsCause) {
  const Modes modes;
  const ModalLoads loads = make_loads();
  const ModalResponse response(modes.lambda, modes.damping, loads,
                               make_state());
  const double end = 5.5;
  const MatrixX work = response.evaluate_step_work({end});
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double power = integrate_power(
        [&](double t) {
          return find_load({loads.steps, {}}, k, t) *
                 response.evaluate({t}).etadot(k, 0);
        },
        {end})[0];
    EXPECT_NEAR(work(k, 0), power, 1e-12) << k;
  }
}

// Under loads: those of steps and sinusoids, steps alone, none.
class ModalLossesUnder : public ::testing::TestWithParam<ModalLoads> {};

TEST_P(ModalLossesUnder, AreTheIntegralsOfTheirPowers) {
  const Modes modes;
  const ModalLoads& loads = GetParam();
  const ModalResponse response(modes.lambda, modes.damping, loads,
                               make_state());
  const std::vector<double> times{0.25, 0.51, 0.9, 2.0, 3.5, 5.5};
  const ModalLosses losses = response.evaluate_losses(times);
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto find_rate = [&](double t) {
      return response.evaluate({t}).etadot(k, 0);
    };
    const VectorX dissipated = integrate_power(
        [&](double t) { return modes.damping[k] * std::pow(find_rate(t), 2); },
        times);
    const VectorX work = integrate_power(
        [&](double t) { return find_load(loads, k, t) * find_rate(t); }, times);
    EXPECT_LT((losses.dissipated.row(k) - dissipated.transpose()).norm(), 1e-9)
        << k;
    EXPECT_LT((losses.work.row(k) - work.transpose()).norm(), 1e-9) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Loads, ModalLossesUnder,
    ::testing::Values(make_loads(), ModalLoads{make_steps(6), {}},
                      ModalLoads{{}, {make_sinusoid(3.0, 0.7, 3.1)}},
                      ModalLoads{}));

// A difference of eta would leave no digit of this work.
TEST(ModalResponse, WorkOfAShortIntervalKeepsItsDigits) {
  const double h = 1e-14;
  const ModalResponse response(make_vector({4.0}), make_vector({0.0}),
                               {{{0.0, h}, MatrixX{{3.0, 0.0}}}, {}},
                               {0.0, make_vector({100.0}), make_vector({2.0})});
  EXPECT_NEAR(response.calc_interval_work()(0, 0) / (3.0 * 2.0 * h), 1.0,
              4.0 * kEps + 100.0 * h);
}

}  // namespace
}  // namespace limber::flexbody::test::modal_energy_test
