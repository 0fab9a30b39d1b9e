// SPDX-License-Identifier: BSD-3-Clause
// Not built under sanitizers (support/allocation_count.hpp).
#include <gtest/gtest.h>

#include "limber/dynamics/integrators/energy_conserving.hpp"
#include "limber/dynamics/integrators/explicit_euler.hpp"
#include "limber/dynamics/integrators/generalized_alpha.hpp"
#include "limber/dynamics/integrators/runge_kutta.hpp"
#include "limber/dynamics/integrators/splitting.hpp"
#include "support/allocation_count.hpp"
#include "support/chain.hpp"

namespace limber::dynamics::allocation_test {
namespace {

// Bodies with Maxwell elements.
SystemModel loaded_chain(SystemState& state) {
  ModalDamping damping;
  damping.maxwell = flexbody::find_maxwell_elements(0.1, {10.0, 1e4});
  testing::Chain chain =
      testing::make_chain({.bodies = 5,
                           .modes = 20,
                           .joint = joints::JointKind::revolute,
                           .body_damping = damping});
  chain.builder.add_load("push", chain.last_interfaces.back(), {0, 50, 5},
                         {1, 0, 0}, LoadFrame::body,
                         Sinusoid{.frequency = 3.0, .phase = 1.0});
  state = chain.state;
  return chain.builder.build();
}

TEST(Allocation, IsCounted) {
  const long before = limber::testing::allocations;
  SystemState state;
  (void)loaded_chain(state);
  EXPECT_GT(limber::testing::allocations - before, 10);
}

TEST(Allocation, AStepOfGeneralizedAlphaMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  GeneralizedAlpha scheme(model, {});
  scheme.start(state, 1e-3);
  scheme.step(state, 1e-3, state.t + 1e-3);
  const long before = limber::testing::allocations;
  int factorizations = 0;
  for (int i = 0; i < 100; ++i) {
    factorizations += scheme.step(state, 1e-3, state.t + 1e-3).factorizations;
  }
  scheme.step(state, 0.5e-3, state.t + 0.5e-3);
  EXPECT_EQ(limber::testing::allocations - before, 0);
  EXPECT_GT(factorizations, 0);
}

TEST(Allocation, AStepOfRungeKuttaMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  RungeKutta4 scheme(model);
  scheme.step(state, 1e-6, state.t + 1e-6);
  const long before = limber::testing::allocations;
  for (int i = 0; i < 100; ++i) scheme.step(state, 1e-6, state.t + 1e-6);
  EXPECT_EQ(limber::testing::allocations - before, 0);
}

TEST(Allocation, AStepOfTheEnergyConservingSchemeMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  EnergyConserving scheme(model, {});
  scheme.step(state, 1e-3, state.t + 1e-3);
  const long before = limber::testing::allocations;
  int factorizations = 0;
  for (int i = 0; i < 100; ++i) {
    factorizations += scheme.step(state, 1e-3, state.t + 1e-3).factorizations;
  }
  factorizations += scheme.step(state, 5e-4, state.t + 5e-4).factorizations;
  EXPECT_EQ(limber::testing::allocations - before, 0);
  EXPECT_GT(factorizations, 0);
}

TEST(Allocation, AStepOfTheSplittingSchemeMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  Splitting scheme(model);
  scheme.step(state, 1e-6, state.t + 1e-6);
  const long before = limber::testing::allocations;
  for (int i = 0; i < 100; ++i) scheme.step(state, 1e-6, state.t + 1e-6);
  scheme.step(state, 5e-7, state.t + 5e-7);
  EXPECT_EQ(limber::testing::allocations - before, 0);
}

TEST(Allocation, AStepOfExplicitEulerMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  ExplicitEuler scheme(model);
  scheme.step(state, 1e-7, state.t + 1e-7);
  const long before = limber::testing::allocations;
  for (int i = 0; i < 100; ++i) scheme.step(state, 1e-7, state.t + 1e-7);
  scheme.step(state, 5e-8, state.t + 5e-8);
  EXPECT_EQ(limber::testing::allocations - before, 0);
}

}  // namespace
}  // namespace limber::dynamics::allocation_test
