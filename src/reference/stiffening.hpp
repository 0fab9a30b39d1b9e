// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "dynamics/system_model.hpp"

/// Joints on their way to ideal ones (docs/theory/verification.md).
namespace limber::reference {

/// What the joints hold, `factor` > 0 times as stiff, its damping in proportion
/// to the root, so that damping ratios stay. What joints leave free and what
/// acts there stays, and so do other couplers.
[[nodiscard]] dynamics::SystemModel stiffen_joints(dynamics::SystemModel model,
                                                   double factor);

/// How differences fall as stiffness grows.
struct StiffnessTrend {
  /// Between neighbours: -d log(difference) / d log(stiffness) [-].
  std::vector<double> orders;
  /// Indices, first < last, of the longest row of differences whose orders are
  /// all within kOrderBand of 1.
  struct Row {
    std::size_t first = 0;
    std::size_t last = 0;
  };
  std::optional<Row> first_order;
  /// Index of the difference after which they first fall at less than half an
  /// order, not counting those before the row of first order: the floor.
  std::optional<std::size_t> floor;
};

inline constexpr double kOrderBand = 0.05;

/// @param factors increasing, > 0 [-]
/// @param differences one a factor, > 0
[[nodiscard]] StiffnessTrend find_trend(const std::vector<double>& factors,
                                        const std::vector<double>& differences);

}  // namespace limber::reference
