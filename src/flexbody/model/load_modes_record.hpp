// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace limber::flexbody {

/// What became of one file of nodal forces as static-deformation modes, kept
/// with the body.
struct LoadModesRecord {
  std::string name;
  int directions = 0;    ///< independent static answers that were found
  bool is_whole = true;  ///< false: there were more than were looked at
  int taken = 0;         ///< of them, those that deform the body most
  /// Of the static answers to all columns, the share in the norm of elastic
  /// energy that the others have, root of the sum of squares [-].
  double left_out = 0.0;

  bool operator==(const LoadModesRecord&) const = default;
};

/// A text if directions were left out.
[[nodiscard]] std::optional<std::string> describe_left_out(
    const LoadModesRecord& record);

}  // namespace limber::flexbody
