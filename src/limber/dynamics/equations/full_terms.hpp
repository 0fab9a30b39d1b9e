// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

/// Contributions of bodies at level `full` to the equations of motion; called
/// by dynamics/equations.
namespace limber::dynamics {

/// Runs `work`; prefixes a NumericalError of the mesh with the body's name and
/// the time [s].
template <typename Work>
auto name_failures(const SystemModel& model, const FullModel& full, double t,
                   const Work& work) {
  try {
    return work();
  } catch (const NumericalError& error) {
    throw NumericalError(
        fmt::format("body '{}' at t = {:.9g} s: {}",
                    model.bodies[static_cast<std::size_t>(full.body)].name, t,
                    error.what()));
  }
}

/// Fills `internal`, the strain energy and, if needed, the mean-axis frame.
/// @throws NumericalError naming the element, body and time if an element is
/// inverted.
void calc_full_terms(const SystemModel& model, const SystemState& state,
                     SystemTerms& terms);

/// Sets `force` to gravity and damping, and adds their powers.
void reset_full_forces(const SystemModel& model, const SystemState& state,
                       SystemTerms& terms);

/// Adds a force [N] and a moment [N m] at an attachment, world frame.
void add_full_wrench(const SystemModel& model, const Attachment& attachment,
                     const AttachmentMotion& motion, const Vector3& force_W,
                     const Vector3& moment_W, SystemTerms& terms);

/// Adds column i of nodal forces that rotate with the body, and their power.
void add_full_nodal_load(const SystemModel& model, const BodyLoad& load,
                         Eigen::Index i, const SystemState& state,
                         SystemTerms& terms);

/// Nodal accelerations from the forces: M^-1 (force - internal).
/// @param accelerations of all unknowns; only nodes are written
void solve_full_accelerations(const SystemModel& model,
                              const SystemTerms& terms, VectorX& accelerations);

/// M u'' + internal - force, zero at clamped nodes.
void calc_full_residual(const FullModel& full, const ConstNodes& uddot_H,
                        FullTerms& terms, Nodes residual);

}  // namespace limber::dynamics
