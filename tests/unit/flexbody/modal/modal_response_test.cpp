// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/modal_response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "unit/flexbody/modal/modal_cases.hpp"

namespace limber::flexbody::test::modal_response_test {
namespace {

constexpr double kPi = std::numbers::pi;

double find_difference(const ModalHistory& a, const ModalHistory& b) {
  return std::max((a.eta - b.eta).cwiseAbs().maxCoeff(),
                  (a.etadot - b.etadot).cwiseAbs().maxCoeff());
}

// Classic Runge-Kutta in long double between two times without a load change:
// an independent reference with error O(h^4), below 1e-13 at this step.
void integrate(const Modes& modes, const ModalLoads& loads, double from,
               double until, ModalHistory& state) {
  const int steps = std::max(1, static_cast<int>((until - from) / 5e-4));
  const long double h = (static_cast<long double>(until) - from) / steps;
  for (Eigen::Index k = 0; k < modes.lambda.size(); ++k) {
    long double x = state.eta(k, 0);
    long double v = state.etadot(k, 0);
    const double held =
        find_load(loads, k, 0.5 * (from + until)) -
        find_load({{}, loads.sinusoids}, k, 0.5 * (from + until));
    ModalLoads smooth = loads;
    smooth.steps = {};
    std::erase_if(smooth.sinusoids, [&](const SinusoidalLoad& s) {
      return s.from >= until || s.until <= from;
    });
    for (SinusoidalLoad& s : smooth.sinusoids) s.until = 1e300;
    const auto acceleration = [&](double t, long double y, long double w) {
      return held + find_load(smooth, k, t) - modes.damping[k] * w -
             modes.lambda[k] * y;
    };
    for (int i = 0; i < steps; ++i) {
      const double t = static_cast<double>(from + h * i);
      const double mid = static_cast<double>(from + h * (i + 0.5L));
      const double end = static_cast<double>(from + h * (i + 1));
      const long double a1 = acceleration(t, x, v);
      const long double v2 = v + 0.5L * h * a1;
      const long double a2 = acceleration(mid, x + 0.5L * h * v, v2);
      const long double v3 = v + 0.5L * h * a2;
      const long double a3 = acceleration(mid, x + 0.5L * h * v2, v3);
      const long double v4 = v + h * a3;
      const long double a4 = acceleration(end, x + h * v3, v4);
      x += h / 6.0L * (v + 2.0L * v2 + 2.0L * v3 + v4);
      v += h / 6.0L * (a1 + 2.0L * a2 + 2.0L * a3 + a4);
    }
    state.eta(k, 0) = static_cast<double>(x);
    state.etadot(k, 0) = static_cast<double>(v);
  }
}

TEST(ModalResponse, AgreesWithSmallStepsForEveryKindOfModeAndLoad) {
  const Modes modes;
  const ModalLoads loads = make_loads();
  const ModalState start = make_state();
  const ModalResponse response(modes.lambda, modes.damping, loads, start);
  ModalHistory state{start.eta, start.etadot};
  double last = start.time;
  for (const double t : {0.4, 0.5, 0.53, 0.7, 1.2, 1.9, 3.1, 4.0, 5.5}) {
    integrate(modes, loads, last, t, state);
    EXPECT_LT(find_difference(response.evaluate({t}), state), 2e-11) << t;
    last = t;
  }
}

TEST(ModalResponse, StartsAtTheInitialState) {
  const Modes modes;
  const ModalState start = make_state();
  const ModalHistory first =
      ModalResponse(modes.lambda, modes.damping, make_loads(), start)
          .evaluate({start.time});
  EXPECT_EQ(first.eta, start.eta);
  EXPECT_EQ(first.etadot, start.etadot);
}

TEST(ModalResponse, AtRestWithoutLoadStaysAtRest) {
  const Modes modes;
  const ModalHistory history =
      ModalResponse(modes.lambda, modes.damping, {}, {}).evaluate({0.0, 9.0});
  EXPECT_EQ(history.eta, MatrixX::Zero(6, 2));
  EXPECT_EQ(history.etadot, MatrixX::Zero(6, 2));
}

TEST(ModalResponse, OrderOfTimesDoesNotMatterToTheLastBit) {
  const Modes modes;
  const ModalResponse response(modes.lambda, modes.damping, make_loads(),
                               make_state());
  std::vector<double> times = make_grid(0.25, 6.0, 100);
  times.insert(times.end(), {0.5, 0.53, 1.9, 3.1, 4.0});
  std::sort(times.begin(), times.end());
  const ModalHistory sorted = response.evaluate(times);
  std::vector<Eigen::Index> order(times.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = static_cast<Eigen::Index>(i);
  std::mt19937 random(3);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<double> shuffled;
  for (const Eigen::Index i : order)
    shuffled.push_back(times[static_cast<std::size_t>(i)]);
  const ModalHistory history = response.evaluate(shuffled);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    EXPECT_EQ(history.eta.col(column), sorted.eta.col(order[i]));
    EXPECT_EQ(history.etadot.col(column), sorted.etadot.col(order[i]));
  }
}

TEST(ModalResponse, IsTheSumOfItsCauses) {
  const Modes modes;
  const ModalLoads loads = make_loads();
  const ModalState start = make_state();
  const std::vector<double> times = make_grid(0.25, 6.0, 57);
  const auto solve = [&](const ModalLoads& part, const ModalState& state) {
    return ModalResponse(modes.lambda, modes.damping, part, state)
        .evaluate(times);
  };
  const ModalState rest{start.time, {}, {}};
  const ModalHistory whole = solve(loads, start);
  ModalHistory sum = solve({}, start);
  for (const ModalLoads& part :
       {ModalLoads{loads.steps, {}}, ModalLoads{{}, {loads.sinusoids[0]}},
        ModalLoads{{}, {loads.sinusoids[1]}}}) {
    const ModalHistory more = solve(part, rest);
    sum.eta += more.eta;
    sum.etadot += more.etadot;
  }
  EXPECT_LT(find_difference(whole, sum), 100.0 * kEps);
}

TEST(ModalResponse, ShiftingAllTimesShiftsTheResponse) {
  const Modes modes;
  const double shift = 1024.0;  // exact in these times' last digits but a few
  ModalLoads later = make_loads();
  for (double& t : later.steps.times) t += shift;
  for (SinusoidalLoad& s : later.sinusoids) {
    s.from += shift;
    s.until += shift;
  }
  ModalState start = make_state();
  const ModalResponse response(modes.lambda, modes.damping, make_loads(),
                               start);
  start.time += shift;
  const ModalResponse shifted(modes.lambda, modes.damping, later, start);
  std::vector<double> times = make_grid(0.25, 6.0, 57);
  const ModalHistory history = response.evaluate(times);
  for (double& t : times) t += shift;
  // Times are rounded to shift eps; speeds of phases and states up to 11.
  EXPECT_LT(find_difference(history, shifted.evaluate(times)),
            200.0 * shift * kEps);
}

TEST(ModalResponse, DividingAnIntervalChangesNothing) {
  const Modes modes;
  StepLoad fine{{}, MatrixX(6, 2000)};
  const StepLoad coarse{{0.0}, make_steps(6).values.col(1)};
  double t = 0.0;
  for (Eigen::Index j = 0; j < 2000; ++j) {
    fine.times.push_back(t);
    fine.values.col(j) = coarse.values;
    t += j % 3 == 0 ? 1e-5 : 0.004;
  }
  const ModalState start{0.0, make_state().eta, make_state().etadot};
  const std::vector<double> times{0.1, 1.0, t, t + 3.0};
  const ModalResponse one(modes.lambda, modes.damping, {coarse, {}}, start);
  const ModalResponse many(modes.lambda, modes.damping, {fine, {}}, start);
  const ModalHistory history = one.evaluate(times);
  EXPECT_LT(find_difference(history, many.evaluate(times)),
            2000.0 * kEps * history.eta.cwiseAbs().maxCoeff());
}

// A response stores its intervals only: no time steps.
TEST(ModalResponse, KeepsOneStatePerLoadChangeWhateverTheDuration) {
  const Modes modes;
  StepLoad steps = make_steps(6);
  for (const double duration : {1.0, 1e9}) {
    steps.times.back() = 3.0 + duration;
    const ModalResponse response(modes.lambda, modes.damping, {steps, {}}, {});
    EXPECT_EQ(response.interval_starts(),
              (std::vector<double>{0.0, 0.5, 0.53, 1.9, 3.0 + duration}));
  }
}

TEST(ModalResponse, LoadsBeforeTheStartCountAsTheyAreThen) {
  const SinusoidalLoad early{2.0, make_vector({0.0}), make_vector({1.0}), 1.0,
                             1e300};
  const SinusoidalLoad cut{2.0, make_vector({std::sin(8.0)}),
                           make_vector({std::cos(8.0)}), 5.0, 1e300};
  SinusoidalLoad over = early;
  over.until = 4.5;
  const StepLoad past{{1.0, 2.0}, MatrixX{{7.0, 3.0}}};
  const StepLoad present{{5.0}, MatrixX{{3.0}}};
  const VectorX lambda = make_vector({4.0});
  const VectorX damping = make_vector({0.1});
  const ModalState start{5.0, {}, {}};
  const std::vector<double> times = make_grid(5.0, 20.0, 40);
  const ModalHistory a =
      ModalResponse(lambda, damping, {past, {early, over}}, start)
          .evaluate(times);
  const ModalHistory b =
      ModalResponse(lambda, damping, {present, {cut}}, start).evaluate(times);
  EXPECT_LT(find_difference(a, b), 100.0 * kEps);
}

TEST(ModalResponse, ASinusoidOfZeroFrequencyIsAConstantLoad) {
  const Modes modes;
  const VectorX f = make_steps(6).values.col(0);
  const SinusoidalLoad slow{.omega = 0.0, .cosine = f, .sine = f};
  const StepLoad constant{{0.0}, f};
  const std::vector<double> times = make_grid(0.0, 9.0, 40);
  const ModalHistory a =
      ModalResponse(modes.lambda, modes.damping, {{}, {slow}}, {})
          .evaluate(times);
  const ModalHistory b =
      ModalResponse(modes.lambda, modes.damping, {constant, {}}, {})
          .evaluate(times);
  EXPECT_LT(find_difference(a, b), 32.0 * kEps * a.eta.cwiseAbs().maxCoeff());
}

// Equation 37 of the report: eta'' + omega^2 eta = cos(omega_F t), from rest.
class Equation37 : public ::testing::TestWithParam<double> {
 protected:
  static constexpr double kOmega = 1096.0;
  static constexpr double kDuration = 0.1;

  [[nodiscard]] static double find_truth(double omega_F, double t) {
    if (omega_F == kOmega) return t / (2.0 * kOmega) * std::sin(kOmega * t);
    return (std::cos(omega_F * t) - std::cos(kOmega * t)) /
           (kOmega * kOmega - omega_F * omega_F);
  }
  // Largest error relative to the largest value.
  [[nodiscard]] static double find_error(const ModalLoads& loads,
                                         double omega_F) {
    const std::vector<double> times = make_grid(0.0, kDuration, 997);
    const ModalResponse response(make_vector({kOmega * kOmega}),
                                 make_vector({0.0}), loads, {});
    const MatrixX eta = response.evaluate(times).eta;
    double error = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double truth = find_truth(omega_F, times[i]);
      error = std::max(error,
                       std::abs(eta(0, static_cast<Eigen::Index>(i)) - truth));
      scale = std::max(scale, std::abs(truth));
    }
    return error / scale;
  }
  [[nodiscard]] static StepLoad sample(double omega_F, int per_period) {
    const double h = 2.0 * kPi / omega_F / per_period;
    const int n = static_cast<int>(kDuration / h) + 1;
    StepLoad steps{{}, MatrixX(1, n)};
    for (int j = 0; j < n; ++j) {
      steps.times.push_back(h * j);
      steps.values(0, j) = std::cos(omega_F * h * (j + 0.5));
    }
    return steps;
  }
};

TEST_P(Equation37, MidPointStepsConvergeAtSecondOrder) {
  double coarse = find_error({sample(GetParam(), 32), {}}, GetParam());
  for (const int per_period : {64, 128, 256, 512}) {
    const double fine =
        find_error({sample(GetParam(), per_period), {}}, GetParam());
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << per_period;
    coarse = fine;
  }
  EXPECT_LT(coarse, 1e-4);
}

TEST_P(Equation37, TheSinusoidIsExactToRoundOff) {
  const SinusoidalLoad load{.omega = GetParam(),
                            .cosine = make_vector({1.0}),
                            .sine = make_vector({0.0})};
  EXPECT_LT(find_error({{}, {load}}, GetParam()),
            8.0 * kEps * (1.0 + kOmega * kDuration));
}

INSTANTIATE_TEST_SUITE_P(Frequencies, Equation37,
                         ::testing::Values(400.0, 1096.0));

TEST(ModalResponse, PhaseOverAMillionPeriodsIsExactToItsRoundOff) {
  const double omega = 1096.0;
  const SinusoidalLoad load{
      .omega = 400.0, .cosine = make_vector({1.0}), .sine = make_vector({0.0})};
  const ModalResponse response(make_vector({omega * omega}), make_vector({0.0}),
                               {{}, {load}}, {});
  const double scale = 2.0 / (omega * omega - 400.0 * 400.0);
  for (const double t : {5732.1, 5732.1003, 5732.104}) {
    const long double exact = t;
    const long double truth =
        (std::cos(400.0L * exact) - std::cos(1096.0L * exact)) /
        (1096.0L * 1096.0L - 400.0L * 400.0L);
    EXPECT_NEAR(response.evaluate({t}).eta(0, 0), static_cast<double>(truth),
                kEps * omega * t * scale);
  }
}

}  // namespace
}  // namespace limber::flexbody::test::modal_response_test
