// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"

/// Convergence of stiff joints to ideal ones (docs/theory/verification.md).
namespace limber::reference {

/// Multiplies the stiffness of the joints' constrained directions by `factor`
/// and their damping by its square root, so that damping ratios are unchanged.
/// Free directions, the laws acting on them, and other couplers are unchanged.
/// @param factor > 0 [-]
[[nodiscard]] dynamics::SystemModel stiffen_joints(dynamics::SystemModel model,
                                                   double factor);

/// How differences decrease with stiffness.
struct StiffnessTrend {
  /// Between neighbours: -d log(difference) / d log(stiffness) [-].
  std::vector<double> orders;
  /// Indices, first < last, of the longest run of differences whose orders are
  /// all within kOrderBand of 1.
  struct Row {
    std::size_t first = 0;  ///< index
    std::size_t last = 0;   ///< index
  };
  std::optional<Row> first_order;
  /// The floor: index of the difference after which the order first is below
  /// one half, not counting those before the run of first order.
  std::optional<std::size_t> floor;
};

/// Tolerance of a first order, see StiffnessTrend [-].
inline constexpr double kOrderBand = 0.05;

/// @param factors increasing, > 0 [-]
/// @param differences one per factor, > 0
[[nodiscard]] StiffnessTrend find_trend(const std::vector<double>& factors,
                                        const std::vector<double>& differences);

}  // namespace limber::reference
