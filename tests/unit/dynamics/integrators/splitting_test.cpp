// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/splitting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::splitting_test {
namespace {

std::vector<EnergyBalance> run(const SystemModel& model, SystemState& state,
                               double end, double step) {
  std::vector<EnergyBalance> energies;
  simulate(model, state,
           {.integrator = IntegratorKind::splitting,
            .end_time = end,
            .step = step,
            .output_times = {0.0, 0.5 * end, end}},
           [&](const SystemState&, const EnergyBalance& energy) {
             energies.push_back(energy);
           });
  return energies;
}

TEST(Splitting, SwingsAFreeDampedModeByItsClosedFormAtAnyStep) {
  testing::PointMassBody body =
      testing::make_point_mass_body(20, 1, 4.0, 1.0, 50.0, 1);
  body.reduced.clamped = true;
  SystemBuilder builder;
  builder.add_flexible_body("b", testing::share(body), Fidelity::coupled,
                            {.ratios = {0.02}});
  const SystemModel model = builder.build();
  for (const double step : {0.001, 0.05, 0.5}) {  // up to four periods
    SystemState state = make_state(model);
    state.etadot[0] = 1.0;
    const auto energies = run(model, state, 2.0, step);
    const double decay = 0.02 * 50.0;
    const double rate = std::sqrt(50.0 * 50.0 - decay * decay);
    EXPECT_NEAR(state.eta[0],
                std::exp(-decay * 2.0) * std::sin(rate * 2.0) / rate, 1e-14);
    EXPECT_NEAR(energies.back().dissipated, 0.5 - energies.back().total(),
                1e-13);
  }
}

// The highest mode makes 18 rad a step, nine times the limit of central
// differences; the motion that the step resolves is the rigid body's.
TEST(Splitting, IsNotLimitedByTheModesOfATumblingBody) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(30, 10, 4.0, 1.0, 3000.0, 9);
  SystemBuilder flexible;
  flexible.add_flexible_body("b", testing::share(body), Fidelity::coupled, {});
  SystemBuilder rigid;
  rigid.add_flexible_body("b", testing::share(body), Fidelity::rigid, {});
  const SystemModel model = flexible.build();
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(5, 1, 2);
  const auto energies = run(model, state, 2.0, 1.1e-3);
  EXPECT_NEAR(energies[2].total(), energies[0].total(),
              1e-4 * energies[0].total());

  const SystemModel stiff = rigid.build();
  SystemState reference = make_state(stiff);
  reference.bodies[0].w_WB_B = Vector3(5, 1, 2);
  simulate(stiff, reference,
           {.integrator = IntegratorKind::runge_kutta_4,
            .end_time = 2.0,
            .step = 1e-3,
            .output_times = {}},
           {});
  EXPECT_LT((state.bodies[0].w_WB_B - reference.bodies[0].w_WB_B).norm(),
            1e-3 * reference.bodies[0].w_WB_B.norm());
}

TEST(Splitting, AuditClosesAtSecondOrderWithLoadsAndDampers) {
  testing::Chain chain =
      testing::make_chain({.bodies = 3,
                           .stiffness = 1e3,
                           .damping = 2.0,
                           .joint = joints::JointKind::revolute,
                           .lowest = 20.0});
  chain.builder.add_load("push", chain.last_interfaces.back(), {0, 5, 0},
                         {0.3, 0, 0}, LoadFrame::body,
                         Sinusoid{.frequency = 3.0});
  chain.builder.set_gravity({0, 0, -1.0});
  const SystemModel model = chain.builder.build();
  std::vector<double> gaps;
  for (const double step : {2e-3, 1e-3, 5e-4}) {
    SystemState state = chain.state;
    const auto e = run(model, state, 0.5, step);
    EXPECT_GT(e[2].dissipated, 0.0);
    gaps.push_back(
        std::abs(e[2].total() - e[0].total() - e[2].work + e[2].dissipated));
  }
  EXPECT_GT(std::log2(gaps[0] / gaps[1]), 1.7);
  EXPECT_GT(std::log2(gaps[1] / gaps[2]), 1.7);
}

}  // namespace
}  // namespace limber::dynamics::splitting_test
