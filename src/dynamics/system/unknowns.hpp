// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_model.hpp"

/// Order of a system's unknowns in residuals, increments and factors: body by
/// body six (displacement in the world frame, rotation in the body frame) and
/// its modes, then the nodes of unreduced bodies.
namespace limber::dynamics {

/// First row of body `b`, whose modes begin six rows later.
[[nodiscard]] inline Eigen::Index first_row(const BodyModel& body,
                                            std::size_t b) {
  return 6 * static_cast<Eigen::Index>(b) + body.offset;
}

/// Row of the first node.
[[nodiscard]] inline Eigen::Index first_node_row(const SystemModel& model) {
  return 6 * static_cast<Eigen::Index>(model.bodies.size()) + model.modal_count;
}

[[nodiscard]] inline Eigen::Index count_unknowns(const SystemModel& model) {
  return first_node_row(model) + model.nodal_count;
}

}  // namespace limber::dynamics
