// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/modal_response.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "common/errors.hpp"

namespace limber::flexbody::test {
namespace {

using ::testing::HasSubstr;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = std::numbers::pi;

VectorX make_vector(std::initializer_list<double> values) {
  VectorX vector(std::ssize(values));
  std::copy(values.begin(), values.end(), vector.data());
  return vector;
}

std::vector<double> make_grid(double from, double until, int intervals) {
  std::vector<double> times;
  for (int i = 0; i <= intervals; ++i)
    times.push_back(from + (until - from) * i / intervals);
  return times;
}

// One mode of each kind: free, damped free, undamped, under-, critically and
// over-damped.
struct Modes {
  VectorX lambda = make_vector({0.0, 0.0, 9.0, 16.0, 25.0, 4.0});
  VectorX damping = make_vector({0.0, 0.5, 0.0, 0.3, 10.0, 7.0});
};

ModalState make_state() {
  return {0.25, make_vector({0.1, -0.2, 0.3, 0.5, -0.4, 0.6}),
          make_vector({1.0, 0.4, -0.7, 0.2, 0.9, -1.1})};
}

StepLoad make_steps(Eigen::Index modes) {
  StepLoad steps{{-1.0, 0.5, 0.53, 1.9, 4.0}, MatrixX(modes, 5)};
  for (Eigen::Index k = 0; k < modes; ++k)
    for (Eigen::Index j = 0; j < 5; ++j)
      steps.values(k, j) = std::sin(1.0 + 3.0 * static_cast<double>(k) +
                                    7.0 * static_cast<double>(j));
  return steps;
}

SinusoidalLoad make_sinusoid(double omega, double from, double until) {
  return {omega, make_vector({0.3, -0.5, 1.0, 0.2, 0.8, -0.9}),
          make_vector({1.0, 0.7, -0.1, 0.6, 0.3, 0.2}), from, until};
}

ModalLoads make_loads() {
  // 3 rad/s is the undamped mode's own frequency.
  return {make_steps(6),
          {make_sinusoid(3.0, 0.7, 3.1), make_sinusoid(11.0, -2.0, 1e300)}};
}

double find_difference(const ModalHistory& a, const ModalHistory& b) {
  return std::max((a.eta - b.eta).cwiseAbs().maxCoeff(),
                  (a.etadot - b.etadot).cwiseAbs().maxCoeff());
}

// The load as a function, written independently of the response.
double find_load(const ModalLoads& loads, Eigen::Index k, double t) {
  double f = 0.0;
  for (std::size_t j = 0; j < loads.steps.times.size(); ++j)
    if (loads.steps.times[j] <= t)
      f = loads.steps.values(k, static_cast<Eigen::Index>(j));
  for (const SinusoidalLoad& s : loads.sinusoids)
    if (t >= s.from && t < s.until)
      f += s.cosine[k] * std::cos(s.omega * (t - s.from)) +
           s.sine[k] * std::sin(s.omega * (t - s.from));
  return f;
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

// The number of intervals is all that a response keeps: no time steps.
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
    // Not because nothing moves.
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

TEST(ModalResponse, StepWorkCountsTheMotionThatSinusoidsCause) {
  const Modes modes;
  const ModalLoads loads = make_loads();
  const ModalResponse response(modes.lambda, modes.damping, loads,
                               make_state());
  const double end = 5.5;
  const std::vector<double> breaks{0.25, 0.5, 0.53, 0.7, 1.9, 3.1, 4.0, end};
  const MatrixX work = response.evaluate_step_work({end});
  for (Eigen::Index k = 0; k < 6; ++k) {
    double power = 0.0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      power += integrate_gauss(
          [&](double t) {
            return find_load({loads.steps, {}}, k, t) *
                   response.evaluate({t}).etadot(k, 0);
          },
          breaks[i], breaks[i + 1], 16);
    EXPECT_NEAR(work(k, 0), power, 1e-12) << k;
  }
}

// A difference of eta would leave no digit of this work.
TEST(ModalResponse, WorkOfAShortIntervalKeepsItsDigits) {
  const double h = 1e-14;
  const ModalResponse response(make_vector({4.0}), make_vector({0.0}),
                               {{{0.0, h}, MatrixX{{3.0, 0.0}}}, {}},
                               {0.0, make_vector({100.0}), make_vector({2.0})});
  EXPECT_NEAR(response.calc_interval_work()(0, 0) / (3.0 * 2.0 * h), 1.0,
              4.0 * kEps + 100.0 * h);
}

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

std::string find_refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing refused";
}

class ModalResponseRefuses : public ::testing::Test {
 protected:
  [[nodiscard]] std::string refusal() const {
    return find_refusal(
        [&] { ModalResponse(lambda, damping, loads, initial); });
  }
  VectorX lambda = make_vector({1.0, 2.0});
  VectorX damping = make_vector({0.0, 0.1});
  ModalLoads loads{{{0.0, 1.0}, MatrixX::Ones(2, 2)},
                   {{.omega = 1.0,
                     .cosine = make_vector({1.0, 1.0}),
                     .sine = make_vector({1.0, 1.0})}}};
  ModalState initial;
};

TEST_F(ModalResponseRefuses, NothingWhenAllIsWell) {
  EXPECT_EQ(refusal(), "nothing refused");
}

TEST_F(ModalResponseRefuses, CoefficientsThatAreNegativeOrNotFinite) {
  lambda[1] = -1e-9;
  damping[0] = kNan;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("lambda of mode 1 is -1e-09 rad^2/s^2"));
  EXPECT_THAT(text, HasSubstr("damping of mode 0 is nan 1/s"));
}

TEST_F(ModalResponseRefuses, AsManyDampingsAsAreNotEigenvalues) {
  damping = make_vector({0.1});
  EXPECT_THAT(refusal(), HasSubstr("2 eigenvalues but 1 damping"));
}

TEST_F(ModalResponseRefuses, InitialStatesOfOtherSizeOrNotFinite) {
  initial.eta = make_vector({1.0});
  initial.etadot = make_vector({1.0, kNan});
  initial.time = kNan;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("initial eta has 1 entries"));
  EXPECT_THAT(text, HasSubstr("initial etadot is not finite"));
  EXPECT_THAT(text, HasSubstr("initial time is not finite"));
}

TEST_F(ModalResponseRefuses, StepTimesThatDoNotIncrease) {
  loads.steps.times[1] = 0.0;
  EXPECT_THAT(refusal(), HasSubstr("time 1 is 0 s after 0 s"));
}

TEST_F(ModalResponseRefuses, StepsThatAreNotFinite) {
  loads.steps.times[0] = kNan;
  loads.steps.values(1, 1) = kNan;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("step load: time 0 is not finite"));
  EXPECT_THAT(text, HasSubstr("a value at time 1 is not finite"));
}

TEST_F(ModalResponseRefuses, StepsOfOtherSize) {
  loads.steps.values = MatrixX::Ones(3, 2);
  EXPECT_THAT(refusal(), HasSubstr("values are 3 x 2"));
  loads.steps.values = MatrixX::Ones(2, 3);
  EXPECT_THAT(refusal(), HasSubstr("values are 2 x 3"));
}

TEST_F(ModalResponseRefuses, SinusoidsWithoutAFrequencyOrATime) {
  loads.sinusoids[0].omega = -1.0;
  loads.sinusoids[0].until = 0.0;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("sinusoid 0: frequency is -1 rad/s"));
  EXPECT_THAT(text, HasSubstr("from 0 s until 0 s"));
}

TEST_F(ModalResponseRefuses, SinusoidsOfOtherSizeOrNotFinite) {
  loads.sinusoids[0].sine = make_vector({1.0});
  loads.sinusoids[0].cosine[1] = kNan;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("2 cosine and 1 sine amplitudes"));
  EXPECT_THAT(text, HasSubstr("an amplitude is not finite"));
}

TEST_F(ModalResponseRefuses, TimesBeforeTheStartOrNotFinite) {
  const ModalResponse response(lambda, damping, loads, initial);
  for (const double t : {-0.1, kNan}) {
    EXPECT_THROW((void)response.evaluate({0.0, t}), InputError);
    EXPECT_THROW((void)response.evaluate_energies({t}), InputError);
    EXPECT_THROW((void)response.evaluate_step_work({t}), InputError);
  }
  EXPECT_THAT(find_refusal([&] {
                (void)response.evaluate({0.0, -0.5});
              }),
              HasSubstr("time 1 is -0.5 s; expected a time from 0 s on"));
}

}  // namespace
}  // namespace limber::flexbody::test
