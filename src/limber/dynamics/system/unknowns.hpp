// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/nodal_frame.hpp"
#include "limber/dynamics/system/system_model.hpp"

/// Order of a system's unknowns in residuals, increments, velocities and
/// accelerations: body by body from BodyModel::row on three of translation (in
/// the world frame), three of rotation (in the body frame) and its modes, then
/// the nodes of unreduced bodies (in their home frames). The six rows of a body
/// without rigid motion of its own are zero.
namespace limber::dynamics {

/// Row of the first node.
[[nodiscard]] inline Eigen::Index first_node_row(const SystemModel& model) {
  return 6 * static_cast<Eigen::Index>(model.bodies.size()) + model.modal_count;
}

[[nodiscard]] inline Eigen::Index count_unknowns(const SystemModel& model) {
  return first_node_row(model) + model.nodal_count;
}

/// A zero for each unknown.
[[nodiscard]] inline VectorX make_unknowns(const SystemModel& model) {
  return VectorX::Zero(count_unknowns(model));
}

/// Rows of a body's translation, rotation and modes, and those of all nodes.
/// @param x of all unknowns, const or not
template <typename Vector>
[[nodiscard]] auto translation_rows(const BodyModel& body, Vector& x) {
  return x.template segment<3>(body.row);
}
template <typename Vector>
[[nodiscard]] auto rotation_rows(const BodyModel& body, Vector& x) {
  return x.template segment<3>(body.row + 3);
}
template <typename Vector>
[[nodiscard]] auto mode_rows(const BodyModel& body, Vector& x) {
  return x.segment(body.row + 6, body.modes);
}
template <typename Vector>
[[nodiscard]] auto nodal_rows(const SystemModel& model, Vector& x) {
  return x.tail(model.nodal_count);
}

/// Rows of the nodes of one unreduced body.
[[nodiscard]] inline ConstNodes nodal_rows(const SystemModel& model,
                                           const FullModel& full,
                                           const VectorX& x) {
  return {x.data() + first_node_row(model) + full.first, 3,
          full.mesh->node_count()};
}
[[nodiscard]] inline Nodes nodal_rows(const SystemModel& model,
                                      const FullModel& full, VectorX& x) {
  return {x.data() + first_node_row(model) + full.first, 3,
          full.mesh->node_count()};
}

}  // namespace limber::dynamics
