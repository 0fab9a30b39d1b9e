// SPDX-License-Identifier: BSD-3-Clause
// Counts every heap allocation of the program, so it has an executable's
// worth of malloc of its own; not built under sanitizers, which replace it too.
#include <gtest/gtest.h>

#include "limber/dynamics/integrators/energy_conserving.hpp"
#include "limber/dynamics/integrators/generalized_alpha.hpp"
#include "limber/dynamics/integrators/runge_kutta.hpp"
#include "limber/dynamics/integrators/splitting.hpp"
#include "support/chain.hpp"

extern "C" {
void* __libc_malloc(std::size_t size);                       // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);    // NOLINT
void* __libc_realloc(void* old, std::size_t size);           // NOLINT
void* __libc_memalign(std::size_t align, std::size_t size);  // NOLINT
}

namespace {
long allocations = 0;
}

extern "C" {
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t align, std::size_t size) {
  ++allocations;
  return __libc_memalign(align, size);
}
}

namespace limber::dynamics {
namespace {

SystemModel loaded_chain(SystemState& state) {
  testing::Chain chain = testing::make_chain(
      {.bodies = 5, .modes = 20, .joint = joints::JointKind::revolute});
  chain.builder.add_load("push", chain.last_interfaces.back(), {0, 50, 5},
                         {1, 0, 0}, LoadFrame::body,
                         Sinusoid{.frequency = 3.0, .phase = 1.0});
  state = chain.state;
  return chain.builder.build();
}

TEST(Allocation, IsCounted) {
  const long before = allocations;
  std::vector<double>* v = new std::vector<double>(100);
  delete v;
  EXPECT_GE(allocations - before, 2);
}

TEST(Allocation, AStepOfGeneralizedAlphaMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  GeneralizedAlpha scheme(model, {});
  scheme.start(state, 1e-3);
  scheme.step(state, 1e-3, state.t + 1e-3);
  const long before = allocations;
  int factorizations = 0;
  for (int i = 0; i < 100; ++i) {
    factorizations += scheme.step(state, 1e-3, state.t + 1e-3).factorizations;
  }
  scheme.step(state, 0.5e-3, state.t + 0.5e-3);
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(factorizations, 0);
}

TEST(Allocation, AStepOfRungeKuttaMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  RungeKutta4 scheme(model);
  scheme.step(state, 1e-6, state.t + 1e-6);
  const long before = allocations;
  for (int i = 0; i < 100; ++i) scheme.step(state, 1e-6, state.t + 1e-6);
  EXPECT_EQ(allocations - before, 0);
}

TEST(Allocation, AStepOfTheEnergyConservingSchemeMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  EnergyConserving scheme(model, {});
  scheme.step(state, 1e-3, state.t + 1e-3);
  const long before = allocations;
  int factorizations = 0;
  for (int i = 0; i < 100; ++i) {
    factorizations += scheme.step(state, 1e-3, state.t + 1e-3).factorizations;
  }
  factorizations += scheme.step(state, 5e-4, state.t + 5e-4).factorizations;
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(factorizations, 0);
}

TEST(Allocation, AStepOfTheSplittingSchemeMakesNone) {
  SystemState state;
  const SystemModel model = loaded_chain(state);
  Splitting scheme(model);
  scheme.step(state, 1e-6, state.t + 1e-6);
  const long before = allocations;
  for (int i = 0; i < 100; ++i) scheme.step(state, 1e-6, state.t + 1e-6);
  scheme.step(state, 5e-7, state.t + 5e-7);
  EXPECT_EQ(allocations - before, 0);
}

}  // namespace
}  // namespace limber::dynamics
