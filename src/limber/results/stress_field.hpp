// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/model/full_stress.hpp"

namespace limber::results {

/// Cauchy stress at nodes of a link at level `full`; at a border of materials
/// that of the first material.
class FullStressField {
 public:
  /// @param model kept by the caller
  /// @param nodes increasing
  /// @returns null below level `full`, and if its solver computes no stress
  static std::unique_ptr<FullStressField> make(
      const dynamics::SystemModel& model, dynamics::BodyIndex body,
      const std::vector<int>& nodes);

  /// 6 x nodes: xx, yy, zz, xy, yz, xz [Pa].
  [[nodiscard]] Matrix6X calc_in_world(
      const dynamics::SystemState& state) const;
  /// The same in the axes of the link's mean-axis frame.
  [[nodiscard]] Matrix6X calc_in_body(const dynamics::SystemState& state) const;

 private:
  FullStressField(const dynamics::SystemModel& model, dynamics::BodyIndex body,
                  std::shared_ptr<const flexbody::FullStress> stress);

  // Axes of the home frame.
  [[nodiscard]] Matrix6X calc_at_home(const dynamics::SystemState& state) const;

  const dynamics::SystemModel& model_;
  std::size_t full_;
  std::shared_ptr<const flexbody::FullStress> stress_;
  std::vector<Eigen::Index> first_points_;  // of each node
};

/// Whether a reduced body has stress modes for the coordinates of its
/// level.
[[nodiscard]] bool has_modal_stress(const dynamics::BodyModel& body);

/// Of stress at nodes, six rows each: xx, yy, zz, xy, yz, xz [as the stress].
[[nodiscard]] double find_largest_von_mises(const VectorX& stress);

}  // namespace limber::results
