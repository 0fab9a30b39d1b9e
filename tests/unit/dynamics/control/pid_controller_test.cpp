// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/control/pid_controller.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics::pid_controller_test {
namespace {

using ::testing::HasSubstr;

constexpr double kPeriod = 0.01;

/// What a law writes at samples 0, 1, ... of what `measure` returns at t.
std::vector<double> run(
    const PidParameters& parameters, int samples,
    const std::function<std::vector<double>(double)>& measure) {
  const PidController law(parameters);
  std::vector<double> memory = law.make_memory();
  const SystemModel model;
  SystemState state;
  std::vector<double> written;
  for (int k = 0; k < samples; ++k) {
    state.t = k * kPeriod;
    const std::vector<double> measured = measure(state.t);
    double u = 0.0;
    law.sample({state.t, k, model, state, measured}, memory, {&u, 1});
    written.push_back(u);
  }
  return written;
}

PidParameters make() { return {.proportional = 3.0, .period = kPeriod}; }

joints::Signal constant(double value) {
  return {.base = joints::ConstantSignal{value}};
}

TEST(PidController, ProportionalPartIsThatOfTheError) {
  PidParameters p = make();
  p.reference = constant(2.0);
  for (const double u : run(p, 3, [](double) { return std::vector{0.5}; })) {
    EXPECT_DOUBLE_EQ(u, 4.5);
  }
}

TEST(PidController, IntegralOfAConstantErrorGrowsByItsShareASample) {
  PidParameters p = make();
  p.proportional = 0.0;
  p.integral = 7.0;
  p.reference = constant(1.0);
  const auto u = run(p, 50, [](double) { return std::vector{0.25}; });
  for (std::size_t k = 0; k < u.size(); ++k) {
    EXPECT_NEAR(u[k], 7.0 * 0.75 * kPeriod * static_cast<double>(k + 1), 1e-12);
  }
}

TEST(PidController, DerivativeIsThatOfTheReferenceLessThatOfTheMeasurement) {
  PidParameters p = make();
  p.proportional = 0.0;
  p.derivative = 2.0;
  p.reference = {.base = joints::RampSignal{.to = 5.0, .duration = 1.0}};
  const auto u = run(p, 4, [](double t) { return std::vector{3.0 * t}; });
  EXPECT_NEAR(u[0], 2.0 * 5.0, 1e-12);  // no difference yet
  EXPECT_NEAR(u[1], 2.0 * (5.0 - 3.0), 1e-12);
  EXPECT_NEAR(u[3], 2.0 * (5.0 - 3.0), 1e-12);
}

TEST(PidController, MeasuredRateTakesThePlaceOfDifferences) {
  PidParameters p = make();
  p.proportional = 0.0;
  p.derivative = 2.0;
  p.has_rate = true;
  for (const double u : run(p, 3, [](double t) {
         return std::vector{t * t, -4.0};
       })) {
    EXPECT_DOUBLE_EQ(u, 8.0);
  }
}

// The step response of a low-pass filter of first order, exact at samples.
TEST(PidController, FilterHasTheExponentialStepResponse) {
  PidParameters p = make();
  p.proportional = -1.0;
  p.filter_time = 0.037;
  const auto u =
      run(p, 40, [](double t) { return std::vector{t > 0.0 ? 1.0 : 0.0}; });
  for (std::size_t k = 0; k < u.size(); ++k) {
    EXPECT_NEAR(u[k], 1.0 - std::exp(-static_cast<double>(k) * kPeriod / 0.037),
                1e-13);
  }
}

TEST(PidController, DelayShiftsWhatIsWrittenByWholeSamples) {
  PidParameters p = make();
  p.initial = 0.125;
  const auto measure = [](double t) { return std::vector{std::sin(30.0 * t)}; };
  const auto now = run(p, 20, measure);
  p.delay = 3;
  const auto later = run(p, 20, measure);
  for (std::size_t k = 0; k < later.size(); ++k) {
    EXPECT_EQ(later[k], k < 3 ? 0.125 : now[k - 3]);
  }
}

TEST(PidController, IntegralDoesNotGrowWhileALimitHoldsTheOutput) {
  PidParameters p = make();
  p.integral = 100.0;
  p.lower = -1.0;
  p.upper = 2.0;
  // An error of 1 for a second, which an unbounded integral takes to 100, then
  // of -0.1: at 100 / s it would take ten seconds to come back.
  const auto u =
      run(p, 130, [](double t) { return std::vector{t < 0.995 ? -1.0 : 0.1}; });
  EXPECT_EQ(u[99], 2.0);
  EXPECT_LT(u[101], 0.0);
  EXPECT_EQ(u[129], -1.0);
}

TEST(PidController, RefusesWhatItCannotDo) {
  const auto error = [](const std::function<void(PidParameters&)>& change) {
    PidParameters p = make();
    change(p);
    try {
      (void)PidController(p);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error([](PidParameters&) {}), "");
  EXPECT_THAT(error([](auto& p) { p.proportional = 0.0; }),
              HasSubstr("no gain"));
  EXPECT_THAT(error([](auto& p) { p.derivative = std::nan(""); }),
              HasSubstr("'derivative'"));
  EXPECT_THAT(error([](auto& p) { p.filter_time = -1.0; }),
              HasSubstr("filter"));
  EXPECT_THAT(error([](auto& p) { p.lower = p.upper = 1.0; }),
              HasSubstr("limits"));
  EXPECT_THAT(error([](auto& p) { p.upper = std::nan(""); }),
              HasSubstr("limits"));
  EXPECT_THAT(error([](auto& p) { p.upper = -1.0; }), HasSubstr("initial"));
  EXPECT_THAT(error([](auto& p) { p.period = 0.0; }), HasSubstr("period"));
}

}  // namespace
}  // namespace limber::dynamics::pid_controller_test
