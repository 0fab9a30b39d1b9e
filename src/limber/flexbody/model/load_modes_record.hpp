// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace limber::flexbody {

/// Result of converting one file of nodal forces into static-deformation modes,
/// stored with the body.
struct LoadModesRecord {
  std::string name;
  int directions = 0;    ///< number of independent static responses
  bool is_whole = true;  ///< false: there were more than examined
  int taken = 0;         ///< number used: those of most elastic energy
  /// Fraction of the omitted ones in the static responses to all columns, in
  /// the norm of elastic energy (root of the sum of squares) [-].
  double left_out = 0.0;

  bool operator==(const LoadModesRecord&) const = default;
};

/// A text if directions were omitted.
[[nodiscard]] std::optional<std::string> describe_left_out(
    const LoadModesRecord& record);

}  // namespace limber::flexbody
