// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

/// A mesh that is cut along its length into several bodies. A piece of a mesh
/// is a mesh: recipes, reduced bodies and their files do not distinguish it
/// from others.
namespace limber::flexbody {

/// A piece of a mesh.
struct Piece {
  int count = 1;  ///< number of pieces; 1: the whole
  int index = 0;  ///< which of them, from 0; the first is at the lower end
};

/// Whether a mesh should be cut.
struct PieceAdvice {
  int count = 1;       ///< number of pieces
  std::string reason;  ///< why it stays whole
};

/// Prefix of the names of interfaces where pieces meet. Both sides of a cut
/// have the same name and the same nodes.
inline constexpr std::string_view kCutPrefix = "cut:";

[[nodiscard]] inline bool is_cut(std::string_view interface) {
  return interface.starts_with(kCutPrefix);
}

}  // namespace limber::flexbody
