// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace limber::flexbody {

/// Error of first-order elements, which lock in bending. Stored with the
/// body.
struct MeshLocking {
  double frequency = 0.0;  ///< lowest elastic one of the mesh [Hz]
  /// That of second-order elements on the same mesh, estimated from above [Hz].
  double refined_frequency = 0.0;

  /// By how much `frequency` is too high [-].
  [[nodiscard]] double error() const {
    return frequency / refined_frequency - 1.0;
  }
  bool operator==(const MeshLocking&) const = default;
};

/// A text if the error is above 1 %.
[[nodiscard]] std::optional<std::string> describe_locking(
    const std::optional<MeshLocking>& locking);

}  // namespace limber::flexbody
