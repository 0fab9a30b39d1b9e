// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// The report's beam tumbles freely: ten modes, no damping, no load. What must
/// stay, stays.
namespace limber::beam_tumbling {
namespace {

using dynamics::EnergyBalance;
using dynamics::SimulationSettings;
using dynamics::SystemModel;
using dynamics::SystemState;

class TumblingBeam : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
    recipe.basis.eigenmodes = 10;
    auto body =
        std::make_shared<const flexbody::ReducedBody>(flexbody::reduce(recipe));
    dynamics::SystemBuilder builder;
    builder.add_flexible_body("beam", body, dynamics::Fidelity::coupled, {});
    model_ = std::make_unique<SystemModel>(builder.build());
  }
  static void TearDownTestSuite() { model_.reset(); }

  static SystemState initial_state() {
    SystemState state = make_state(*model_);
    state.bodies[0].w_WB_B = Vector3(30.0, 2.0, 5.0);
    return state;
  }
  static std::vector<EnergyBalance> run(const SimulationSettings& settings) {
    SystemState state = initial_state();
    std::vector<EnergyBalance> balances;
    simulate(*model_, state, settings,
             [&](const SystemState&, const EnergyBalance& balance) {
               balances.push_back(balance);
             });
    return balances;
  }
  static inline std::unique_ptr<SystemModel> model_;
};

struct Errors {
  double energy = 0.0;            ///< relative
  double angular_momentum = 0.0;  ///< relative
};

Errors compare(const EnergyBalance& now, const EnergyBalance& start) {
  return {(now.total() - start.total()) / start.total(),
          (now.angular_momentum - start.angular_momentum).norm() /
              start.angular_momentum.norm()};
}

// Energy is a quadratic invariant: the classic tableau loses it at its fifth
// power, and at no less than its fourth where rotation and modes mix.
TEST_F(TumblingBeam, KeepsEnergyToTheOrderOfRungeKutta) {
  constexpr double kEnd = 0.02;
  std::vector<double> errors;
  for (const double step : {8e-5, 4e-5, 2e-5}) {
    const auto balances =
        run({.integrator = dynamics::IntegratorKind::runge_kutta_4,
             .end_time = kEnd,
             .step = step,
             .output_times = {0.0, kEnd}});
    errors.push_back(
        std::abs(compare(balances.back(), balances.front()).energy));
  }
  EXPECT_GT(errors[0], 1e-9);  // far above round-off, or the order says nothing
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
    const double order = std::log2(errors[i] / errors[i + 1]);
    EXPECT_GT(order, 3.9);
    EXPECT_LT(order, 5.2);
  }
}

TEST_F(TumblingBeam, KeepsAngularMomentumToTwelveDigitsUnderRungeKutta) {
  constexpr double kEnd = 0.1;
  const auto balances =
      run({.integrator = dynamics::IntegratorKind::runge_kutta_4,
           .end_time = kEnd,
           .step = 2e-5,
           .output_times = {0.0, kEnd / 2, kEnd}});
  for (const EnergyBalance& balance : balances) {
    EXPECT_LT(compare(balance, balances.front()).angular_momentum, 1e-12);
  }
}

double mean(std::vector<double>::const_iterator begin,
            std::vector<double>::const_iterator end) {
  return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
}

// Steps of a twentieth of the shortest retained period, 1e5 of them: the
// error of energy stays within bounds and does not move.
TEST_F(TumblingBeam, DoesNotDriftUnderGeneralizedAlphaOver100000Steps) {
  constexpr int kSteps = 100000;
  const double step = 2.0 * std::numbers::pi /
                      std::sqrt(model_->bodies[0].reduced->lambda.maxCoeff()) /
                      20.0;
  std::vector<double> times;
  for (int i = 0; i <= kSteps; i += 50) times.push_back(i * step);
  const auto balances = run({.end_time = times.back(),
                             .step = step,
                             .output_times = times,
                             .rho_inf = 1.0});
  std::vector<double> errors;
  double elastic = 0.0;
  for (const EnergyBalance& balance : balances) {
    errors.push_back(compare(balance, balances.front()).energy);
    elastic = std::max(elastic, balance.elastic / balance.total());
    EXPECT_LT(compare(balance, balances.front()).angular_momentum, 1e-6);
  }
  const double largest = std::abs(*std::max_element(
      errors.begin(), errors.end(),
      [](double a, double b) { return std::abs(a) < std::abs(b); }));
  EXPECT_LT(largest, 1e-3 * elastic);
  const auto fifth = static_cast<std::ptrdiff_t>(errors.size() / 5);
  const double second =
      mean(errors.cbegin() + fifth, errors.cbegin() + 2 * fifth);
  const double last = mean(errors.cend() - fifth, errors.cend());
  EXPECT_LT(std::abs(last - second), 0.01 * largest);
}

}  // namespace
}  // namespace limber::beam_tumbling
