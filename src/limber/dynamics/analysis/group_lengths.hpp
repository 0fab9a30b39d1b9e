// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Lengths of increments relative to the size of what moves: each group of
/// bodies that are linked to each other is measured by its own masses and
/// extent, so that a test does not depend on other bodies of the scene, nor on
/// places.
///
/// Equation   L^2 = sum_b (m |dp|^2 + m r^2 |dtheta|^2 + |deta|^2
///            + m |du|^2 / N) / sum_b m   over the bodies of a group,
///            r the radius of gyration; the group's extent is its
///            GroupExtent::reach
class GroupLengths {
 public:
  GroupLengths(const SystemModel& model, const SystemState& start);

  /// The largest over groups of L over the extent [-].
  [[nodiscard]] double measure(const VectorX& increments) const;
  /// The largest L [m].
  [[nodiscard]] double measure_length(const VectorX& increments) const;
  /// The largest extent [m].
  [[nodiscard]] double largest_extent() const;

  /// Weights of increments; their weighted norm in a group is L [m].
  [[nodiscard]] const VectorX& weights() const { return weights_; }

  /// Of forces, as rows of a residual: on the whole mass of each group that
  /// gives it the same root mean square acceleration [N].
  [[nodiscard]] VectorX measure_forces(const VectorX& residual) const;
  /// The largest over groups of that acceleration over the extent [1/s^2].
  [[nodiscard]] double measure_acceleration(const VectorX& residual) const;

 private:
  void include_body(const SystemModel& model, BodyIndex body,
                    std::size_t group);
  [[nodiscard]] VectorX sum_squares(const VectorX& weighted) const;

  std::vector<Eigen::Index> group_of_row_;
  VectorX weights_;  // of lengths [-], of rotations [m]
  VectorX extents_;  // a group each [m]
  VectorX masses_;   // a group each [kg]
};

}  // namespace limber::dynamics
