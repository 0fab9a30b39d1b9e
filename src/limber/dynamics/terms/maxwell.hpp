// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_model.hpp"

/// Internal damping of a reduced body: its Maxwell elements at a state, by the
/// equations of flexbody/modal/maxwell_elements.hpp with lambda the stiffness
/// of the undeformed body's modes.
namespace limber::dynamics {

/// A body's part of SystemState::maxwell, m x J [kg^1/2 m].
[[nodiscard]] inline Eigen::Map<const MatrixX> maxwell_of(const BodyModel& body,
                                                          const VectorX& all) {
  return {all.data() + body.maxwell_offset, body.modes, body.maxwell.size()};
}
[[nodiscard]] inline Eigen::Map<MatrixX> maxwell_of(const BodyModel& body,
                                                    VectorX& all) {
  return {all.data() + body.maxwell_offset, body.modes, body.maxwell.size()};
}

/// Adds their force on the modes, of the same sign as the elastic one.
/// @param force m [kg^-1/2 N]
void add_maxwell_force(const BodyModel& body, const VectorX& all,
                       Eigen::Ref<VectorX> force);

/// [J]
[[nodiscard]] double find_maxwell_energy(const BodyModel& body,
                                         const VectorX& all);

/// Dissipated power [W].
[[nodiscard]] double find_maxwell_loss(const BodyModel& body,
                                       const VectorX& all);

/// Stretches all elements of all bodies by `fraction` times a change of the
/// modes.
void stretch_maxwell(const SystemModel& model, const VectorX& change,
                     double fraction, VectorX& all);

}  // namespace limber::dynamics
