// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/constraint_wrenches.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/newton/velocity_terms.hpp"

namespace limber::dynamics {
namespace {

// Of a step so short that inertia alone resists [1/s^2].
constexpr double kInstant = 1e24;

}  // namespace

void set_constraint_wrenches(const SystemModel& model, SystemState& state) {
  if (!has_ideal_joints(model)) return;
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  const VectorX none = make_unknowns(model);
  VectorX residual = none;
  calc_residual(model, none, terms, residual);
  NewtonMatrix matrix(model);
  matrix.factor(model, state, terms, none, {.acceleration = kInstant}, true);
  std::vector<Vector6> gaps(model.couplers.size() + model.transmissions.size(),
                            Vector6::Zero());
  add_velocity_terms(terms, find_velocity_terms(model, state), kInstant, 0.0,
                     gaps);
  VectorX increments = none;
  matrix.solve(model, terms, residual, gaps, increments);
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    if (terms.couplers[c].ideal < 0) continue;
    const Matrix6& held =
        terms.constraints[index(terms.couplers[c].ideal)].directions;
    joints::CouplerMemory& memory = state.memory[c];
    memory.constraint_wrench =
        held * (memory.constraint_wrench + matrix.wrench_increments()[c]);
    memory.solved_wrench = memory.constraint_wrench;
    memory.solved_time = state.t;
  }
}

}  // namespace limber::dynamics
