// SPDX-License-Identifier: BSD-3-Clause
// Couplers of any stiffness at a step that does not resolve them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/chain.hpp"
#include "unit/dynamics/simulation/simulation_outcome.hpp"

namespace limber::dynamics::stiff_coupler_test {
namespace {

using joints::JointKind;
using test::Outcome;
using test::run;
using testing::Chain;
using testing::make_chain;

class StiffCouplers : public ::testing::TestWithParam<double> {};

TEST_P(StiffCouplers, DoNotDictateTheStep) {
  Chain chain = make_chain(
      {.bodies = 4, .stiffness = GetParam(), .joint = JointKind::revolute});
  chain.builder.add_load("hit", chain.last_interfaces.back(), {0, 100, 10},
                         Vector3::Zero(), LoadFrame::world,
                         Pulse{PulseShape::rectangular, 0.1, 0.01});
  const SystemModel model = chain.builder.build();
  const Outcome r = run(model, chain.state,
                        {.end_time = 1.0, .step = 1e-3, .output_times = {1.0}});
  EXPECT_LE(static_cast<double>(r.statistics.newton_iterations),
            4.0 * static_cast<double>(r.statistics.steps));
  const Vector3 impulse = 0.01 * Vector3(0, 100, 10);
  EXPECT_LT((r.energies.back().linear_momentum - impulse).norm(),
            1e-6 * impulse.norm());
  // Energy cannot exceed what the load put in.
  EXPECT_LT(r.energies.back().total(), 1.01 * r.energies.back().work);
}

INSTANTIATE_TEST_SUITE_P(FromSoftToRigid, StiffCouplers,
                         ::testing::Values(1e5, 1e7, 1e9, 1e11, 1e13));

TEST(Simulation, HingesConvergeAtFirstOrderInCompliance) {
  // Tip position after a fixed time tends to a limit as 1/k.
  std::vector<Vector3> tips;
  for (const double k : {1e6, 1e7, 1e8}) {
    Chain chain = make_chain({.bodies = 3,
                              .stiffness = k,
                              .joint = JointKind::revolute,
                              .fidelity = Fidelity::rigid});
    chain.builder.add_load("push", chain.last_interfaces.back(), {0, 4, 1},
                           Vector3::Zero(), LoadFrame::world,
                           Pulse{PulseShape::half_sine, 0.0, 0.5});
    const SystemModel model = chain.builder.build();
    SystemState state = chain.state;
    simulate(model, state, {.end_time = 1.0, .step = 1e-3, .output_times = {}},
             {});
    tips.push_back(state.bodies[2].p_WB);
  }
  const double ratio = (tips[1] - tips[0]).norm() / (tips[2] - tips[1]).norm();
  EXPECT_NEAR(std::log10(ratio), 1.0, 0.1);
}

}  // namespace
}  // namespace limber::dynamics::stiff_coupler_test
