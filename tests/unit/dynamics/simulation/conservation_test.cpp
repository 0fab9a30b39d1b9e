// SPDX-License-Identifier: BSD-3-Clause
// Momenta and energy of free and driven systems.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/chain.hpp"
#include "support/point_mass_body.hpp"
#include "unit/dynamics/simulation/simulation_outcome.hpp"

namespace limber::dynamics::conservation_test {
namespace {

using joints::JointKind;
using test::Outcome;
using test::run;
using test::sample;
using test::stir;
using testing::Chain;
using testing::make_chain;

TEST(Simulation, FreeChainKeepsItsLinearMomentumToRoundOff) {
  Chain chain = make_chain({.bodies = 10});
  stir(chain.state, 1.0, 2.0, 1.0);
  const SystemModel model = chain.builder.build();
  const Outcome r =
      run(model, chain.state,
          {.end_time = 0.5, .step = 1e-3, .output_times = sample(0.5, 50)});
  double absolute = 0.0;
  for (const BodyState& b : chain.state.bodies) {
    absolute += model.bodies[0].mass * b.v_WB_W.norm();
  }
  for (const EnergyBalance& e : r.energies) {
    EXPECT_LT((e.linear_momentum - r.energies[0].linear_momentum).norm(),
              1e-12 * absolute);
  }
}

TEST(Simulation, AngularMomentumOfAFreeChainIsKeptToSecondOrder) {
  Chain chain = make_chain({.bodies = 10, .stiffness = 1e3, .lowest = 20.0});
  stir(chain.state, 0.2, 1.0, 0.2);
  const SystemModel model = chain.builder.build();
  std::vector<double> errors;
  for (const double h : {4e-4, 2e-4, 1e-4}) {
    const Outcome r =
        run(model, chain.state,
            {.end_time = 0.1, .step = h, .output_times = {0.0, 0.1}});
    errors.push_back(
        (r.energies[1].angular_momentum - r.energies[0].angular_momentum)
            .norm() /
        r.energies[0].angular_momentum.norm());
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8);
}

TEST(RungeKutta4, TumblingFlexibleBodyKeepsMomentumAndEnergyAtFourthOrder) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(30, 6, 4.0, 1.0, 40.0, 9);
  SystemBuilder builder;
  builder.add_flexible_body("b", testing::share(body), Fidelity::coupled, {});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(5, 1, 2);
  std::vector<double> energy;
  std::vector<double> momentum;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    const Outcome r = run(model, state,
                          {.integrator = IntegratorKind::runge_kutta_4,
                           .end_time = 1.0,
                           .step = h,
                           .output_times = {0.0, 1.0}});
    energy.push_back(std::abs(r.energies[1].total() - r.energies[0].total()) /
                     r.energies[0].total());
    momentum.push_back(
        (r.energies[1].angular_momentum - r.energies[0].angular_momentum)
            .norm() /
        r.energies[0].angular_momentum.norm());
  }
  // RK4 loses the energy of an oscillator at fifth order, the rest at fourth.
  EXPECT_GT(std::log2(energy[0] / energy[1]), 3.8);
  EXPECT_GT(std::log2(energy[1] / energy[2]), 3.8);
  EXPECT_GT(std::log2(momentum[0] / momentum[1]), 3.8);
}

// The promise for the default scheme: without damping and with rho_inf = 1 the
// energy of a tumbling flexible body stays within a band that does not grow,
// over 1e5 steps of 1/20 of its shortest period.
TEST(GeneralizedAlpha, EnergyDriftOfATumblingBodyIsBoundedWithoutTrend) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(30, 10, 4.0, 1.0, 40.0, 9);
  SystemBuilder builder;
  builder.add_flexible_body("b", testing::share(body), Fidelity::coupled, {});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(5, 1, 2);
  const double shortest = 2.0 * std::numbers::pi / (40.0 * 5.5);
  const double h = shortest / 20.0;
  const double end = 1e5 * h;
  const Outcome r = run(model, state,
                        {.end_time = end,
                         .step = h,
                         .output_times = sample(end, 1000),
                         .rho_inf = 1.0});
  ASSERT_GE(r.statistics.steps, 100000);
  const auto band = [&](std::size_t from, std::size_t to) {
    double low = 1e300;
    double high = -1e300;
    for (std::size_t i = from; i < to; ++i) {
      low = std::min(low, r.energies[i].total());
      high = std::max(high, r.energies[i].total());
    }
    return std::pair{low, high};
  };
  const double total = r.energies[0].total();
  const auto [low1, high1] = band(0, 200);
  const auto [low2, high2] = band(800, 1000);
  EXPECT_LT(high1 - low1, 0.02 * total);
  // No trend: the last fifth stays in the first fifth's band, half a band
  // wider.
  const double slack = 0.5 * (high1 - low1);
  EXPECT_GT(low2, low1 - slack);
  EXPECT_LT(high2, high1 + slack);
}

TEST(Simulation, EnergyAuditClosesAtSecondOrderWithLoadsAndDampers) {
  Chain chain = make_chain({.bodies = 3,
                            .stiffness = 1e4,
                            .damping = 5.0,
                            .joint = JointKind::revolute});
  chain.builder.add_load("push", chain.last_interfaces.back(), {0, 5, 0},
                         {0.3, 0, 0}, LoadFrame::body,
                         Sinusoid{.frequency = 3.0});
  chain.builder.set_gravity({0, 0, -1.0});
  const SystemModel model = chain.builder.build();
  std::vector<double> errors;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    const Outcome r =
        run(model, chain.state,
            {.end_time = 0.5, .step = h, .output_times = {0.0, 0.5}});
    const EnergyBalance& e = r.energies.back();
    const double gap =
        e.total() - r.energies[0].total() - e.work + e.dissipated;
    EXPECT_GT(e.dissipated, 0.0);
    errors.push_back(std::abs(gap) / std::abs(e.work));
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.7);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.7);
  EXPECT_LT(errors[2], 1e-4);
}

}  // namespace
}  // namespace limber::dynamics::conservation_test
