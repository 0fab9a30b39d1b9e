// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/monitors/contact_record.hpp"

namespace limber::runs {

/// Contact of a pair of bodies in a run, over all its impacts.
struct PairContact {
  std::string pair;         ///< name, "A/B"
  int impacts = 0;          ///< count
  int touches = 0;          ///< count, sum
  double impulse = 0.0;     ///< of the normal force, sum [N s]
  double peak_force = 0.0;  ///< the largest [N]
  double duration = 0.0;    ///< sum [s]
  /// Of the impact with the largest impulse; none while it lasts [-].
  std::optional<double> restitution;
};

/// One for each pair that touched, in the order of their first touches.
[[nodiscard]] std::vector<PairContact> sum_up(
    const std::vector<dynamics::ContactRecord>& records);

/// Relative differences from the reference; for restitution the absolute one.
/// None where the reference's is zero or does not exist.
struct ContactDifference {
  std::optional<double> impulse;      ///< [-]
  std::optional<double> peak_force;   ///< [-]
  std::optional<double> duration;     ///< [-]
  std::optional<double> restitution;  ///< [-]
};
[[nodiscard]] ContactDifference find_difference(const PairContact& contact,
                                                const PairContact& reference);

}  // namespace limber::runs
